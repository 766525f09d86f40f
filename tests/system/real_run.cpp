#include "tests/system/real_run.h"

#include <fstream>

#include <gmock/gmock.h>

namespace crosswalk::system_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string channels_of(const fs::path& run) {
  const std::string text = text_of(run / "channels.csv");
  std::size_t begin = 0;
  while (begin < text.size() && text[begin] == '#') begin = text.find('\n', begin) + 1;
  return text.substr(begin);
}

std::string provenance_of(const fs::path& run, const std::string& key) {
  const std::string text = text_of(run / "provenance.json");
  const std::size_t begin = text.find("\"" + key + "\": \"") + key.size() + 5;
  return text.substr(begin, text.find('"', begin) - begin);
}

RealRun::RealRun() : scenario_(folder_.path() / "coarse.toml") {
  std::ofstream(scenario_) << "base = \"" << (kScenarios / "v2370.toml").string()
                           << "\"\n[run]\nfidelity = \"coarse\"\n";
}

Launched RealRun::call(const std::string& program, std::vector<std::string> arguments,
                       const std::string& name) {
  return Launched(kPrograms / program, std::move(arguments), folder_.path() / (name + ".txt"));
}

Launched RealRun::run(const std::string& name, std::vector<std::string> options) {
  std::vector<std::string> arguments = {"run", scenario_.string(), "--out", out(name).string()};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return call("crosswalk", arguments, name);
}

void RealRun::complete(const std::string& name, std::vector<std::string> options) {
  Launched launched = run(name, std::move(options));
  const auto status = launched.wait(kLong);
  ASSERT_TRUE(status) << "still running:\n" << launched.output();
  ASSERT_TRUE(status->is_success()) << launched.output();
  EXPECT_THAT(launched.output(), HasSubstr("results: " + out(name).string()));
  for (const char* file : {"scenario.toml", "provenance.json", "signals.lcmlog", "channels.csv",
                           "summary.json", "summary.txt", "logs/coupler.log"})
    EXPECT_TRUE(fs::exists(out(name) / file)) << file;
}

void RealRun::lay_over(const std::string& tables) {
  const fs::path file = folder_.path() / "scenario.toml";
  std::ofstream(file) << "base = \"" << scenario_.string() << "\"\n" << tables;
  scenario_ = file;
}

}  // namespace crosswalk::system_test
