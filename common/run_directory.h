// The folder of one run: where each file stands, and the record of how it was made.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace crosswalk {

class RunDirectory {
 public:
  explicit RunDirectory(std::filesystem::path root) : root_(std::move(root)) {}
  const std::filesystem::path& root() const { return root_; }
  std::filesystem::path scenario() const { return root_ / "scenario.toml"; }  ///< merged
  std::filesystem::path provenance() const { return root_ / "provenance.json"; }
  std::filesystem::path log(std::string_view node) const {
    return root_ / "logs" / (std::string(node) + ".log");
  }
  std::filesystem::path signals() const { return root_ / "signals.lcmlog"; }  ///< LCM event log
  std::filesystem::path channels() const { return root_ / "channels.csv"; }
  std::filesystem::path summary() const { return root_ / "summary.json"; }
  std::filesystem::path summary_text() const { return root_ / "summary.txt"; }  ///< the table
  std::filesystem::path report() const { return root_ / "report.html"; }
  std::filesystem::path model() const { return root_ / "model"; }               ///< generated decks
  std::filesystem::path fields() const { return root_ / "fields"; }             ///< VTU and PVD
  std::filesystem::path checkpoints() const { return root_ / "checkpoints"; }
  /// Makes the folder and logs/; throws UserError when it cannot.
  void create() const;

 private:
  std::filesystem::path root_;
};

/// What produced a run: version, libraries, machine, command and scenario digest, one JSON object.
/// Written once per run folder; a file that is already there is kept.
void write_provenance(const RunDirectory& directory, const std::string& run_id,
                      std::uint64_t scenario_digest, const std::vector<std::string>& command);

}  // namespace crosswalk
