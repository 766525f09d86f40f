// The broker of `crosswalk broker`: hands every message to all clients that subscribed its channel.
//
// Clients speak LCM's tcpq protocol (common/tcpq.h), ours or LCM's own. One thread, one poll loop;
// a client that does not take its messages is let go before it can hold up the others.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <list>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "common/tcpq.h"

namespace crosswalk {

class Broker {
 public:
  /// Port 0: any free one. Throws ProtocolError{NoTransport} when it cannot listen there.
  explicit Broker(const tcpq::Address& address);
  ~Broker();
  Broker(const Broker&) = delete;
  Broker& operator=(const Broker&) = delete;

  int port() const { return port_; }
  /// Serves until the flag is raised.
  void serve(const std::atomic<bool>& stop);

 private:
  struct Client {
    explicit Client(int number) : socket(number) {}
    int socket;
    std::string name;  ///< address, for messages
    bool is_greeted = false, is_gone = false;
    tcpq::Stream in;
    std::deque<std::vector<std::byte>> out;
    std::size_t sent = 0, waiting = 0;  ///< bytes: of the first of `out`, of all of it
    std::vector<std::pair<std::string, std::regex>> patterns;
    std::map<std::string, bool> wants;  ///< answers known so far, by channel
  };

  void accept_client();
  void read(Client& client);
  void take(Client& client, const tcpq::Record& record);
  void hand_out(const tcpq::Record& record);
  static void queue(Client& client, std::vector<std::byte> bytes);
  static void write(Client& client);
  static bool wants(Client& client, const std::string& channel);
  void remove_gone();

  int listener_ = -1;
  int port_ = 0;
  std::list<Client> clients_;  // stable addresses
};

}  // namespace crosswalk
