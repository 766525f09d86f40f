// A multibody run in one process, without bus and coupler: for studies, tests and `mb_node solo`.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "mb_node/mb_config.h"
#include "mb_node/mb_node.h"

namespace crosswalk::mb {

/// Head and energies at one instant; displacements from t0, W axes.
struct SoloSample {
  double t = 0;  ///< s since the first contact of car and pedestrian
  Vec3 head_displacement = Vec3::Zero();
  Vec3 head_relative = Vec3::Zero();  ///< position of the head COG in the buck frame
  double head_relative_speed = 0;
  double head_acceleration = 0;
  double car_force = 0, head_force = 0, ground_force = 0;
  MbEnergies energies;
};

/// What the published bands speak of; SI, times from t0, NaN when it did not happen.
struct SoloSummary {
  double first_contact = 0;              ///< s since the start
  double head_contact = 0;               ///< s
  std::string head_component;            ///< part of the car it struck
  double wrap_around = 0;                ///< m
  double head_speed = 0, car_speed = 0;  ///< m/s at head contact, head relative to the car
  double head_angle = 0;                 ///< rad below the horizontal, in the car's frame
  double head_travel = 0;                ///< m along the car, from t0
  double head_drop = 0;                  ///< m
  double head_peak = 0;                  ///< m/s2, mean over 1 ms, before the road
  double road_contact = 0;               ///< s, head on the road
  double road_peak = 0;                  ///< m/s2, mean over 1 ms, from then on
  double throw_distance = 0;             ///< m, COG from its start to its last position, along y
  double rest_speed = 0;                 ///< m/s of the COG at the end
  MbEnergies energies;                   ///< at the end
  double energy_error = 0;               ///< of held against supplied, over the largest kinetic
  double stepping_error = 0;             ///< the part of steps and joint constraints
  double total_mass = 0;                 ///< kg
  double stature = 0;                    ///< m
  double wall = 0;                       ///< s
  std::vector<std::string> broken;       ///< bones and ligaments
};

struct SoloResult {
  SoloSummary summary;
  std::vector<SoloSample> samples;
  std::vector<std::pair<double, std::vector<Pose>>> poses;  ///< time since the start, every 1 ms
  std::string description;
};

inline constexpr double kHeadContactForce = 50;  ///< N: the head has struck car or road [E]

/// Runs for `duration` after the first contact, in windows of 20 us, or of the substep when longer.
SoloResult run_solo(const MbConfig& config, double duration);
/// Reads a scenario as a multibody-only run.
MbConfig read_solo_config(const std::filesystem::path& scenario);
MbConfig read_solo_config(ConfigDocument& document);

void write_samples_csv(const SoloResult& result, const std::filesystem::path& file);
/// Every law's book.
std::string energy_text(const MbEnergies& energies);
std::string summary_text(const SoloResult& result, const std::string& name);

}  // namespace crosswalk::mb
