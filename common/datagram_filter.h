// What the kernel lets through to the socket of an LCM receiver: whole messages of bearable size on
// the channels that are subscribed, and with ttl=0 only those sent on this machine.
//
// LCM 1.3.1 puts fragments together before anyone can look at them, and a forged one crashes it; no
// message of ours is ever fragmented, so none is let through. LCM binds its socket to every address
// of the machine: without a filter, a datagram sent there by another machine would come in although
// the multicast of the run never leaves. And it wakes its reader for every message on the port;
// what the filter drops costs the waiting process nothing.
#pragma once

#include <string>
#include <vector>

namespace crosswalk {

/// Where datagrams may come from.
enum class Origin { ThisMachine, Anywhere };

/// Lets through what fits one of the patterns, regular expressions for whole channel names, as far
/// as their literal beginnings tell. False, with errno, when the kernel refuses.
bool let_through_only(int socket, const std::vector<std::string>& patterns, Origin origin);

/// While it lives, a socket that this thread binds gets the filter before it can receive anything.
/// LCM binds its receiver and begins to read within one call, and shows the socket to nobody: a
/// filter set afterwards comes too late for a datagram that was quicker.
class FilterAtBind {
 public:
  FilterAtBind(std::vector<std::string> patterns, Origin origin);
  ~FilterAtBind();
  FilterAtBind(const FilterAtBind&) = delete;
  FilterAtBind& operator=(const FilterAtBind&) = delete;
  /// The socket that has the filter, or -1.
  int socket() const { return socket_; }
  void put_on(int socket);

 private:
  std::vector<std::string> patterns_;
  Origin origin_;
  int socket_ = -1;
};

}  // namespace crosswalk
