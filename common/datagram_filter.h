// What the kernel lets through to the socket of an LCM receiver: whole messages of bearable size on
// the channels that are subscribed, and with ttl=0 only those sent on this machine.
//
// LCM 1.3.1 puts fragments together before anyone can look at them, and a forged one crashes it; no
// message of ours is ever fragmented, so none is let through. LCM binds its socket to every address
// of the machine: without a filter, a datagram sent there by another machine would come in although
// the multicast of the run never leaves. And it wakes its reader for every message on the port;
// what the filter drops costs the waiting process nothing.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace crosswalk {

/// Where datagrams may come from.
enum class Origin { ThisMachine, Anywhere };

/// File numbers of this process's UDP sockets.
std::set<int> udp_sockets();
/// Lets through what fits one of the patterns, regular expressions for whole channel names, as far
/// as their literal beginnings tell. False, with errno, when the kernel refuses.
bool let_through_only(int socket, const std::vector<std::string>& patterns, Origin origin);

}  // namespace crosswalk
