#include "fe_node/fe_node.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/error.h"
#include "common/log.h"
#include "common/neck_landmarks.h"
#include "fe_node/contact/surface.h"
#include "fe_node/output/field_writer.h"
#include "fe_node/output/state_bytes.h"
#include "fe_node/own_head.h"
#include "fe_node/solver.h"

namespace crosswalk::fe {
namespace {

constexpr std::int64_t kSoundInterval = 1'000'000;  ///< ns between copies of a sound state

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

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Without added mass and without what sleeps, kg: what added mass is a share of.
double head_neck_mass(const Model& model) {
  double mass = model.total_mass() - sum_of(model.added_mass);
  if (!model.sleeper) return mass;
  for (int n = model.sleeper->first_node; n < model.mesh.node_count(); ++n) mass -= model.mass[n];
  return mass - model.bodies[model.sleeper->body].own.mass;
}

}  // namespace

FeNode::FeNode(FeConfig config, int threads, std::filesystem::path folder)
    : config_(std::move(config)),
      threads_(threads),
      folder_(std::move(folder)),
      node_(build_node_model(config_, folder_)) {
  const Model& model = node_.built.model;
  const int skull = model.mesh.find_node_set(kSkullNodes);
  CW_ASSERT(skull >= 0);
  const int head = require_part_set(node_.built, kHeadParts);
  const Inertia inertia = inertia_of_parts(model, node_.built.part_sets[head].second);
  const HeadNeckConfig& own = config_.head_neck;
  const Pose X_DH{own.q_ND.conjugate(), own.head_centre.value_or(inertia.com)};
  head_ = HeadMotion(model, model.mesh.node_sets[skull].nodes, X_DH);
  compare_with_multibody_head();
  tissue_ = TissueMetrics(model, regions_of(node_.built, kBrainParts));
  scratch_.emplace(model, threads_);
  cut_neck(node_.built.part_sets[head].second);
  const double added = sum_of(model.added_mass);
  log_info(
      "model: {} nodes, {} hexahedra, {} shells, {} lines, mass {:.3f} kg (head {:.3f} kg), added "
      "mass {:.4f} kg, {:.2f} % of head and neck, stable step {:.3f} us, elements in {} precision",
      model.mesh.node_count(), model.mesh.table(ElementKind::Hex8).size(),
      model.mesh.table(ElementKind::Quad4).size(), model.mesh.table(ElementKind::Line2).size(),
      model.total_mass(), inertia.mass, added, 100 * added / head_neck_mass(model),
      1e6 * initial_stable_step(model),
      config_.precision == Precision::Double ? "double" : "single");
  for (std::size_t p = 0; p < model.mesh.parts.size(); ++p)
    if (model.added_mass[p] > 0)
      log_info("added mass of part {} '{}': {:.3g} kg, {:.2g} %", model.mesh.parts[p].id.value,
               model.mesh.parts[p].name, model.added_mass[p],
               100 * model.added_mass[p] / model.part_mass[p]);
  for (const std::string& note : node_.built.notes) log_warning("{}", note);
}

FeNode::~FeNode() = default;

/// A head far from where the subject has it was mapped or measured wrongly.
void FeNode::compare_with_multibody_head() const {
  if (config_.head_neck.is_generated) return;
  constexpr double kFar = 0.03;  // m; a generated head without a fit lies up to 28 mm off
  const NeckLandmarks marks = neck_landmarks(config_.body);
  const Vec3 ours = config_.head_neck.q_ND * Vec3(head_.frame().p - node_.joint);
  const Vec3 off = 1e3 * (ours - (marks.head_centre - marks.base));
  const std::string text = fmt::format(
      "the head's centre lies ({:+.0f}, {:+.0f}, {:+.0f}) mm (forward, left, up) from the "
      "multibody head's",
      off.x(), off.y(), off.z());
  if (off.norm() < 1e3 * kFar)
    log_info("{}", text);
  else
    log_warning("{}; check head_neck.joint, forward_axis, up_axis and units", text);
}

/// The load between head and neck is that of the elements which hold on to the head's nodes.
void FeNode::cut_neck(const std::vector<int>& head_parts) {
  const SectionCut cut = cut_round(node_.built.model, head_parts);
  if (cut.elements.empty()) return;
  const NeckLandmarks marks = neck_landmarks(config_.body);
  const Vec3 p_DC =
      node_.joint + config_.head_neck.q_ND.conjugate() * Vec3(marks.condyles - marks.base);
  condyles_ = head_.frame().inverse() * p_DC;
  neck_.emplace(node_.built.model, cut, *scratch_);
}

std::vector<InterfaceBody> FeNode::interface_bodies() const {
  std::vector<InterfaceBody> bodies;
  for (const InterfaceSpec& interface : config_.interfaces)
    bodies.push_back({interface.body, {}, {}, interface.is_attached});
  return bodies;
}

std::vector<InterfaceBody> FeNode::place(std::vector<InterfaceBody> bodies) {
  CW_ASSERT(bodies.size() == node_.boundary.bodies.size());
  const auto find = [&bodies](const char* name) {
    return std::find_if(bodies.begin(), bodies.end(),
                        [name](const InterfaceBody& b) { return b.name == name; });
  };
  const auto torso = find("torso_up"), buck = find("buck"), head = find("head");
  Pose X_WD;
  Twist V_WD;
  if (torso != bodies.end()) {
    const Quat& q_ND = config_.head_neck.q_ND;
    const Vec3 p_TD = neck_landmarks(config_.body).base_on_torso - q_ND * node_.joint;
    X_WD = torso->motion.X_WB * Pose{q_ND, p_TD};
    V_WD = torso->motion.V_WB.shifted(X_WD.p - torso->motion.X_WB.p);
  }
  if (head != bodies.end()) {  // alone: it stands where the other run's head was
    X_WD = head->motion.X_WB * head_.frame().inverse();
    V_WD = head->motion.V_WB.shifted(X_WD.p - head->motion.X_WB.p);
  }
  run_.state = initial_state(node_.built.model, X_WD, V_WD);
  if (config_.windshield && buck != bodies.end())
    place_sleeper(node_.built.model, buck->motion.X_WB * windshield_in_buck(), buck->motion.V_WB,
                  run_.state);
  const std::vector<Inertia> blocks =
      rebase_bodies(node_.boundary, bodies, node_.built.model, run_.state);
  for (std::size_t k = 0; k < bodies.size(); ++k) bodies[k].block = blocks[k];
  start_motion_log(X_WD, V_WD);
  run_.head_twist = head_.twist(run_.state);
  run_.peaks = tissue_.no_peaks();
  if (!folder_.empty() && config_.field_interval > 0)
    fields_ = std::make_unique<FieldWriter>(node_.built.model, folder_ / "fields");
  return bodies;
}

void FeNode::start_motion_log(const Pose& X_WD, const Twist& V_WD) {
  BlockMotionSetup setup = node_.motion;
  if (!config_.logs_block_motion || folder_.empty() || config_.is_head_alone) return;
  if (static_cast<int>(setup.blocks.size()) < node_.boundary.attached) {
    log_warning("no model/driven.k: an attached body follows no rigid part of the deck");
    return;
  }
  setup.X_WD = X_WD;
  setup.V_WD = V_WD;
  motion_log_.emplace(std::move(setup), folder_ / "model");
}

FeReply FeNode::run_window(const FeGrant& grant) {
  const Model& model = node_.built.model;
  if (is_asleep(model, run_.state) &&
      is_near_windshield(config_, node_, run_.state, run_.state.bodies[model.sleeper->body].X_WB)) {
    wake_sleeper(model, run_.state);
    log_info("the head is near the windshield: it takes part from {:.2f} ms on",
             1e3 * run_.state.time);
  }
  last_window_ = advance_window(model, node_.boundary, grant, run_.state, *scratch_, &watch_);
  tell_short_step();
  const WindowLoads& window = last_window_;
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
  reply.added_mass = sum_of(model.added_mass);
  Vec3 on_car = Vec3::Zero();
  for (std::size_t c : node_.car_contacts) on_car += scratch_->contact_reports[c].force;
  reply.head_contact_force = on_car.norm();
  return reply;
}

/// Who makes the run slow: said whenever the step has lost another fifth.
void FeNode::tell_short_step() {
  constexpr double kWorthTelling = 0.8;
  const State& state = run_.state;
  if (told_step_ <= 0) told_step_ = state.stable_step;
  if (state.stable_step > kWorthTelling * told_step_) return;
  told_step_ = state.stable_step;
  const StepReport& limit = state.element_limit;
  log_info(
      "{:.2f} ms: the stable step has fallen to {:.3g} us, the shortest by itself is that of {}",
      1e3 * state.time, 1e6 * state.stable_step,
      limit.stable_step > state.stable_step || limit.critical_element < 0
          ? "a contact"
          : describe_element(node_.built.model, limit.critical_block, limit.critical_element));
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
      if (!folder_.empty()) sound_.write(node_.built.model, run_.state, folder_ / "fields");
      throw;
    }
  }
  if (grant.id.phase != Phase::Evaluate) {
    if (motion_log_) motion_log_->add(grant.id.begin_s(), last_window_);
    publish(grant.id, sink);
  }
  return last_reply_;
}

