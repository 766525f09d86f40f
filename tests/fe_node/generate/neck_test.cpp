// Discs, facets, ligaments and strands of the generated neck against closed forms.
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "common/curve.h"
#include "common/units.h"
#include "fe_node/generate/head_neck.h"
#include "fe_node/generate/muscles_data.h"
#include "fe_node/generate/part_ids.h"

namespace crosswalk::fe::generate {
namespace {

const HeadNeck& reference() {
  static const HeadNeck model = build_head_neck({});
  return model;
}

Curve curve_of(int id) {
  for (const CurveSpec& spec : reference().draft.curves) {
    if (spec.id != id) continue;
    std::vector<double> x, y;
    for (const auto& [a, b] : spec.points) {
      x.push_back(a);
      y.push_back(b);
    }
    return Curve(x, y, Curve::Outside::LastSlope);
  }
  return {};
}

/// Force of a spring part at an elongation, N.
double spring_force(const PartSpec& part, double elongation) {
  return curve_of(std::get<mat::SpringNonlinearElastic>(part.law).curve.value).value(elongation);
}

// Straight fibres between two circles of radius r at height h, their ends b apart in angle: length
// l = sqrt(h2 + 2 r2 (1 - cos b)), torque of a pull F on it F r2 sin b / l. A twist lengthens one
// of the two slants. The discs are nearly round and wedge-shaped, so the mean rim stands for all.
TEST(Discs, FibresBearTorsionAsThinTubesDo) {
  const Spine& spine = reference().spine;
  const MeshDraft& mesh = reference().draft.mesh;
  constexpr double kTwist = 0.07;
  for (int level = C2; level <= C7; ++level) {
    const SpineBody &upper = spine.bodies[level], &lower = spine.bodies[level + 1];
    const Vec3 centre = spine.disc_centre(static_cast<Level>(level));
    const Vec3 axis =
        (upper.X_NB.R() * Vec3::UnitZ() + lower.X_NB.R() * Vec3::UnitZ()).normalized();
    const Mat3 turn = exp_rotation(kTwist * axis).toRotationMatrix();
    double torque = 0;
    for (const Line& line : mesh.lines) {
      if (line.part < part::kFirstFibre + 10 * (level - C2) ||
          line.part > part::kFirstFibre + 10 * (level - C2) + 2)
        continue;
      const PartSpec& spec = reference().draft.part(line.part);
      const Vec3 a = mesh.nodes[line.from], b = mesh.nodes[line.to];
      const Vec3 moved = centre + turn * (b - centre);
      const double rest = (b - a).norm(), length = (moved - a).norm();
      const double stress =
          curve_of(std::get<mat::CableDiscreteBeam>(spec.law).curve.value).value(length / rest - 1);
      const Vec3 force = stress * std::get<CableSection>(spec.section).area * (a - moved) / length;
      torque -= axis.dot((moved - centre).cross(force));
    }
    const double height =
        (upper.at(0, 0, -0.5 * upper.height) - lower.at(0, 0, 0.5 * lower.height)).norm();
    const double rim =
        0.125 * (upper.lower_depth + upper.lower_width + lower.upper_depth + lower.upper_width);
    double expected = 0;
    const double radius[] = {0.95, 0.84, 0.73}, slant[] = {30, 37.5, 45},
                 modulus[] = {136e6, 110e6, 80e6};
    for (int k = 0; k < 3; ++k) {
      const double r = radius[k] * rim, angle = height / std::tan(slant[k] * kDegree) / r;
      const auto length = [&](double b) {
        return std::sqrt(height * height + 2 * r * r * (1 - std::cos(b)));
      };
      const double turned = length(angle + kTwist);
      const double stress = modulus[k] * (turned / length(angle) - 1 - 0.005);
      const double wall = 0.6e-3 * 2 * kPi * r * std::sin(slant[k] * kDegree);
      expected += stress * wall * r * r * std::sin(angle + kTwist) / turned;
    }
    EXPECT_NEAR(torque / expected, 1, 0.12) << upper.name;
  }
}

TEST(Facets, StayClosedWhereverTheySlide) {
  const Spine& spine = reference().spine;
  const MeshDraft& mesh = reference().draft.mesh;
  int points = 0;
  for (const Line& line : mesh.lines) {
    if (reference().draft.part(line.part).name != "facets") continue;
    ++points;
    // `to` lies on the upper body, `from` below the plane of the lower one.
    const Vec3 a = mesh.nodes[line.from], b = mesh.nodes[line.to];
    const Vec3 normal = (b - a).normalized();
    for (const Vec3& along : {normal.unitOrthogonal(), normal.cross(normal.unitOrthogonal())}) {
      const double lift = (b + 6e-3 * along - a).norm() - (b - a).norm();
      EXPECT_LT(lift, 0.2e-3);
    }
    const PartSpec& part = reference().draft.part(line.part);
    EXPECT_EQ(spring_force(part, -0.45e-3), 0);
    EXPECT_LT(spring_force(part, -0.8e-3), -50);
    EXPECT_EQ(spring_force(part, 3e-3), 0);
  }
  EXPECT_EQ(points, 7 * 2 * 4);
  // At C3 they face the mid-plane, below C5 outwards.
  EXPECT_LT(spine.facet_normal(C2, 1).y(), -0.3);
  EXPECT_GT(spine.facet_normal(C6, 1).y(), 0.05);
  EXPECT_EQ(spine.facet_normal(C3, 1).y(), -spine.facet_normal(C3, -1).y());
}

// Whole ligaments pulled along their lines: failure force (N) and elongation (mm) of ligament tests
// and the stiffness about half of it, N/mm, as the shape of the curve has it.
TEST(Ligaments, PulledFailWhereTestsSayTheyDo) {
  struct Expected {
    double force, elongation;
  };
  const std::map<std::string, Expected> expected{{"ALL_C4C5", {250, 6}}, {"PLL_C4C5", {250, 4.5}},
                                                 {"LF_C4C5", {130, 6}},  {"CL_C4C5", {200, 7}},
                                                 {"ISL_C4C5", {60, 6}},  {"alar", {428, 6}}};
  for (const auto& [name, e] : expected) {
    for (const PartSpec& part : reference().draft.parts) {
      if (part.name != name) continue;
      int lines = 0;
      for (const Line& line : reference().draft.mesh.lines) lines += line.part == part.id ? 1 : 0;
      const auto pull = [&](double mm) { return lines * spring_force(part, 1e-3 * mm); };
      EXPECT_NEAR(pull(e.elongation), e.force, 1e-6 * e.force) << name;
      EXPECT_LT(pull(1.3 * e.elongation), e.force) << name;
      EXPECT_EQ(pull(-1), 0) << name;
      const double stiffness =
          (pull(0.6 * e.elongation) - pull(0.4 * e.elongation)) / (0.2 * e.elongation);
      EXPECT_NEAR(stiffness, 1.4 * e.force / e.elongation, 0.01 * stiffness) << name;
      // Fast pulls are stiffer, slack ones are not.
      const Curve rate = curve_of(std::get<mat::SpringNonlinearElastic>(part.law).rate_curve.value);
      EXPECT_NEAR(rate.value(0), 1, 1e-12);
      EXPECT_NEAR(rate.value(-1), 1, 1e-12);
      EXPECT_GT(rate.value(1), 1.2);
    }
  }
}

TEST(Strands, AreAsLongAsTheStraightWayAndHeldByTheirVertebrae) {
  const MeshDraft& mesh = reference().draft.mesh;
  std::map<int, int> body;
  for (const RigidAttachment& a : mesh.attachments)
    for (const int n : a.nodes) body[n] = a.part;
  // Chains are lines that follow each other.
  int held = 0;
  for (std::size_t i = 0; i < mesh.lines.size();) {
    const Line& first = mesh.lines[i];
    std::size_t last = i;
    double length = (mesh.nodes[first.from] - mesh.nodes[first.to]).norm();
    while (last + 1 < mesh.lines.size() && mesh.lines[last + 1].part == first.part &&
           mesh.lines[last + 1].from == mesh.lines[last].to) {
      ++last;
      length += (mesh.nodes[mesh.lines[last].from] - mesh.nodes[mesh.lines[last].to]).norm();
      EXPECT_NE(body[mesh.lines[last].from], body[mesh.lines[last].to]);
      ++held;
    }
    EXPECT_NEAR(length, (mesh.nodes[first.from] - mesh.nodes[mesh.lines[last].to]).norm(), 1e-9);
    if (last > i) {
      EXPECT_TRUE(reference().draft.part(first.part).is_strand);
    }
    i = last + 1;
  }
  EXPECT_GT(held, 60);
}

}  // namespace
}  // namespace crosswalk::fe::generate
