// Eight bytes behind every message, a digest of the message and of its run, so that a mutated
// payload under an intact header, or one of another run, is dropped before it is decoded. LCM's
// decoders read a type's members and ignore what follows, so its tools see our messages as before.
//
// Against damage and strangers' noise, not against forgery: whoever knows this file can seal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace crosswalk {

inline constexpr std::size_t kSealBytes = 8;

/// Appends the seal of `run`, the digest of a run id.
void seal(std::int64_t run, std::vector<std::byte>& message);
/// The message without its seal; nothing when the seal is not that of these bytes and this run.
std::optional<std::span<const std::byte>> unsealed(std::int64_t run,
                                                   std::span<const std::byte> message);

}  // namespace crosswalk
