// *MAT_LAMINATED_GLASS of a deck against the bonded laminate and its broken ply.
#include <gtest/gtest.h>

#include "tests/fe_node/plate_model.h"
#include "tests/verification/deck_model.h"

namespace crosswalk::fe {
namespace {

constexpr double kGlass = 2.1e-3, kFilm = 0.76e-3, kTotal = 2 * kGlass + kFilm;
constexpr double kGlassE = 70e9, kGlassNu = 0.23, kFilmE = 280e6, kFilmNu = 0.45;
constexpr double kStrength = 80e6;
/// Bending stiffness per width of panes alone and of the film alone, about the middle.
const double kPanes =
    kGlassE / (1 - kGlassNu * kGlassNu) * (std::pow(kTotal, 3) - std::pow(kFilm, 3)) / 12;
const double kCore = kFilmE / (1 - kFilmNu * kFilmNu) * std::pow(kFilm, 3) / 12;

constexpr double kSide = 0.02;

/// Small plate of 4 x 4 shells (ELFORM 2 or 16), two points in each pane and one in the film.
std::string laminated_plate(int formulation = 2) {
  const double middle = (kGlass + kFilm) / kTotal, reach = kGlass / kTotal / std::sqrt(3.0);
  std::string text = fmt::format(
      "*PART\npane\n1,1,1\n*SECTION_SHELL\n1,{6},,5,,-7\n{0},{0},{0},{0}\n"
      "*MAT_LAMINATED_GLASS\n1,2286,{1},{2},{3},0,0.0011,{4}\n{5},11e6,9.5e6\n0,0,1,0,0\n"
      "*INTEGRATION_SHELL\n7,5,0\n",
      kTotal, kGlassE, kGlassNu, kStrength, kFilmE, kFilmNu, formulation);
  const double weight = 0.5 * kGlass / kTotal;
  for (const auto& [s, w] : {std::pair(-middle - reach, weight),
                             {-middle + reach, weight},
                             {0.0, kFilm / kTotal},
                             {middle - reach, weight},
                             {middle + reach, weight}})
    text += fmt::format("{:.9g},{:.9g}\n", s, w);
  text += "*NODE\n";
  const Plate plate{4, 4, kSide, kSide};
  const Mesh mesh = plate_mesh(plate);
  for (int n = 0; n < mesh.node_count(); ++n) text += node_card(n + 1, mesh.position[n]);
  text += "*ELEMENT_SHELL\n";
  for (int e = 0; e < 16; ++e) {
    const std::span<const int> c = mesh.corners(ElementKind::Quad4, e);
    text += fmt::format("{},1,{},{},{},{}\n", e + 1, c[0] + 1, c[1] + 1, c[2] + 1, c[3] + 1);
  }
  return text;
}

/// Moment per width on the edge y = 0 after the plate is bent to a curvature about x in one step
/// of a second, long enough for a crack to open and to lose all its tension.
double edge_moment(double curvature, int formulation = 2) {
  BuiltModel model = built(laminated_plate(formulation));
  finish_model(model);
  PlateMotion motion = still(model.model);
  for (int n = 0; n < model.model.mesh.node_count(); ++n) {
    const double y = model.model.mesh.position[n].y();
    motion.displacement[n].z() = 0.5 * curvature * y * y;
    motion.rotation[n].x() = curvature * y;
  }
  const NodalLoads loads = loads_after(model.model, motion);
  double edge = 0;
  for (int n = 0; n < model.model.mesh.node_count(); ++n)
    if (model.model.mesh.position[n].y() == 0) edge += loads.moment[n].x();
  return edge / kSide;
}

/// Curvature at which the innermost point of a pane reaches the strength, in plane strain.
double breaking_curvature() {
  const double inner = 0.5 * (kGlass + kFilm) - 0.5 * kGlass / std::sqrt(3.0);
  return kStrength * (1 - kGlassNu * kGlassNu) / kGlassE / inner;
}

// Small curvature: D = E' ((2 g + c)^3 - c^3) / 12 + E'c c^3 / 12, plane sections staying plane.
TEST(FeLaminate, DeckGlassBendsAsTheBondedLaminate) {
  const double k = 1e-3;
  for (const int formulation : {2, 16})
    EXPECT_NEAR(edge_moment(k, formulation), (kPanes + kCore) * k, 1e-4 * kPanes * k);
}

TEST(FeLaminate, TheSectionSaysHowManyPointsAShellHas) {
  EXPECT_EQ(built(laminated_plate(2)).model.blocks[0]->points(), 1);
  EXPECT_EQ(built(laminated_plate(16)).model.blocks[0]->points(), 4);
  const BuiltModel reduced = built(laminated_plate(7));
  EXPECT_EQ(reduced.model.blocks[0]->points(), 4);
  EXPECT_NE(reduced.notes.back().find("computed as the fully integrated shell (16)"),
            std::string::npos)
      << reduced.notes.back();
}

// Beyond the strength of the whole pane in tension that pane carries nothing and the other, in
// compression, carries on: half the panes' moment is left. The deflection of k y^2/2 turns the
// plate by at most k y = 0.03, which costs its square.
TEST(FeLaminate, ABrokenPaneLeavesTheOtherAndTheFilm) {
  const double k = 1.02 * breaking_curvature();
  for (const int formulation : {2, 16})
    EXPECT_NEAR(edge_moment(k, formulation), (0.5 * kPanes + kCore) * k, 0.01 * kPanes * k);
  // just below the strength of the outermost points nothing has broken
  const double outer = 0.5 * (kGlass + kFilm) + 0.5 * kGlass / std::sqrt(3.0);
  const double whole = 0.97 * kStrength * (1 - kGlassNu * kGlassNu) / kGlassE / outer;
  EXPECT_NEAR(edge_moment(whole), (kPanes + kCore) * whole, 0.01 * kPanes * whole);
}

TEST(FeLaminate, TheMappingIsTold) {
  const BuiltModel model = built(laminated_plate());
  ASSERT_EQ(model.notes.size(), 1U);
  EXPECT_NE(model.notes[0].find("principal tension"), std::string::npos) << model.notes[0];
}

}  // namespace
}  // namespace crosswalk::fe
