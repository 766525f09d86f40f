#include "mb_node/state_bytes.h"

#include "common/byte_archive.h"

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
  archive.value(state.vehicle.dive_rate);
  for (auto& joint : state.joints) {
    for (auto& coordinate : joint.coordinate) {
      archive.value(coordinate.low.deepest);
      archive.value(coordinate.high.deepest);
      archive.value(coordinate.ligament.deepest);
      archive.value(coordinate.ligament.is_torn);
    }
    archive.value(joint.bone.is_broken);
  }
  for (auto& contact : state.car_contacts) {
    archive.value(contact.deepest);
    archive.value(contact.pressed);
    archive.value(contact.unpressed);
    archive.value(contact.is_touching);
  }
  archive.values(state.self_deepest);
  archive.values(state.bone_broken);
  archive.value(state.energy.joint_work);
  archive.value(state.energy.contact_work);
  archive.value(state.energy.car_work);
  archive.value(state.energy.interface_work);
  archive.value(state.energy.car_interface_work);
  archive.value(state.energy.lost);
  archive.value(state.contact_set);
  archive.value(state.substeps);
  archive.value(state.time);
  archive.value(state.first_contact_time);
}

}  // namespace

std::vector<std::byte> to_bytes(const MbState& state) {
  ByteWriter writer;
  visit(writer, state);
  return writer.take();
}

void from_bytes(const std::vector<std::byte>& bytes, MbState& state) {
  ByteReader reader(bytes);
  visit(reader, state);
  reader.require_end();
}

}  // namespace crosswalk::mb
