// The multibody state as bytes and back, bit by bit; same machine and build only.
#pragma once

#include <cstddef>
#include <vector>

#include "mb_node/model.h"

namespace crosswalk::mb {

std::vector<std::byte> to_bytes(const MbState& state);
/// `state` comes with the sizes of its model; throws ProtocolError when the bytes do not fit it.
void from_bytes(const std::vector<std::byte>& bytes, MbState& state);

}  // namespace crosswalk::mb
