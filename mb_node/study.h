// Studies: many multibody runs and one table.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/node_main.h"
#include "mb_node/solo.h"

namespace crosswalk::mb {

/// A published or estimated range of one quantity of one case.
struct Band {
  std::string vehicle, speed, quantity;  ///< "*" is any
  double min = 0, max = 0;
  std::string tag, source;
};

std::vector<Band> read_bands(const std::filesystem::path& file);
/// The most specific band of a quantity: vehicle and speed before "*"; null when there is none.
const Band* find_band(const std::vector<Band>& bands, const std::string& vehicle, int speed_km_h,
                      const std::string& quantity);

struct StudyCase {
  std::string name;     ///< subject and stance
  std::string vehicle;  ///< file stem under scenarios/vehicles
  int speed_km_h = 40;
  std::string toml;     ///< the scenario
  double duration = 0;  ///< s after first contact
};

/// The three cadaver tests and every car front at 20 to 60 km/h with the walking 50th-percentile
/// male.
std::vector<StudyCase> kinematics_cases(const std::filesystem::path& scenarios);
SoloSummary run_case(const StudyCase& study_case, const std::filesystem::path& scenarios);
std::string kinematics_row(const StudyCase& study_case, const SoloSummary& s,
                           const std::vector<Band>& bands);

/// V2370 by every stepper over the substep.
std::vector<StudyCase> convergence_cases();
std::string convergence_row(const StudyCase& study_case, const SoloSummary& s);

/// `scenarios/` beside or above the working folder or the program.
std::filesystem::path find_scenarios();

NodeCommand study_command();

}  // namespace crosswalk::mb
