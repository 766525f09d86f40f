// Published and closed-form impacts: Taylor's bar, and a sphere on a laminated pane.
#include <numbers>

#include <gtest/gtest.h>

#include "fe_node/contact/rigid_surface.h"
#include "tests/fe_node/box_model.h"
#include "tests/fe_node/run_until.h"
#include "tests/verification/deck_model.h"

namespace crosswalk::fe {
namespace {

/// A quarter of a disc of radius 1: n x n cells in the middle, m rings of 2 n cells around them.
struct QuarterDisc {
  std::vector<Vec3> points;
  std::vector<std::array<int, 4>> quads;

  QuarterDisc(int n, int m) {
    constexpr double kCore = 0.5, kBulge = 0.16;  // side of the core; its outer edges are curved
    const auto core = [&](int i, int j) { return j * (n + 1) + i; };
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const double u = double(i) / n, v = double(j) / n;
        points.emplace_back(kCore * u * (1 + kBulge * (1 - v * v)),
                            kCore * v * (1 + kBulge * (1 - u * u)), 0);
      }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        quads.push_back({core(i, j), core(i + 1, j), core(i + 1, j + 1), core(i, j + 1)});
    std::vector<int> inner;
    for (int k = 0; k <= 2 * n; ++k) inner.push_back(k <= n ? core(n, k) : core(2 * n - k, n));
    for (int ring = 1; ring <= m; ++ring) {
      std::vector<int> outer;
      for (int k = 0; k <= 2 * n; ++k) {
        const double angle = 0.5 * std::numbers::pi * k / (2 * n), s = double(ring) / m;
        const int border = k <= n ? core(n, k) : core(2 * n - k, n);
        outer.push_back(static_cast<int>(points.size()));
        const Vec3 rim(std::cos(angle), std::sin(angle), 0);
        points.push_back((1 - s) * points[border] + s * rim);
      }
      for (int k = 0; k < 2 * n; ++k)
        quads.push_back({inner[k], outer[k], outer[k + 1], inner[k + 1]});
      inner = outer;
    }
  }
};

/// A quarter of a cylinder standing on z = 0.
Mesh quarter_cylinder(double radius, double length, int n, int m, int layers) {
  const QuarterDisc disc(n, m);
  const int count = static_cast<int>(disc.points.size());
  Mesh mesh;
  for (int k = 0; k <= layers; ++k)
    for (const Vec3& p : disc.points) {
      mesh.position.push_back(radius * p + length * k / layers * Vec3::UnitZ());
      mesh.node_id.push_back(DeckId{mesh.node_count()});
    }
  ElementTable& hexes = mesh.table(ElementKind::Hex8);
  for (int k = 0; k < layers; ++k)
    for (const auto& quad : disc.quads) {
      for (int level : {k, k + 1})
        for (int c : quad) hexes.nodes.push_back(level * count + c);
      hexes.part.push_back(0);
      hexes.id.push_back(DeckId{hexes.size()});
    }
  mesh.parts.push_back({DeckId{1}, "bar", false});
  return mesh;
}

// Copper cylinder of 3.2 x 32.4 mm at 227 m/s on a rigid frictionless wall, E 117 GPa, nu 0.35,
// yield 400 MPa, tangent modulus 100 MPa, 80 us. Published codes: final length 21.26 .. 21.66 mm,
// foot radius 6.97 .. 7.24 mm [kamoulakos1990] [zhu1995] [camacho1997]. A third of a millimetre per
// element at the foot: 1 % of the length and 3 % of the radius beyond their spread.
TEST(FeImpact, TaylorBar) {
  constexpr double kE = 117e9, kNu = 0.35, kDensity = 8930, kSpeed = 227;
  Plastic copper{kDensity, kE / (3 * (1 - 2 * kNu)), 0.5 * kE / (1 + kNu), {}, 0, 0};
  constexpr double kTangent = 100e6;
  copper.yield = YieldStress(HardeningCurve::linear(400e6, kE * kTangent / (kE - kTangent)));
  Model model;
  model.mesh = quarter_cylinder(3.2e-3, 32.4e-3, 4, 4, 50);
  ElementControls controls;
  controls.hourglass = HourglassForm::Viscous;
  controls.hourglass_coefficient = 0.1;
  model.blocks.push_back(make_hex8_block(model.mesh, 0, all_of(model.mesh.table(ElementKind::Hex8)),
                                         copper, controls));
  std::vector<int> all;
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    const Vec3& p = model.mesh.position[n];
    all.push_back(n);
    if (p.x() < 1e-12 || p.y() < 1e-12 || p.z() < 1e-12)  // symmetry, and the wall at the foot
      model.fixed.push_back({n, {p.x() < 1e-12, p.y() < 1e-12, p.z() < 1e-12}, {}});
  }
  model.start_velocities.push_back({all, {0, 0, -kSpeed}});
  model.finish();
  State state = initial_state(model);
  Scratch scratch(model, 1);
  while (state.time < 80e-6) {
    const StepReport report = compute_forces(model, state, scratch);
    move(model, state, scratch, 0.9 * report.stable_step);
  }
  double length = 0, radius = 0;
  for (int n : all) {
    const Vec3 x = state.nodes[n].position();
    length = std::max(length, x.z());
    if (model.mesh.position[n].z() < 1e-12) radius = std::max(radius, std::hypot(x.x(), x.y()));
  }
  EXPECT_GT(length, 0.99 * 21.26e-3);
  EXPECT_LT(length, 1.01 * 21.66e-3);
  EXPECT_GT(radius, 0.97 * 6.97e-3);
  EXPECT_LT(radius, 1.03 * 7.24e-3);
  EXPECT_LT(state.energies.hourglass(), 0.05 * state.energies.internal);
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
}

