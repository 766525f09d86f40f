#include "recorder/message_decode.h"

#include <array>

#include "common/seal.h"

namespace crosswalk::recording {

namespace {

constexpr std::size_t kHashBytes = 8;

std::int32_t int32_at(std::span<const std::byte> data, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = (value << 8U) | static_cast<std::uint32_t>(data[offset + i]);
  return static_cast<std::int32_t>(value);
}

}  // namespace

std::optional<msg::header> peek_header(std::span<const std::byte> data) {
  msg::header h{};
  const auto header_bytes = static_cast<std::size_t>(h._getEncodedSizeNoHash());
  if (data.size() < kHashBytes + header_bytes || data.size() > kMaxMessageBytes + kSealBytes) {
    return std::nullopt;
  }
  if (h._decodeNoHash(data.data(), static_cast<int>(kHashBytes), static_cast<int>(header_bytes)) <
      0) {
    return std::nullopt;
  }
  const bool is_sound = h.protocol == kProtocolVersion && unsealed(h.run_id, data).has_value();
  const bool is_ours = is_sound && h.sender >= 1 && h.sender <= static_cast<int>(Role::Tool) &&
                       h.kind >= 1 && h.kind <= static_cast<int>(kind_rules().size());
  return is_ours ? std::optional<msg::header>(h) : std::nullopt;
}

bool is_sound_manifest(std::span<const std::byte> data) {
  // hash, header, three int64, scheme, has_fe, then n_bodies
  const msg::header h{};
  const std::size_t offset =
      kHashBytes + static_cast<std::size_t>(h._getEncodedSizeNoHash()) + 3 * 8 + 2 * 4;
  if (data.size() < offset + 4) return false;
  const std::int32_t n = int32_at(data, offset);
  return n >= 0 && n <= kMaxInterfaceBodies;
}

}  // namespace crosswalk::recording
