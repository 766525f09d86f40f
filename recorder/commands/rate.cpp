#include <cstdio>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "recorder/commands/commands.h"
#include "recorder/csv_table.h"
#include "recorder/scoring/score_json.h"

namespace crosswalk::recording {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct Pair {
  Series reference, simulation;
  std::vector<double> sigma;
};

Pair read_pair(const std::vector<std::filesystem::path>& files) {
  if (files.size() == 2) {
    Pair pair;
    const CsvTable reference = read_csv(files[0]);
    if (reference.has("sigma")) pair.sigma = reference.column("sigma");
    pair.reference = {time_column(reference), value_column(reference)};
    pair.simulation = read_series(files[1]);
    return pair;
  }
  const CsvTable table = read_csv(files.at(0));
  const std::vector<double> t = time_column(table);
  Pair pair{{t, table.column("ref")}, {t, table.column("sim")}, {}};
  if (table.has("sigma")) pair.sigma = table.column("sigma");
  return pair;
}

void print_parameters(const ordered_json& parameters) {
  std::string line = "parameters:";
  for (const auto& [key, value] : parameters.items()) {
    const std::string item =
        fmt::format(" {}={}", key, value.is_string() ? value.get<std::string>() : value.dump());
    if (line.size() + item.size() > 100) {
      fmt::print("{}\n", line);
      line = "           ";
    }
    line += item;
  }
  fmt::print("{}\n", line);
}

ExitCode rate_cora(const Pair& pair, const json& overrides, OutputForm form) {
  const CoraParameters parameters = cora_parameters(overrides);
  const CoraResult r = cora(pair.reference, pair.simulation, parameters, pair.sigma);
  if (form == OutputForm::Json) {
    ordered_json out = to_json(r);
    out["grade"] = cora_grade(r.C);
    out["parameters"] = to_json(parameters);
    fmt::print("{}\n", out.dump(1));
    return ExitCode::Done;
  }
  fmt::print("CORA rating C = {:.3f} ({})\n", r.C, cora_grade(r.C));
  fmt::print("  corridor          C1 = {:.3f}   weight {:g}\n", r.C1, parameters.G_1);
  fmt::print("  cross-correlation C2 = {:.3f}   weight {:g}\n", r.C2, parameters.G_2);
  fmt::print("    progression V = {:.3f}, size G = {:.3f}, phase P = {:.3f}\n", r.V, r.G, r.P);
  fmt::print("    largest correlation {:.5f} at {:+.2f} ms (negative: simulation late)\n", r.K_max,
             1e3 * r.delta);
  fmt::print("  interval {:.4g} .. {:.4g} s, {} samples of {:.4g} ms, Y_norm {:.5g}\n", r.t_min,
             r.t_max, r.n, 1e3 * r.dt, r.Y_norm);
  print_parameters(to_json(parameters));
  return ExitCode::Done;
}

ExitCode rate_iso18571(Pair pair, const json& overrides, OutputForm form) {
  const Iso18571Parameters parameters = iso18571_parameters(overrides);
  align_grids(pair.reference, pair.simulation);
  const Iso18571Result r = iso18571(pair.reference, pair.simulation, parameters);
  if (form == OutputForm::Json) {
    ordered_json out = to_json(r);
    out["parameters"] = to_json(parameters);
    fmt::print("{}\n", out.dump(1));
    return ExitCode::Done;
  }
  fmt::print("ISO/TS 18571 rating R = {:.3f} ({})\n", r.R, r.grade);
  fmt::print("  corridor Z = {:.3f}, phase EP = {:.3f}, magnitude EM = {:.3f}, slope ES = {:.3f}\n",
             r.Z, r.EP, r.EM, r.ES);
  fmt::print("  best correlation {:.5f} at a shift of {} samples\n", r.rho_E, r.n_eps);
  print_parameters(to_json(parameters));
  return ExitCode::Done;
}

}  // namespace

json read_parameters(const std::filesystem::path& path) {
  if (path.empty()) return json::object();
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path)) {
    throw SignalError(SignalFault::BadParameter, "parameters: cannot read " + path.string());
  }
  try {
    return json::parse(in);
  } catch (const json::exception& error) {  // no JSON, or a number beyond a double
    throw SignalError(SignalFault::BadParameter, path.string() + ": " + error.what());
  }
}

ExitCode rate(const RateRequest& request, OutputForm form) {
  const json overrides = read_parameters(request.parameters);
  if (!request.run.empty()) return rate_runs(request, overrides, form);
  const Pair pair = read_pair(request.files);
  return request.method == "cora" ? rate_cora(pair, overrides, form)
                                  : rate_iso18571(pair, overrides, form);
}

}  // namespace crosswalk::recording
