#include "fe_node/output/state_bytes.h"

#include <cstring>

#include "common/error.h"

namespace crosswalk::fe {
namespace {

// One list of the fields serves both directions.
template <class Archive, class Any>
void visit(Archive& archive, Any& state) {
  archive.value(state.time);
  archive.value(state.step);
  archive.value(state.last_dt);
  archive.value(state.stable_step);
  archive.value(state.element_limit);
  archive.value(state.awake_from);
  archive.value(state.energies);
  archive.values(state.nodes);
  archive.values(state.spin);
  archive.values(state.bodies);
  for (auto& history : state.history) archive.values(history);
  for (auto& contact : state.contacts) {
    archive.list(contact.values);
    archive.list(contact.indices);
    archive.value(contact.friction_dissipated);
    archive.value(contact.damping_dissipated);
  }
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

void write_state(const State& state, ByteWriter& writer) {
  writer.value(kLanes);  // histories are laid out in groups of so many elements
  visit(writer, state);
}

void read_state(ByteReader& reader, State& state) {
  if (reader.take<int>() != kLanes)
    throw ProtocolError(ExitCode::CheckpointMismatch,
                        "the saved state comes from a program built for another kind of processor");
  State read = state;  // `state` stays whole when the bytes do not fit
  visit(reader, read);
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
