// A State as bytes and back, bit for bit; and its digest. For checkpoints on the same machine and
// build.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fe_node/state.h"

namespace crosswalk::fe {

/// Appends raw values to a byte string, and reads them back in order.
class ByteWriter {
 public:
  template <class T>
  void value(const T& v) {
    raw(&v, sizeof(T));
  }
  template <class Vector>
  void vector(const Vector& v) {
    value(static_cast<std::uint64_t>(v.size()));
    raw(v.data(), v.size() * sizeof(typename Vector::value_type));
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void raw(const void* data, std::size_t size);
  std::vector<std::byte> bytes_;
};

/// Throws ProtocolError (checkpoint mismatch) when the bytes run out.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  void value(T& v) {
    raw(&v, sizeof(T));
  }
  template <class Vector>
  void vector(Vector& v) {
    std::uint64_t size = 0;
    value(size);
    check(size * sizeof(typename Vector::value_type));
    v.resize(size);
    raw(v.data(), size * sizeof(typename Vector::value_type));
  }
  bool is_at_end() const { return bytes_.empty(); }

 private:
  void raw(void* data, std::size_t size);
  void check(std::size_t size) const;
  std::span<const std::byte> bytes_;
};

void write_state(const State& state, ByteWriter& writer);
/// The state must have been made for the same model; throws ProtocolError otherwise.
void read_state(ByteReader& reader, State& state);
/// Digest of positions, velocities and bodies (64-bit FNV-1a over 8-byte words).
std::uint64_t state_digest(const State& state);

}  // namespace crosswalk::fe
