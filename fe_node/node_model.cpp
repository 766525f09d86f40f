#include "fe_node/node_model.h"

#include <algorithm>
#include <fstream>

#include "common/error.h"
#include "common/log.h"
#include "common/units.h"
#include "fe_node/contact/rigid_surface.h"
#include "fe_node/contact/surface.h"
#include "fe_node/deck/deck_writer.h"
#include "fe_node/generate/deck_export.h"
#include "fe_node/head_alone.h"
#include "fe_node/model_report.h"
#include "fe_node/own_head.h"
#include "fe_node/solver.h"

namespace crosswalk::fe {
namespace {

using generate::kWindshieldContact;
using generate::kWindshieldFrame;
using generate::kWindshieldParts;

constexpr const char* kGlass = "windshield";  ///< component of the car that the pane replaces

CharacteristicLaw law_of(const Characteristic& c, double rate) {
  return {c.loading, c.permanent_fraction, c.unloading_exponent, rate};
}

/// One patch per component of the car, so that its facets share one deflection.
std::vector<RigidPatch> patches_of(const BodyShapes& shapes, double rate, bool with_glass) {
  std::vector<RigidPatch> patches;
  for (const EllipsoidShape& e : shapes.ellipsoids)
    patches.push_back({e.name, {RigidEllipsoid{e.X_BE, e.semi_axes}}, law_of(e.flesh, rate)});
  for (const FrontFacet& f : shapes.facets) {
    if (!with_glass && f.component == kGlass) continue;
    if (patches.empty() || patches.back().name != f.component)
      patches.push_back({f.component, {}, law_of(f.structure, rate)});
    const Vec3 begin(0, f.begin.x(), f.begin.y()), end(0, f.end.x(), f.end.y());
    RigidFacet facet;
    facet.across = (end - begin).normalized();
    facet.width = (end - begin).norm();
    facet.along = facet.across.cross(Vec3(0, f.normal.x(), f.normal.y()));
    facet.length = 2 * f.half_width;
    facet.corner = begin - f.half_width * facet.along;
    patches.back().shapes.push_back(facet);
  }
  return patches;
}

class Assembly {
 public:
  Assembly(const FeConfig& config, const std::filesystem::path& folder)
      : config_(config), folder_(folder) {}

  NodeModel run() {
    choose_bodies();
    Deck deck = head_neck_deck();
    if (config_.is_head_alone) keep_head_alone(deck);
    if (config_.is_head_alone && result_.boundary.attached > 0) drive_skull(deck, driven_.front());
    write(deck, config_.is_head_alone ? "head.k" : "head_neck.k");
    options_.units = config_.head_neck.units;
    options_.mass_scaling_step = 0;
    options_.precision = config_.precision;
    double step = scaling_step(deck);
    if (config_.windshield) {
      generate::WindshieldSpec spec = *config_.windshield;
      spec.units = deck.units != UnitSystem::Unknown ? deck.units : config_.head_neck.units;
      const Deck pane = generate::generate_windshield(spec);
      write(pane, "windshield.k");
      step = std::min(step, initial_stable_step(build_model(pane, {}).model));
      for (const DeckNode& node : deck.nodes)
        options_.last_nodes_from = std::max(options_.last_nodes_from, node.id.value + 1);
      generate::join_windshield(deck, spec, kHeadSurface, config_.vehicle_friction);
    }
    options_.driven_parts = driven_;
    options_.followers = followers_;
    options_.mass_scaling_step = config_.added_mass_limit > 0 ? step : 0;
    set_up_motion_log(deck);
    BuiltModel& built = result_.built;
    built = build_model(deck, options_);
    built.model.settings.step_scale = config_.step_scale;
    built.model.settings.gravity = {0, 0, -config_.gravity};
    find_bodies();
    add_partner_contacts();
    finish_model(built);
    if (made_) report();
    if (config_.windshield) add_sleeper();
    for (std::size_t c = 0; c < built.model.contacts.size(); ++c) {
      const std::string& name = built.model.contacts[c]->name();
      if (name == "head and buck" || name == kWindshieldContact) result_.car_contacts.push_back(c);
    }
    return std::move(result_);
  }

 private:
  Deck head_neck_deck() {
    if (config_.head_neck.is_generated) {
      made_ = generate::build_head_neck(config_.head_neck.spec);
      result_.joint = made_->landmarks.c7_t1;
      return generate::to_deck(made_->draft, config_.head_neck.spec.units);
    }
    result_.joint = config_.head_neck.joint;
    return read_own_deck(config_);
  }

  void write(const Deck& deck, const char* name) const {
    if (folder_.empty()) return;
    std::filesystem::create_directories(folder_ / "model");
    write_deck(folder_ / "model" / name, deck);
  }

  void report() {
    result_.report = model_report(*made_, result_.built.model);
    if (!folder_.empty()) std::ofstream(folder_ / "model/head_neck.txt") << result_.report;
  }

