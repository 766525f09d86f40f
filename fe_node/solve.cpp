#include "fe_node/solve.h"

#include <cmath>
#include <fstream>
#include <optional>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "common/error.h"
#include "common/interrupt.h"
#include "common/log.h"
#include "fe_node/deck/runnable.h"
#include "fe_node/explosion.h"
#include "fe_node/last_sound.h"
#include "fe_node/model_builder/model_builder.h"
#include "fe_node/output/field_writer.h"
#include "fe_node/output/head_motion.h"
#include "fe_node/output/history.h"
#include "fe_node/output/state_bytes.h"
#include "fe_node/own_head.h"
#include "fe_node/solver.h"

namespace crosswalk::fe {
namespace {

constexpr int kDefaultFrames = 20;     ///< field files of a deck that asks for none
constexpr int kDefaultHistory = 1000;  ///< history lines likewise
constexpr int kProgressLines = 10;

class EnergyHistory {
 public:
  explicit EnergyHistory(const std::filesystem::path& path) : file_(path) {
    file_ << "time_s,step_s,kinetic_J,internal_J,hourglass_J,viscous_J,damping_J,contact_J,"
             "external_work_J,balance_error_percent\n";
  }
  void add(const State& state) {
    const Energies& e = state.energies;
    fmt::print(file_, "{:.9g},{:.6g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.4f}\n",
               state.time, state.last_dt, e.kinetic, e.internal, e.hourglass(), e.viscous,
               e.damping, e.contact(), e.external_work + e.interface_work, 100 * e.balance_error());
  }

 private:
  std::ofstream file_;
};

/// Motion of the head's mass centre where the deck says what the head is: sets `head`, `skull_fit`.
class HeadHistory {
 public:
  HeadHistory(const BuiltModel& built, const std::filesystem::path& path) {
    const int skull = built.model.mesh.find_node_set(kSkullNodes),
              parts = built.part_set(kHeadParts);
    if (skull < 0 || parts < 0) return;
    const Inertia inertia = inertia_of_parts(built.model, built.part_sets[parts].second);
    head_.emplace(built.model, built.model.mesh.node_sets[skull].nodes,
                  Pose{Quat::Identity(), inertia.com});
    file_.open(path);
    file_ << "time_s,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s\n";
  }
  /// Positions at the state's time, velocities of half a step before.
  void add(const State& state) {
    if (!head_) return;
    const HeadSample h = head_->sample(state, 0, {}, 1);
    const Vec3 &p = h.X_WH.p, &v = h.V_WH.v, &w = h.V_WH.w;
    fmt::print(file_,
               "{:.9g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g}\n",
               state.time, p.x(), p.y(), p.z(), v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
  }

 private:
  std::optional<HeadMotion> head_;
  std::ofstream file_;
};

void write_restart(const State& state, const std::filesystem::path& path) {
  ByteWriter writer;
  write_state(state, writer);
  const std::vector<std::byte> bytes = writer.take();
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  if (!file.flush())
    throw UserError(Problem{{path.string()}, "restart file", "room to write", "none", {}});
}

void read_restart(const std::filesystem::path& path, State& state) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file)
    throw UserError(Problem{{path.string()}, "restart file", "a readable file", "none", {}});
  std::vector<std::byte> bytes(static_cast<std::size_t>(file.tellg()));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  ByteReader reader(bytes);
  read_state(reader, state);
}

/// True each time `time` passes another multiple of `interval`.
class Clock {
 public:
  Clock(double interval, double start) : interval_(interval), next_(start) {}
  bool strikes(double time) {
    if (interval_ <= 0 || time < next_ - 1e-9 * interval_) return false;
    while (next_ <= time + 1e-9 * interval_) next_ += interval_;
    return true;
  }

 private:
  double interval_, next_;
};

void describe(const BuiltModel& built, const SolveRequest& request) {
  log_info("deck {}", request.deck.string());
  for (const std::string& line : model_summary(built.model)) log_info("{}", line);
  for (const std::string& note : built.notes) log_warning("{}", note);
}

}  // namespace

