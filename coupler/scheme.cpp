#include "coupler/scheme.h"

#include <algorithm>

#include <fmt/format.h>

#include "common/error.h"
#include "common/messages.h"
#include "coupler/fixed_point.h"

namespace crosswalk::coupling {

namespace {

std::vector<Vec6> zeros(std::size_t n) { return std::vector<Vec6>(n, Vec6::Zero()); }

// Impulses of the attached bodies, stacked.
Eigen::VectorXd stacked(const std::vector<Vec6>& a, int n) {
  Eigen::VectorXd out(6 * n);
  for (int k = 0; k < n; ++k) out.segment<6>(6 * k) = a[static_cast<std::size_t>(k)];
  return out;
}

// The motion fe follows: from the twist at the start (after `kick`, the twist change by the carried
// impulse) to the twist that mb reached.
std::vector<BodyDrive> drives_between(const std::vector<BodyMotion>& begin,
                                      const std::vector<BodyMotion>& end,
                                      const std::vector<Vec6>& kick,
                                      const std::vector<Vec6>& bias) {
  std::vector<BodyDrive> drives(begin.size());
  for (std::size_t k = 0; k < begin.size(); ++k) {
    const Vec6 V_0 = stack(begin[k].V_WB) + kick[k];
    drives[k] = {begin[k].X_WB, twist_from(V_0), stack(end[k].V_WB) - V_0, bias[k]};
  }
  return drives;
}

// Books the impulses of a window or part: what mb did not yet get becomes the carry, the mean
// wrench the next bias.
void hand_on(CouplingState& state, const WindowResult& result, const std::vector<Vec6>& bias_used) {
  const double H = result.id.length_s();
  state.bias_before = bias_used;
  for (std::size_t k = 0; k < state.bias.size(); ++k) {
    const Vec6& J = result.fe.loads[k].impulse;
    state.carry[k] = J - bias_used[k] * H;
    state.bias[k] = J / H;
  }
  state.bias = as_on_wire(MbGrant{.id = {}, .carry = {}, .bias = state.bias}).bias;
  state.motion = result.mb.bodies;
}

void note_mobility(const SchemeSettings& settings, CouplingState& state, const MbReply& mb) {
  if (mb.mobility.size() > 0) {
    state.mobility = mobility_as_on_wire(mb.mobility);
    state.mobility_window = state.window;
  }
  state.mobility_is_due =
      mb.mobility_changed || state.window + 1 - state.mobility_window >= settings.mobility_every;
}

// Mobility-corrected staggering with impulse carry-over.
//   1. mb advances over the window with the bias and the carried impulse, never rolled back.
//   2. V_0 = V_n + M C, A = (V_n+1 - V_0) / H describe the whole multibody system to fe.
//   3. fe advances: in every substep V += d [A + M (F - b)]; it returns J = sum d F.
//   4. C = J - b H, next b = J / H.
// The block and the body share one velocity at every substep of fe, so the scheme has no lagged
// force that could feed energy, however light the body.
WindowResult advance_mic(const SchemeSettings& settings, CouplingState& state,
                         std::int64_t window_ns, MbLink& mb, FeLink& fe) {
  WindowResult result{.id = {state.window, window_ns}, .mb = {}, .fe = {}};
  result.mb = mb.advance({.id = result.id,
                          .want_mobility = state.mobility_is_due && settings.n_attached > 0,
                          .carry = state.carry,
                          .bias = state.bias});
  note_mobility(settings, state, result.mb);

  std::vector<Vec6> kick = zeros(state.motion.size());
  if (settings.n_attached > 0) {
    const Eigen::VectorXd dV = state.mobility * stacked(state.carry, settings.n_attached);
    for (int k = 0; k < settings.n_attached; ++k)
      kick[static_cast<std::size_t>(k)] = dV.segment<6>(6 * k);
  }
  const FeGrant grant =
      as_on_wire({.id = result.id,
                  .drives = drives_between(state.motion, result.mb.bodies, kick, state.bias),
                  .mobility = state.mobility});
  result.fe = fe.advance(grant);
  hand_on(state, result, state.bias);
  ++state.window;
  return result;
}

// Conventional staggering, for comparison only: mb takes the last window's wrench, fe follows
// blindly. The force lags one window behind the motion and feeds energy: light bodies blow up.
WindowResult advance_staggered(CouplingState& state, std::int64_t window_ns, MbLink& mb,
                               FeLink& fe) {
  WindowResult result{.id = {state.window, window_ns}, .mb = {}, .fe = {}};
  const std::vector<Vec6> none = zeros(state.motion.size());
  result.mb = mb.advance({.id = result.id, .carry = none, .bias = state.bias});
  result.fe =
      fe.advance(as_on_wire({.id = result.id,
                             .drives = drives_between(state.motion, result.mb.bodies, none, none),
                             .mobility = {}}));
  hand_on(state, result, state.bias);
  state.carry = none;
  ++state.window;
  return result;
}

// One part of a window by the implicit scheme: from states saved at its begin, until the wrench mb
// assumed is the one fe returns. Returns the residual; when it is not accepted the nodes stay where
// the last evaluation led, and go back to the begin with the next.
double iterate_part(const SchemeSettings& settings, CouplingState& state, WindowResult& result,
                    MbLink& mb, FeLink& fe) {
  const auto n = static_cast<int>(state.motion.size());
  const double H = result.id.length_s();
  const std::vector<Vec6> none = zeros(state.motion.size());
  std::vector<Vec6> assumed;

  const auto mean_wrench = [&](const Eigen::VectorXd& x) {
    assumed.resize(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) assumed[static_cast<std::size_t>(k)] = x.segment<6>(6 * k);
    const MbGrant grant = as_on_wire({.id = result.id, .carry = state.carry, .bias = assumed});
    assumed = grant.bias;
    result.mb = mb.advance(grant);
    result.fe =
        fe.advance(as_on_wire({.id = result.id,
                               .drives = drives_between(state.motion, result.mb.bodies, none, none),
                               .mobility = {}}));
    ++result.id.iteration;
    Eigen::VectorXd returned(6 * n);
    for (int k = 0; k < n; ++k) {
      returned.segment<6>(6 * k) = result.fe.loads[static_cast<std::size_t>(k)].impulse / H;
    }
    return returned;
  };

  const Eigen::VectorXd last = stacked(state.bias, n), before = stacked(state.bias_before, n);
  const FixedPoint solved =
      solve_fixed_point(mean_wrench, 2 * last - before, wrench_scale(last),
                        {settings.tolerance, settings.max_iterations, settings.anderson_depth});
  result.iterations += solved.evaluations;
  if (!(solved.residual <= settings.accepted_residual)) return solved.residual;
  WindowId accepted = result.id;
  accepted.phase = Phase::Accept;
  mb.advance({.id = accepted, .carry = none, .bias = none});
  fe.advance(FeGrant{
      .id = accepted, .drives = std::vector<BodyDrive>(state.motion.size()), .mobility = {}});
  hand_on(state, result, assumed);
  return solved.residual;
}

// A window as a whole or, where that does not converge, in parts of half the length, and half
// again.
WindowResult advance_implicit(const SchemeSettings& settings, CouplingState& state,
                              std::int64_t window_ns, MbLink& mb, FeLink& fe) {
  WindowResult result{.id = {state.window, window_ns, 0, Phase::Evaluate}, .mb = {}, .fe = {}};
  result.iterations = result.parts = 0;
  const std::int64_t shortest = std::max<std::int64_t>(1, window_ns / settings.most_parts);
  for (std::int64_t length = window_ns; result.id.offset_ns < window_ns;) {
    result.id.part_ns = std::min(length, window_ns - result.id.offset_ns);
    const double residual = iterate_part(settings, state, result, mb, fe);
    if (residual <= settings.accepted_residual) {
      result.residual = std::max(result.residual, residual);
      result.id.offset_ns += result.id.part_ns;
      result.id.iteration = 0;
      ++result.parts;
    } else if (length / 2 < shortest) {
      throw NumericalError(
          result.id.begin_s(),
          fmt::format("the implicit iteration of window {} is at a relative residual of {:.1e} "
                      "after {} passes, even in parts of {:g} us (accepted: {:.0e}); use a "
                      "shorter window_us or scheme = \"mic\"",
                      state.window, residual, result.iterations,
                      1e-3 * static_cast<double>(result.id.part_ns), settings.accepted_residual));
    } else {
      length /= 2;
    }
  }
  result.converged = result.residual <= settings.tolerance;
  result.id = {state.window, window_ns};
  ++state.window;
  return result;
}

/// One list of the fields for both directions of a checkpoint.
template <class Archive, class State>
void visit(Archive& archive, State& state) {
  archive.value(state.window);
  for (std::size_t k = 0; k < state.motion.size(); ++k) {
    auto& m = state.motion[k];
    archive.values(m.X_WB.p);
    archive.values(m.X_WB.q.coeffs());
    archive.values(m.V_WB.w);
    archive.values(m.V_WB.v);
    archive.values(state.bias[k]);
    archive.values(state.bias_before[k]);
    archive.values(state.carry[k]);
  }
  archive.values(state.mobility);
  archive.value(state.mobility_is_due);
  archive.value(state.mobility_window);
}

}  // namespace

CouplingState start_state(const std::vector<InterfaceBody>& bodies) {
  CouplingState state;
  for (const InterfaceBody& body : bodies) state.motion.push_back(body.motion);
  state.bias = state.bias_before = state.carry = zeros(bodies.size());
  return state;
}

void save(const CouplingState& state, ByteWriter& out) {
  out.value(state.motion.size());
  out.value(state.mobility.rows());
  visit(out, state);
}

CouplingState load_coupling_state(ByteReader& in) {
  CouplingState state = start_state(std::vector<InterfaceBody>(in.take<std::size_t>()));
  const auto rows = in.take<Eigen::Index>();
  state.mobility.resize(rows, rows);
  visit(in, state);
  return state;
}

WindowResult advance_window(const SchemeSettings& settings, CouplingState& state,
                            std::int64_t window_ns, MbLink& mb, FeLink& fe) {
  switch (settings.scheme) {
    case Scheme::Mic:
      return advance_mic(settings, state, window_ns, mb, fe);
    case Scheme::Implicit:
      return advance_implicit(settings, state, window_ns, mb, fe);
    case Scheme::Staggered:
      return advance_staggered(state, window_ns, mb, fe);
  }
  CW_ASSERT(false);
}

WindowResult advance_multibody(CouplingState& state, std::int64_t window_ns, MbLink& mb) {
  WindowResult result{.id = {state.window, window_ns}, .mb = {}, .fe = {}, .iterations = 0};
  result.mb = mb.advance({.id = result.id, .carry = state.carry, .bias = state.bias});
  state.motion = result.mb.bodies;
  ++state.window;
  return result;
}

std::string_view scheme_name(Scheme scheme) {
  switch (scheme) {
    case Scheme::Mic:
      return "mic";
    case Scheme::Implicit:
      return "implicit";
    case Scheme::Staggered:
      return "staggered";
  }
  return "";
}

}  // namespace crosswalk::coupling
