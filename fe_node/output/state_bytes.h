// A State as bytes and back, bit for bit; and its digest. For checkpoints on the same machine and
// build.
#pragma once

#include <cstdint>

#include "common/byte_archive.h"
#include "fe_node/state.h"

namespace crosswalk::fe {

void write_state(const State& state, ByteWriter& writer);
/// The state must have been made for the same model; throws ProtocolError otherwise.
void read_state(ByteReader& reader, State& state);
/// Digest of positions, velocities and bodies (64-bit FNV-1a over 8-byte words).
std::uint64_t state_digest(const State& state);

}  // namespace crosswalk::fe