std::vector<std::string> model_summary(const Model& model) {
  double added = 0;
  for (double m : model.added_mass) added += m;
  std::vector<std::string> lines{
      fmt::format("{} nodes, {} parts, mass {:.6g} kg, added mass {:.4g} kg, stable step {:.4g} us",
                  model.mesh.node_count(), model.mesh.parts.size(), model.total_mass(), added,
                  1e6 * initial_stable_step(model))};
  for (std::size_t p = 0; p < model.mesh.parts.size(); ++p)
    if (model.added_mass[p] > 0)
      lines.push_back(fmt::format("added mass of part {} '{}': {:.4g} kg, {:.3g} %",
                                  model.mesh.parts[p].id.value, model.mesh.parts[p].name,
                                  model.added_mass[p],
                                  100 * model.added_mass[p] / model.part_mass[p]));
  return lines;
}

SolveResult solve_deck(const SolveRequest& request) {
  ReadDeck read = read_deck(request.deck, request.reading);
  if (request.units != UnitSystem::Unknown) read.deck.units = request.units;
  require_runnable(read, request.accept_missing ? MissingPolicy::Accept : MissingPolicy::Refuse);
  for (const Problem& warning : read.problems.warnings.summary()) log_warning("{}", warning.text());
  BuildOptions options;
  options.precision = request.precision;
  BuiltModel built = build_model(read.deck, options);
  finish_model(built);
  const Model& model = built.model;
  const double end = request.end_time > 0 ? request.end_time : built.end_time;
  if (!(end > 0))
    throw UserError(Problem{
        {request.deck.string()}, "end time", "*CONTROL_TERMINATION or --end-ms", "neither", {}});
  State state = initial_state(model);
  if (!request.restart.empty()) read_restart(request.restart, state);
  Scratch scratch(model, request.threads);
  describe(built, request);

  FieldWriter fields(model, request.folder / "fields");
  EnergyHistory history(request.folder / "energies.csv");
  HistoryWriter details(model, built.histories, request.folder, scratch);
  HeadHistory head(built, request.folder / "head.csv");
  Clock field_clock(built.field_interval > 0 ? built.field_interval : end / kDefaultFrames,
                    state.time);
  Clock history_clock(built.history_interval > 0 ? built.history_interval : end / kDefaultHistory,
                      state.time);
  Clock detail_clock(built.histories.interval > 0 ? built.histories.interval
                     : built.history_interval > 0 ? built.history_interval
                                                  : end / kDefaultHistory,
                     state.time);
  Clock progress_clock(end / kProgressLines, state.time);
  LastSound sound;
  sound.keep(state);
  ExplosionWatch watch;
  while (state.time < end * (1 - 1e-12) && !interrupt_flag()) {
    set_log_time(state.time);
    if (field_clock.strikes(state.time)) fields.write(state);
    StepReport report;
    try {
      watch.look(model, state, scratch);
      report = compute_forces(model, state, scratch);
      watch.require_step(model, state, scratch, report);
    } catch (const NumericalError&) {
      sound.write(model, state, request.folder);
      throw;
    }
    // No step is cut short at the end: a run that goes on from its restart file then takes the same
    // steps as one that was never stopped.
    const double stable = next_step(model, state, report);
    const double dt = std::isfinite(stable) ? stable : end / kDefaultHistory;
    if (detail_clock.strikes(state.time)) {
      details.write(state, scratch);
      head.add(state);
    }
    for (std::size_t b = 0; b < model.bodies.size(); ++b)
      scratch.body_command[b] = state.bodies[b].V_WB;
    move(model, state, scratch, dt);
    if (history_clock.strikes(state.time)) {
      history.add(state);
      sound.keep(state);
    }
    if (progress_clock.strikes(state.time))
      log_info("{:3.0f} %, step {:.4g} us, energy balance {:+.3f} %", 100 * state.time / end,
               1e6 * dt, 100 * state.energies.balance_error());
  }
  fields.write(state);
  history.add(state);
  head.add(state);
  write_restart(state, request.folder / "restart.bin");
  SolveResult result{state.time, state.step, state.energies, 0, model.total_mass()};
  for (double m : model.added_mass) result.added_mass += m;
  return result;
}

}  // namespace crosswalk::fe
