#include "fe_node/last_sound.h"

#include <cmath>

#include "common/log.h"
#include "fe_node/output/field_writer.h"

namespace crosswalk::fe {
namespace {

constexpr double kSoundBalance = 0.05;  ///< energy balance of a frame worth looking at

bool is_sound(const State& state) {
  return std::abs(state.energies.balance_error()) < kSoundBalance &&
         std::isfinite(state.energies.total());
}

}  // namespace

void LastSound::keep(const State& state) {
  if (kept_.nodes.empty() || is_sound(state)) kept_ = state;
}

void LastSound::write(const Model& model, const State& failed,
                      const std::filesystem::path& folder) const {
  State sound = failed;
  if (is_sound(failed) || kept_.nodes.empty()) {
    for (NodeRecord& node : sound.nodes)
      node.set_position(node.position() - sound.last_dt * node.velocity());
    sound.time -= sound.last_dt;
  } else {
    sound = kept_;
  }
  FieldWriter writer(model, folder / "last_sound");
  log_error("last sound frame, t = {:.6g} ms: {}", 1e3 * sound.time,
            (folder / "last_sound" / writer.write(sound)).string());
}

}  // namespace crosswalk::fe
