#include "fe_node/element/hex8.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "fe_node/element/hex8_block.h"

namespace crosswalk::fe {
namespace {

constexpr double kXi[8] = {-1, 1, 1, -1, -1, 1, 1, -1};
constexpr double kEta[8] = {-1, -1, 1, 1, -1, -1, 1, 1};
constexpr double kZeta[8] = {-1, -1, -1, -1, 1, 1, 1, 1};

void set_reference(const Vec3 (&x)[8], HexReference<double>& ref, HexMetric<double>& bound) {
  Vec3 B[8];
  hex8_volume_gradient(x, B);
  const double volume = hex8_volume(x);
  Mat3 metric = Mat3::Zero();
  for (const Vec3& b : B) metric += b * b.transpose() / (volume * volume);
  ref.volume = volume;
  ref.inverse_volume = 1.0 / volume;
  ref.length = std::cbrt(volume);
  for (int node = 0; node < 8; ++node)
    for (int i = 0; i < 3; ++i) ref.gradient[node][i] = B[node][i];
  const double* signs[4][2] = {{kEta, kZeta}, {kXi, kZeta}, {kXi, kEta}, {nullptr, nullptr}};
  for (int a = 0; a < 4; ++a) {
    Vec3 sum = Vec3::Zero();
    for (int node = 0; node < 8; ++node)
      sum +=
          (a < 3 ? signs[a][0][node] * signs[a][1][node] : kXi[node] * kEta[node] * kZeta[node]) *
          x[node];
    for (int i = 0; i < 3; ++i) ref.hourglass[a][i] = sum[i];
  }
  const double entries[6] = {metric(0, 0), metric(1, 1), metric(2, 2),
                             metric(0, 1), metric(1, 2), metric(2, 0)};
  std::copy_n(entries, 6, bound.entries);
  ref.hourglass_scale = volume * metric.trace() / 8;
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

template <class N>
HexShapes<N> make_hex_shapes(const ElementBlock& block, const Mesh& mesh) {
  HexShapes<N> shapes;
  shapes.packs.resize(block.group_count() / kGroupsPerPack<N>);
  shapes.metrics.resize(shapes.packs.size());
  shapes.volume.resize(block.element_count());
  for (int slot = 0; slot < block.group_count() * kLanes; ++slot) {
    Vec3 x[8];
    for (int corner = 0; corner < 8; ++corner)
      x[corner] = mesh.position[block.node(slot / kLanes, corner, slot % kLanes)];
    HexReference<double> ref;
    HexMetric<double> metric;
    set_reference(x, ref, metric);
    CW_ASSERT(ref.volume > 0);  // the model builder refuses such elements with their place
    if (slot < block.element_count()) shapes.volume[slot] = ref.volume;
    set_lane(ref, slot % kWidth<N>, shapes.packs[slot / kWidth<N>]);
    set_lane(metric, slot % kWidth<N>, shapes.metrics[slot / kWidth<N>]);
  }
  return shapes;
}

template HexShapes<Lanes> make_hex_shapes(const ElementBlock&, const Mesh&);
template HexShapes<SingleLanes> make_hex_shapes(const ElementBlock&, const Mesh&);

std::unique_ptr<ElementBlock> make_hex8_block(const Mesh& mesh, int part, std::vector<int> elements,
                                              const SolidLaw& law,
                                              const ElementControls& controls) {
  return std::visit(
      [&](const auto& l) -> std::unique_ptr<ElementBlock> {
        using Law = std::decay_t<decltype(l)>;
        if (controls.precision == Precision::Single)
          return std::make_unique<Hex8Block<SingleLanes, Law>>(mesh, part, std::move(elements), l,
                                                               controls);
        return std::make_unique<Hex8Block<Lanes, Law>>(mesh, part, std::move(elements), l,
                                                       controls);
      },
      law);
}

}  // namespace crosswalk::fe
