// Where the messages of a run on one machine go: over its multicast where that works, so that stock
// tools can listen, else into a private network.
//
// LCM needs a route for 224.0.0.0/4; without one it fails, or waits 10 s for a self-test. So we
// probe with a socket of our own first. When the probe fails, or on request, the launcher moves
// into a network namespace of its own with loopback and that route; the processes it starts inherit
// it. What others send to the port is kept out by the filter of common/datagram_filter.h.
#pragma once

#include <string>

namespace crosswalk {

/// How a multicast datagram fared that was sent with a time to live of 0.
struct Multicast {
  std::string defect;     ///< why it did not come back; empty when it did
  std::string interface;  ///< the one it went through
};
Multicast probe_multicast();
/// True when no other process listens on the UDP port.
bool is_udp_port_free(int port);
/// Moves this process into a private network namespace (and, unless root, a user namespace) with
/// loopback and multicast route. Empty on success; else why not. The process must have one thread.
std::string enter_private_network();

/// Where the messages of a run or a replay go.
struct RunNetwork {
  std::string url;
  bool is_private = false;  ///< this process and its children are alone in it
};
/// A URL on which traffic works. `url` empty: the one of the run id, on the next free port.
/// `is_isolated`: a private network in any case. Says on stdout what was chosen and is not obvious;
/// throws ProtocolError{NoTransport} with the cure when nothing works.
RunNetwork open_network(const std::string& url, bool is_isolated, const std::string& run_id);

/// "udpm://239.255.76.67:PORT?..." with another port.
std::string url_with_port(const std::string& url, int port);
/// The port of a udpm URL, or 0.
int port_of(const std::string& url);

}  // namespace crosswalk
