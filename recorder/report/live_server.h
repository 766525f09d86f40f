// The live page of a run on localhost: one HTML page and a stream of server-sent events.
//
// Events are kept, so a browser that comes late or comes back sees the run from its start. Clients
// only ever read; a slow or closed browser holds up nobody.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace crosswalk::recording {

class LiveServer {
 public:
  /// Listens on 127.0.0.1 at `port`, or the next free one; 0 takes any. `report` is offered at
  /// /report.html once it exists. Throws UserError when no port can be had.
  LiveServer(int port, std::string title, std::filesystem::path report);
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  std::string url() const;
  /// Appends an event; `data` is one line (JSON).
  void publish(const std::string& name, const std::string& data);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace crosswalk::recording
