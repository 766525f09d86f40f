#include "mb_node/state_bytes.h"

#include <cstring>
#include <type_traits>

#include "common/error.h"

namespace crosswalk::mb {
namespace {

// One list of the fields serves both directions.
template <class Archive, class State>
void visit(Archive& archive, State& state) {
  archive.values(state.world.bodies);
  archive.value(state.world.random_seed);
  archive.value(state.vehicle.y);
  archive.value(state.vehicle.v);
  archive.value(state.vehicle.dive);
  for (auto& joint : state.joints) {
    for (auto& coordinate : joint.coordinate) {
      archive.value(coordinate.low.deepest);
      archive.value(coordinate.high.deepest);
      archive.value(coordinate.ligament.deepest);
      archive.value(coordinate.ligament.is_torn);
    }
    archive.value(joint.bone.is_broken);
  }
  archive.values(state.car_deepest);
  archive.values(state.self_deepest);
  archive.values(state.bone_broken);
  archive.value(state.energy.joint_work);
  archive.value(state.energy.contact_work);
  archive.value(state.energy.car_work);
  archive.value(state.energy.interface_work);
  archive.value(state.energy.car_interface_work);
  archive.value(state.contact_set);
  archive.value(state.substeps);
  archive.value(state.time);
  archive.value(state.first_contact_time);
}

struct Writer {
  std::vector<std::byte> bytes;
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* from = reinterpret_cast<const std::byte*>(&v);
    bytes.insert(bytes.end(), from, from + sizeof(T));
  }
  template <class T>
  void values(const std::vector<T>& vs) {
    for (const T& v : vs) value(v);
  }
};

struct Reader {
  const std::vector<std::byte>& bytes;
  std::size_t at = 0;
  template <class T>
  void value(T& v) {
    if (at + sizeof(T) > bytes.size()) {
      throw ProtocolError(ExitCode::CheckpointMismatch,
                          "multibody state: too short for this model");
    }
    std::memcpy(&v, bytes.data() + at, sizeof(T));
    at += sizeof(T);
  }
  template <class T>
  void values(std::vector<T>& vs) {
    for (T& v : vs) value(v);
  }
};

}  // namespace

std::vector<std::byte> to_bytes(const MbState& state) {
  Writer writer;
  visit(writer, state);
  return std::move(writer.bytes);
}

void from_bytes(const std::vector<std::byte>& bytes, MbState& state) {
  Reader reader{bytes};
  visit(reader, state);
  if (reader.at != bytes.size()) {
    throw ProtocolError(ExitCode::CheckpointMismatch, "multibody state: too long for this model");
  }
}

}  // namespace crosswalk::mb
