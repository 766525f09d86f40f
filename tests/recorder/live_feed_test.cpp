// What the live page is told while a run's log grows.
#include "recorder/live_feed.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/recorder/synthetic_run.h"

namespace crosswalk::recording {
namespace {

struct Told {
  std::map<std::string, int> count;
  std::vector<double> t, speed;  // ms, m/s
  nlohmann::json state;
};

/// The messages of the synthetic run handed over `portion` at a time.
Told told(std::size_t portion) {
  Told out;
  LiveFeed feed([&out](const std::string& name, const std::string& text) {
    const nlohmann::json data = nlohmann::json::parse(text);
    ++out.count[name];
    if (name == "state") out.state = data;
    if (name != "samples" || !data.contains("speed")) return;
    for (const auto& t : data["speed"]["t"]) out.t.push_back(t);
    for (const auto& v : data["speed"]["y"]) out.speed.push_back(v);
  });
  std::vector<LogEvent> batch;
  for (const RawMessage& message : SyntheticRun{}.messages()) {
    batch.push_back({0, 0, message.channel, message.data});
    if (batch.size() < portion) continue;
    feed.take(batch);
    batch.clear();
  }
  feed.take(batch);
  EXPECT_TRUE(feed.has_ended());
  return out;
}

TEST(LiveFeed, TellsHeadSpeedAndTimeAsWindowsComplete) {
  const Told out = told(100);
  EXPECT_GT(out.count.at("samples"), 10);
  EXPECT_EQ(out.count.at("end"), 1);
  EXPECT_NEAR(out.state["t_ms"].get<double>(), 20, 0.1);
  EXPECT_EQ(out.state["mode"], "coupled");
  EXPECT_TRUE(std::is_sorted(out.t.begin(), out.t.end()));
  EXPECT_NEAR(out.speed.front(), 0.5, 1e-3);  // falling at 0.5 m/s before it is struck
  EXPECT_GT(out.speed.back(), 1);
}

TEST(LiveFeed, PortionsDoNotMatter) {
  const Told one = told(1), all = told(1'000'000);
  EXPECT_EQ(one.state, all.state);
  EXPECT_EQ(one.count.at("end"), all.count.at("end"));
  EXPECT_EQ(*std::max_element(one.speed.begin(), one.speed.end()),
            *std::max_element(all.speed.begin(), all.speed.end()));
}

}  // namespace
}  // namespace crosswalk::recording
