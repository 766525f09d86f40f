#include "common/run_directory.h"

#include <array>
#include <ctime>
#include <fstream>
#include <thread>

#include <Eigen/Core>
#include <fmt/format.h>
#include <lcm/lcm.h>
#include <nlohmann/json.hpp>
#include <spdlog/version.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "common/error.h"
#include "common/protocol.h"
#include "common/version.h"

namespace crosswalk {

namespace {

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string local_time() {
  const std::time_t now = std::time(nullptr);
  std::tm calendar{};
  localtime_r(&now, &calendar);
  std::array<char, 40> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S%z", &calendar);
  return text.data();
}

}  // namespace

void RunDirectory::create() const {
  std::error_code error;
  std::filesystem::create_directories(root_ / "logs", error);
  if (error)
    throw UserError(Problem{Place{root_.string()}, "run folder", "a folder that can be written",
                            error.message(), "choose another with --out"});
}

void write_provenance(const RunDirectory& directory, const std::string& run_id,
                      std::uint64_t scenario_digest, const std::vector<std::string>& command) {
  if (std::filesystem::exists(directory.provenance())) return;
  utsname system{};
  uname(&system);
  nlohmann::ordered_json json;
  json["crosswalk"] = version_text();
  json["protocol"] = kProtocolVersion;
  json["run_id"] = run_id;
  json["scenario_digest"] = fmt::format("{:016x}", scenario_digest);
  json["command"] = command;
  json["started"] = local_time();
  json["host"] = system.nodename;
  json["system"] = fmt::format("{} {} {}", system.sysname, system.release, system.machine);
  json["processor"] = processor_name();
  json["logical_processors"] = std::thread::hardware_concurrency();
  json["compiler"] = __VERSION__;
  json["libraries"] = {
      {"lcm", fmt::format("{}.{}.{}", LCM_MAJOR_VERSION, LCM_MINOR_VERSION, LCM_MICRO_VERSION)},
      {"eigen",
       fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"spdlog", fmt::format("{}.{}.{}", SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH)},
      {"fmt", fmt::format("{}", FMT_VERSION)}};
  std::ofstream(directory.provenance()) << json.dump(2) << '\n';
}

}  // namespace crosswalk
