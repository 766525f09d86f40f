#include "fe_node/generate/discs.h"

#include <array>
#include <cmath>

#include "common/units.h"
#include "fe_node/generate/part_ids.h"

namespace crosswalk::fe::generate {

namespace {

/// A layer of the annulus: place from the middle (1: rim of the endplate), slant of its fibres to
/// the endplates [vivaplus2022], modulus of a lamella beyond its toe [skaggs1994] [L, medium].
struct Layer {
  double radius, slant_deg, modulus;
};
constexpr std::array<Layer, 3> kLayers{{{0.95, 30, 136e6}, {0.84, 37.5, 110e6}, {0.73, 45, 80e6}}};
/// Of the whole annulus, radially; half of each layer runs in either slant [E].
constexpr double kAnnulusThickness = 3.6e-3;
/// Strain over which a fibre straightens; set against axial rotation at 1 N m [panjabi2001] [E].
constexpr double kToe = 0.01;
/// Strain at which a lamella gives no more: 0.09 to 0.15 [skaggs1994]; the stress stays from there.
constexpr double kYield = 0.12;
constexpr int kFibres = 12;  ///< of one slant round a disc

/// Nucleus: share of the disc's area, and stress per axial strain. With the ground a disc has 0.5
/// to 1 MN/m; isolated discs 0.49 +- 0.47 [moroney1988] [E].
constexpr double kNucleusShare = 0.45, kNucleusModulus = 24e6;

/// Endplate outlines as ellipses; `angle` from the front, to the left.
Vec3 upper_rim(const SpineBody& body, double radius, double angle) {
  return body.at(0.5 * radius * body.upper_depth * std::cos(angle),
                 0.5 * radius * body.upper_width * std::sin(angle), 0.5 * body.height);
}
Vec3 lower_rim(const SpineBody& body, double radius, double angle) {
  return body.at(0.5 * radius * body.lower_depth * std::cos(angle),
                 0.5 * radius * body.lower_width * std::sin(angle), -0.5 * body.height);
}

class Builder {
 public:
  Builder(ModelDraft& draft, const Spine& spine) : draft_(draft), spine_(spine) {}

  void run() {
    for (std::size_t k = 0; k < kLayers.size(); ++k) add_curve(static_cast<int>(k));
    for (int level = C2; level <= T1; ++level) {
      const SpineBody &upper = spine_.bodies[level], &lower = spine_.bodies[level + 1];
      for (std::size_t k = 0; k < kLayers.size(); ++k)
        add_layer(static_cast<int>(k), level - C2, upper, lower);
      add_nucleus(level - C2, upper, lower);
    }
  }

 private:
  /// Stress over strain: a parabola over the toe, then straight.
  void add_curve(int layer) {
    CurveSpec curve{.id = part::kFirstFibre + layer,
                    .name = "annulus fibres",
                    .points = {{-1, 0}, {0, 0}},
                    .axes = CurveAxes::StressOverStrain};
    const double modulus = kLayers[layer].modulus;
    for (const double share : {0.25, 0.5, 0.75, 1.0})
      curve.points.emplace_back(share * kToe, 0.5 * modulus * kToe * share * share);
    const double peak = modulus * (kYield - 0.5 * kToe);
    curve.points.insert(curve.points.end(), {{kYield, peak}, {2, peak}});
    draft_.curves.push_back(curve);
  }

  void add_line(int part, const SpineBody& lower, const Vec3& a, const SpineBody& upper,
                const Vec3& b) {
    const int from = draft_.mesh.add_node(a), to = draft_.mesh.add_node(b);
    draft_.mesh.attach(lower.part, {from});
    draft_.mesh.attach(upper.part, {to});
    draft_.mesh.lines.push_back({from, to, part});
  }

  void add_layer(int layer, int disc, const SpineBody& upper, const SpineBody& lower) {
    const Layer& data = kLayers[layer];
    const int id = part::kFirstFibre + 10 * disc + layer;
    const double slant = data.slant_deg * kDegree, step = 2 * kPi / kFibres;
    double area = 0;
    for (int k = 0; k < kFibres; ++k) {
      const double angle = (k + 0.5) * step;
      const double height =
          (lower_rim(upper, data.radius, angle) - upper_rim(lower, data.radius, angle)).norm();
      // Way along the rim per angle.
      const double speed = (upper_rim(lower, data.radius, angle + 0.5 * step) -
                            upper_rim(lower, data.radius, angle - 0.5 * step))
                               .norm() /
                           step;
      const double half_way = 0.5 * height / std::tan(slant) / speed;
      for (const double sense : {-1.0, 1.0})
        add_line(id, lower, upper_rim(lower, data.radius, angle - sense * half_way), upper,
                 lower_rim(upper, data.radius, angle + sense * half_way));
      area += speed * step * std::sin(slant) * spine_.scale * kAnnulusThickness /
              (2 * kLayers.size() * kFibres);
    }
    draft_.parts.push_back(
        {.id = id,
         .name = "annulus_" + upper.name + lower.name + "_" + std::to_string(layer + 1),
         .density = 0,
         .law = mat::CableDiscreteBeam{.youngs = data.modulus,
                                       .curve = DeckId(part::kFirstFibre + layer)},
         .section = CableSection{.area = area},
         .source = "lamellae of Skaggs 1994, slants of VIVA+",
         .grade = Grade::Literature});
  }

  void add_nucleus(int disc, const SpineBody& upper, const SpineBody& lower) {
    const int id = part::kFirstNucleus + disc;
    const Vec3 a = lower.at(0, 0, 0.5 * lower.height), b = upper.at(0, 0, -0.5 * upper.height);
    const double area = 0.25 * kPi * lower.upper_width * lower.upper_depth;
    const double stiffness = kNucleusModulus * kNucleusShare * area / (b - a).norm();
    draft_.curves.push_back({.id = id,
                             .name = "nucleus",
                             .points = {{-1e-2, -1e-2 * stiffness}, {0, 0}, {1e-2, 0}, {2e-2, 0}}});
    draft_.parts.push_back(
        {.id = id,
         .name = "nucleus_" + upper.name + lower.name,
         .density = 0,
         .law = mat::SpringNonlinearElastic{.curve = DeckId(id), .rate_curve = {}},
         .section = SpringSection{},
         .source = "fluid, no bending; set against Moroney 1988",
         .grade = Grade::Estimate});
    add_line(id, lower, a, upper, b);
  }

  ModelDraft& draft_;
  const Spine& spine_;
};

}  // namespace

PartSpec disc_ground(int id, const std::string& name) {
  return {
      .id = id,
      .name = name,
      .density = 1100,
      .law =
          mat::Viscoelastic{.bulk = 1.7e6, .shear_short = 0.5e6, .shear_long = 0.35e6, .decay = 20},
      .section = SolidSection{},
      .source = "matrix of the annulus; K of its 55 % of the area",
      .grade = Grade::Literature};
}

void add_disc_fibres(ModelDraft& draft, const Spine& spine) { Builder(draft, spine).run(); }

}  // namespace crosswalk::fe::generate
