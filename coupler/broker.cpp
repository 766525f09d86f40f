#include "coupler/broker.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/error.h"
#include "common/log.h"

namespace crosswalk {

namespace {

// A client that leaves so much unread has stalled; a run's whole traffic is some 30 MB.
constexpr std::size_t kMaxWaitingBytes = 64U << 20U;
constexpr int kPollMs = 100;

int port_of_socket(int number) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  getsockname(number, reinterpret_cast<sockaddr*>(&address), &size);
  if (address.ss_family == AF_INET6)
    return ntohs(reinterpret_cast<const sockaddr_in6&>(address).sin6_port);
  return ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

}  // namespace

Broker::Broker(const tcpq::Address& address) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  const int unknown =
      getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &wanted, &found);
  std::string why = unknown != 0 ? gai_strerror(unknown) : "";
  for (const addrinfo* a = found; a != nullptr && listener_ < 0; a = a->ai_next) {
    const int number =
        socket(a->ai_family, a->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, a->ai_protocol);
    const int on = 1;
    setsockopt(number, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    if (bind(number, a->ai_addr, a->ai_addrlen) == 0 && listen(number, 64) == 0) {
      listener_ = number;
    } else {
      why = std::strerror(errno);
      if (number >= 0) close(number);
    }
  }
  if (found != nullptr) freeaddrinfo(found);
  if (listener_ < 0)
    throw ProtocolError(ExitCode::NoTransport, fmt::format("the broker cannot listen on {}:{}: {}",
                                                           address.host, address.port, why));
  port_ = port_of_socket(listener_);
}

Broker::~Broker() {
  for (const Client& client : clients_) close(client.socket);
  close(listener_);
}

void Broker::serve(const std::atomic<bool>& stop) {
  std::vector<pollfd> waits;
  while (!stop) {
    waits.assign(1, {listener_, POLLIN, 0});
    for (const Client& client : clients_)
      waits.push_back(
          {client.socket, static_cast<short>(client.out.empty() ? POLLIN : POLLIN | POLLOUT), 0});
    if (poll(waits.data(), waits.size(), kPollMs) <= 0) continue;
    std::size_t i = 1;
    for (Client& client : clients_) {
      const short events = waits[i++].revents;
      if ((events & POLLOUT) != 0) write(client);
      if ((events & (POLLIN | POLLHUP | POLLERR)) != 0) read(client);
    }
    if ((waits.front().revents & POLLIN) != 0) accept_client();
    remove_gone();
  }
}

void Broker::accept_client() {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  const int number = accept4(listener_, reinterpret_cast<sockaddr*>(&address), &size,
                             SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (number < 0) return;
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> service{};
  getnameinfo(reinterpret_cast<sockaddr*>(&address), size, host.data(), host.size(), service.data(),
              service.size(), NI_NUMERICHOST | NI_NUMERICSERV);
  Client& client = clients_.emplace_back(number);
  client.name = fmt::format("{}:{}", host.data(), service.data());
  tcpq::send_without_delay(number);
  queue(client, tcpq::greeting(tcpq::kServerMagic));
  log_info("{} has connected", client.name);
}

void Broker::read(Client& client) {
  std::array<std::byte, 1U << 16U> buffer;
  const ssize_t n = recv(client.socket, buffer.data(), buffer.size(), 0);
  if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR)) client.is_gone = true;
  if (n <= 0) return;
  client.in.append({buffer.data(), static_cast<std::size_t>(n)});
  try {
    if (!client.is_greeted) {
      std::uint32_t magic = 0, version = 0;
      if (!client.in.take_greeting(magic, version)) return;
      if (magic != tcpq::kClientMagic)
        throw ProtocolError(ExitCode::NoTransport, "it does not speak tcpq");
      client.is_greeted = true;
    }
    for (tcpq::Record record; client.in.take(record);) take(client, record);
  } catch (const ProtocolError& error) {
    log_warning("{} is let go: {}", client.name, error.what());
    client.is_gone = true;
  } catch (const std::regex_error&) {
    log_warning("{} is let go: a subscription is no regular expression", client.name);
    client.is_gone = true;
  }
}

void Broker::take(Client& client, const tcpq::Record& record) {
  switch (record.kind) {
    case tcpq::RecordKind::Publish:
      hand_out(record);
      return;
    case tcpq::RecordKind::Subscribe:
      client.patterns.emplace_back(record.channel, std::regex(record.channel));
      break;
    case tcpq::RecordKind::Unsubscribe:
      std::erase_if(client.patterns, [&](const auto& p) { return p.first == record.channel; });
      break;
  }
  client.wants.clear();
}

bool Broker::wants(Client& client, const std::string& channel) {
  constexpr std::size_t kKnownChannels = 1024;  // a run has some thirty
  if (client.wants.size() > kKnownChannels) client.wants.clear();
  const auto known = client.wants.find(channel);
  if (known != client.wants.end()) return known->second;
  const bool answer = std::ranges::any_of(
      client.patterns, [&](const auto& p) { return std::regex_match(channel, p.second); });
  client.wants.emplace(channel, answer);
  return answer;
}

void Broker::hand_out(const tcpq::Record& record) {
  const std::vector<std::byte> bytes =
      tcpq::encode(tcpq::RecordKind::Publish, record.channel, record.data);
  for (Client& client : clients_)
    if (!client.is_gone && wants(client, record.channel)) queue(client, bytes);
}

void Broker::queue(Client& client, std::vector<std::byte> bytes) {
  client.waiting += bytes.size();
  client.out.push_back(std::move(bytes));
  if (client.out.size() == 1) write(client);
  if (client.waiting > kMaxWaitingBytes) {
    log_warning("{} is let go: it does not take its messages", client.name);
    client.is_gone = true;
  }
}

void Broker::write(Client& client) {
  while (!client.out.empty()) {
    const std::vector<std::byte>& first = client.out.front();
    const ssize_t n =
        send(client.socket, first.data() + client.sent, first.size() - client.sent, MSG_NOSIGNAL);
    if (n < 0) {
      if (errno != EAGAIN && errno != EINTR) client.is_gone = true;
      return;
    }
    client.sent += static_cast<std::size_t>(n);
    if (client.sent < first.size()) continue;
    client.waiting -= first.size();
    client.sent = 0;
    client.out.pop_front();
  }
}

void Broker::remove_gone() {
  std::erase_if(clients_, [](const Client& client) {
    if (!client.is_gone) return false;
    log_info("{} has left", client.name);
    close(client.socket);
    return true;
  });
}

}  // namespace crosswalk
