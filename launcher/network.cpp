#include "launcher/network.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <string_view>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <net/if.h>
#include <net/route.h>
#include <netinet/in.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/error.h"
#include "common/protocol.h"

namespace crosswalk {

namespace {

constexpr const char* kGroup = "239.255.76.67";  // LCM's default group
constexpr int kProbeMs = 200;
constexpr int kPortsTried = 100;

class Socket {
 public:
  explicit Socket(int type) : number_(socket(AF_INET, type | SOCK_CLOEXEC, 0)) {}
  ~Socket() {
    if (number_ >= 0) close(number_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

std::string failure(std::string_view what) {
  return fmt::format("{}: {}", what, std::strerror(errno));
}

sockaddr* generic(sockaddr_in& address) { return reinterpret_cast<sockaddr*>(&address); }

sockaddr_in address_of(in_addr_t host, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = host;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

/// Switches the loopback interface on.
std::string raise_loopback(int socket_number) {
  ifreq request{};
  std::strcpy(request.ifr_name, "lo");
  if (ioctl(socket_number, SIOCGIFFLAGS, &request) != 0) return failure("loopback interface");
  request.ifr_flags = static_cast<short>(request.ifr_flags | IFF_UP | IFF_RUNNING | IFF_MULTICAST);
  if (ioctl(socket_number, SIOCSIFFLAGS, &request) != 0) return failure("loopback interface");
  return {};
}

/// ip route add 224.0.0.0/4 dev lo
std::string add_multicast_route(int socket_number) {
  char device[] = "lo";
  sockaddr_in target = address_of(inet_addr("224.0.0.0"), 0);
  sockaddr_in mask = address_of(inet_addr("240.0.0.0"), 0);
  rtentry route{};
  std::memcpy(&route.rt_dst, &target, sizeof target);
  std::memcpy(&route.rt_genmask, &mask, sizeof mask);
  route.rt_flags = RTF_UP;
  route.rt_dev = device;
  if (ioctl(socket_number, SIOCADDRT, &route) != 0 && errno != EEXIST)
    return failure("multicast route");
  return {};
}

bool write_file(const char* path, const std::string& text) {
  std::ofstream file(path);
  file << text << std::flush;
  return file.good();
}

/// Own user id inside the new user namespace, so that files keep their owner.
std::string map_user(uid_t user, gid_t group) {
  write_file("/proc/self/setgroups", "deny");  // absent on kernels that do not ask for it
  if (!write_file("/proc/self/uid_map", fmt::format("{0} {0} 1", user)) ||
      !write_file("/proc/self/gid_map", fmt::format("{0} {0} 1", group)))
    return failure("user namespace");
  return {};
}

}  // namespace

namespace {

/// The token of our own datagram and the interface it came back by; 0 when it is not ours.
unsigned interface_of_own(int receiver, int token) {
  int answer = 0;
  iovec data{&answer, sizeof answer};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(in_pktinfo))> control{};
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  if (recvmsg(receiver, &message, 0) != sizeof answer || answer != token) return 0;
  const cmsghdr* info = CMSG_FIRSTHDR(&message);
  if (info == nullptr || info->cmsg_type != IP_PKTINFO) return 0;
  in_pktinfo where{};
  std::memcpy(&where, CMSG_DATA(info), sizeof where);
  return static_cast<unsigned>(where.ipi_ifindex);
}

}  // namespace

Multicast probe_multicast() {
  const Socket receiver(SOCK_DGRAM), sender(SOCK_DGRAM);
  sockaddr_in any = address_of(htonl(INADDR_ANY), 0);
  if (bind(receiver.number(), generic(any), sizeof any) != 0) return {failure("bind"), ""};
  socklen_t size = sizeof any;
  getsockname(receiver.number(), generic(any), &size);
  const int on = 1;
  setsockopt(receiver.number(), IPPROTO_IP, IP_PKTINFO, &on, sizeof on);
  ip_mreq membership{};
  membership.imr_multiaddr.s_addr = inet_addr(kGroup);
  if (setsockopt(receiver.number(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership,
                 sizeof membership) != 0)
    return {failure("joining the multicast group"), ""};
  const unsigned char ttl = 0, loop = 1;
  setsockopt(sender.number(), IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
  setsockopt(sender.number(), IPPROTO_IP, IP_MULTICAST_LOOP, &loop, sizeof loop);
  sockaddr_in group = address_of(inet_addr(kGroup), ntohs(any.sin_port));
  const int token = getpid();
  if (sendto(sender.number(), &token, sizeof token, 0, generic(group), sizeof group) < 0)
    return {failure("sending to the multicast group"), ""};
  pollfd wait{receiver.number(), POLLIN, 0};
  std::array<char, IF_NAMESIZE> name{};
  while (poll(&wait, 1, kProbeMs) > 0)
    if (const unsigned index = interface_of_own(receiver.number(), token); index != 0)
      return {"", if_indextoname(index, name.data()) != nullptr ? name.data() : "an interface"};
  return {"multicast datagrams do not come back", ""};
}

bool is_udp_port_free(int port) {
  const Socket probe(SOCK_DGRAM);
  sockaddr_in any = address_of(htonl(INADDR_ANY), port);
  return bind(probe.number(), generic(any), sizeof any) == 0;
}

std::string enter_private_network() {
  const uid_t user = getuid();
  const gid_t group = getgid();
  if (unshare(CLONE_NEWNET) != 0) {
    if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return failure("private network namespace");
    if (std::string defect = map_user(user, group); !defect.empty()) return defect;
  }
  const Socket control(SOCK_DGRAM);
  if (std::string defect = raise_loopback(control.number()); !defect.empty()) return defect;
  if (std::string defect = add_multicast_route(control.number()); !defect.empty()) return defect;
  return probe_multicast().defect;
}

namespace {

/// Tries in a child first: a namespace that is half set up could not be left again.
std::string private_network_or_obstacle() {
  const pid_t child = fork();
  if (child == 0) _exit(enter_private_network().empty() ? 0 : 1);
  int status = 0;
  if (child > 0 && waitpid(child, &status, 0) == child && status == 0)
    return enter_private_network();
  return "the kernel does not allow it to this account";
}

/// Where the port's digits stand in a udpm URL; {npos, 0} when there are none.
std::pair<std::size_t, std::size_t> port_digits(const std::string& url) {
  constexpr std::string_view kScheme = "udpm://";
  if (!url.starts_with(kScheme)) return {std::string::npos, 0};
  const std::size_t end = std::min(url.find('?'), url.size());
  const std::size_t colon = url.find(':', kScheme.size());
  if (colon == std::string::npos || colon >= end) return {std::string::npos, 0};
  return {colon + 1, end - colon - 1};
}

}  // namespace

int port_of(const std::string& url) {
  const auto [begin, length] = port_digits(url);
  int port = 0;
  if (begin != std::string::npos)
    std::from_chars(url.data() + begin, url.data() + begin + length, port);
  return port;
}

std::string url_with_port(const std::string& url, int port) {
  const auto [begin, length] = port_digits(url);
  if (begin == std::string::npos) return url;
  return std::string(url).replace(begin, length, fmt::format("{}", port));
}

RunNetwork open_network(const std::string& url, bool is_isolated, const std::string& run_id) {
  RunNetwork network{url.empty() ? default_lcm_url(run_id) : url};
  if (!network.url.starts_with("udpm://") && !is_isolated) return network;
  const Multicast here = probe_multicast();
  if (is_isolated || !here.defect.empty()) {
    const std::string obstacle = private_network_or_obstacle();
    if (!obstacle.empty())
      throw ProtocolError(
          ExitCode::NoTransport,
          fmt::format(
              "no private network ({}){};\nas root:  ip link set lo up && ip route add "
              "224.0.0.0/4 dev lo",
              obstacle,
              here.defect.empty()
                  ? ""
                  : fmt::format(" and no UDP multicast on this machine ({})", here.defect)));
    network.is_private = true;
    fmt::print("messages in a private network ({}); `crosswalk spy` looks into it\n",
               is_isolated ? "as asked" : "no multicast here: " + here.defect);
  } else if (here.interface != "lo") {
    fmt::print("messages by multicast of this machine ({}, not beyond it); --isolate hides them\n",
               here.interface);
  }
  const int asked = port_of(network.url);
  for (int port = asked; port != 0 && port < asked + kPortsTried; ++port) {
    if (is_udp_port_free(port)) {
      if (port != asked) fmt::print("port {} is in use; this run takes {}\n", asked, port);
      network.url = url_with_port(network.url, port);
      return network;
    }
    if (!url.empty()) {
      fmt::print("port {} is in use by another process; messages of other runs are ignored\n",
                 port);
      return network;
    }
  }
  return network;
}

}  // namespace crosswalk
