#include "common/solver_node.h"

#include "common/interrupt.h"
#include "common/participant.h"
#include "common/version.h"

namespace crosswalk {

namespace {

template <class Session, class Participant>
ExitCode run_node(RunContext& context, Role role, Participant& participant) {
  NodeIdentity identity{.scenario_digest = static_cast<std::int64_t>(context.scenario.digest),
                        .version = version_text(),
                        .bodies = {}};
  for (const InterfaceBody& body : participant.interface_bodies()) {
    identity.bodies.push_back(body.name);
    identity.n_attached += body.is_attached ? 1 : 0;
  }
  Bus bus(open_transport(context.url), context.run_id, role, BusFaults::from_environment());
  Session session(bus, participant, std::move(identity), {.join_s = context.wait_s},
                  context.directory.checkpoints());
  return session.run(interrupt_flag());
}

}  // namespace

ExitCode run_mb_node(RunContext& context, MbParticipant& participant) {
  return run_node<MbSession>(context, Role::Mb, participant);
}

ExitCode run_fe_node(RunContext& context, FeParticipant& participant) {
  return run_node<FeSession>(context, Role::Fe, participant);
}

}  // namespace crosswalk