void FeNode::publish(const WindowId& id, RecordSink& sink) {
  if (!id.ends_window()) return;
  const std::int64_t end_ns = id.end_ns();
  HeadSample head =
      head_.sample(run_.state, end_ns, run_.head_twist, 1e-9 * static_cast<double>(id.window_ns));
  if (neck_) head.neck = neck_->about(head.X_WH * condyles_, run_.state, *scratch_);
  run_.head_twist = head.V_WH;
  sink.head(head);
  if (!folder_.empty() && end_ns >= next_sound_ns_) {
    sound_.keep(run_.state);
    next_sound_ns_ = end_ns + kSoundInterval;
  }
  const auto is_due = [end_ns](std::int64_t& next, double interval) {
    if (interval <= 0 || end_ns < next) return false;
    next = end_ns + std::llround(interval * 1e9);
    return true;
  };
  const bool tissue_due = is_due(run_.next_tissue_ns, config_.tissue_interval);
  if (is_due(run_.next_strain_ns, config_.strain_interval) || tissue_due) {
    const TissueSample tissue =
        tissue_.sample(node_.built.model, run_.state, end_ns, run_.peaks, threads_);
    if (tissue_due) sink.tissue(tissue);
  }
  if (fields_ && is_due(run_.next_field_ns, config_.field_interval)) {
    if (is_asleep(node_.built.model, run_.state)) carry_sleeper(node_.built.model, run_.state);
    fields_->write(run_.state);
  }
}

