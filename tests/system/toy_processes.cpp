#include "tests/system/toy_processes.h"

#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "common/checkpoint.h"
#include "tests/source_folder.h"

namespace crosswalk::system_test {
namespace {

namespace fs = std::filesystem;

constexpr double kLong = 300;       // s; far beyond what a run takes
constexpr std::size_t kAtOnce = 4;  // runs: while some start or end, others compute

void write_scenario(const fs::path& file, const ToyScenario& s) {
  const double window_us = 1e-3 * static_cast<double>(s.window_ns);
  // The run ends its duration after the contact, which the toys report in their first window.
  std::ofstream(file) << fmt::format(
      "[run]\nname = \"toy\"\nduration_us = {}\n[coupling]\nwindow_us = {}\n"
      "checkpoint_every_us = {}\ndrift_stop = 10.0\n{}",
      window_us * (s.windows - 1), window_us,
      window_us * (s.checkpoint_every > 0 ? s.checkpoint_every : s.windows), s.tables);
}

/// For a coupler that only reads its state.
struct NoMb : coupling::MbLink {
  MbReply advance(const MbGrant&) override { return {}; }
};

}  // namespace

ToyProcesses::ToyProcesses(const fs::path& folder, ToyScenario scenario, bool resume)
    : folder_(folder), scenario_(std::move(scenario)) {
  fs::create_directories(folder);
  write_scenario(folder / "toy.toml", scenario_);
  const std::string run_id = fmt::format("{}-{}", folder.filename().string(), getpid());
  for (const char* name : {"recorder", "mb_node", "fe_node", "coupler"}) {
    std::vector<std::string> arguments = {"run",   "--scenario",    (folder / "toy.toml").string(),
                                          "--out", folder.string(), "--run-id",
                                          run_id,  "--wait-s",      "60"};
    if (resume) arguments.push_back("--resume");
    programs_.emplace_back(build_folder() / "toy_bin" / name, arguments,
                           folder / (std::string(name) + ".txt"));
  }
}

ToyOutcome ToyProcesses::outcome() {
  for (Launched& program : programs_) {
    const auto status = program.wait(kLong);
    if (!status || !status->is_success()) {
      ADD_FAILURE() << folder_ << ":\n" << program.output();
      return {};
    }
  }
  const fs::path checkpoints = folder_ / "checkpoints";
  EXPECT_EQ(latest_checkpoint(checkpoints), scenario_.windows);
  ToyOutcome outcome;
  outcome.mb = read_part(checkpoints, Role::Mb, scenario_.windows).state;
  outcome.fe = read_part(checkpoints, Role::Fe, scenario_.windows).state;
  const CheckpointPart own = read_part(checkpoints, Role::Coupler, scenario_.windows);
  ByteReader in(own.state);  // as coupler/coupler_part.cpp writes it
  in.take<std::int64_t>();
  in.take<int>();
  in.take<std::int64_t>();
  NoMb nobody;
  coupling::Coupler coupler({}, nobody, nullptr, nullptr, {});
  coupler.load(in);
  outcome.coupling = coupler.state();
  outcome.books = coupler.audit().books();
  return outcome;
}

std::vector<ToyOutcome> run_toys(const fs::path& folder,
                                 const std::vector<ToyScenario>& scenarios) {
  std::vector<ToyProcesses> runs;
  std::vector<ToyOutcome> outcomes;
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    if (i >= kAtOnce) outcomes.push_back(runs[i - kAtOnce].outcome());
    runs.emplace_back(folder / fmt::format("run{}", i), scenarios[i]);
  }
  while (outcomes.size() < runs.size()) outcomes.push_back(runs[outcomes.size()].outcome());
  return outcomes;
}

}  // namespace crosswalk::system_test
