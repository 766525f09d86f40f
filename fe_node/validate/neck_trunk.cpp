#include "fe_node/validate/neck_trunk.h"

#include <iterator>
#include <limits>
#include <vector>

#include "fe_node/generate/part_ids.h"
#include "fe_node/validate/head_draft.h"

namespace crosswalk::fe::validate {
namespace {

namespace part = generate::part;

constexpr int kFirstContact = 7101, kGiven = 7150, kActivation = 7200;
constexpr double kReach = 10;  ///< m; a point that slides by 0.2 m meets its plane 2 mm late

/// Force over depth, m and N: skin and muscle, then ribs or the shoulder girdle give way at 90
/// N/mm; a third of it comes back [E].
constexpr std::pair<double, double> kFlesh[] = {
    {0.005, 50}, {0.010, 200}, {0.020, 700}, {0.040, 2500}};
constexpr std::pair<double, double> kGivenBack[] = {{-1, 1}, {-0.1, 1}, {0.1, 0.33}, {1, 0.33}};

struct Plane {
  Vec3 point, normal;
  std::vector<Vec3> meets;  ///< the head's outermost points in these directions
};

std::vector<Plane> planes() {
  // Above the breastbone's upper edge at (71, 0, -24) mm and the acromia at (-25, +-166, -26) mm
  // [vivaplus2022], under 10 to 15 mm of skin and muscle [E].
  std::vector<Plane> out{{Vec3(0.080, 0, -0.015),
                          Vec3(0.7, 0, 0.714),
                          {Vec3(0.5, 0, -0.87), Vec3(0.4, 0.4, -0.82), Vec3(0.4, -0.4, -0.82)}}};
  for (const double side : {1.0, -1.0})
    out.push_back({Vec3(0, 0.100 * side, 0.015),
                   Vec3(0, 0.26 * side, 0.966),
                   {Vec3(0.2, 0.95 * side, 0), Vec3(-0.3, 0.95 * side, 0),
                    Vec3(0.4, 0.7 * side, -0.6), Vec3(0, 0.95 * side, 0.3)}});
  return out;
}

Vec3 outermost(const generate::ModelDraft& draft, const Vec3& direction) {
  Vec3 best = Vec3::Zero();
  double farthest = -std::numeric_limits<double>::infinity();
  for (const generate::Hex& hex : draft.mesh.hexes) {
    if (hex.part != rigid_skull_part()) continue;
    for (const int n : hex.node)
      if (const double along = draft.mesh.nodes[n].dot(direction); along > farthest) {
        farthest = along;
        best = draft.mesh.nodes[n];
      }
  }
  return best;
}

}  // namespace

void add_trunk(generate::ModelDraft& draft) {
  generate::CurveSpec given{.id = kGiven,
                            .name = "loss",
                            .points = {std::begin(kGivenBack), std::end(kGivenBack)},
                            .axes = generate::CurveAxes::FactorOverVelocity};
  draft.curves.push_back(given);
  int id = kFirstContact;
  for (const Plane& plane : planes()) {
    const Vec3 normal = plane.normal.normalized();
    for (const Vec3& direction : plane.meets) {
      const Vec3 on_head = outermost(draft, direction.normalized());
      const double gap = (on_head - plane.point).dot(normal);
      generate::CurveSpec curve{.id = id, .name = "trunk contact", .points = {}};
      for (int i = 3; i >= 0; --i)
        curve.points.emplace_back(-gap - kFlesh[i].first, -kFlesh[i].second);
      curve.points.insert(curve.points.end(), {{-gap, 0}, {1, 0}, {2, 0}});
      draft.curves.push_back(curve);
      draft.parts.push_back(
          {.id = id,
           .name = "trunk_contact_" + std::to_string(id - kFirstContact + 1),
           .density = 0,
           .law = mat::SpringNonlinearElastic{.curve = DeckId(id), .rate_curve = DeckId(kGiven)},
           .section = generate::SpringSection{},
           .source = "chest or shoulder under the head",
           .grade = generate::Grade::Estimate});
      const int below = draft.mesh.add_node(on_head - (gap + kReach) * normal);
      const int head = draft.mesh.add_node(on_head);
      draft.mesh.attach(part::kBlockTorsoUp, {below});
      draft.mesh.attach(rigid_skull_part(), {head});
      draft.mesh.lines.push_back({below, head, id});
      ++id;
    }
  }
}

void activate_muscles(generate::ModelDraft& draft, const Points& activation) {
  draft.curves.push_back({.id = kActivation,
                          .name = "activation",
                          .points = activation,
                          .axes = generate::CurveAxes::FactorOverTime});
  for (generate::PartSpec& spec : draft.parts)
    if (auto* muscle = std::get_if<mat::Muscle>(&spec.law)) muscle->activation = -kActivation;
}

Points volunteer(double start) {
  constexpr double kTone = 0.035, kReflex = 0.6, kDelay = 0.075, kRise = 0.010;
  return {{0, kTone}, {start + kDelay, kTone}, {start + kDelay + kRise, kReflex}, {1, kReflex}};
}

}  // namespace crosswalk::fe::validate
