#include "launcher/plan.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <ctime>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "launcher/handover.h"
#include "launcher/remote.h"

namespace crosswalk {

namespace fs = std::filesystem;

namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Scenario files found by name: stem -> path, the current folder's first.
std::vector<std::pair<std::string, fs::path>> named_scenarios() {
  std::vector<std::pair<std::string, fs::path>> found;
  for (const fs::path& root : {fs::path("."), fs::path(CROSSWALK_SOURCE_DIR)}) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(root / "scenarios/tests", ignored))
      if (entry.path().extension() == ".toml")
        found.emplace_back(entry.path().stem().string(), entry.path().lexically_normal());
  }
  return found;
}

std::string clock_text() {
  const std::time_t now = std::time(nullptr);
  std::tm calendar{};
  localtime_r(&now, &calendar);
  std::array<char, 20> text{};
  std::strftime(text.data(), text.size(), "%Y%m%d-%H%M%S", &calendar);
  return text.data();
}

/// Of an impact alone: the head has left the glass again, ms.
constexpr double kImpactMs = 40;

/// The motion of head and car of the run that a head alone follows, as a file in its folder.
fs::path export_motion(const RunRequest& request) {
  const bool is_impact = request.mode == "impact_only";
  if (!is_impact && request.mode != "prescribed")
    throw UserError(Problem{{}, "--from", "--mode prescribed or impact_only", request.mode, {}});
  const fs::path out = fs::absolute(request.from).lexically_normal() / "export";
  const std::string format = is_impact ? "impact_motion" : "motion";
  ProcessSpec spec;
  spec.name = "recorder export";
  spec.program = sibling_program("recorder");
  spec.arguments = {"export", request.from.string(), "--format", format, "--out", out.string()};
  spec.log = out.parent_path() / "logs" / "export.log";
  if (!fs::exists(RunDirectory(request.from).signals()))
    throw UserError(
        Problem{Place{request.from.string()}, "--from", "the folder of a run", "none", {}});
  if (!Process(spec).wait().is_success()) {
    std::ifstream log(spec.log);
    throw UserError(Problem{Place{request.from.string()},
                            "--from",
                            "a run whose head can be followed",
                            std::string(std::istreambuf_iterator<char>(log), {}),
                            {}});
  }
  return out / (format + ".csv");
}

/// A folder name without blanks, slashes and the like.
std::string file_name(const std::string& name) {
  std::string out = name;
  for (char& c : out)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '_' && c != '-')
      c = '_';
  return out.empty() ? "run" : out;
}

}  // namespace

fs::path find_scenario(const std::string& name_or_path) {
  if (fs::is_regular_file(name_or_path)) return name_or_path;
  const auto named = named_scenarios();
  const std::string wanted = lower(name_or_path);
  std::vector<std::string> names;
  for (const auto& [name, path] : named) {
    if (lower(name) == wanted || lower(name) + ".toml" == wanted) return path;
    if (std::find(names.begin(), names.end(), lower(name)) == names.end())
      names.push_back(lower(name));
  }
  std::sort(names.begin(), names.end());
  const std::string near = did_you_mean(wanted, names);
  std::string hint = near.empty() ? "" : fmt::format("did you mean `{}`? ", near);
  hint +=
      fmt::format("known: {}", names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")));
  throw UserError(Problem{{},
                          "scenario",
                          "a file, or a name under scenarios/tests/",
                          fmt::format("\"{}\"", name_or_path),
                          hint});
}

ConfigDocument load_scenario(const fs::path& file, const RunRequest& request, Scenario& scenario) {
  ConfigDocument document(file);
  if (!request.mode.empty())
    document.override_with(fmt::format("[run]\nmode = \"{}\"\n", request.mode), "--mode");
  if (!request.from.empty())
    document.override_with(fmt::format("[run]\nmotion = \"{}\"\n", export_motion(request).string()),
                           "--from");
  if (request.mode == "impact_only" && !request.until_ms)
    document.override_with(fmt::format("[run]\nduration_ms = {:#}\n", kImpactMs), "--mode");
  if (!request.fidelity.empty())
    document.override_with(fmt::format("[run]\nfidelity = \"{}\"\n", request.fidelity),
                           "--fidelity");
  if (request.until_ms)
    document.override_with(fmt::format("[run]\nduration_ms = {:#}\n", *request.until_ms),
                           "--until-ms");
  ignore_tables_of_others(document, "crosswalk");
  scenario = read_scenario(document);
  document.finish();
  return document;
}

RunDirectory make_run_directory(const fs::path& out, const std::string& name) {
  if (!out.empty()) {
    const RunDirectory directory(fs::absolute(out).lexically_normal());
    if (fs::exists(directory.scenario()))
      throw UserError(Problem{Place{out.string()}, "--out", "a new or empty folder", "another run",
                              "choose another folder or remove this one"});
    directory.create();
    return directory;
  }
  const std::string stem = file_name(name) + "-" + clock_text();
  std::error_code error;
  fs::create_directories("runs", error);
  fs::path root = fs::absolute("runs") / stem;
  for (int i = 2; !error && !fs::create_directory(root, error); ++i)
    root = fs::absolute("runs") / fmt::format("{}-{}", stem, i);
  const RunDirectory directory(root);
  directory.create();
  return directory;
}

std::string commands_text(const std::vector<ProcessSpec>& specs, const RunDirectory& directory,
                          const std::string& run_id) {
  std::string text;
  for (const ProcessSpec& spec : specs) {
    if (spec.host.empty()) {
      text += spec.command_text() + "\n";
      continue;
    }
    const ProcessSpec there = in_remote_folder(spec, directory);
    text += fmt::format("# on {0}, with {1} copied to {2}/ there:\ncd {2} && {3}\n", spec.host,
                        directory.scenario().string(), remote_folder(run_id).string(),
                        there.command_text());
  }
  return text;
}

std::vector<std::string> programs_of(const Scenario& scenario) {
  if (scenario.has_fe()) return {"coupler", "mb_node", "fe_node", "recorder"};
  return {"coupler", "mb_node", "recorder"};
}

std::vector<ProcessSpec> process_specs(const Scenario& scenario, const RunRequest& request,
                                       const RunDirectory& directory, const std::string& run_id,
                                       const std::string& url) {
  std::vector<ProcessSpec> specs;
  for (const std::string& name : programs_of(scenario)) {
    ProcessSpec spec;
    spec.name = name;
    for (const NodeSpec& node : scenario.nodes)
      if (node.name == name) spec.host = node.host;
    const bool is_elsewhere = !spec.host.empty() && !request.remote_programs.empty();
    spec.program = is_elsewhere ? fs::path(request.remote_programs) / name : sibling_program(name);
    spec.arguments = {"run",
                      "--scenario",
                      directory.scenario().string(),
                      "--run-id",
                      run_id,
                      "--url",
                      url,
                      "--out",
                      directory.root().string(),
                      "--wait-s",
                      fmt::format("{}", request.wait_s)};
    if (request.is_resumed) spec.arguments.emplace_back("--resume");
    if (request.threads > 0)
      spec.arguments.insert(spec.arguments.end(), {"--threads", std::to_string(request.threads)});
    spec.log = directory.log(name);
    spec.is_output_piped = name == "coupler";
    specs.push_back(std::move(spec));
  }
  return specs;
}

}  // namespace crosswalk
