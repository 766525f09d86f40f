#include "fe_node/generate/windshield.h"

#include <algorithm>
#include <cmath>

#include "fe_node/generate/deck_export.h"
#include "fe_node/generate/part_ids.h"

namespace crosswalk::fe::generate {

namespace {

constexpr double kBeadWidth = 0.010, kBeadThickness = 0.006;  // m [E]
constexpr double kFrameWidth = 0.020;                         // m, for drawing and contact [E]
// Bead of E 12 MPa: transverse shear stiffness G t / width of 2 MN/m per metre of edge [E].
constexpr double kBeadModulus = 12e6;

/// Cuts of one direction of the grid: frame, bead, pane cells, bead, frame.
std::vector<double> cuts(double length, double cell) {
  const int cells = std::max(2, static_cast<int>(std::lround(length / cell)));
  std::vector<double> result{-kBeadWidth - kFrameWidth, -kBeadWidth};
  for (int i = 0; i <= cells; ++i) result.push_back(length * i / cells);
  result.push_back(length + kBeadWidth);
  result.push_back(length + kBeadWidth + kFrameWidth);
  return result;
}

/// 0 frame, 1 bead, 2 pane, by the cell's place from the nearer end.
int ring(int cell, int cells) { return std::min({cell, cells - 1 - cell, 2}); }

PartSpec pane(const WindshieldSpec& spec) {
  PartSpec part{.id = part::kWindshield, .name = "windshield", .grade = Grade::Literature};
  if (spec.kind == WindshieldKind::Panel) {
    part.density = 7850;
    // Deep-drawing steel, typical; stands for the unpublished curve of the test buck.
    part.law = mat::PiecewiseLinearPlasticity{.youngs = 210e9,
                                              .poisson = 0.3,
                                              .yield = 180e6,
                                              .strain = {0, 0.02, 0.05, 0.10, 0.20, 0.40},
                                              .stress = {180e6, 235e6, 275e6, 315e6, 355e6, 400e6}};
    part.section = ShellSection{.thickness = spec.panel_thickness, .points = 5};
    part.source = "mild steel sheet for the unpublished panel";
    part.grade = Grade::Estimate;
    return part;
  }
  const double glass = spec.glass_thickness, pvb = spec.pvb_thickness, total = 2 * glass + pvb;
  part.density = (2 * glass * 2500 + pvb * 1100) / total;
  part.law = mat::LaminatedGlass{.glass_youngs = 70e9,
                                 .glass_poisson = 0.23,
                                 .glass_yield = 80e6,
                                 .glass_failure_strain = 80e6 / 70e9,
                                 .polymer_youngs = 280e6,
                                 .polymer_poisson = 0.495,
                                 .polymer_yield = 11e6,
                                 .polymer_tangent = 9.5e6,
                                 .layer_is_polymer = {0, 0, 1, 0, 0}};
  // Two Gauss points in each glass ply, one in the interlayer.
  const double middle = (glass + pvb) / total, reach = glass / total / std::sqrt(3.0);
  const double weight = 0.5 * glass / total;
  // Cracked cells of one point in the plane zigzag without resistance.
  ShellSection section{.thickness = total, .points = 5, .form = ShellForm::Full};
  section.rule = {{-middle - reach, weight},
                  {-middle + reach, weight},
                  {0, pvb / total},
                  {middle - reach, weight},
                  {middle + reach, weight}};
  part.section = section;
  part.source = "float glass 80 MPa dynamic; PVB after Shang 2018";
  return part;
}

}  // namespace

double pane_height(const WindshieldSpec& spec) {
  return std::hypot(spec.upper_x - spec.lower_x, spec.upper_z - spec.lower_z);
}

Pose pane_frame(const WindshieldSpec& spec) {
  const Vec3 lower(spec.lower_x, 0, spec.lower_z), upper(spec.upper_x, 0, spec.upper_z);
  Mat3 R;
  R.col(0) = (upper - lower).normalized();
  R.col(1) = Vec3::UnitY();
  R.col(2) = R.col(0).cross(R.col(1));
  return {Quat(R), lower};
}

ModelDraft build_windshield(const WindshieldSpec& spec) {
  ModelDraft draft;
  draft.title = "Crosswalk generated windshield";
  const double height = pane_height(spec);
  const Pose frame = pane_frame(spec);
  const std::vector<double> up = cuts(height, spec.cell), across = cuts(spec.width, spec.cell);
  const int rows = static_cast<int>(up.size()), columns = static_cast<int>(across.size());
  for (const double t : up)
    for (const double s : across) {
      const double v = 2 * t / height - 1, u = 2 * s / spec.width - 1;
      const double bulge = spec.sagitta * std::max(0.0, 1 - u * u) * std::max(0.0, 1 - v * v);
      draft.mesh.add_node(frame * Vec3(t, s - 0.5 * spec.width, bulge));
    }
  constexpr int kPartOfRing[] = {part::kBlockBuck, part::kWindshieldBead, part::kWindshield};
  for (int i = 0; i + 1 < rows; ++i)
    for (int j = 0; j + 1 < columns; ++j) {
      const int part = kPartOfRing[std::min(ring(i, rows - 1), ring(j, columns - 1))];
      const int a = i * columns + j, b = a + columns;  // normal outwards: along, then across
      draft.mesh.quads.push_back({{a, b, b + 1, a + 1}, part});
    }
  draft.parts.push_back(pane(spec));
  draft.parts.push_back({.id = part::kWindshieldBead,
                         .name = "windshield_bead",
                         .density = 1200,
                         .law = mat::Elastic{.youngs = kBeadModulus, .poisson = 0.45},
                         .section = ShellSection{.thickness = kBeadThickness, .points = 2},
                         .source = "edge held by 2 MN/m per metre",
                         .grade = Grade::Estimate});
  draft.parts.push_back({.id = part::kBlockBuck,
                         .name = "block_buck",
                         .density = 100,
                         .law = mat::Rigid{.youngs = 210e9, .poisson = 0.3},
                         .section = ShellSection{.thickness = 0.002, .points = 2},
                         .source = "nearly massless frame; the buck has the mass",
                         .grade = Grade::Estimate});
  draft.part_sets = {
      {"windshield", {part::kWindshield}},
      {"windshield_contact", {part::kWindshield, part::kWindshieldBead}},
      {kWindshieldParts, {part::kWindshield, part::kWindshieldBead, part::kBlockBuck}}};
  return draft;
}

Deck generate_windshield(const WindshieldSpec& spec) {
  return to_deck(
      build_windshield(spec), spec.units,
      {.node = 1000001, .element = 1000001, .section = 8001, .hourglass = 8001, .set = 8001});
}

}  // namespace crosswalk::fe::generate
