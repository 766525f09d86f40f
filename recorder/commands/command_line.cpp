#include "recorder/commands/command_line.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "recorder/commands/commands.h"

namespace crosswalk::recording {

namespace {

/// What the parser fills; it outlives the parser inside the returned action.
template <typename Request>
struct Parsed {
  Request request;
  bool is_json = false;
  OutputForm form() const { return is_json ? OutputForm::Json : OutputForm::Text; }
};

[[noreturn]] void wrong_usage(const std::string& what, const std::string& expected) {
  Problem problem;
  problem.what = what;
  problem.expected = expected;
  throw UserError(problem);
}

using Action = std::function<ExitCode()>;

Action define_rate(CLI::App& app) {
  auto parsed = std::make_shared<Parsed<RateRequest>>();
  RateRequest& r = parsed->request;
  app.add_option("method", r.method, "cora or iso18571")->required();
  app.add_option("files", r.files,
                 "PAIR.csv (columns t,ref,sim[,sigma]) or REF.csv SIM.csv (columns t,value)")
      ->expected(0, 2);
  app.add_option("--run", r.run, "rate this run: against its test's curves, or");
  app.add_option("--reference-run", r.reference_run,
                 "against the channels of this one, or of an ISO-MME test");
  app.add_option("--parameters", r.parameters,
                 "JSON object with parameters under the method's own names");
  app.add_option("--set", r.set,
                 "TOML file of signals and weights (default: the five head signals)");
  app.add_flag("--json", parsed->is_json, "one JSON object in full precision");
  return [parsed] {
    return reported(parsed->form(), [&parsed] {
      const RateRequest& request = parsed->request;
      if (request.method != "cora" && request.method != "iso18571") {
        throw SignalError(SignalFault::BadParameter,
                          "method: expected cora or iso18571, found " + request.method);
      }
      const bool is_lone_reference = request.run.empty() && !request.reference_run.empty();
      if (is_lone_reference || request.run.empty() == request.files.empty()) {
        wrong_usage("rate", "PAIR.csv, or REF.csv SIM.csv, or --run A [--reference-run B]");
      }
      return rate(request, parsed->form());
    });
  };
}

Action define_injury(CLI::App& app) {
  auto parsed = std::make_shared<Parsed<InjuryRequest>>();
  app.add_option(
         "source", parsed->request.source,
         "CSV of head signals (columns t,ax,ay,az and more), a run, a log, or an ISO-MME test")
      ->required();
  app.add_flag("--no-filter", parsed->request.is_filtered, "the signals are filtered already");
  app.add_flag("--json", parsed->is_json, "one JSON object in full precision");
  return [parsed] {
    return reported(parsed->form(), [&parsed] { return injury(parsed->request, parsed->form()); });
  };
}

Action define_analyze(CLI::App& app) {
  auto parsed = std::make_shared<Parsed<AnalyzeRequest>>();
  app.add_option("source", parsed->request.source, "Run folder, or any log of lcm-logger")
      ->required();
  app.add_option("--out", parsed->request.out, "Folder of the results");
  app.add_flag("--json", parsed->is_json, "print summary.json instead of the table");
  return [parsed] {
    return reported(parsed->form(), [&parsed] { return analyze(parsed->request, parsed->form()); });
  };
}

Action define_export(CLI::App& app) {
  auto request = std::make_shared<ExportRequest>();
  app.add_option("run", request->run, "Run folder")->required();
  app.add_option("--format", request->format,
                 "csv or isomme; bodies: poses of all bodies; motion, impact_motion: head and car, "
                 "from the first "
                 "contact or from 2 ms before the head's, for a head alone")
      ->capture_default_str()
      ->check(CLI::IsMember({"csv", "isomme", "bodies", "motion", "impact_motion"}));
  app.add_option("--out", request->out,
                 "Folder to write into; export/ in the run folder by default");
  return
      [request] { return reported(OutputForm::Text, [&request] { return export_run(*request); }); };
}

Action define_report(CLI::App& app) {
  auto request = std::make_shared<ReportRequest>();
  app.add_option("run", request->run, "Run folder, or any log of lcm-logger")->required();
  app.add_option("--with", request->with, "Further runs, laid over the charts");
  app.add_option("--out", request->out, "File; report.html in the run folder by default");
  return [request] { return reported(OutputForm::Text, [&request] { return report(*request); }); };
}

Action define_compare(CLI::App& app) {
  auto request = std::make_shared<CompareRequest>();
  app.add_option("runs", request->runs, "Two or more run folders")->required()->expected(2, 64);
  app.add_option("--out", request->out, "File")->capture_default_str();
  app.add_option("--set", request->set,
                 "TOML file of signals and weights (default: the five head signals)");
  app.add_option("--parameters", request->parameters, "JSON object with CORA's parameters");
  return [request] { return reported(OutputForm::Text, [&request] { return compare(*request); }); };
}

Action define_view(CLI::App& app) {
  auto request = std::make_shared<ViewRequest>();
  app.add_option("run", request->run, "Run folder, or any log of lcm-logger")->required();
  app.add_flag("--frames", request->has_frames,
               "Still pictures, posterior and superior (the only form there is)");
  app.add_option("--at-ms", request->times_ms,
                 "Times after first contact, ms; 0, 40 .. 200 by default");
  app.add_option("--height", request->height, "Picture height, pixels")
      ->capture_default_str()
      ->check(CLI::Range(60, 4000));
  app.add_option("--out", request->out, "Folder; pictures/ in the run folder by default");
  return [request] { return reported(OutputForm::Text, [&request] { return view(*request); }); };
}

Action define_watch(CLI::App& app) {
  auto request = std::make_shared<WatchRequest>();
  app.add_option("run", request->run, "Run folder, of a running or a finished run")->required();
  app.add_option("--port", request->port, "First port tried on 127.0.0.1")
      ->capture_default_str()
      ->check(CLI::Range(0, 65000));
  app.add_flag("--ends-with-run", request->ends_with_run, "End when the run's report is written");
  return [request] { return reported(OutputForm::Text, [&request] { return watch(*request); }); };
}

Action define_feed(CLI::App& app) {
  auto request = std::make_shared<FeedRequest>();
  app.add_option("run", request->run, "Run folder")->required();
  app.add_option("--url", request->url, "LCM URL of the node")->required();
  app.add_option("--run-id", request->run_id, "Run id of the node")->required();
  return [request] { return feed(*request); };
}

Action define_bench(CLI::App& app) {
  auto request = std::make_shared<BenchRequest>();
  app.add_option("what", request->what, "rating, report or live")->required();
  app.add_option("run", request->run, "Run folder, for report and live");
  return [request] { return reported(OutputForm::Text, [&request] { return bench(*request); }); };
}

}  // namespace

std::vector<NodeCommand> commands() {
  return {{"rate", "Rate one signal against another.", define_rate},
          {"injury", "Injury metrics of head signals.", define_injury},
          {"analyze", "Channels, summary and table from a log.", define_analyze},
          {"export", "Channels in an exchange format.", define_export},
          {"report", "One HTML page about a run.", define_report},
          {"compare", "Two or more runs side by side: table and HTML page.", define_compare},
          {"view", "Still pictures of a run.", define_view},
          {"watch", "Live page of a run on localhost.", define_watch},
          {"feed", "A run's grants to a fresh fe_node (`crosswalk replay --to fe`).", define_feed},
          {"bench", "Speed of rating, report and live page.", define_bench}};
}

}  // namespace crosswalk::recording
