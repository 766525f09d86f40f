#include "fe_node/element/hex8.h"

#include <cmath>

#include "common/error.h"
#include "fe_node/element/hex8_block.h"

namespace crosswalk::fe {
namespace {

constexpr double kXi[8] = {-1, 1, 1, -1, -1, 1, 1, -1};
constexpr double kEta[8] = {-1, -1, 1, 1, -1, -1, 1, 1};
constexpr double kZeta[8] = {-1, -1, -1, -1, 1, 1, 1, 1};

/// Undeformed shape of one element, written into one lane.
void set_reference(const Vec3 (&x)[8], double density, int lane, HexReference<Lanes>& ref) {
  Vec3 B[8];
  hex8_volume_gradient(x, B);
  const double volume = hex8_volume(x);
  Mat3 metric = Mat3::Zero();
  for (const Vec3& b : B) metric += b * b.transpose() / (volume * volume);
  ref.volume[lane] = volume;
  ref.inverse_volume[lane] = 1.0 / volume;
  ref.length[lane] = std::cbrt(volume);
  ref.density[lane] = density;
  for (int node = 0; node < 8; ++node)
    for (int i = 0; i < 3; ++i) ref.gradient[node][i][lane] = B[node][i];
  const double* signs[4][2] = {{kEta, kZeta}, {kXi, kZeta}, {kXi, kEta}, {nullptr, nullptr}};
  for (int a = 0; a < 4; ++a) {
    Vec3 sum = Vec3::Zero();
    for (int node = 0; node < 8; ++node)
      sum +=
          (a < 3 ? signs[a][0][node] * signs[a][1][node] : kXi[node] * kEta[node] * kZeta[node]) *
          x[node];
    for (int i = 0; i < 3; ++i) ref.hourglass[a][i][lane] = sum[i];
  }
  const double entries[6] = {metric(0, 0), metric(1, 1), metric(2, 2),
                             metric(0, 1), metric(1, 2), metric(2, 0)};
  for (int k = 0; k < 6; ++k) ref.metric[k][lane] = entries[k];
}

}  // namespace

// The volume is the sum of six times the triple products of a trilinear brick; its gradient is the
// closed form of [flanagan1981, eq. 16], whose other entries follow by cyclic node permutations.
void hex8_volume_gradient(const Vec3 (&x)[8], Vec3 (&gradient)[8]) {
  constexpr int kPermutation[8][8] = {{0, 1, 2, 3, 4, 5, 6, 7}, {1, 2, 3, 0, 5, 6, 7, 4},
                                      {2, 3, 0, 1, 6, 7, 4, 5}, {3, 0, 1, 2, 7, 4, 5, 6},
                                      {4, 7, 6, 5, 0, 3, 2, 1}, {5, 4, 7, 6, 1, 0, 3, 2},
                                      {6, 5, 4, 7, 2, 1, 0, 3}, {7, 6, 5, 4, 3, 2, 1, 0}};
  for (int node = 0; node < 8; ++node) {
    const int* p = kPermutation[node];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      auto y = [&](int n) { return x[p[n]][j]; };
      auto z = [&](int n) { return x[p[n]][k]; };
      gradient[node][i] =
          (y(1) * ((z(5) - z(2)) - (z(3) - z(4))) + y(2) * (z(1) - z(3)) +
           y(3) * ((z(2) - z(7)) - (z(4) - z(1))) + y(4) * ((z(7) - z(5)) - (z(1) - z(3))) +
           y(5) * (z(4) - z(1)) + y(7) * (z(3) - z(4))) /
          12.0;
    }
  }
}

double hex8_volume(const Vec3 (&x)[8]) {
  Vec3 gradient[8];
  hex8_volume_gradient(x, gradient);
  double volume = 0;
  for (int node = 0; node < 8; ++node) volume += x[node].x() * gradient[node].x();
  return volume;
}

HexShapes make_hex_shapes(const ElementBlock& block, const Mesh& mesh, double density,
                          double bulk_modulus, double shear_modulus, double minimum_step) {
  HexShapes shapes;
  shapes.groups.resize(block.group_count());
  shapes.added_density.resize(block.element_count());
  Tensor<Lanes> identity;
  for (int k = 0; k < 9; ++k) identity(k / 3, k % 3) = Lanes::Constant(k % 4 == 0 ? 1.0 : 0.0);
  for (int group = 0; group < block.group_count(); ++group) {
    HexReference<Lanes>& ref = shapes.groups[group];
    for (int lane = 0; lane < kLanes; ++lane) {
      Vec3 x[8];
      for (int node = 0; node < 8; ++node) x[node] = mesh.position[block.node(group, node, lane)];
      set_reference(x, density, lane, ref);
      CW_ASSERT(ref.volume[lane] > 0);  // the model builder refuses such elements with their place
    }
    const Lanes squared =
        hex_stable_step_squared(ref, identity, constant<Lanes>(1), constant<Lanes>(bulk_modulus),
                                constant<Lanes>(shear_modulus));
    const Lanes lacking = larger(Lanes(minimum_step * minimum_step / squared), constant<Lanes>(1));
    ref.density *= lacking;
    for (int lane = 0; lane < kLanes; ++lane) {
      const int element = group * kLanes + lane;
      if (element < block.element_count())
        shapes.added_density[element] = ref.density[lane] - density;
    }
  }
  return shapes;
}

void find_inverted(const Lanes& J, int first_element, int element_count, BlockSums& sums) {
  if (sums.inverted_element >= 0) return;
  for (int lane = kLanes - 1; lane >= 0; --lane)
    if (!(J[lane] > 0)) {
      sums.inverted_element = std::min(first_element + lane, element_count - 1);
      sums.inverted_jacobian = J[lane];
    }
}

std::unique_ptr<ElementBlock> make_hex8_block(const Mesh& mesh, int part, std::vector<int> elements,
                                              const SolidLaw& law,
                                              const ElementControls& controls) {
  return std::visit(
      [&](const auto& l) -> std::unique_ptr<ElementBlock> {
        using Law = std::decay_t<decltype(l)>;
        return std::make_unique<Hex8Block<Law>>(mesh, part, std::move(elements), l, controls);
      },
      law);
}

}  // namespace crosswalk::fe
