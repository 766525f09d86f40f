#include "fe_node/output/state_bytes.h"

#include <cstring>

#include "common/error.h"

namespace crosswalk::fe {
namespace {

template <class T>
void require_same(const T& expected, const T& found) {
  if (expected != found)
    throw ProtocolError(ExitCode::CheckpointMismatch, "the saved state belongs to another model");
}

std::uint64_t digest_words(const void* data, std::size_t size, std::uint64_t digest) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i + 8 <= size; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i, 8);
    digest = (digest ^ word) * 1099511628211ULL;
  }
  return digest;
}

}  // namespace

void ByteWriter::raw(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::byte*>(data);
  bytes_.insert(bytes_.end(), bytes, bytes + size);
}

void ByteReader::check(std::size_t size) const {
  if (size > bytes_.size())
    throw ProtocolError(ExitCode::CheckpointMismatch, "the saved state ends too early");
}

void ByteReader::raw(void* data, std::size_t size) {
  check(size);
  if (size > 0) std::memcpy(data, bytes_.data(), size);
  bytes_ = bytes_.subspan(size);
}

void write_state(const State& state, ByteWriter& writer) {
  writer.value(state.time);
  writer.value(state.step);
  writer.value(state.last_dt);
  writer.value(state.stable_step);
  writer.value(state.awake_from);
  writer.value(state.energies);
  writer.vector(state.nodes);
  writer.vector(state.spin);
  writer.vector(state.bodies);
  writer.value(static_cast<std::uint64_t>(state.history.size()));
  for (const LaneVector& history : state.history) writer.vector(history);
  writer.value(static_cast<std::uint64_t>(state.contacts.size()));
  for (const ContactHistory& contact : state.contacts) {
    writer.vector(contact.values);
    writer.vector(contact.indices);
    writer.value(contact.friction_dissipated);
    writer.value(contact.damping_dissipated);
  }
}

void read_state(ByteReader& reader, State& state) {
  State read;
  reader.value(read.time);
  reader.value(read.step);
  reader.value(read.last_dt);
  reader.value(read.stable_step);
  reader.value(read.awake_from);
  reader.value(read.energies);
  reader.vector(read.nodes);
  reader.vector(read.spin);
  reader.vector(read.bodies);
  std::uint64_t count = 0;
  reader.value(count);
  require_same<std::size_t>(state.history.size(), count);
  read.history.resize(count);
  for (LaneVector& history : read.history) reader.vector(history);
  reader.value(count);
  require_same<std::size_t>(state.contacts.size(), count);
  read.contacts.resize(count);
  for (ContactHistory& contact : read.contacts) {
    reader.vector(contact.values);
    reader.vector(contact.indices);
    reader.value(contact.friction_dissipated);
    reader.value(contact.damping_dissipated);
  }
  require_same(state.nodes.size(), read.nodes.size());
  require_same(state.spin.size(), read.spin.size());
  require_same(state.bodies.size(), read.bodies.size());
  for (std::size_t b = 0; b < state.history.size(); ++b)
    require_same(state.history[b].size(), read.history[b].size());
  state = std::move(read);
}

std::uint64_t state_digest(const State& state) {
  std::uint64_t digest = 14695981039346656037ULL;
  digest = digest_words(&state.time, sizeof state.time, digest);
  digest = digest_words(state.nodes.data(), state.nodes.size() * sizeof(NodeRecord), digest);
  for (const BodyState& body : state.bodies) {
    digest = digest_words(body.X_WB.q.coeffs().data(), 32, digest);
    digest = digest_words(body.X_WB.p.data(), 24, digest);
    digest = digest_words(body.angular_momentum.data(), 24, digest);
  }
  return digest;
}

}  // namespace crosswalk::fe
