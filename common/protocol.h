// What every Crosswalk process knows about the others: roles, message kinds, channel names,
// numbering.
//
// Streams and their numbers (header.seq, from 0):
//   lockstep  step_to_mb / step_to_fe count grants; mb_done / fe_done repeat the number of the
//   grant they
//             answer. A node executes seq == last + 1, answers seq == last from its cache, ignores
//             older ones.
//   records   head_kinematics, body_states, contact_forces, tissue_strain, node_description,
//   run_event and
//             coupling_audit of one sender share one count, so that a listener sees every gap; the
//             sender keeps them for resend_request{kind = 0}. node_status and the done messages
//             tell the count.
//   others    hello, manifest, control, status, set-up, mobility: repeated until answered; seq
//   counts sendings.
// docs/messages.md tells the life of a run.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace crosswalk {

/// Raised on any change of a message's meaning, even when its type hash stays. Logs of other
/// versions are not read.
inline constexpr int kProtocolVersion = 3;
inline constexpr int kMaxInterfaceBodies = 8;  ///< array size in the lockstep messages
inline constexpr int kMaxAttachedBodies = 4;   ///< bodies with a mobility
/// Encoded size of any message: one Ethernet frame of 1500 B less IP, UDP and LCM headers and seal.
inline constexpr int kMaxMessageBytes = 1400;
/// The coupler stays at most this far ahead of the recorder's acknowledgement.
inline constexpr int kMaxWindowsAhead = 64;
/// Batched records are sent at the latest after so many windows; checkpoints fall on a multiple,
/// when nothing waits.
inline constexpr int kWindowsPerFlush = 8;
/// Text pieces of node_description and the longest free text of other messages, bytes.
inline constexpr int kDescriptionPieceBytes = 1000;
inline constexpr int kMaxTextBytes = 800;

enum class Role : int { Coupler = 1, Mb = 2, Fe = 3, Recorder = 4, Launcher = 5, Tool = 6 };

enum class MessageKind : int {
  StepToMb = 1,
  MbDone,
  StepToFe,
  FeDone,
  Mobility,
  BoundaryMotion,
  BoundaryMass,
  NodeHello,
  RunManifest,
  RunControl,
  NodeStatus,
  RecorderAck,
  ResendRequest,
  HeadKinematics,
  BodyStates,
  ContactForces,
  TissueStrain,
  NodeDescription,
  RunEvent,
  CouplingAudit
};

enum class Command : int {
  Claim = 1,    ///< coupler: is another coupler on this run?
  Present = 2,  ///< coupler: yes, here
  Refuse = 3,   ///< coupler to target_instance: leave with exit_code
  Start = 4,    ///< coupler: window 0 follows
  Finish = 5,   ///< coupler: `window` was the last; complete your record
  Abort = 6,    ///< coupler: the run failed; leave
  Stop = 7,     ///< coupler: all done, leave with 0. launcher or tool to coupler: end the run now
  WantManifest = 8,  ///< anyone: publish the manifest
  Checkpoint = 9     ///< coupler: save your state at the end of `window`
};

enum class NodeState : int {
  Joining = 0,
  Configuring = 1,
  Waiting = 2,
  Solving = 3,
  Done = 4,
  Failed = 5
};

/// Node roles by the name used in channels, logs and messages to the user: "coupler", "mb_node",
/// ...
std::string_view role_name(Role role);

struct KindRule {
  MessageKind kind;
  std::string_view topic;  ///< part of the channel name
  bool is_record;          ///< numbered in the sender's record stream
};
const KindRule& rule_of(MessageKind kind);
const std::vector<KindRule>& kind_rules();

/// 64-bit FNV-1a, the digest used for run ids, scenarios, message types and states.
std::uint64_t fnv1a(std::string_view bytes, std::uint64_t seed = 14695981039346656037ULL);

/// Digest of a run id, the header's run_id.
std::int64_t run_digest(std::string_view run_id);

/// `CW_<first 8 hex digits of the run digest>_<TOPIC>_<ROLE>`.
std::string channel_name(std::int64_t run, MessageKind kind, Role sender);
/// Regular expressions for LCM subscriptions: one kind from every sender, or the whole run.
std::string channel_pattern(std::int64_t run, MessageKind kind);
std::string channel_pattern(std::int64_t run);

/// One UDP port per run: 20000 + digest mod 20000; group of LCM's default, never leaving the
/// machine.
int default_port(std::string_view run_id);
std::string default_lcm_url(std::string_view run_id);

}  // namespace crosswalk
