#include "fe_node/generate/head_neck.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/units.h"
#include "fe_node/generate/deck_export.h"
#include "fe_node/generate/discs.h"
#include "fe_node/generate/head_mesh.h"
#include "fe_node/generate/ligaments.h"
#include "fe_node/generate/membranes.h"
#include "fe_node/generate/muscles.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/generate/skull.h"
#include "fe_node/generate/spine.h"
#include "fe_node/generate/spine_data.h"
#include "fe_node/generate/tissues.h"

namespace crosswalk::fe::generate {

namespace {

struct Resolution {
  HeadResolution head;
  SpineResolution spine;
  int levels_above_chin, levels_below_chin;
};

// Of finer meshes the shape of a few cells would set the time step, of the coarse one the thin CSF
// does.
constexpr double kLift = 0.7;

Resolution resolution_of(Fidelity fidelity) {
  switch (fidelity) {
    case Fidelity::Coarse:
      break;
    case Fidelity::Medium:
      return {{.n = 22,
               .csf_layers = 1,
               .skull_layers = 2,
               .scalp_layers = 2,
               .lift = kLift,
               .even_sweeps = 30},
              {6, 3, 2},
              12,
              12};
    case Fidelity::Fine:
      return {{.n = 40,
               .csf_layers = 2,
               .skull_layers = 3,
               .scalp_layers = 3,
               .lift = kLift,
               .even_sweeps = 30},
              {8, 6, 3},
              22,
              22};
  }
  return {{.n = 10, .csf_layers = 1, .skull_layers = 2, .scalp_layers = 1}, {4, 2, 1}, 6, 6};
}

// Section of the neck: depth to breadth 1.05; its centre lies a little before the spine [E].
constexpr double kDepthToBreadth = 1.05, kCentreBeforeSpine = -0.003;
constexpr double kFleshBottom = 0.0;  // z of the lowest flesh nodes in N, reference size, m
constexpr double kReferenceHeadCentreX = 5, kReferenceHeadCentreZ = 26;  // of the tragion, mm
constexpr double kHeadPlace = 1e-4;  // m, how near the head's centre comes to its place
constexpr int kMostPasses = 4;

/// Spine centre line x over z in N.
double spine_line(const Spine& spine, double z) {
  const auto x = [&](int level) { return spine.bodies[level].X_NB.p.x(); };
  const auto height = [&](int level) { return spine.bodies[level].X_NB.p.z(); };
  int level = C1;
  while (level < T2 && height(level + 1) > z) ++level;
  const double share =
      std::clamp((z - height(level + 1)) / (height(level) - height(level + 1)), 0.0, 1.0);
  return x(level + 1) + share * (x(level) - x(level + 1));
}

class Assembly {
 public:
  /// `head_offset`: the head's mass centre from the tragion, where a fit asks for its place.
  Assembly(const HeadNeckSpec& spec, const Vec3& head_offset)
      : spec_(spec), resolution_(resolution_of(spec.fidelity)), shape_(spec.head) {
    Landmarks& marks = result_.landmarks;
    marks.c7_t1 = neck_base(spec.stature);
    const Vec3 neck = spec.fit ? spec.fit->condyles : reference_neck(spec.stature);
    marks.condyles = marks.c7_t1 + neck;
    const Vec3 condyles_frankfurt(1e-3 * kCondyleFrankfurtX, 0, 1e-3 * kCondyleFrankfurtZ);
    marks.tragion = marks.condyles - shape_.scale().cwiseProduct(condyles_frankfurt);
    if (spec.fit) marks.tragion = marks.c7_t1 + spec.fit->head_centre - head_offset;
    spine_ = spine_of(spec.stature, neck, marks.tragion, shape_.scale());
    result_.spine = spine_;
  }

  HeadNeck run() {
    draft().title = "Crosswalk generated head and neck";
    draft().parts = head_tissues(spec_.brain_bulk);
    add_head();
    add_spine(draft(), spine_, resolution_.spine);
    add_clavicle_blocks();
    attach_flesh();
    add_disc_fibres(draft(), spine_);
    add_ligaments(draft(), spine_);
    add_muscles(draft(), spine_, shape_.scale(),
                {.area_factor = spec_.muscle_area_factor, .activation = spec_.activation});
    add_sets();
    settle_masses();
    return std::move(result_);
  }

 private:
  ModelDraft& draft() { return result_.draft; }

