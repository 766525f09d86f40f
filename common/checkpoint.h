// One process's part of a checkpoint, a file RUN/checkpoints/<window>/<role>.state.
//
// A checkpoint is the set of all parts; the coupler owns it and names the latest complete one in
// RUN/checkpoints/latest.json. Files are written aside and renamed, so that a part is there whole
// or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "common/protocol.h"

namespace crosswalk {

struct CheckpointPart {
  std::int64_t window = 0;     ///< the next one to do
  std::int64_t last_seq = -1;  ///< number of the last grant executed
  std::int64_t n_records = 0;  ///< records published so far
  std::vector<std::byte> state;
};

/// Throws ProtocolError{CheckpointMismatch} when the file cannot be written.
void write_part(const std::filesystem::path& checkpoints, Role role, const CheckpointPart& part);
/// Throws ProtocolError{CheckpointMismatch} for a missing, damaged or foreign file.
CheckpointPart read_part(const std::filesystem::path& checkpoints, Role role, std::int64_t window);
/// Marks the checkpoint of `window` complete and removes the ones before it.
void commit_checkpoint(const std::filesystem::path& checkpoints, std::int64_t window);
/// The window of the latest complete checkpoint.
std::optional<std::int64_t> latest_checkpoint(const std::filesystem::path& checkpoints);
/// The same for `--resume`; throws UserError when there is none.
std::int64_t checkpoint_to_resume(const std::filesystem::path& checkpoints);

}  // namespace crosswalk
