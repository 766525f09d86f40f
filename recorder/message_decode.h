// Bytes of a message to its type, with a gate in front: size, type hash, header, counts, and no
// exception from a generated decoder gets out.
#pragma once

#include <cstddef>
#include <exception>
#include <optional>
#include <span>

#include "common/messages.h"
#include "common/protocol.h"
#include "crosswalk/msg/body_states.hpp"
#include "crosswalk/msg/contact_forces.hpp"
#include "crosswalk/msg/coupling_audit.hpp"
#include "crosswalk/msg/head_kinematics.hpp"
#include "crosswalk/msg/node_description.hpp"
#include "crosswalk/msg/node_status.hpp"
#include "crosswalk/msg/run_control.hpp"
#include "crosswalk/msg/run_event.hpp"
#include "crosswalk/msg/run_manifest.hpp"
#include "crosswalk/msg/tissue_strain.hpp"

namespace crosswalk::recording {

/// The header that every message of ours opens with; nothing for anything that cannot be ours, a
/// broken seal included.
std::optional<msg::header> peek_header(std::span<const std::byte> data);

/// False when the manifest's count of bodies cannot be true.
bool is_sound_manifest(std::span<const std::byte> data);

template <class M>
std::optional<M> decoded(std::span<const std::byte> data) {
  M message{};
  try {
    if (message.decode(data.data(), 0, static_cast<int>(data.size())) < 0) return std::nullopt;
  } catch (const std::exception&) {  // generated decoders throw on absurd string lengths
    return std::nullopt;
  }
  return message;
}

/// Calls `handler(message)` with the decoded type of the kinds a record is made of; other kinds of
/// ours are passed over. False when the bytes do not decode.
template <class Handler>
bool with_decoded(MessageKind kind, std::span<const std::byte> data, const Handler& handler) {
  const auto as = [&]<class M>(std::type_identity<M>) {
    const std::optional<M> message = decoded<M>(data);
    if (message) handler(*message);
    return message.has_value();
  };
  switch (kind) {
    case MessageKind::RunManifest:
      return is_sound_manifest(data) && as(std::type_identity<msg::run_manifest>{});
    case MessageKind::HeadKinematics:
      return as(std::type_identity<msg::head_kinematics>{});
    case MessageKind::BodyStates:
      return as(std::type_identity<msg::body_states>{});
    case MessageKind::ContactForces:
      return as(std::type_identity<msg::contact_forces>{});
    case MessageKind::TissueStrain:
      return as(std::type_identity<msg::tissue_strain>{});
    case MessageKind::NodeDescription:
      return as(std::type_identity<msg::node_description>{});
    case MessageKind::RunEvent:
      return as(std::type_identity<msg::run_event>{});
    case MessageKind::CouplingAudit:
      return as(std::type_identity<msg::coupling_audit>{});
    case MessageKind::MbDone:
      return as(std::type_identity<msg::mb_done>{});
    case MessageKind::FeDone:
      return as(std::type_identity<msg::fe_done>{});
    case MessageKind::RunControl:
      return as(std::type_identity<msg::run_control>{});
    case MessageKind::NodeStatus:
      return as(std::type_identity<msg::node_status>{});
    default:
      return true;
  }
}

}  // namespace crosswalk::recording