  void choose_bodies() {
    for (const InterfaceSpec& interface : config_.interfaces) {
      const bool is_frame = config_.windshield && interface.body == "buck";
      const std::string name = is_frame                ? kWindshieldFrame
                               : interface.is_attached ? block_title(interface.body)
                                                       : interface.body;
      (is_frame || interface.is_attached ? driven_ : followers_).push_back(name);
      interface_names_.push_back(name);
      if (interface.is_attached) ++result_.boundary.attached;
    }
  }

  /// The unscaled step up to which the head and neck alone may be scaled, s; 0: not at all.
  double scaling_step(const Deck& deck) const {
    if (!(config_.added_mass_limit > 0)) return 0;
    return mass_scaling_step_for(build_model(deck, options_).model, config_.added_mass_limit);
  }

  void set_up_motion_log(const Deck& deck) {
    BlockMotionSetup& motion = result_.motion;
    for (const InterfaceSpec& interface : config_.interfaces)
      for (const Part& part : deck.parts)
        if (interface.is_attached && part.title == block_title(interface.body))
          motion.blocks.push_back({interface.body, part.id.value});
    motion.units = deck.units != UnitSystem::Unknown ? deck.units : options_.units;
    motion.gravity = {0, 0, -config_.gravity};
    motion.least_step = options_.mass_scaling_step;
    motion.step_scale = config_.step_scale;
  }

  int find_body(const std::string& name) const {
    const std::vector<RigidBody>& bodies = result_.built.model.bodies;
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (bodies[b].name == name) return static_cast<int>(b);
    throw UserError(
        Problem{{}, "interface part `" + name + "`", "a rigid part of the deck", "none", {}});
  }

  void find_bodies() {
    for (const std::string& name : interface_names_)
      result_.boundary.bodies.push_back(find_body(name));
  }

  void add_partner_contacts() {
    BuiltModel& built = result_.built;
    const int set = require_part_set(built, kHeadSurface);
    std::vector<ContactPart> parts;
    for (int p : built.part_sets[set].second) parts.push_back({p, 0, 0, {}});
    for (const ContactNode& n : surface_of(built.model.mesh, parts).nodes)
      result_.head_surface.push_back(n.node);
    for (const BodyShapes& shapes : config_.partner_shapes) {
      RigidSurfaceSpec spec;
      spec.name = "head and " + shapes.body;
      spec.nodes = result_.head_surface;
      spec.patches = patches_of(shapes, config_.body.contact.rate, !config_.windshield);
      spec.friction = shapes.facets.empty() ? config_.self_friction : config_.vehicle_friction;
      const bool is_frame = config_.windshield && shapes.body == "buck";
      spec.body = find_body(is_frame ? kWindshieldFrame : shapes.body);
      if (!spec.patches.empty())
        built.model.contacts.push_back(make_rigid_surface_contact(std::move(spec)));
    }
  }

  void add_sleeper() {
    BuiltModel& built = result_.built;
    const std::vector<int>& parts =
        built.part_sets[require_part_set(built, kWindshieldParts)].second;
    built.model.sleeper =
        make_sleeper(built.model, parts, find_body(kWindshieldFrame), kWindshieldContact);
    built.model.sleeper->X_BD = windshield_in_buck();
    log_info("windshield: {} shells, {:.2f} kg, asleep until the head is within {:.0f} mm",
             built.model.mesh.table(ElementKind::Quad4).size(), built.model.sleeper->inertia.mass,
             1e3 * config_.wake_distance);
  }

  const FeConfig& config_;
  const std::filesystem::path& folder_;
  NodeModel result_;
  std::optional<generate::HeadNeck> made_;
  BuildOptions options_;
  std::vector<std::string> driven_, followers_, interface_names_;
};

}  // namespace

NodeModel build_node_model(const FeConfig& config, const std::filesystem::path& folder) {
  return Assembly(config, folder).run();
}

int require_part_set(const BuiltModel& built, const std::string& name) {
  const int index = built.part_set(name);
  if (index < 0)
    throw UserError(
        Problem{{}, "part set `" + name + "`", "a *SET_PART of that title", "none", {}});
  return index;
}

// Deck: x rearward, z up; the car drives along +y of its body frame.
Pose windshield_in_buck() { return {exp_rotation(Vec3(0, 0, -0.5 * kPi)), Vec3::Zero()}; }

bool is_near_windshield(const FeConfig& config, const NodeModel& model, const State& state,
                        const Pose& X_WB) {
  const generate::WindshieldSpec& spec = *config.windshield;
  const Pose X_PW = (X_WB * windshield_in_buck() * pane_frame(spec)).inverse();
  const double margin = config.wake_distance, half = 0.5 * spec.width + margin;
  const Vec3 low(-margin, -half, -margin),
      high(generate::pane_height(spec) + margin, half, spec.sagitta + margin);
  return std::any_of(model.head_surface.begin(), model.head_surface.end(), [&](int n) {
    const Vec3 p = X_PW * state.nodes[n].position();
    return (p.array() > low.array()).all() && (p.array() < high.array()).all();
  });
}

}  // namespace crosswalk::fe