/// A rigid body of 20 kg let go with its tip on a simply supported laminated pane of 1 m by 1 m.
std::string ball_on_pane() {
  constexpr double kGlass = 2.1e-3, kFilm = 0.76e-3, kTotal = 2 * kGlass + kFilm;
  std::string text = fmt::format(
      "*PART\npane\n1,1,1\n*SECTION_SHELL\n1,2,,5,,-7\n{0},{0},{0},{0}\n"
      "*MAT_LAMINATED_GLASS\n1,2286,70e9,0.23,0,0,0,280e6\n0.45,11e6,9.5e6\n0,0,1,0,0\n"
      "*INTEGRATION_SHELL\n7,5,0\n",
      kTotal);
  const double middle = (kGlass + kFilm) / kTotal, reach = kGlass / kTotal / std::sqrt(3.0);
  const double weight = 0.5 * kGlass / kTotal;
  for (const auto& [s, w] : {std::pair(-middle - reach, weight),
                             {-middle + reach, weight},
                             {0.0, kFilm / kTotal},
                             {middle - reach, weight},
                             {middle + reach, weight}})
    text += fmt::format("{:.9g},{:.9g}\n", s, w);
  // the ball is a small rigid octahedron of pyramids standing on its tip, with a given mass
  text +=
      "*PART_INERTIA\nball\n2,2,2\n0.5,0.5,0.0526,20\n0.01,0,0,0.01,0,0.01\n0,0,0\n"
      "*SECTION_SHELL\n2,2\n1e-4,1e-4,1e-4,1e-4\n*MAT_RIGID\n2,7800,70e9,0.3\n1,4,7\n\n*NODE\n";
  constexpr int kN = 16;
  for (int j = 0; j <= kN; ++j)
    for (int i = 0; i <= kN; ++i)
      text += node_card(1 + j * (kN + 1) + i, {double(i) / kN, double(j) / kN, 0});
  const double tip = 0.5 * kTotal + 0.5e-4 + 1e-7;
  text += node_card(1001, {0.5, 0.5, tip}) + node_card(1002, {0.55, 0.5, tip + 0.05}) +
          node_card(1003, {0.5, 0.55, tip + 0.05}) + node_card(1004, {0.45, 0.5, tip + 0.05}) +
          node_card(1005, {0.5, 0.45, tip + 0.05});
  text += "*ELEMENT_SHELL\n";
  for (int j = 0; j < kN; ++j)
    for (int i = 0; i < kN; ++i) {
      const int a = 1 + j * (kN + 1) + i;
      text += fmt::format("{},1,{},{},{},{}\n", 1 + j * kN + i, a, a + 1, a + kN + 2, a + kN + 1);
    }
  text +=
      "2001,2,1001,1003,1002,1002\n2002,2,1001,1004,1003,1003\n2003,2,1001,1005,1004,1004\n"
      "2004,2,1001,1002,1005,1005\n*SET_NODE_LIST\n1\n";
  std::string list;
  int on_line = 0;
  for (int j = 0; j <= kN; ++j)
    for (int i = 0; i <= kN; ++i)
      if (i == 0 || j == 0 || i == kN || j == kN) {
        list += fmt::format("{}{}", on_line == 0 ? "" : ",", 1 + j * (kN + 1) + i);
        if (++on_line == 8) {
          list += '\n';
          on_line = 0;
        }
      }
  text += list +
          "\n*BOUNDARY_SPC_SET\n1,0,1,1,1\n*LOAD_BODY_Z\n1,0.5\n*DEFINE_CURVE\n1\n0,1\n9,1\n"
          "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n2,1,3,3\n\n\n";
  return text;
}

// Static deflection under a central load is 0.01160 F a^2 / D [timoshenko1959, table 23]. With that
// shape the pane swings with 0.196 of its mass and is loaded by 0.349 of its weight (Navier's
// series), so the body sinks to twice (M + 0.349 m) g / k and is back after 2 pi sqrt((M + 0.196 m)
// / k). Small, hence linear. The film's shear adds 1 %, the grid 1 %, the pane's other modes the
// rest.
TEST(FeImpact, BallOnALaminatedPaneSinksAndSwings) {
  constexpr double kGlassE = 70e9, kNu = 0.23, kTotal = 4.96e-3, kFilm = 0.76e-3;
  const double D = kGlassE / (1 - kNu * kNu) * (std::pow(kTotal, 3) - std::pow(kFilm, 3)) / 12 +
                   280e6 / (1 - 0.45 * 0.45) * std::pow(kFilm, 3) / 12;
  const double k = D / 0.01160, mass = 20, pane = 2286 * kTotal, gravity = 0.5;
  const double omega = std::sqrt(k / (mass + 0.196 * pane));
  BuiltModel built_model = built(ball_on_pane());
  finish_model(built_model);
  const Model& model = built_model.model;
  State state = initial_state(model);
  ASSERT_EQ(model.bodies.size(), 1U);
  const double start = state.bodies[0].X_WB.p.z();
  const double period = 2 * std::numbers::pi / omega;
  double deepest = 0, when = 0;
  run_until(model, state, 0.9 * period, 0.8, [&] {
    const double sink = start - state.bodies[0].X_WB.p.z();
    if (sink > deepest) {
      deepest = sink;
      when = state.time;
    }
  });
  const double exact = (mass + 0.349 * pane) * gravity / k;
  EXPECT_NEAR(deepest, 2 * exact, 0.05 * 2 * exact);
  EXPECT_NEAR(2 * when, period, 0.05 * period);
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
}

}  // namespace
}  // namespace crosswalk::fe
