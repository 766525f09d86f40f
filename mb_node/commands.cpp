#include "mb_node/commands.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mb_node/solo.h"

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

std::string subject_report(const BodyDescription& body) {
  const Anthropometry got = measured_on(body);
  std::string text =
      fmt::format("Subject {}\n\n   measure{:26}asked   obtained  difference\n", body.name, "");
  for (const Measure& m : anthropometry_measures()) {
    const bool is_mass = m.kind == MeasureKind::Mass;
    const double unit = is_mass ? 1 : 1e3;
    const double asked = unit * body.measures.*m.value, obtained = unit * got.*m.value;
    if (obtained == 0) {  // not on this body
      text += fmt::format("{:3} {:28}{:9.1f}          -           -\n", m.number, m.name, asked);
      continue;
    }
    text += fmt::format("{:3} {:28}{:9.1f}  {:9.1f}  {:+9.1f}  {:+6.1f} %\n", m.number, m.name,
                        asked, obtained, obtained - asked, 100 * (obtained / asked - 1));
  }
  text +=
      "   (kg for the mass, else mm; obtained: taken back from the model's joints and "
      "ellipsoids)\n\n";
  text +=
      "Height reconciliation\n   equation                                   residual mm   sigma "
      "mm\n";
  for (const HeightResidual& r : body.height_residuals) {
    text += fmt::format("   {:44}{:+9.1f}  {:9.1f}\n", r.equation, 1e3 * r.residual, 1e3 * r.sigma);
  }
  text +=
      "\nBodies\n   name              mass kg   COM x, y, z mm            Ixx, Iyy, Izz 1e-4 kg "
      "m2\n";
  for (const Segment& s : body.segments) {
    text += fmt::format("   {:16}{:9.4f}{:9.1f}{:8.1f}{:8.1f}{:11.2f}{:9.2f}{:9.2f}\n", s.name,
                        s.mass, 1e3 * s.com.x(), 1e3 * s.com.y(), 1e3 * s.com.z(),
                        1e4 * s.inertia(0, 0), 1e4 * s.inertia(1, 1), 1e4 * s.inertia(2, 2));
  }
  return text + fmt::format("   total {:19.4f}\n", body.total_mass());
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
              fmt::print("{}", subject_report(body));
              return ExitCode::Done;
            };
          }};
}

}  // namespace crosswalk::mb
