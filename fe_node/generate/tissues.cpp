#include "fe_node/generate/tissues.h"

#include "fe_node/element/element_controls.h"
#include "fe_node/generate/part_ids.h"

namespace crosswalk::fe::generate {

namespace {

/// Eight points: one would answer to the mean deformation alone, and bricks turn inside out in a
/// hard blow.
PartSpec brain(int id, const char* name, double bulk, double shear_short, double shear_long,
               const char* source, Grade grade) {
  return {.id = id,
          .name = name,
          .density = 1040,
          .law =
              mat::Viscoelastic{
                  .bulk = bulk, .shear_short = shear_short, .shear_long = shear_long, .decay = 80},
          .section = SolidSection{.hourglass = 0},
          .source = source,
          .grade = grade};
}

mat::PlasticKinematic bone(double youngs, double yield, double tangent) {
  return {.youngs = youngs, .poisson = 0.22, .yield = yield, .tangent = tangent, .hardening = 1};
}

PartSpec table(int id, const char* name, double thickness, const mat::PlasticKinematic& law,
               ShellReference reference) {
  return {.id = id,
          .name = name,
          .density = 2100,
          .law = law,
          .section = ShellSection{.thickness = thickness, .points = 5, .reference = reference},
          .source = "cortical bone, 5.6 to 15 GPa in head models; yield 90 to 100 MPa",
          .grade = Grade::Literature};
}

PartSpec membrane(int id, const char* name, double density, double youngs, double thickness,
                  const char* source, Grade grade = Grade::Literature) {
  return {.id = id,
          .name = name,
          .density = density,
          .law = mat::Elastic{.youngs = youngs, .poisson = 0.45},
          .section = ShellSection{.thickness = thickness, .form = ShellForm::Membrane},
          .source = source,
          .grade = grade};
}

}  // namespace

std::vector<PartSpec> head_tissues(double brain_bulk) {
  const char* brain_source = "GHBMC grey matter G0 6, Ginf 1.2 kPa; decay 80/s usual";
  const char* stem_source = "twice the cerebrum, after the ratio in WSUHIM";
  return {
      {.id = part::kScalp,
       .name = "scalp",
       .density = 1100,
       .law =
           mat::Viscoelastic{.bulk = 20e6, .shear_short = 1.7e6, .shear_long = 0.68e6, .decay = 20},
       .section = SolidSection{.hourglass = kOwnHourglass},
       .source = "K as GHBMC flesh; shear as scalp tests",
       .grade = Grade::Literature},
      // The density is that of the tissue; the tables' share of the bricks is taken off later.
      {.id = part::kDiploe,
       .name = "diploe",
       .density = 1300,
       .law = bone(1.0e9, 25e6, 50e6),
       .section = SolidSection{.hourglass = 0.05},
       .source = "E 0.6 to 4.6 GPa in head models; bricks of the whole skull",
       .grade = Grade::Literature},
      table(part::kOuterTable, "outer_table", 1.8e-3, bone(15e9, 95e6, 1.2e9), ShellReference::Top),
      table(part::kInnerTable, "inner_table", 1.4e-3, bone(12e9, 90e6, 1.0e9),
            ShellReference::Bottom),
      {.id = part::kFirstVertebra - 10,
       .name = "occiput",
       .density = 1750,
       .law = mat::Rigid{.youngs = 7.2e9, .poisson = 0.22},
       .section = SolidSection{},
       .source = "skull base round the foramen magnum, rigid",
       .grade = Grade::Estimate},
      // Eight points, as of the brain: thin layers that it shears turned inside out at fine.
      {.id = part::kCsf,
       .name = "csf",
       .density = 1000,
       .law =
           mat::Viscoelastic{
               .bulk = brain_bulk, .shear_short = 500, .shear_long = 500, .decay = 100},
       .section = SolidSection{.hourglass = 0},
       .source = "K as brain; shear modulus 0.5 kPa numerical",
       .grade = Grade::Literature},
      brain(part::kCerebrumLeft, "cerebrum_left", brain_bulk, 6e3, 1.2e3, brain_source,
            Grade::Source),
      brain(part::kCerebrumRight, "cerebrum_right", brain_bulk, 6e3, 1.2e3, brain_source,
            Grade::Source),
      brain(part::kCerebellumLeft, "cerebellum_left", brain_bulk, 6e3, 1.2e3, brain_source,
            Grade::Source),
      brain(part::kCerebellumRight, "cerebellum_right", brain_bulk, 6e3, 1.2e3, brain_source,
            Grade::Source),
      brain(part::kBrainstem, "brainstem", brain_bulk, 12e3, 2.4e3, stem_source, Grade::Literature),
      {.id = part::kCord,
       .name = "cord",
       .density = 1040,
       .law =
           mat::Viscoelastic{
               .bulk = brain_bulk, .shear_short = 0.1e6, .shear_long = 0.1e6, .decay = 80},
       .section = SolidSection{.hourglass = kOwnHourglass},
       .source = "spinal cord, E 0.3 MPa; fills the foramen magnum",
       .grade = Grade::Literature},
      membrane(part::kDura, "dura", 1130, 31.5e6, 1.0e-3, "E 31.5 MPa, 1 mm, as in most models"),
      membrane(part::kPia, "pia", 1000, 11.5e6, 0.1e-3, "arachnoid and pia as one, 0.1 mm"),
      membrane(part::kFalx, "falx", 1130, 31.5e6, 1.0e-3, "as dura"),
      membrane(part::kTentorium, "tentorium", 1130, 31.5e6, 1.0e-3, "as dura"),
      {.id = part::kFace,
       .name = "face",
       .density = 1250,
       .law = mat::Elastic{.youngs = 500e6, .poisson = 0.23},
       .section = SolidSection{.hourglass = 0.05},
       .source = "bone, muscle and sinuses as one block",
       .grade = Grade::Estimate},
      // One-point bricks of a soft, nearly incompressible tissue keep their mean volume while
      // hourglass modes turn their corners inside out: flesh folds by far more than bone or brain.
      // Eight points have no such modes and need no coefficient.
      {.id = part::kFlesh,
       .name = "neck_flesh",
       .density = 1000,
       .law =
           mat::Viscoelastic{.bulk = 20e6, .shear_short = 30e3, .shear_long = 10e3, .decay = 100},
       .section = SolidSection{.hourglass = 0},
       .source = "passive muscle and fat, airway spread into the density",
       .grade = Grade::Estimate},
      membrane(part::kNeckSkin, "neck_skin", 1100, 0.1e6, 1.0e-3,
               "0.1 to 0.2 MPa by suction of living skin; slack, so not the 1 to 22 MPa of drawn",
               Grade::Estimate),
  };
}

}  // namespace crosswalk::fe::generate
