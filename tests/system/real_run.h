// Short runs of the first test scenario with the four programs as the user has them.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/source_folder.h"
#include "tests/system/launched.h"

namespace crosswalk::system_test {

// s; far beyond what anything here takes, also under sanitizers
#ifdef __SANITIZE_ADDRESS__
constexpr double kLong = 2400;
#else
constexpr double kLong = 300;
#endif

const std::filesystem::path kPrograms = build_folder() / "bin";
const std::filesystem::path kScenarios = source_folder() / "scenarios/tests";

/// Everything below the comment lines, which name the scenario.
std::string channels_of(const std::filesystem::path& run);
/// A text entry of the run's provenance.json.
std::string provenance_of(const std::filesystem::path& run, const std::string& key);

class RealRun : public testing::Test {
 protected:
  RealRun();
  Launched call(const std::string& program, std::vector<std::string> arguments,
                const std::string& name);
  /// `crosswalk run` of scenario(), into the folder out(name).
  Launched run(const std::string& name, std::vector<std::string> options);
  /// Runs to the end and expects success.
  void complete(const std::string& name, std::vector<std::string> options);
  std::filesystem::path out(const std::string& name) const { return folder_.path() / name; }
  /// v2370 on the coarse mesh by default; with tables laid over it after this call.
  void lay_over(const std::string& tables);
  const std::filesystem::path& scenario() const { return scenario_; }
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
  std::filesystem::path scenario_;
};

}  // namespace crosswalk::system_test