std::string FeNode::description() const {
  using nlohmann::json;
  json parts = json::array();
  for (const MeshPart& part : node_.built.model.mesh.parts)
    parts.push_back({{"id", part.id.value}, {"name", part.name}, {"rigid", part.is_rigid}});
  const ContactSurface surface = outer_surface(node_.built, kHeadSurface);
  const Pose X_HD = head_.frame().inverse();
  json vertices = json::array(), triangles = json::array();
  std::vector<int> vertex(node_.built.model.mesh.node_count(), -1);
  const auto rounded = [](double x) { return std::round(x * 1e4) / 1e4; };  // 0.1 mm
  for (const ContactNode& n : surface.nodes) {
    vertex[n.node] = static_cast<int>(vertices.size());
    const Vec3 p = X_HD * node_.built.model.mesh.position[n.node];
    vertices.push_back({rounded(p.x()), rounded(p.y()), rounded(p.z())});
  }
  for (const ContactFacet& facet : surface.facets) {
    const auto corner = [&](int i) { return vertex[facet.node[i]]; };
    triangles.push_back({corner(0), corner(1), corner(2)});
    if (!facet.is_triangle()) triangles.push_back({corner(0), corner(2), corner(3)});
  }
  const json text = {{"mass_kg", head_neck_mass(node_.built.model)},
                     {"regions", tissue_.names()},
                     {"parts", parts},
                     {"head_surface", {{"vertices_m", vertices}, {"triangles", triangles}}}};
  return text.dump();
}

std::vector<std::byte> FeNode::save_state() const {
  ByteWriter writer;
  write_state(run_.state, writer);
  writer.values(run_.head_twist.w);
  writer.values(run_.head_twist.v);
  writer.list(run_.peaks);
  writer.value(run_.next_tissue_ns);
  writer.value(run_.next_strain_ns);
  writer.value(run_.next_field_ns);
  writer.value(progress_.load());
  return writer.take();
}

void FeNode::load_state(const std::vector<std::byte>& bytes) {
  ByteReader reader(bytes);
  read_state(reader, run_.state);
  reader.values(run_.head_twist.w);
  reader.values(run_.head_twist.v);
  reader.list(run_.peaks);
  reader.value(run_.next_tissue_ns);
  reader.value(run_.next_strain_ns);
  reader.value(run_.next_field_ns);
  progress_ = reader.take<std::int64_t>();
  reader.require_end();
  if (fields_) fields_->continue_after(run_.state.time);
  if (motion_log_) motion_log_->continue_after(run_.state.time);
}

}  // namespace crosswalk::fe