  void add_head() {
    MeshDraft& mesh = draft().mesh;
    const HeadMesh head = add_cranium(mesh, shape_, resolution_.head);
    const double s = spine_.scale;
    const Vec3& tragion = result_.landmarks.tragion;
    NeckFleshPlan plan{.bottom_z = kFleshBottom * s - tragion.z(),
                       .levels_above_chin = resolution_.levels_above_chin,
                       .levels_below_chin = resolution_.levels_below_chin,
                       .section = [&](double z) { return section(z); }};
    mark_skull_base(mesh, head, shape_, result_.landmarks.condyles - tragion, spine_[C0].part);
    add_tables(mesh, head, shape_);
    // The petrous bones are of the rigid skull base.
    mesh.attach(spine_[C0].part, add_membranes(mesh, head, shape_));
    flesh_ = add_face_and_flesh(mesh, head, shape_, plan);
    skull_fit_ = on_bone(mesh, head.skull_inner, spine_[C0].part);
    skull_outer_ = on_bone(mesh, head.skull_outer, spine_[C0].part);
    for (Vec3& p : mesh.nodes) p += tragion;
  }

  NeckSection section(double z_frankfurt) const {
    const Vec3& tragion = result_.landmarks.tragion;
    const double z = z_frankfurt + tragion.z();
    const double radius = spec_.neck_circumference / (2 * kPi);
    const double flare = 1 + 0.05 * smooth_step(0.040, 0.0, z);
    NeckSection section;
    section.centre = {spine_line(spine_, z) + kCentreBeforeSpine - tragion.x(), 0, z_frankfurt};
    section.half_breadth = flare * radius * 2 / (1 + kDepthToBreadth);
    section.half_depth = kDepthToBreadth * section.half_breadth;
    return section;
  }

  /// Bricks that show where muscle ends are tied to the clavicles.
  void add_clavicle_blocks() {
    const double s = spine_.scale;
    for (const int side : {1, -1}) {
      const int id = side > 0 ? part::kBlockClavicleLeft : part::kBlockClavicleRight;
      const Vec3 centre = s * Vec3(0.0345, side * 0.086, -0.040);  // middle of the clavicle
      const Vec3 half = s * Vec3(0.010, 0.030, 0.0075);
      add_block(
          draft().mesh, {1, 1, 1},
          [&](int a, int b, int c) -> Vec3 {
            return centre + half.cwiseProduct(Vec3(2 * a - 1, 2 * b - 1, 2 * c - 1));
          },
          id);
      (side > 0 ? result_.landmarks.clavicle_left : result_.landmarks.clavicle_right) = centre;
      draft().parts.push_back({.id = id,
                               .name = side > 0 ? "block_clavicle_l" : "block_clavicle_r",
                               .density = 100,
                               .law = mat::Rigid{.youngs = 1e9, .poisson = 0.3},
                               .section = SolidSection{},
                               .source = "nearly massless; the body it follows has the mass",
                               .grade = Grade::Estimate});
    }
  }

  /// Deep flesh behind the middle of the vertebral bodies, where the processes are that muscles
  /// hang on, follows the nearest vertebra; the throat before them glides. The lowest ring follows
  /// the torso block.
  void attach_flesh() {
    MeshDraft& mesh = draft().mesh;
    for (const int id : flesh_.channel_wall) {
      const double z = mesh.nodes[id].z();
      if (mesh.nodes[id].x() > spine_line(spine_, z)) continue;
      int best = C1;
      for (int level = C2; level <= T2; ++level)
        if (std::abs(spine_.bodies[level].X_NB.p.z() - z) <
            std::abs(spine_.bodies[best].X_NB.p.z() - z))
          best = level;
      mesh.attach(spine_.bodies[best].part, {id});
    }
    mesh.attach(part::kBlockTorsoUp, flesh_.bottom);
  }

