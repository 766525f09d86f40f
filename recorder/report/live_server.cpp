#include "recorder/report/live_server.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <fstream>
#include <mutex>
#include <sstream>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <httplib.h>
#include <kainjow/mustache.hpp>

#include "common/error.h"
#include "recorder/report/assets.h"

namespace crosswalk::recording {

namespace {

constexpr int kPortsTried = 50;
constexpr std::size_t kBrowsers = 16;  // served at a time, one thread each
constexpr auto kHeartbeat = std::chrono::seconds(2);

std::string page_text(const std::string& title) {
  kainjow::mustache::mustache page{std::string(assets::live_template)};
  CW_ASSERT(page.is_valid());
  kainjow::mustache::data data{kainjow::mustache::data::type::object};
  data.set("title", title);
  data.set("style", std::string(assets::report_style));
  data.set("script_style", std::string(assets::page_script_style));
  data.set("script", std::string(assets::page_script));
  data.set("is_interactive", kainjow::mustache::data(!assets::page_script.empty()));
  return page.render(data);
}

}  // namespace

struct LiveServer::Impl {
  httplib::Server server;
  std::string page;
  std::filesystem::path report;
  int port = 0;
  std::mutex mutex;
  std::condition_variable grown;
  std::vector<std::string> events;
  std::atomic<bool> is_ending = false;
  std::thread thread;

  /// Sends what is new from `next` on, or a heartbeat; false when the browser has gone.
  bool send_new(std::size_t& next, httplib::DataSink& sink) {
    std::string text;
    {
      std::unique_lock lock(mutex);
      grown.wait_for(lock, kHeartbeat, [&] { return next < events.size() || is_ending; });
      for (; next < events.size(); ++next) text += events[next];
    }
    if (is_ending && text.empty()) return false;
    if (text.empty()) text = ": here\n\n";
    return sink.write(text.data(), text.size());
  }

  void define_pages() {
    server.new_task_queue = [] { return new httplib::ThreadPool(kBrowsers); };  // httplib owns it
    server.Get("/", [this](const httplib::Request&, httplib::Response& response) {
      response.set_content(page, "text/html; charset=utf-8");
    });
    server.Get("/report.html", [this](const httplib::Request&, httplib::Response& response) {
      std::ifstream file(report, std::ios::binary);
      std::ostringstream text;
      text << file.rdbuf();
      response.status = file ? 200 : 404;
      response.set_content(file ? text.str() : "not written yet", "text/html; charset=utf-8");
    });
    server.Get("/events", [this](const httplib::Request& request, httplib::Response& response) {
      std::size_t first = 0;
      const std::string last = request.get_header_value("Last-Event-ID");
      if (!last.empty()) first = std::strtoull(last.c_str(), nullptr, 10) + 1;
      const auto next = std::make_shared<std::size_t>(first);
      response.set_header("Cache-Control", "no-store");
      response.set_chunked_content_provider(
          "text/event-stream",
          [this, next](std::size_t, httplib::DataSink& sink) { return send_new(*next, sink); });
    });
  }
};

LiveServer::LiveServer(int port, std::string title, std::filesystem::path report)
    : impl_(std::make_unique<Impl>()) {
  impl_->page = page_text(title);
  impl_->report = std::move(report);
  impl_->define_pages();
  const int last = port == 0 ? 0 : port + kPortsTried;
  for (int candidate = port; candidate <= last && impl_->port == 0; ++candidate) {
    if (candidate == 0) {
      impl_->port = std::max(0, impl_->server.bind_to_any_port("127.0.0.1"));
    } else if (impl_->server.bind_to_port("127.0.0.1", candidate)) {
      impl_->port = candidate;
    }
  }
  if (impl_->port == 0) {
    throw UserError(Problem{{},
                            "live page",
                            "a free port on 127.0.0.1",
                            fmt::format("none from {} to {}", port, last),
                            "choose another --port"});
  }
  impl_->thread = std::thread([this] { impl_->server.listen_after_bind(); });
  while (!impl_->server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

LiveServer::~LiveServer() {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->is_ending = true;
  }
  impl_->grown.notify_all();
  impl_->server.stop();
  impl_->thread.join();
}

std::string LiveServer::url() const { return fmt::format("http://127.0.0.1:{}/", impl_->port); }

void LiveServer::publish(const std::string& name, const std::string& data) {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->events.push_back(
        fmt::format("id: {}\nevent: {}\ndata: {}\n\n", impl_->events.size(), name, data));
  }
  impl_->grown.notify_all();
}

}  // namespace crosswalk::recording
