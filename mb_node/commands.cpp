#include "mb_node/commands.h"

#include <cstdio>
#include <fstream>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mb_node/solo.h"
#include "mb_node/subject_report.h"

namespace crosswalk::mb {
namespace {

void write_poses(const SoloResult& result, const std::filesystem::path& file) {
  nlohmann::json frames = nlohmann::json::array();
  for (const auto& [t, poses] : result.poses) {
    nlohmann::json bodies = nlohmann::json::array();
    for (const Pose& X : poses) {
      bodies.push_back({X.p.x(), X.p.y(), X.p.z(), X.q.w(), X.q.x(), X.q.y(), X.q.z()});
    }
    frames.push_back({{"t_s", t}, {"X_WB", bodies}});
  }
  std::ofstream(file) << nlohmann::json{{"description", nlohmann::json::parse(result.description)},
                                        {"frames", frames}};
}

/// The published model's scaling to this subject, where it is kept beside the subjects.
PublishedScaling published_of(const BodyDescription& body, const std::filesystem::path& subject) {
  const std::filesystem::path file = subject.parent_path() / "../reference/scaled_models.csv";
  return std::filesystem::exists(file) ? read_published_scaling(file, body.name)
                                       : PublishedScaling{};
}

}  // namespace

NodeCommand solo_command() {
  return {"solo", "Run the multibody pedestrian alone, in this process.",
          [](CLI::App& options) -> std::function<ExitCode()> {
            struct Arguments {
              std::string scenario, csv, poses;
              double until_ms = 200;
            };
            auto args = std::make_shared<Arguments>();
            options.add_option("scenario", args->scenario, "scenario file")->required();
            options.add_option("--until-ms", args->until_ms,
                               "simulated ms after the first contact");
            options.add_option("--csv", args->csv, "write head motion, forces and energies here");
            options.add_option("--poses", args->poses, "write the poses of all bodies, as JSON");
            return [args] {
              const SoloResult result =
                  run_solo(read_solo_config(args->scenario), 1e-3 * args->until_ms);
              fmt::print("{}", summary_text(result, args->scenario));
              if (!args->csv.empty()) write_samples_csv(result, args->csv);
              if (!args->poses.empty()) write_poses(result, args->poses);
              return ExitCode::Done;
            };
          }};
}

NodeCommand subject_command() {
  return {"subject", "Print what became of a subject's measures: bodies, masses, differences.",
          [](CLI::App& options) -> std::function<ExitCode()> {
            auto file = std::make_shared<std::string>();
            options.add_option("subject", *file, "subject file")->required();
            return [file] {
              ConfigDocument document(*file);
              const BodyDescription body = read_body_description(document.root());
              document.finish();
              fmt::print("{}", subject_report(body, published_of(body, *file)));
              return ExitCode::Done;
            };
          }};
}

}  // namespace crosswalk::mb
