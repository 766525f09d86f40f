#include "fe_node/validate/neck_moment.h"

#include <algorithm>

namespace crosswalk::fe::validate {

std::vector<MomentSample> turn_slowly(const generate::ModelDraft& draft, const Turning& turning,
                                      const std::filesystem::path& folder,
                                      const Computing& computing) {
  constexpr double kRise = 0.020, kWindow = 0.004;  // s
  constexpr double kDamping = 60;  // 1/s, on masses; its work is left out of the moment [E]
  const double end = 0.5 * kRise + turning.last_angle / turning.rate;
  DeckCase deck(draft, UnitSystem::MmTonneS);
  deck.guide_part(turning.part, 3 + turning.axis,
                  {{0, 0},
                   {kRise, turning.sense * turning.rate},
                   {end + kWindow, turning.sense * turning.rate}});
  for (const int part : turning.held)
    for (int dof = 0; dof < 6; ++dof) deck.guide_part(part, dof, {{0, 0}, {end, 0}});
  Damping damping;
  damping.value = kDamping * unit_factors(UnitSystem::MmTonneS).time;
  deck.deck.dampings.push_back(damping);
  deck.end_at(end);
  DeckRun run(deck.deck, folder, computing, 0.02);
  const std::vector<int> bodies = spine_bodies(run, draft);

  std::vector<MomentSample> samples;
  double work = 0, turned = 0;
  bool is_over = false;
  run.run(end, kWindow, [&](const State& state) {
    if (is_over || state.time == 0) return;
    // Of the prescribed speed: the work is the moment times this angle, however the body tilts.
    MomentSample now;
    now.turned = turning.rate * (state.time < kRise ? state.time * state.time / (2 * kRise)
                                                    : state.time - 0.5 * kRise);
    const Energies& e = state.energies;
    const double useful = e.external_work - e.damping - e.kinetic;
    now.moment = (useful - work) / std::max(now.turned - turned, 1e-9);
    now.levels = level_angles(state, bodies, turning.axis);
    for (double& angle : now.levels) angle *= turning.sense;
    now.energy = energy_by_bearer(run);
    samples.push_back(now);
    is_over = now.moment >= turning.last_moment && state.time > kRise;
    work = useful;
    turned = now.turned;
  });
  return samples;
}

MomentSample at_moment(const std::vector<MomentSample>& samples, double moment) {
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const MomentSample &a = samples[i - 1], &b = samples[i];
    if (b.moment < moment) continue;
    const double share = std::clamp((moment - a.moment) / (b.moment - a.moment), 0.0, 1.0);
    const auto between = [share](double x, double y) { return x + share * (y - x); };
    MomentSample out;
    out.moment = moment;
    out.turned = between(a.turned, b.turned);
    for (std::size_t k = 0; k < a.levels.size(); ++k)
      out.levels.push_back(between(a.levels[k], b.levels[k]));
    for (int k = 0; k < kBearers; ++k) out.energy[k] = between(a.energy[k], b.energy[k]);
    return out;
  }
  return {};
}

}  // namespace crosswalk::fe::validate