  void add_sets() {
    using namespace part;
    const std::vector<int> brain{kCerebrumLeft, kCerebrumRight, kCerebellumLeft, kCerebellumRight,
                                 kBrainstem};
    const std::vector<int> skull{kDiploe, kOuterTable, kInnerTable, kFirstVertebra - 10};
    head_parts_ = brain;
    head_parts_.insert(head_parts_.end(), skull.begin(), skull.end());
    head_parts_.insert(head_parts_.end(),
                       {kCsf, kCord, kDura, kPia, kFalx, kTentorium, kScalp, kFace});
    neck_parts_ = {kFlesh, kNeckSkin};
    for (const PartSpec& p : draft().parts)
      if ((p.id >= kFirstVertebra && p.id < 4000) && p.id != kFirstVertebra - 10)
        neck_parts_.push_back(p.id);
    draft().part_sets = {{"brain", brain},
                         {"skull", skull},
                         {"head", head_parts_},
                         {"neck", neck_parts_},
                         {"outer_surface", {kScalp, kFace, kFlesh}}};
    draft().mesh.sets.push_back({"skull_fit", skull_fit_});
  }

  void settle_masses() {
    MassReport& report = result_.masses;
    PartSpec& diploe = draft().part(part::kDiploe);
    diploe.density = diploe_density(draft(), diploe.density);
    double mass = 0;
    Vec3 moments = Vec3::Zero();
    const double size = shape_.scale().prod();
    switch (spec_.mass.preset) {
      case MassPreset::Untrimmed:
        break;
      case MassPreset::Literature:  // [yoganandan2009] [plaga2005], grown with the head
        mass = 4.3 * size;
        moments = std::pow(size, 5.0 / 3.0) * Vec3(0.0200, 0.0220, 0.0150);
        break;
      case MassPreset::SeedA1:  // [yu2020, Table A1]
        mass = 4.1;
        moments = {0.015126, 0.017991, 0.010557};
        break;
      case MassPreset::Measured:
        mass = spec_.mass.head_mass;
        moments = spec_.mass.head_moments;
        break;
    }
    report.face_density = draft().part(part::kFace).density;
    if (mass > 0) trim_head(draft(), head_parts_, skull_outer_, mass, moments, report);
    const std::vector<int> blocks{part::kBlockTorsoUp, part::kBlockClavicleLeft,
                                  part::kBlockClavicleRight};
    if (spec_.mass.preset == MassPreset::SeedA1) {
      // The whole model of [yu2020, Table A1] weighs 5.66 kg: the flesh takes the difference.
      const double rest = 5.66 - inertia_of(draft(), head_parts_, true).mass -
                          inertia_of(draft(), neck_parts_, false).mass -
                          inertia_of(draft(), blocks, false).mass;
      PartSpec& flesh = draft().part(part::kFlesh);
      const double volume = inertia_of(draft(), {part::kFlesh}, false).mass / flesh.density;
      flesh.density = std::max(300.0, flesh.density + rest / volume);
    }
    report.flesh_density = draft().part(part::kFlesh).density;
    std::vector<int> all = head_parts_;
    all.insert(all.end(), neck_parts_.begin(), neck_parts_.end());
    all.insert(all.end(), blocks.begin(), blocks.end());
    report.rows = {{"head", inertia_of(draft(), head_parts_, true)},
                   {"neck", inertia_of(draft(), neck_parts_, false)},
                   {"blocks", inertia_of(draft(), blocks, false)},
                   {"assembly", inertia_of(draft(), all, true)}};
    result_.landmarks.head_centre = report.rows[0].inertia.com;
  }

  const HeadNeckSpec& spec_;
  Resolution resolution_;
  HeadShape shape_;
  Spine spine_;
  HeadNeck result_;
  FaceAndFlesh flesh_;
  std::vector<int> skull_fit_, skull_outer_, head_parts_, neck_parts_;
};

}  // namespace

// The mass centre from the tragion depends hardly on where the head stands (the face ends at the
// neck), so two or three passes settle it.
HeadNeck build_head_neck(const HeadNeckSpec& spec) {
  Vec3 offset(1e-3 * kReferenceHeadCentreX, 0, 1e-3 * kReferenceHeadCentreZ);
  HeadNeck model = Assembly(spec, offset).run();
  for (int pass = 0; spec.fit && pass < kMostPasses; ++pass) {
    const Landmarks& marks = model.landmarks;
    const Vec3 wanted = marks.c7_t1 + spec.fit->head_centre;
    if ((marks.head_centre - wanted).norm() < kHeadPlace) break;
    offset = marks.head_centre - marks.tragion;
    model = Assembly(spec, offset).run();
  }
  return model;
}

Deck generate_head_neck(const HeadNeckSpec& spec) {
  return to_deck(build_head_neck(spec).draft, spec.units);
}

}  // namespace crosswalk::fe::generate
