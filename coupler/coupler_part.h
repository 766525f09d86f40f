// The coupler's own part of a checkpoint: the coupling state, the audit, and the numbers of both
// links.
#pragma once

#include <filesystem>

#include "common/checkpoint.h"
#include "coupler/coupler.h"
#include "coupler/lcm_link.h"

namespace crosswalk::coupling {

/// Writes the part and names the checkpoint of `window` complete; every node must have written its
/// own.
void save_part(const std::filesystem::path& checkpoints, std::int64_t window,
               const Coupler& coupler, const LcmMbLink& mb, const LcmFeLink& fe, const Hub& hub);
/// Continues from the part; call after the nodes have loaded theirs (Hub::gather).
void load_part(const CheckpointPart& part, Coupler& coupler, LcmMbLink& mb, LcmFeLink& fe,
               Hub& hub);

}  // namespace crosswalk::coupling
