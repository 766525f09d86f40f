#include "common/scenario.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace crosswalk {

namespace {

struct Owner {
  std::string_view table;
  std::string_view program;
};

constexpr std::array kOwners = {
    Owner{"subject", "mb_node"},   Owner{"posture", "mb_node"},     Owner{"vehicle", "mb_node"},
    Owner{"multibody", "mb_node"}, Owner{"environment", "mb_node"}, Owner{"fe", "fe_node"},
    Owner{"head_neck", "fe_node"}, Owner{"windshield", "fe_node"},  Owner{"output", "fe_node"},
    Owner{"coupling", "coupler"},  Owner{"recorder", "recorder"}};

constexpr std::array<const char*, 4> kModes = {"coupled", "multibody", "prescribed", "impact_only"};

constexpr std::array kNodes = {"mb_node", "fe_node", "coupler", "recorder"};

std::vector<InterfaceSpec> read_interfaces(ConfigTable root) {
  std::vector<InterfaceSpec> interfaces;
  for (ConfigTable& table : root.tables("interfaces",
                                        "One body through which the two sides act on "
                                        "each other.")) {
    InterfaceSpec spec;
    spec.body = table.text("body", "Body of the multibody side; it gives the motion.");
    spec.part = table.text_or("part", spec.body,
                              "Part of the finite-element side that follows the body and returns "
                              "the wrench; the body's name by default.");
    spec.is_attached = table.flag_or("attached", true,
                                     "Finite-element nodes are tied to the body; false: the body "
                                     "is only a rigid contact partner.");
    spec.place = table.place("body");
    const bool is_again = std::any_of(interfaces.begin(), interfaces.end(),
                                      [&](const auto& other) { return other.body == spec.body; });
    if (is_again) table.problem("body", "every body once", fmt::format("\"{}\" again", spec.body));
    interfaces.push_back(std::move(spec));
  }
  std::stable_partition(interfaces.begin(), interfaces.end(),
                        [](const InterfaceSpec& spec) { return spec.is_attached; });
  return interfaces;
}

std::vector<NodeSpec> read_nodes(ConfigTable root) {
  ConfigTable table = root.table("nodes", "Where the processes run when not all on this machine.");
  std::vector<NodeSpec> nodes;
  for (const char* name : kNodes)
    nodes.push_back(
        {name,
         table.text_or(name, "", "Host of this process, as ssh knows it; this machine by default."),
         table.place(name)});
  return nodes;
}

}  // namespace

std::string_view name_of(RunMode mode) { return kModes[static_cast<std::size_t>(mode)]; }

std::string_view name_of(Fidelity fidelity) {
  constexpr std::array<std::string_view, 3> names = {"coarse", "medium", "fine"};
  return names[static_cast<std::size_t>(fidelity)];
}

std::int64_t Scenario::duration_ns() const { return std::llround(duration_s * 1e9); }

Scenario read_scenario(ConfigDocument& document) {
  ConfigTable root = document.root();
  Scenario scenario;
  ConfigTable run = root.table("run", "The run as a whole.");
  scenario.name = run.text("name", "Name of the run, part of the run folder's name.");
  scenario.duration_s =
      run.quantity("duration", Dimension::Time, {1e-6, 10.0},
                   "Simulated time, counted from the first contact of car and pedestrian.");
  const std::string mode = run.choice_or(
      "mode", {kModes.begin(), kModes.end()}, "coupled",
      "coupled: finite-element head and neck on the multibody pedestrian; multibody: the "
      "pedestrian alone; prescribed: a finite-element head alone whose skull follows the head of "
      "another run; "
      "impact_only: one thrown at the car as the head of another run was.");
  scenario.mode =
      static_cast<RunMode>(std::find(kModes.begin(), kModes.end(), mode) - kModes.begin());
  scenario.motion = run.text_or("motion", "",
                                "File with the motion of head and car for a head alone, as "
                                "`crosswalk export RUN --format motion` writes it.");
  if (scenario.has_head_alone() && scenario.motion.empty())
    run.problem("motion", fmt::format("a file in mode \"{}\"", mode), "none",
                "`crosswalk run SCENARIO --mode prescribed --from RUN` makes it");
  const std::vector<std::string> fidelities = {"coarse", "medium", "fine"};
  const std::string fidelity =
      run.choice_or("fidelity", fidelities, "coarse", "Size of the generated finite-element mesh.");
  scenario.fidelity = static_cast<Fidelity>(
      std::find(fidelities.begin(), fidelities.end(), fidelity) - fidelities.begin());
  scenario.interfaces = read_interfaces(root);
  if (scenario.mode == RunMode::Prescribed)
    scenario.interfaces = {{"head", "head", true, {}}};
  else if (scenario.mode == RunMode::ImpactOnly)
    scenario.interfaces = {{"head", "head", false, {}}, {"buck", "buck", false, {}}};
  else if (!scenario.has_fe())
    scenario.interfaces.clear();
  else if (scenario.interfaces.empty() || !scenario.interfaces.front().is_attached)
    run.problem("mode", "at least one attached [[interfaces]] in mode \"coupled\"", "none",
                "write `mode = \"multibody\"` for the pedestrian alone");
  scenario.nodes = read_nodes(root);
  scenario.digest = document.digest();
  return scenario;
}

void ignore_tables_of_others(ConfigDocument& document, std::string_view program) {
  std::vector<std::string> others;
  for (const Owner& owner : kOwners)
    if (owner.program != program) others.emplace_back(owner.table);
  document.ignore_tables(others);
}

std::vector<std::string> owned_tables(std::string_view program) {
  std::vector<std::string> tables;
  for (const Owner& owner : kOwners)
    if (owner.program == program) tables.emplace_back(owner.table);
  return tables;
}

}  // namespace crosswalk
