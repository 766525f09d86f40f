#include "recorder/recorder_node.h"

#include "common/bus.h"
#include "common/interrupt.h"
#include "common/log.h"
#include "common/version.h"
#include "recorder/analysis.h"
#include "recorder/recorder_session.h"
#include "recorder/run_report.h"

namespace crosswalk::recording {

namespace {

/// Channels, summary, table and report from what the log holds; a log too poor for them is said,
/// not fatal.
void conclude(const RunDirectory& directory, const Recorder& recorder,
              const RecorderSession::Advanced& advanced) {
  log_info("{} messages, {:.1f} MB in {}", recorder.messages(),
           1e-6 * static_cast<double>(recorder.bytes()), directory.signals().string());
  try {
    const RunRecord record = read_run_record(directory.signals());
    advanced();
    const Analysis analysis = analyze_record(record);
    advanced();
    // The summary comes last: it tells a later `crosswalk resume` that everything is there.
    write_report(directory.report(), report_input(analysis, record, directory));
    advanced();
    write_results(analysis, directory);
    for (const std::string& warning : analysis.summary.warnings) log_warning("{}", warning);
  } catch (const UserError& error) {
    log_warning("no results: {}", error.what());
  } catch (const SignalError& error) {
    log_warning("no results ({}): {}", error.code(), error.what());
  }
}

}  // namespace

void read_recorder_table(ConfigDocument& document, const Scenario&) {
  document.root().table("recorder", "Settings of the recorder; none are needed.");
}

ExitCode run_recorder(RunContext& context) {
  read_recorder_table(context.document, context.scenario);
  context.document.finish();
  Bus bus(open_transport(context.url), context.run_id, Role::Recorder,
          BusFaults::from_environment());
  const std::filesystem::path checkpoints = context.directory.checkpoints();
  const LogExtent kept =
      context.resume ? kept_log(checkpoints, checkpoint_to_resume(checkpoints)) : LogExtent{};
  Recorder recorder(context.directory.signals(), bus.run(), kept);
  NodeIdentity identity;
  identity.scenario_digest = static_cast<std::int64_t>(context.scenario.digest);
  identity.version = version_text();
  NodeSession::Limits limits;
  limits.join_s = context.wait_s;
  bool is_concluded = false;
  const auto conclude_once = [&](const RecorderSession::Advanced& advanced) {
    recorder.flush();
    if (!is_concluded) conclude(context.directory, recorder, advanced);
    is_concluded = true;
  };
  RecorderSession session(bus, recorder, identity, limits, conclude_once, checkpoints);
  try {
    const ExitCode code = session.run(interrupt_flag());
    conclude_once([] {});
    return code;
  } catch (const ProtocolError& error) {
    if (!session.manifest()) throw;
    // The run failed elsewhere: keep and judge what there is.
    log_warning("the record is not complete: {}", error.what());
    conclude_once([] {});
    return ExitCode::Done;
  }
}

}  // namespace crosswalk::recording
