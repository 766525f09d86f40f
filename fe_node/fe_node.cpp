#include "fe_node/fe_node.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/error.h"
#include "common/log.h"
#include "common/neck_landmarks.h"
#include "fe_node/contact/rigid_surface.h"
#include "fe_node/contact/surface.h"
#include "fe_node/deck/deck_writer.h"
#include "fe_node/deck/keyword_reader.h"
#include "fe_node/generate/deck_export.h"
#include "fe_node/output/field_writer.h"
#include "fe_node/output/state_bytes.h"

namespace crosswalk::fe {
namespace {

/// The rigid part that follows an attached body: its name in the scenario, or "block_" and the
/// body's.
std::string block_name(const InterfaceSpec& interface, const Deck& deck) {
  const std::string own = "block_" + interface.body;
  for (const Part& part : deck.parts)
    if (part.title == own && interface.part == interface.body) return own;
  return interface.part;
}

int require_part_set(const BuiltModel& built, const std::string& name) {
  const int index = built.part_set(name);
  if (index < 0)
    throw UserError(
        Problem{{}, "part set `" + name + "`", "a *SET_PART of that title", "none", {}});
  return index;
}

CharacteristicLaw law_of(const Characteristic& c, double rate) {
  return {c.loading, c.permanent_fraction, c.unloading_exponent, rate};
}

/// One patch per component of the car, so that its facets share one deflection.
std::vector<RigidPatch> patches_of(const BodyShapes& shapes, double rate) {
  std::vector<RigidPatch> patches;
  for (const EllipsoidShape& e : shapes.ellipsoids)
    patches.push_back({e.name, {RigidEllipsoid{e.X_BE, e.semi_axes}}, law_of(e.flesh, rate)});
  for (const FrontFacet& f : shapes.facets) {
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

ContactSurface outer_surface(const BuiltModel& built, const std::string& parts) {
  std::vector<ContactPart> of;
  for (int p : built.part_sets[require_part_set(built, parts)].second) of.push_back({p, 0, 0, {}});
  return surface_of(built.model.mesh, of);
}

std::vector<TissueRegion> regions_of(const BuiltModel& built, const std::string& brain) {
  const std::vector<int>& parts = built.part_sets[require_part_set(built, brain)].second;
  std::vector<TissueRegion> regions{{"brain", parts}};
  for (int p : parts) regions.push_back({built.model.mesh.parts[p].name, {p}});
  return regions;
}

}  // namespace

FeNode::FeNode(FeConfig config, int threads, std::filesystem::path folder)
    : config_(std::move(config)), threads_(threads), folder_(std::move(folder)) {
  Deck deck;
  if (config_.head_neck.is_generated) {
    const generate::HeadNeck made = generate::build_head_neck(config_.head_neck.spec);
    joint_ = made.landmarks.c7_t1;
    deck = generate::to_deck(made.draft, config_.head_neck.spec.units);
  } else {
    joint_ = config_.head_neck.joint;
    deck = require_runnable(read_deck(config_.head_neck.deck), MissingPolicy::Refuse);
  }
  if (!folder_.empty()) {
    std::filesystem::create_directories(folder_ / "model");
    write_deck(folder_ / "model" / "head_neck.k", deck);
  }
  BuildOptions options;
  options.units = config_.head_neck.units;
  options.mass_scaling_step = 0;
  for (const InterfaceSpec& interface : config_.interfaces) {
    if (interface.is_attached)
      options.driven_parts.push_back(block_name(interface, deck));
    else
      options.followers.push_back(interface.body);
  }
  built_ = build_model(deck, options);
  built_.model.settings.step_scale = config_.step_scale;
  if (config_.added_mass_limit > 0) {
    options.mass_scaling_step = mass_scaling_step_for(built_.model, config_.added_mass_limit);
    built_ = build_model(deck, options);
    built_.model.settings.step_scale = config_.step_scale;
  }
  built_.model.settings.gravity = {0, 0, -config_.gravity};
  const auto find_body = [&](const std::string& name) {
    const std::vector<RigidBody>& bodies = built_.model.bodies;
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (bodies[b].name == name) return static_cast<int>(b);
    throw UserError(
        Problem{{}, "interface part `" + name + "`", "a rigid part of the deck", "none", {}});
  };
  for (const std::string& name : options.driven_parts) boundary_.bodies.push_back(find_body(name));
  boundary_.attached = static_cast<int>(boundary_.bodies.size());
  for (const std::string& name : options.followers) boundary_.bodies.push_back(find_body(name));
  add_partner_contacts();
  finish_model(built_);
  const Model& model = built_.model;
  const int skull = model.mesh.find_node_set(config_.head_neck.skull_set);
  if (skull < 0)
    throw UserError(Problem{{},
                            "node set `" + config_.head_neck.skull_set + "`",
                            "a *SET_NODE of that title",
                            "none",
                            {}});
  const int head = require_part_set(built_, config_.head_neck.head_parts);
  const Inertia inertia = inertia_of_parts(model, built_.part_sets[head].second);
  head_ = HeadMotion(model, model.mesh.node_sets[skull].nodes, inertia.com);
  tissue_ = TissueMetrics(model, regions_of(built_, config_.head_neck.brain_parts));
  scratch_.emplace(model, threads_);
  double added = 0;
  for (double m : model.added_mass) added += m;
  log_info(
      "model: {} nodes, {} hexahedra, {} lines, mass {:.3f} kg (head {:.3f} kg), added mass "
      "{:.4f} kg, stable step {:.3f} us",
      model.mesh.node_count(), model.mesh.table(ElementKind::Hex8).size(),
      model.mesh.table(ElementKind::Line2).size(), model.total_mass(), inertia.mass, added,
      1e6 * initial_stable_step(model));
  for (const std::string& note : built_.notes) log_warning("{}", note);
}

FeNode::~FeNode() = default;

void FeNode::add_partner_contacts() {
  const ContactSurface surface = outer_surface(built_, config_.head_neck.surface_parts);
  std::vector<int> nodes;
  for (const ContactNode& n : surface.nodes) nodes.push_back(n.node);
  for (const BodyShapes& shapes : config_.partner_shapes) {
    RigidSurfaceSpec spec;
    spec.name = "head and " + shapes.body;
    spec.nodes = nodes;
    spec.patches = patches_of(shapes, config_.body.contact.rate);
    spec.friction = shapes.facets.empty() ? config_.self_friction : config_.vehicle_friction;
    for (std::size_t k = boundary_.attached; k < boundary_.bodies.size(); ++k)
      if (built_.model.bodies[boundary_.bodies[k]].name == shapes.body)
        spec.body = boundary_.bodies[k];
    if (!spec.patches.empty())
      built_.model.contacts.push_back(make_rigid_surface_contact(std::move(spec)));
  }
}

std::vector<InterfaceBody> FeNode::interface_bodies() const {
  std::vector<InterfaceBody> bodies;
  for (const InterfaceSpec& interface : config_.interfaces)
    bodies.push_back({interface.body, {}, {}, interface.is_attached});
  return bodies;
}

std::vector<InterfaceBody> FeNode::place(std::vector<InterfaceBody> bodies) {
  CW_ASSERT(bodies.size() == boundary_.bodies.size());
  const auto torso = std::find_if(bodies.begin(), bodies.end(),
                                  [](const InterfaceBody& b) { return b.name == "torso_up"; });
  Pose X_WD;
  Twist V_WD;
  if (torso != bodies.end()) {
    const Vec3 p_TD = neck_landmarks(config_.body).base_on_torso - joint_;
    X_WD = torso->motion.X_WB * Pose{Quat::Identity(), p_TD};
    V_WD = torso->motion.V_WB.shifted(X_WD.p - torso->motion.X_WB.p);
  }
  run_.state = initial_state(built_.model, X_WD, V_WD);
  const std::vector<Inertia> blocks = rebase_bodies(boundary_, bodies, built_.model, run_.state);
  for (std::size_t k = 0; k < bodies.size(); ++k) bodies[k].block = blocks[k];
  run_.head_twist = head_.twist(run_.state);
  run_.peaks = tissue_.no_peaks();
  if (!folder_.empty() && config_.field_interval > 0)
    fields_ = std::make_unique<FieldWriter>(built_.model, folder_ / "fields");
  return bodies;
}

FeReply FeNode::run_window(const FeGrant& grant) {
  const Model& model = built_.model;
  const WindowLoads window = advance_window(model, boundary_, grant, run_.state, *scratch_);
  progress_ += window.substeps;
  FeReply reply;
  reply.substeps = window.substeps;
  reply.loads = window.loads;
  reply.state_hash = state_digest(run_.state);
  reply.stable_step = run_.state.stable_step;
  const Energies& e = run_.state.energies;
  reply.kinetic = e.kinetic;
  reply.internal = e.internal;
  reply.hourglass = e.hourglass();
  reply.contact = e.contact();
  reply.damping = e.damping + e.viscous;
  reply.external_work = e.external_work;
  reply.interface_work = e.interface_work;
  for (double m : model.added_mass) reply.added_mass += m;
  for (std::size_t k = 0; k < boundary_.bodies.size(); ++k)
    if (config_.interfaces[k].body == "buck")
      reply.head_contact_force = window.loads[k].impulse.head<3>().norm() / grant.id.length_s();
  return reply;
}

FeReply FeNode::advance(const FeGrant& grant, RecordSink& sink) {
  if (grant.id.phase == Phase::Evaluate) {
    if (grant.id.iteration == 0)
      saved_ = run_;
    else
      run_ = saved_;
  }
  if (grant.id.phase != Phase::Accept) {
    try {
      last_reply_ = run_window(grant);
    } catch (const NumericalError&) {
      write_last_sound_frame();
      throw;
    }
  }
  if (grant.id.phase != Phase::Evaluate) publish(grant.id, sink);
  return last_reply_;
}

void FeNode::publish(const WindowId& id, RecordSink& sink) {
  const std::int64_t end_ns = (id.window + 1) * id.window_ns;
  const HeadSample head = head_.sample(run_.state, end_ns, run_.head_twist, id.length_s());
  run_.head_twist = head.V_WH;
  sink.head(head);
  const auto is_due = [end_ns](std::int64_t& next, double interval) {
    if (interval <= 0 || end_ns < next) return false;
    next = end_ns + std::llround(interval * 1e9);
    return true;
  };
  const bool tissue_due = is_due(run_.next_tissue_ns, config_.tissue_interval);
  if (is_due(run_.next_strain_ns, config_.strain_interval) || tissue_due) {
    const TissueSample tissue = tissue_.sample(built_.model, run_.state, end_ns, run_.peaks);
    if (tissue_due) sink.tissue(tissue);
  }
  if (fields_ && is_due(run_.next_field_ns, config_.field_interval)) fields_->write(run_.state);
}

/// An element is inverted at the present positions: one step back none was.
void FeNode::write_last_sound_frame() {
  if (folder_.empty()) return;
  State sound = run_.state;
  for (NodeRecord& node : sound.nodes)
    node.set_position(node.position() - sound.last_dt * node.velocity());
  sound.time -= sound.last_dt;
  FieldWriter writer(built_.model, folder_ / "fields" / "last_sound");
  log_error("last sound frame: fields/last_sound/{}", writer.write(sound).string());
}

std::string FeNode::description() const {
  using nlohmann::json;
  json parts = json::array();
  for (const MeshPart& part : built_.model.mesh.parts)
    parts.push_back({{"id", part.id.value}, {"name", part.name}, {"rigid", part.is_rigid}});
  const ContactSurface surface = outer_surface(built_, config_.head_neck.surface_parts);
  json vertices = json::array(), triangles = json::array();
  std::vector<int> vertex(built_.model.mesh.node_count(), -1);
  const auto rounded = [](double x) { return std::round(x * 1e4) / 1e4; };  // 0.1 mm
  for (const ContactNode& n : surface.nodes) {
    vertex[n.node] = static_cast<int>(vertices.size());
    const Vec3 p = built_.model.mesh.position[n.node] - head_.origin();
    vertices.push_back({rounded(p.x()), rounded(p.y()), rounded(p.z())});
  }
  for (const ContactFacet& facet : surface.facets) {
    const auto corner = [&](int i) { return vertex[facet.node[i]]; };
    triangles.push_back({corner(0), corner(1), corner(2)});
    if (!facet.is_triangle()) triangles.push_back({corner(0), corner(2), corner(3)});
  }
  const json text = {{"regions", tissue_.names()},
                     {"parts", parts},
                     {"head_surface", {{"vertices_m", vertices}, {"triangles", triangles}}}};
  return text.dump();
}

std::vector<std::byte> FeNode::save_state() const {
  ByteWriter writer;
  write_state(run_.state, writer);
  writer.value(run_.head_twist);
  writer.vector(run_.peaks);
  writer.value(run_.next_tissue_ns);
  writer.value(run_.next_strain_ns);
  writer.value(run_.next_field_ns);
  writer.value(progress_.load());
  return writer.take();
}

void FeNode::load_state(const std::vector<std::byte>& bytes) {
  ByteReader reader(bytes);
  read_state(reader, run_.state);
  reader.value(run_.head_twist);
  reader.vector(run_.peaks);
  reader.value(run_.next_tissue_ns);
  reader.value(run_.next_strain_ns);
  reader.value(run_.next_field_ns);
  std::int64_t done = 0;
  reader.value(done);
  if (!reader.is_at_end())
    throw ProtocolError(ExitCode::CheckpointMismatch, "the saved state is too long for this model");
  progress_ = done;
}

}  // namespace crosswalk::fe
