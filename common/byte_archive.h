// Raw values as bytes and back, in the order written; for checkpoints on the same machine and
// build.
//
// Both classes have the same members, so that one list of a state's fields serves both directions:
// template <class Archive, class State> void visit(Archive& archive, State& state).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace crosswalk {

class ByteWriter {
 public:
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    raw(&v, sizeof(T));
  }
  /// A contiguous container whose size the reader knows as well.
  template <class Container>
  void values(const Container& v) {
    list(v);
  }
  /// A contiguous container of any size.
  template <class Container>
  void list(const Container& v) {
    value(static_cast<std::uint64_t>(v.size()));
    raw(v.data(), static_cast<std::size_t>(v.size()) * sizeof(*v.data()));
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void raw(const void* data, std::size_t size);
  std::vector<std::byte> bytes_;
};

/// Throws ProtocolError{CheckpointMismatch} when the bytes do not fit what is asked for.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}
  template <class T>
  void value(T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    raw(&v, sizeof(T));
  }
  template <class T>
  T take() {
    T v;
    value(v);
    return v;
  }
  template <class Container>
  void values(Container&& v) {
    require(size_of(sizeof(*v.data())) == static_cast<std::size_t>(v.size()));
    raw(v.data(), static_cast<std::size_t>(v.size()) * sizeof(*v.data()));
  }
  template <class Container>
  void list(Container& v) {
    v.resize(size_of(sizeof(*v.data())));
    raw(v.data(), v.size() * sizeof(*v.data()));
  }
  void require_end() const { require(rest_.empty()); }

 private:
  void raw(void* data, std::size_t size);
  std::size_t size_of(std::size_t item);
  static void require(bool holds);
  std::span<const std::byte> rest_;
};

}  // namespace crosswalk
