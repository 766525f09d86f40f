// The bridge between the plain structs of exchange.h and the wire types of lcmtypes/.
//
// to_message() fills the body of a message (not its header); from_message() reads it back. Floats
// on the wire are rounded the same way for every side: as_on_wire() rounds a grant before the
// coupler uses it. problem_in() is the last gate: a message with a non-finite or absurd number is
// named, never used.
#pragma once

#include <string>
#include <vector>

#include "common/exchange.h"
#include "common/protocol.h"
#include "crosswalk/msg/boundary_mass.hpp"
#include "crosswalk/msg/boundary_motion.hpp"
#include "crosswalk/msg/fe_done.hpp"
#include "crosswalk/msg/mb_done.hpp"
#include "crosswalk/msg/mobility.hpp"
#include "crosswalk/msg/step_to_fe.hpp"
#include "crosswalk/msg/step_to_mb.hpp"

namespace crosswalk::msg {
class body_states;
class contact_forces;
class coupling_audit;
class head_kinematics;
class head_sample;
class node_description;
class node_hello;
class node_status;
class recorder_ack;
class resend_request;
class run_control;
class run_event;
class run_manifest;
class tissue_strain;
}  // namespace crosswalk::msg

namespace crosswalk {

/// kKindOf<M>: the message kind of a wire type.
template <class M>
inline constexpr MessageKind kKindOf = MessageKind{0};
template <>
inline constexpr MessageKind kKindOf<msg::step_to_mb> = MessageKind::StepToMb;
template <>
inline constexpr MessageKind kKindOf<msg::mb_done> = MessageKind::MbDone;
template <>
inline constexpr MessageKind kKindOf<msg::step_to_fe> = MessageKind::StepToFe;
template <>
inline constexpr MessageKind kKindOf<msg::fe_done> = MessageKind::FeDone;
template <>
inline constexpr MessageKind kKindOf<msg::mobility> = MessageKind::Mobility;
template <>
inline constexpr MessageKind kKindOf<msg::boundary_motion> = MessageKind::BoundaryMotion;
template <>
inline constexpr MessageKind kKindOf<msg::boundary_mass> = MessageKind::BoundaryMass;
template <>
inline constexpr MessageKind kKindOf<msg::node_hello> = MessageKind::NodeHello;
template <>
inline constexpr MessageKind kKindOf<msg::run_manifest> = MessageKind::RunManifest;
template <>
inline constexpr MessageKind kKindOf<msg::run_control> = MessageKind::RunControl;
template <>
inline constexpr MessageKind kKindOf<msg::node_status> = MessageKind::NodeStatus;
template <>
inline constexpr MessageKind kKindOf<msg::recorder_ack> = MessageKind::RecorderAck;
template <>
inline constexpr MessageKind kKindOf<msg::resend_request> = MessageKind::ResendRequest;
template <>
inline constexpr MessageKind kKindOf<msg::head_kinematics> = MessageKind::HeadKinematics;
template <>
inline constexpr MessageKind kKindOf<msg::body_states> = MessageKind::BodyStates;
template <>
inline constexpr MessageKind kKindOf<msg::contact_forces> = MessageKind::ContactForces;
template <>
inline constexpr MessageKind kKindOf<msg::tissue_strain> = MessageKind::TissueStrain;
template <>
inline constexpr MessageKind kKindOf<msg::node_description> = MessageKind::NodeDescription;
template <>
inline constexpr MessageKind kKindOf<msg::run_event> = MessageKind::RunEvent;
template <>
inline constexpr MessageKind kKindOf<msg::coupling_audit> = MessageKind::CouplingAudit;

/// One number for all wire types together; differs when any field of any message differs.
std::int64_t message_digest();

msg::step_to_mb to_message(const MbGrant& grant);
MbGrant from_message(const msg::step_to_mb& m);
/// Without the mobility, which travels in its own message.
msg::mb_done to_message(const WindowId& id, const MbReply& reply);
MbReply from_message(const msg::mb_done& m);
msg::step_to_fe to_message(const FeGrant& grant, int mobility_id);
/// Without the mobility.
FeGrant from_message(const msg::step_to_fe& m);
msg::fe_done to_message(const WindowId& id, const FeReply& reply);
FeReply from_message(const msg::fe_done& m);
msg::mobility to_message(const Eigen::MatrixXd& mobility);
Eigen::MatrixXd from_message(const msg::mobility& m);

msg::boundary_motion motion_message(const std::vector<InterfaceBody>& bodies);
msg::boundary_mass mass_message(const std::vector<InterfaceBody>& bodies);
/// Write the received values into bodies that already have names, in the same order.
void read_motion(const msg::boundary_motion& m, std::vector<InterfaceBody>& bodies);
void read_mass(const msg::boundary_mass& m, std::vector<InterfaceBody>& bodies);

msg::head_sample to_message(const HeadSample& sample);
HeadSample from_message(const msg::head_sample& m);
msg::tissue_strain to_message(const TissueSample& sample);

/// The grant as the peer will read it: bias and twist change rounded to float.
MbGrant as_on_wire(MbGrant grant);
FeGrant as_on_wire(FeGrant grant);
Eigen::MatrixXd mobility_as_on_wire(Eigen::MatrixXd mobility);

/// Free text for the wire: control characters removed, cut at `max_bytes`.
std::string wire_text(std::string text, int max_bytes = kMaxTextBytes);

}  // namespace crosswalk
