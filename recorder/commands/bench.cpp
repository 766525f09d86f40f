// Speed of what the recorder makes: `crosswalk bench rating`, `bench report RUN`, `bench live RUN`.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include <fmt/format.h>

#include "recorder/analysis.h"
#include "recorder/commands/commands.h"
#include "recorder/live_feed.h"
#include "recorder/log_file.h"
#include "recorder/report/report.h"
#include "recorder/run_report.h"
#include "recorder/scoring/cora.h"
#include "recorder/scoring/iso18571.h"

namespace crosswalk::recording {

namespace {

constexpr int kRepeats = 5;           // the median counts
constexpr double kRate = 20000;       // Hz
constexpr double kDuration = 0.2;     // s
constexpr double kRatingLimit = 0.2;  // s, what a CORA rating of such signals may take
constexpr double kReportLimit = 20;   // s, what the report of a medium run may take

template <typename Work>
double median_seconds(const Work& work) {
  std::vector<double> seconds;
  for (int i = 0; i < kRepeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(seconds.begin(), seconds.begin() + kRepeats / 2, seconds.end());
  return seconds[kRepeats / 2];
}

/// A head acceleration of two blows (m/s2), late by `delay` (s) and larger by `scale`.
Series two_blows(double delay, double scale) {
  Series s;
  for (int i = 0; i <= static_cast<int>(kRate * kDuration); ++i) {
    const double t = i / kRate;
    const auto bell = [&](double at, double width) {
      return std::exp(-std::pow((t - delay - at) / width, 2));
    };
    s.t.push_back(t);
    s.y.push_back(scale *
                  (900 * bell(0.135, 0.004) + 250 * bell(0.16, 0.006) + 10 * std::sin(900 * t)));
  }
  return s;
}

void print_row(const char* what, double seconds, double limit) {
  fmt::print("{:<44}{:>10.4f} s   limit {:g} s\n", what, seconds, limit);
}

void bench_rating() {
  const Series reference = two_blows(0, 1);
  const Series simulation = two_blows(0.002, 0.85);
  double sum = 0;  // printed, so that no rating can be left out
  const double by_cora = median_seconds([&] { sum += cora(reference, simulation, {}, {}).C; });
  const double by_iso = median_seconds([&] { sum += iso18571(reference, simulation, {}).R; });
  fmt::print("two signals of {} samples, median of {}, scores sum {:.4f}\n", reference.t.size(),
             kRepeats, sum);
  print_row("CORA", by_cora, kRatingLimit);
  print_row("ISO/TS 18571", by_iso, kRatingLimit);
}

void bench_report(const std::filesystem::path& run) {
  const RunDirectory directory(run);
  const auto start = std::chrono::steady_clock::now();
  const auto since_start = [&start] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const RunRecord record = read_run_record(directory.signals());
  const Analysis analysis = analyze_record(record);
  const double analyzed = since_start();
  const std::size_t bytes = render_report(report_input(analysis, record, directory)).size();
  const double rendered = since_start();
  fmt::print("{}: {} messages, page of {:.1f} MB\n", run.string(), record.messages,
             1e-6 * static_cast<double>(bytes));
  print_row("log to channels and summary", analyzed, kReportLimit);
  print_row("log to report", rendered, kReportLimit);
}

/// What the live page's server works on a run, against the time the run took: the log is handed
/// over in the portions in which it came.
void bench_live(const std::filesystem::path& run) {
  std::vector<LogEvent> events;
  read_log(RunDirectory(run).signals(), [&](const LogEvent& event) { events.push_back(event); });
  if (events.empty()) throw UserError(Problem{{run.string()}, "bench", "a log", "none", {}});
  std::size_t bytes = 0;
  LiveFeed feed([&bytes](const std::string&, const std::string& data) { bytes += data.size(); });
  constexpr std::int64_t kPortionUs = 200'000;
  const std::clock_t start = std::clock();
  for (std::size_t i = 0; i < events.size();) {
    std::vector<LogEvent> portion;
    const std::int64_t end = events[i].time_us + kPortionUs;
    for (; i < events.size() && events[i].time_us < end; ++i) portion.push_back(events[i]);
    feed.take(portion);
  }
  const double work = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const double took = 1e-6 * static_cast<double>(events.back().time_us - events.front().time_us);
  fmt::print("{}: {} messages in {:.1f} s, {:.1f} MB of events\n", run.string(), events.size(),
             took, 1e-6 * static_cast<double>(bytes));
  fmt::print("{:<44}{:>10.4f} s   {:.2f} % of the run on one processor, limit 2 %\n",
             "processor time of the live page, no browser", work, 100 * work / took);
}

}  // namespace

ExitCode bench(const BenchRequest& request) {
  if (request.what == "rating") {
    bench_rating();
  } else if (request.what == "report" && !request.run.empty()) {
    bench_report(request.run);
  } else if (request.what == "live" && !request.run.empty()) {
    bench_live(request.run);
  } else {
    throw UserError(Problem{{}, "bench", "rating, report RUN or live RUN", request.what, {}});
  }
  return ExitCode::Done;
}

}  // namespace crosswalk::recording
