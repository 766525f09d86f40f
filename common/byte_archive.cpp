#include "common/byte_archive.h"

#include <cstring>

#include "common/error.h"

namespace crosswalk {

void ByteWriter::raw(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::byte*>(data);
  bytes_.insert(bytes_.end(), bytes, bytes + size);
}

void ByteReader::raw(void* data, std::size_t size) {
  require(size <= rest_.size());
  if (size > 0) std::memcpy(data, rest_.data(), size);
  rest_ = rest_.subspan(size);
}

/// The number of items that follow, each of `item` bytes: no more than there are bytes.
std::size_t ByteReader::size_of(std::size_t item) {
  const auto count = take<std::uint64_t>();
  require(count <= rest_.size() / item);
  return count;
}

void ByteReader::require(bool holds) {
  if (!holds)
    throw ProtocolError(ExitCode::CheckpointMismatch,
                        "a saved state is damaged or belongs to another model");
}

}  // namespace crosswalk
