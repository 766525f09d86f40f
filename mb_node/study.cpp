#include "mb_node/study.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/error.h"
#include "common/units.h"

namespace crosswalk::mb {
namespace {

namespace fs = std::filesystem;

// Fast settings: to all printed digits those of the direct stepper at 10 us (docs/multibody.md).
constexpr const char* kFast = "[multibody]\nstepper = \"quick\"\nsubstep_us = 20.0\n";
constexpr const char* kCars[] = {"generic_sedan_buck", "family_car", "roadster", "mpv", "suv",
                                 "flat_front_van"};
constexpr double kDurationAt40 = 0.24;  // s; longer for slower cars

std::string cell(double value, int digits, const Band* band) {
  if (std::isnan(value)) return fmt::format("{:>21}", "-");
  const std::string shown = fmt::format("{:.{}f}", value, digits);
  if (band == nullptr) return fmt::format("{:>8} {:12}", shown, "");
  const bool is_inside = value >= band->min && value <= band->max;
  return fmt::format("{:>8} {:12}", shown,
                     fmt::format("{}{}..{}", is_inside ? "in " : "OUT ", band->min, band->max));
}

using Filter = std::function<bool(const StudyCase&)>;

void print_kinematics(const fs::path& scenarios, const Filter& is_wanted) {
  const std::vector<Band> bands = read_bands(scenarios / "reference/kinematics_bands.csv");
  fmt::print("{:16} {:19}{:>4}  {:21}{:21}{:21}{:21}{:21}{:21}{:21}{:21}  {}\n", "subject", "car",
             "km/h", "head contact ms", "WAD mm", "WAD / stature", "speed / car speed", "angle deg",
             "travel mm", "drop mm", "peak g", "struck");
  for (const StudyCase& c : kinematics_cases(scenarios)) {
    if (!is_wanted(c)) continue;
    fmt::print("{}", kinematics_row(c, run_case(c, scenarios), bands));
    std::fflush(stdout);
  }
  fmt::print(
      "Car fronts, contact curves and bands marked E or L are estimates or recollections: see "
      "scenarios/reference/kinematics_bands.csv.\n");
}

void print_convergence(const fs::path& scenarios, const Filter& is_wanted) {
  fmt::print("{:14}{:>14}{:>10}{:>14}{:>10}{:>14}{:>14}{:>10}\n", "stepper, step", "contact ms",
             "WAD mm", "speed m/s", "peak g", "balance %", "steps %", "wall s");
  for (const StudyCase& c : convergence_cases()) {
    if (!is_wanted(c)) continue;
    fmt::print("{}", convergence_row(c, run_case(c, scenarios)));
    std::fflush(stdout);
  }
}

}  // namespace

std::vector<Band> read_bands(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw UserError({{}, "bands", "a readable file", file.string(), ""});
  std::vector<Band> bands;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#' || line.rfind("vehicle,", 0) == 0) continue;
    std::istringstream cells(line);
    std::string min, max;
    Band b;
    std::getline(cells, b.vehicle, ',');
    std::getline(cells, b.speed, ',');
    std::getline(cells, b.quantity, ',');
    std::getline(cells, min, ',');
    std::getline(cells, max, ',');
    std::getline(cells, b.tag, ',');
    std::getline(cells, b.source);
    b.min = std::stod(min);
    b.max = std::stod(max);
    bands.push_back(b);
  }
  return bands;
}

const Band* find_band(const std::vector<Band>& bands, const std::string& vehicle, int speed_km_h,
                      const std::string& quantity) {
  const Band* best = nullptr;
  int best_rank = -1;
  for (const Band& b : bands) {
    const bool any_car = b.vehicle == "*", any_speed = b.speed == "*";
    if (b.quantity != quantity || (!any_car && b.vehicle != vehicle) ||
        (!any_speed && std::stoi(b.speed) != speed_km_h)) {
      continue;
    }
    const int rank = (any_car ? 0 : 2) + (any_speed ? 0 : 1);
    if (rank > best_rank) {
      best_rank = rank;
      best = &b;
    }
  }
  return best;
}

std::vector<StudyCase> kinematics_cases(const fs::path& scenarios) {
  std::vector<StudyCase> cases;
  const auto tests = scenarios / "tests";
  for (const char* test : {"v2370", "v2371", "v2374"}) {
    cases.push_back(
        {test, "generic_sedan_buck", 40, fmt::format("base = \"{}.toml\"\n{}", test, kFast), 0.2});
  }
  for (const char* car : kCars) {
    for (const int speed : {20, 30, 40, 50, 60}) {
      cases.push_back({"male_50 walking", car, speed,
                       fmt::format("base = \"walking_40.toml\"\n[vehicle]\nbase = "
                                   "\"../vehicles/{}.toml\"\nspeed_km_h = {}\n{}",
                                   car, speed, kFast),
                       kDurationAt40 * 40 / speed});
    }
  }
  return cases;
}

