// What is made to be looked at: report, comparison, still pictures.
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "common/interrupt.h"
#include "recorder/commands/commands.h"
#include "recorder/live_feed.h"
#include "recorder/report/frames.h"
#include "recorder/run_compare.h"
#include "recorder/run_report.h"
#include "recorder/run_scene.h"
#include "recorder/scoring/score_json.h"

namespace crosswalk::recording {

namespace fs = std::filesystem;

namespace {

/// Where a run's log is and where its files go: a run folder, or the folder of a bare log.
struct Source {
  explicit Source(const fs::path& given)
      : is_folder(fs::is_directory(given)),
        directory(is_folder ? given : given.parent_path()),
        log(is_folder ? directory.signals() : given) {}
  bool is_folder;
  RunDirectory directory;
  fs::path log;
};

std::string label_of(const Analysis& analysis, const fs::path& given) {
  return fmt::format("{} ({})", mode_of(analysis.summary),
                     fs::absolute(given).lexically_normal().filename().string());
}

}  // namespace

ExitCode report(const ReportRequest& request) {
  const Source source(request.run);
  const RunRecord record = read_run_record(source.log);
  const Analysis analysis = analyze_record(record);
  ReportInput input = report_input(analysis, record, source.directory);
  for (const fs::path& other : request.with) {
    const Analysis second = analyze_log(Source(other).log);
    overlay(input, second, label_of(second, other));
  }
  const fs::path out = !request.out.empty() ? request.out
                       : source.is_folder   ? source.directory.report()
                                            : fs::path(source.log).replace_extension("report.html");
  write_report(out, input);
  fmt::print("written: {}\n", out.string());
  return ExitCode::Done;
}

ExitCode compare(const CompareRequest& request) {
  const ComparisonSettings settings{rating_set(request.set),
                                    {cora_parameters(read_parameters(request.parameters)), {}}};
  std::vector<ComparedRun> runs;
  for (const fs::path& run : request.runs) {
    const Source source(run);
    RunRecord record = read_run_record(source.log);
    Analysis analysis = analyze_record(record);
    runs.push_back({run.lexically_normal().filename().string(), std::move(analysis), {}});
    runs.back().scene = scene_of(record, runs.back().analysis.summary.t0);
  }
  write_report(request.out, comparison_input(runs, settings));
  fmt::print("{}\nwritten: {}\n", comparison_text(runs, settings), request.out.string());
  return ExitCode::Done;
}

ExitCode view(const ViewRequest& request) {
  const Source source(request.run);
  const RunRecord record = read_run_record(source.log);
  const Scene scene = scene_of(record, extract(record).t0);
  if (scene.empty()) {
    throw UserError(Problem{{source.log.string()},
                            "pictures",
                            "body poses and ellipsoids of mb_node",
                            "none in this log",
                            {}});
  }
  std::vector<double> times;
  for (const double t_ms : request.times_ms) times.push_back(1e-3 * t_ms);
  if (times.empty()) times = default_still_times(scene);
  const fs::path folder = request.out.empty() ? source.directory.root() / "pictures" : request.out;
  for (const fs::path& file : write_stills(folder, scene, times, request.height)) {
    fmt::print("{}\n", file.string());
  }
  return ExitCode::Done;
}

ExitCode watch(const WatchRequest& request) {
  if (!fs::is_directory(request.run)) {
    throw UserError(
        Problem{{request.run.string()}, "live page", "the folder of a run", "no folder", {}});
  }
  if (!report_is_interactive()) {
    throw UserError(Problem{{},
                            "live page",
                            "a build with npm",
                            "a build without",
                            "apt-get install npm, then configure and build again"});
  }
  catch_interrupts();
  const pid_t parent = getppid();
  const auto stop = [&] {
    return is_interrupted() || (request.ends_with_run && getppid() != parent);
  };
  if (nice(19) == -1) {  // harmless: the run goes first where it can
    fmt::print(stderr, "watch: runs at normal priority\n");
  }
  serve_live_page(request.run, request.port,
                  request.ends_with_run ? LivePage::UntilRunEnds : LivePage::Lasting, stop);
  return ExitCode::Done;
}

}  // namespace crosswalk::recording
