#include "recorder/live_feed.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/run_directory.h"
#include "common/units.h"
#include "recorder/message_decode.h"
#include "recorder/report/live_server.h"
#include "recorder/report/scene_json.h"
#include "recorder/run_scene.h"

namespace crosswalk::recording {

namespace {

constexpr auto kPollEvery = std::chrono::milliseconds(200);
constexpr auto kLastLook = std::chrono::seconds(3);  // for browsers to fetch the last events
constexpr std::int64_t kBinNs = 100'000;             // one plotted sample per 0.1 ms

using Json = nlohmann::ordered_json;

/// The value of largest magnitude in every bin of kBinNs.
template <typename Samples, typename Value>
Json binned(const Samples& samples, Value value) {
  Json t = Json::array();
  Json y = Json::array();
  std::int64_t bin = -1;
  for (const auto& [t_ns, sample] : samples) {
    const double v = value(sample);
    if (!std::isfinite(v)) continue;
    if (t_ns / kBinNs != bin) {
      bin = t_ns / kBinNs;
      t.push_back(1e-6 * static_cast<double>(t_ns));
      y.push_back(v);
    } else if (std::abs(v) > std::abs(y.back().get<double>())) {
      y.back() = v;
    }
  }
  return {{"t", t}, {"y", y}};
}

std::optional<MessageKind> kind_of(const LogEvent& event) {
  const auto h = peek_header(event.data);
  if (!h) return std::nullopt;
  return static_cast<MessageKind>(h->kind);
}

}  // namespace

void LiveFeed::remember(const LogEvent& event) {
  const auto kind = kind_of(event);
  if (kind == MessageKind::RunManifest && manifest_.empty()) manifest_ = event.data;
  if (!has_scene_ && (kind == MessageKind::RunManifest || kind == MessageKind::NodeDescription))
    set_up_.add(event.data, event.time_us);
}

void LiveFeed::take(const std::vector<LogEvent>& batch) {
  for (const LogEvent& event : batch) remember(event);
  if (manifest_.empty()) {
    early_.insert(early_.end(), batch.begin(), batch.end());
    return;
  }
  // A builder of its own for every batch: its record holds the news only.
  RecordBuilder builder;
  builder.add(manifest_, 0);
  for (const LogEvent& event : early_) builder.add(event.data, event.time_us);
  for (const LogEvent& event : batch) builder.add(event.data, event.time_us);
  early_.clear();
  const RunRecord news = builder.record();
  if (news.manifest) run_ = *news.manifest;
  if (!has_scene_) publish_scene();
  if (has_scene_) publish_frames(news);
  publish_samples(news);
  publish_state(news);
}

void LiveFeed::publish_scene() {
  const RunRecord record = set_up_.record();
  if (!record.description.contains(Role::Mb)) return;
  if (run_.has_fe && !record.description.contains(Role::Fe)) return;
  scene_ = shapes_of(record);
  has_scene_ = true;
  publish_("scene", scene_json(scene_).dump());
}

void LiveFeed::publish_frames(const RunRecord& news) {
  scene_.frames.clear();
  add_frames(scene_, news, 0);
  if (!scene_.frames.empty()) publish_("frames", Json{{"poses", poses_base64(scene_)}}.dump());
}

void LiveFeed::publish_samples(const RunRecord& news) {
  Json out;
  if (!news.head.empty()) {
    out["acceleration"] = binned(
        news.head, [](const HeadSample& s) { return s.acceleration.norm() / kStandardGravity; });
    out["speed"] = binned(news.head, [](const HeadSample& s) { return s.V_WH.v.norm(); });
  }
  if (!news.contact.empty()) {
    out["force"] = binned(news.contact, [](const std::vector<Vec3>& f) {
      return f.empty() ? 0.0 : 1e-3 * f.front().norm();
    });
  }
  if (!news.audit.empty()) {
    std::map<std::int64_t, double> drift;
    for (const auto& [window, a] : news.audit) drift[a.t_ns] = a.drift;
    out["drift"] = binned(drift, [](double d) { return d; });
  }
  if (!out.empty()) publish_("samples", out.dump());
}

void LiveFeed::publish_state(const RunRecord& news) {
  if (!news.mb.empty()) {
    const MbWindow& last = news.mb.rbegin()->second;
    const Json state{{"scenario", run_.scenario},
                     {"mode", run_.mode()},
                     {"t_ms", 1e-6 * static_cast<double>(last.t_ns)},
                     {"duration_ms", 1e-6 * static_cast<double>(run_.duration_ns)},
                     {"contacts", last.contacts}};
    publish_("state", state.dump());
  }
  if (!has_ended_ && (news.is_finished || news.abort_reason)) {
    has_ended_ = true;
    publish_("end", Json{{"reason", news.abort_reason.value_or("")}}.dump());
  }
}

void serve_live_page(const std::filesystem::path& run, int port, LivePage page,
                     const std::function<bool()>& stop) {
  const RunDirectory directory(run);
  LiveServer server(port, run.lexically_normal().filename().string(), directory.report());
  fmt::print("{}\n", server.url());
  std::fflush(stdout);
  LiveFeed feed(
      [&server](const std::string& name, const std::string& data) { server.publish(name, data); });
  LogFollower log(directory.signals());
  std::optional<std::chrono::steady_clock::time_point> ended;
  bool is_report_told = false;
  while (!stop()) {
    std::vector<LogEvent> batch;
    log.poll([&batch](const LogEvent& event) { batch.push_back(event); });
    if (!batch.empty()) feed.take(batch);
    if (!is_report_told && feed.has_ended() && std::filesystem::exists(directory.report())) {
      is_report_told = true;
      ended = std::chrono::steady_clock::now();
      server.publish("report", "{}");
    }
    if (page == LivePage::UntilRunEnds && ended &&
        std::chrono::steady_clock::now() - *ended > kLastLook)
      return;
    std::this_thread::sleep_for(kPollEvery);
  }
}

}  // namespace crosswalk::recording