SoloSummary run_case(const StudyCase& study_case, const fs::path& scenarios) {
  ConfigDocument document =
      ConfigDocument::from_text(study_case.toml, study_case.name, scenarios / "tests");
  return run_solo(read_solo_config(document), study_case.duration).summary;
}

std::string kinematics_row(const StudyCase& c, const SoloSummary& s,
                           const std::vector<Band>& bands) {
  const auto band = [&](const char* quantity) {
    return find_band(bands, c.vehicle, c.speed_km_h, quantity);
  };
  return fmt::format("{:16} {:19}{:4}  {}{}{}{}{}{}{}{}  {}\n", c.name, c.vehicle, c.speed_km_h,
                     cell(1e3 * s.head_contact, 1, band("head_contact_ms")),
                     cell(1e3 * s.wrap_around, 0, band("wad_mm")),
                     cell(s.wrap_around / s.stature, 3, band("wad_per_stature")),
                     cell(s.head_speed / s.car_speed, 2, band("speed_ratio")),
                     cell(s.head_angle / kDegree, 0, band("angle_deg")),
                     cell(1e3 * s.head_travel, 0, band("travel_mm")),
                     cell(1e3 * s.head_drop, 0, band("drop_mm")),
                     cell(s.head_peak / kStandardGravity, 0, band("peak_g")), s.head_component);
}

std::vector<StudyCase> convergence_cases() {
  std::vector<StudyCase> cases;
  for (const char* stepper : {"direct", "quick"}) {
    for (const double substep_us : {5.0, 10.0, 20.0, 50.0, 100.0}) {
      const std::string name = fmt::format("{} {:g} us", stepper, substep_us);
      cases.push_back({name, "generic_sedan_buck", 40,
                       fmt::format("base = \"v2370.toml\"\n[multibody]\nstepper = \"{}\"\n"
                                   "substep_us = {:.1f}\n",
                                   stepper, substep_us),
                       0.2});
    }
  }
  return cases;
}

std::string convergence_row(const StudyCase& c, const SoloSummary& s) {
  return fmt::format("{:14}{:14.3f}{:10.2f}{:14.4f}{:10.2f}{:14.4f}{:14.4f}{:10.1f}\n", c.name,
                     1e3 * s.head_contact, 1e3 * s.wrap_around, s.head_speed,
                     s.head_peak / kStandardGravity, 100 * s.energy_error, 100 * s.stepping_error,
                     s.wall);
}

fs::path find_scenarios() {
  std::error_code ignored;
  for (fs::path start :
       {fs::current_path(), fs::canonical("/proc/self/exe", ignored).parent_path()}) {
    for (; !start.empty(); start = start.parent_path()) {
      if (fs::is_directory(start / "scenarios/tests", ignored)) return start / "scenarios";
      if (start == start.root_path()) break;
    }
  }
  throw UserError({{},
                   "--scenarios",
                   "a folder with tests/, subjects/ and vehicles/",
                   "none above the working folder or the program",
                   "give it: --scenarios DIR"});
}

NodeCommand study_command() {
  return {"study", "Run many multibody cases and print their table.",
          [](CLI::App& options) -> std::function<ExitCode()> {
            struct Arguments {
              std::string what = "kinematics", scenarios, only;
            };
            auto args = std::make_shared<Arguments>();
            options
                .add_option("what", args->what,
                            "kinematics: tests and cars beside published bands; convergence: V2370 "
                            "over the time step")
                ->check(CLI::IsMember({"kinematics", "convergence"}));
            options.add_option("--scenarios", args->scenarios, "folder of the scenario files");
            options.add_option("--only", args->only, "only cases whose car or name contains this");
            return [args] {
              const fs::path scenarios =
                  args->scenarios.empty() ? find_scenarios() : fs::path(args->scenarios);
              const auto is_wanted = [&](const StudyCase& c) {
                return args->only.empty() || c.vehicle.find(args->only) != std::string::npos ||
                       c.name.find(args->only) != std::string::npos;
              };
              if (args->what == "kinematics") {
                print_kinematics(scenarios, is_wanted);
              } else {
                print_convergence(scenarios, is_wanted);
              }
              return ExitCode::Done;
            };
          }};
}

}  // namespace crosswalk::mb
