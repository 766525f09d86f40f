// The tables every process reads alike: [run], [nodes] and [[interfaces]]; and who owns the others.
//
// The launcher lays its options over the user's file and writes the merged result to the run
// folder; every process of the run reads that one file, so equal digests mean equal runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/config.h"

namespace crosswalk {

enum class RunMode {
  Coupled,     ///< finite-element head and neck on the multibody pedestrian
  Multibody,   ///< the pedestrian alone
  Prescribed,  ///< a head alone whose skull follows the head of another run
  ImpactOnly   ///< a head alone, thrown at the car as the head of another run was
};
enum class Fidelity { Coarse, Medium, Fine };
std::string_view name_of(RunMode mode);
std::string_view name_of(Fidelity fidelity);

/// One body through which the two sides act on each other.
struct InterfaceSpec {
  std::string body;  ///< of the multibody side, which gives its motion
  std::string
      part;  ///< of the finite-element side, which returns a wrench; the body's name by default
  bool is_attached = true;  ///< carries finite-element nodes; false: a rigid contact partner only
  Place place;
};

/// Where a node runs when not on this machine.
struct NodeSpec {
  std::string name;  ///< "mb_node", "fe_node", "coupler" or "recorder"
  std::string host;  ///< empty: this machine
  Place place;
};

struct Scenario {
  std::string name;
  RunMode mode = RunMode::Coupled;
  Fidelity fidelity = Fidelity::Coarse;
  double duration_s = 0;         ///< simulated, from the first contact of car and pedestrian
  std::filesystem::path motion;  ///< of head and car, for a head alone (recorder/export_motion.h)
  std::vector<InterfaceSpec> interfaces;  ///< attached ones first; empty in multibody mode
  std::vector<NodeSpec> nodes;
  std::uint64_t digest = 0;  ///< of the merged document

  bool has_fe() const { return mode != RunMode::Multibody; }
  bool has_head_alone() const { return mode == RunMode::Prescribed || mode == RunMode::ImpactOnly; }
  std::int64_t duration_ns() const;
};

/// Reads the shared tables; problems are gathered in the document.
Scenario read_scenario(ConfigDocument& document);
/// Tells the document which top-level tables `program` does not read, so that only its own are
/// checked for unknown keys.
void ignore_tables_of_others(ConfigDocument& document, std::string_view program);
/// The top-level tables a program owns, for example {"coupling"} for "coupler".
std::vector<std::string> owned_tables(std::string_view program);

}  // namespace crosswalk
