#include "common/protocol.h"

#include <algorithm>

#include <fmt/format.h>

#include "common/error.h"

namespace crosswalk {

std::string_view role_name(Role role) {
  switch (role) {
    case Role::Coupler:
      return "coupler";
    case Role::Mb:
      return "mb_node";
    case Role::Fe:
      return "fe_node";
    case Role::Recorder:
      return "recorder";
    case Role::Launcher:
      return "launcher";
    case Role::Tool:
      return "tool";
  }
  return "unknown";
}

const std::vector<KindRule>& kind_rules() {
  using enum MessageKind;
  static const std::vector<KindRule> rules = {{StepToMb, "STEP_TO_MB", false},
                                              {MbDone, "MB_DONE", false},
                                              {StepToFe, "STEP_TO_FE", false},
                                              {FeDone, "FE_DONE", false},
                                              {Mobility, "MOBILITY", false},
                                              {BoundaryMotion, "BOUNDARY_MOTION", false},
                                              {BoundaryMass, "BOUNDARY_MASS", false},
                                              {NodeHello, "HELLO", false},
                                              {RunManifest, "MANIFEST", false},
                                              {RunControl, "CONTROL", false},
                                              {NodeStatus, "STATUS", false},
                                              {RecorderAck, "RECORDER_ACK", false},
                                              {ResendRequest, "RESEND", false},
                                              {HeadKinematics, "HEAD", true},
                                              {BodyStates, "BODIES", true},
                                              {ContactForces, "CONTACT", true},
                                              {TissueStrain, "TISSUE", true},
                                              {NodeDescription, "DESCRIPTION", true},
                                              {RunEvent, "EVENT", true},
                                              {CouplingAudit, "AUDIT", true}};
  return rules;
}

const KindRule& rule_of(MessageKind kind) {
  const int index = static_cast<int>(kind) - 1;
  CW_ASSERT(index >= 0 && index < static_cast<int>(kind_rules().size()));
  return kind_rules()[static_cast<std::size_t>(index)];
}

std::uint64_t fnv1a(std::string_view bytes, std::uint64_t seed) {
  std::uint64_t hash = seed;
  for (const char c : bytes) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 1099511628211ULL;
  }
  return hash;
}

std::int64_t run_digest(std::string_view run_id) {
  return static_cast<std::int64_t>(fnv1a(run_id));
}

namespace {
std::string run_prefix(std::int64_t run) {
  return fmt::format("CW_{:08X}_", static_cast<std::uint64_t>(run) >> 32);
}
std::string upper(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  return out;
}
}  // namespace

std::string channel_name(std::int64_t run, MessageKind kind, Role sender) {
  return run_prefix(run) + std::string(rule_of(kind).topic) + '_' + upper(role_name(sender));
}

std::string channel_pattern(std::int64_t run, MessageKind kind) {
  return run_prefix(run) + std::string(rule_of(kind).topic) +
         "_(COUPLER|MB_NODE|FE_NODE|RECORDER|LAUNCHER|TOOL)";
}

std::string channel_pattern(std::int64_t run) { return run_prefix(run) + "[A-Z_]+"; }

int default_port(std::string_view run_id) {
  return 20000 + static_cast<int>(fnv1a(run_id) % 20000);
}

std::string default_lcm_url(std::string_view run_id) {
  return fmt::format("udpm://239.255.76.67:{}?ttl=0&recv_buf_size=4194304", default_port(run_id));
}

}  // namespace crosswalk
