#include "fe_node/element/beam.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/error.h"

namespace crosswalk::fe {
namespace {

/// Per element: the triads of both ends as quaternions (x y z w), and the work stored.
enum Slot { kEnds = 0, kEnergy = 8, kSlots };

/// Rotation vector of a rotation below pi.
Vec3 rotation_vector(const Mat3& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

/// Triad with x along `axis` and y in the half-plane of `in_plane`.
Mat3 triad(const Vec3& axis, const Vec3& in_plane) {
  Mat3 E;
  E.col(0) = axis.normalized();
  E.col(2) = E.col(0).cross(in_plane).normalized();
  E.col(1) = E.col(2).cross(E.col(0));
  return E;
}

class BeamBlock final : public ElementBlock {
 public:
  BeamBlock(const Mesh& mesh, int part, std::vector<int> elements, const BeamSection& section,
            std::span<const Vec3> in_plane)
      : ElementBlock(mesh, ElementKind::Line2, part, std::move(elements)), section_(section) {
    CW_ASSERT(static_cast<int>(in_plane.size()) == element_count());
    for (int e = 0; e < element_count(); ++e) {
      const Vec3 span = mesh.position[end(e, 1)] - mesh.position[end(e, 0)];
      length_.push_back(span.norm());
      start_.push_back(triad(span, in_plane[e]));
    }
  }

  bool has_moments() const override { return true; }
  int history_per_group() const override { return kSlots * kLanes; }
  void initialise(std::span<double> history) const override {
    for (int e = 0; e < element_count(); ++e)
      for (int corner = 0; corner < 2; ++corner) set_end(history, e, corner, Quat(start_[e]));
  }
  double corner_mass(int element) const override {
    return 0.5 * section_.density * element_volume(element);
  }
  double corner_inertia(int element) const override {
    const double gyration = std::max(section_.inertia_ss, section_.inertia_tt) / section_.area;
    return corner_mass(element) * (length_[element] * length_[element] / 12 + gyration);
  }
  double element_volume(int element) const override { return section_.area * length_[element]; }
  double density() const override { return section_.density; }

  void forces(const StepContext& step, std::span<double> history, std::span<double> corner_forces,
              std::span<double> corner_moments, int first, int last,
              BlockSums& sums) const override;

  /// By the largest frequency of the element alone: stretching, twisting, and in each plane the
  /// symmetric and the antisymmetric bending mode.
  double initial_stiffness(int e) const override {
    const double L = length_[e], m = 2 * corner_mass(e), j = corner_inertia(e);
    double omega2 = 4 * section_.youngs_modulus * section_.area / (L * m);
    omega2 = std::max(omega2, 2 * section_.shear_modulus * section_.torsion / (L * j));
    for (double I : {section_.inertia_ss, section_.inertia_tt}) {
      const double EI = section_.youngs_modulus * I;
      omega2 = std::max(omega2, 2 * EI / (L * j));
      const double k = 12 * EI / (L * (1 + shear_share(I, L)));
      omega2 = std::max(omega2, k * (1 / (2 * j) + 4 / (L * L * m)));
    }
    return corner_mass(e) * omega2;
  }

  ElementSample sample(const StepContext& step, std::span<const double> history,
                       int element) const override {
    ElementSample out;
    const Vec3 a = step.nodes[end(element, 0)].position(),
               b = step.nodes[end(element, 1)].position();
    out.centre = 0.5 * (a + b);
    out.volume = element_volume(element);
    const double strain = (b - a).norm() / length_[element] - 1;
    const Vec3 axis = (b - a).normalized();
    out.stress = section_.youngs_modulus * strain * axis * axis.transpose();  // of the axis
    out.deformation(0, 0) = 1 + strain;
    out.energy = slot(history, element, kEnergy);
    return out;
  }

 private:
  int end(int element, int corner) const {
    return node(element / kLanes, corner, element % kLanes);
  }
  static std::size_t place(int element, int which) {
    return static_cast<std::size_t>(element / kLanes * kSlots + which) * kLanes + element % kLanes;
  }
  static double slot(std::span<const double> history, int element, int which) {
    return history[place(element, which)];
  }
  static Quat end_triad(std::span<const double> history, int element, int corner) {
    const int at = kEnds + 4 * corner;
    return {slot(history, element, at + 3), slot(history, element, at),
            slot(history, element, at + 1), slot(history, element, at + 2)};
  }
  static void set_end(std::span<double> history, int element, int corner, const Quat& q) {
    for (int k = 0; k < 4; ++k) history[place(element, kEnds + 4 * corner + k)] = q.coeffs()[k];
  }
  /// 12 E I / (G A_s L^2)
  double shear_share(double I, double L) const {
    if (section_.shear_area <= 0) return 0;
    return 12 * section_.youngs_modulus * I /
           (section_.shear_modulus * section_.shear_area * L * L);
  }

  BeamSection section_;
  std::vector<double> length_;
  std::vector<Mat3> start_;
};

/// End moments of one plane from the end rotations against the chord.
struct EndMoments {
  double first, second, energy;
  EndMoments(double EI, double L, double share, double a, double b) {
    const double k = EI / (L * (1 + share));
    first = k * ((4 + share) * a + (2 - share) * b);
    second = k * ((2 - share) * a + (4 + share) * b);
    energy = 0.5 * (first * a + second * b);
  }
};

void BeamBlock::forces(const StepContext& step, std::span<double> history,
                       std::span<double> corner_forces, std::span<double> corner_moments, int first,
                       int last, BlockSums& sums) const {
  for (int e = first * kLanes; e < std::min(last * kLanes, element_count()); ++e) {
    Mat3 T[2];
    for (int corner = 0; corner < 2; ++corner) {
      const Quat turned =
          (exp_rotation(step.dt * step.spin[end(e, corner)]) * end_triad(history, e, corner))
              .normalized();
      set_end(history, e, corner, turned);
      T[corner] = turned.toRotationMatrix();
    }
    const Vec3 chord = step.nodes[end(e, 1)].position() - step.nodes[end(e, 0)].position();
    const double length = chord.norm(), L = length_[e];
    const Mat3 E = triad(chord, T[0].col(1) + T[1].col(1));
    const Vec3 a = rotation_vector(E.transpose() * T[0]), b = rotation_vector(E.transpose() * T[1]);

    const double stretch = length - L, twist = b.x() - a.x();
    const double N = section_.youngs_modulus * section_.area / L * stretch;
    const double torque = section_.shear_modulus * section_.torsion / L * twist;
    // rotation about y (s) bends with I_ss, about z (t) with I_tt
    const EndMoments s(section_.youngs_modulus * section_.inertia_ss, L,
                       shear_share(section_.inertia_ss, L), a.y(), b.y());
    const EndMoments t(section_.youngs_modulus * section_.inertia_tt, L,
                       shear_share(section_.inertia_tt, L), a.z(), b.z());
    const double energy = 0.5 * N * stretch + 0.5 * torque * twist + s.energy + t.energy;
    history[place(e, kEnergy)] = energy;

    // Loads on the second node; the first one's force is the opposite. Moments balance about it.
    const Vec3 force = E * Vec3(-N, (t.first + t.second) / length, -(s.first + s.second) / length);
    const Vec3 moments[2] = {E * Vec3(torque, -s.first, -t.first),
                             E * Vec3(-torque, -s.second, -t.second)};
    const double stiffness = initial_stiffness(e);
    for (int corner = 0; corner < 2; ++corner) {
      const std::size_t at = corner_slot(e / kLanes - first, corner, e % kLanes);
      Eigen::Map<Vec3>{corner_forces.data() + at} = corner == 1 ? force : Vec3(-force);
      Eigen::Map<Vec3>{corner_moments.data() + at} = moments[corner];
      corner_forces[at + kCornerStiffness] = stiffness;
      corner_moments[at + kCornerStiffness] = stiffness * corner_inertia(e) / corner_mass(e);
    }
    sums.internal += energy;
    if (!(length > 0) || !std::isfinite(energy)) {
      if (sums.inverted_element < 0) sums.inverted_element = e;
      sums.inverted_jacobian = length / L;
    }
    sums.limit(e, initial_stable_step(e));
  }
}

}  // namespace

BeamSection rectangular_beam(double density, double youngs_modulus, double poisson_ratio,
                             double width_s, double width_t) {
  BeamSection out;
  out.density = density;
  out.youngs_modulus = youngs_modulus;
  out.shear_modulus = 0.5 * youngs_modulus / (1 + poisson_ratio);
  out.area = width_s * width_t;
  out.shear_area = 5.0 / 6.0 * out.area;
  out.inertia_ss = width_s * std::pow(width_t, 3) / 12;
  out.inertia_tt = width_t * std::pow(width_s, 3) / 12;
  // Roark's series for a solid rectangle 2a x 2b, a >= b [young2012, table 10.7]
  const double a = 0.5 * std::max(width_s, width_t), b = 0.5 * std::min(width_s, width_t);
  out.torsion = a * b * b * b * (16.0 / 3 - 3.36 * b / a * (1 - std::pow(b / a, 4) / 12));
  return out;
}

BeamSection tubular_beam(double density, double youngs_modulus, double poisson_ratio, double outer,
                         double inner) {
  BeamSection out;
  out.density = density;
  out.youngs_modulus = youngs_modulus;
  out.shear_modulus = 0.5 * youngs_modulus / (1 + poisson_ratio);
  out.area = std::numbers::pi / 4 * (outer * outer - inner * inner);
  out.shear_area = (inner > 0 ? 0.5 : 0.9) * out.area;
  out.inertia_ss = out.inertia_tt =
      std::numbers::pi / 64 * (std::pow(outer, 4) - std::pow(inner, 4));
  out.torsion = 2 * out.inertia_ss;
  return out;
}

std::unique_ptr<ElementBlock> make_beam_block(const Mesh& mesh, int part, std::vector<int> elements,
                                              const BeamSection& section,
                                              std::span<const Vec3> in_plane) {
  return std::make_unique<BeamBlock>(mesh, part, std::move(elements), section, in_plane);
}

}  // namespace crosswalk::fe
