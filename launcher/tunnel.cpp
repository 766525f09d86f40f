#include "launcher/tunnel.h"

#include <fmt/format.h>
#include <poll.h>

#include "common/error.h"
#include "launcher/handover.h"
#include "launcher/remote.h"
#include "launcher/supervisor.h"

namespace crosswalk {

namespace {

constexpr int kConnectionWaitMs = 30'000;

/// One word comes over the connection once the port there leads here.
void await(const Process& connection, const std::string& host) {
  pollfd ready{connection.output(), POLLIN, 0};
  if (poll(&ready, 1, kConnectionWaitMs) == 1 && (ready.revents & POLLIN) != 0) return;
  throw UserError(
      Problem{{},
              "host " + host,
              "a machine where ssh may forward a port to this one",
              last_words(connection.spec().log),
              "AllowTcpForwarding in its sshd_config; " + connection.spec().log.string()});
}

}  // namespace

Tunnel::Tunnel(int port, const std::set<std::string>& hosts, const RunDirectory& directory) {
  processes_.emplace_back(
      ProcessSpec{.name = "broker",
                  .program = sibling_program("coupler"),
                  .arguments = {"broker", "--listen", fmt::format("127.0.0.1:{}", port)},
                  .log = directory.log("broker")});
  for (const std::string& host : hosts) {
    ProcessSpec connection = forwarded_port(host, port);
    connection.log = directory.log("tunnel-" + host);
    processes_.emplace_back(std::move(connection));
    await(processes_.back(), host);
  }
}

}  // namespace crosswalk
