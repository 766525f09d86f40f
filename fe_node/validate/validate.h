// Component tests of the generated models against experiments and closed forms, on demand.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fe_node/generate/head_neck.h"
#include "fe_node/validate/computing.h"
#include "fe_node/validate/measure.h"

namespace crosswalk::fe::validate {

struct CaseContext {
  generate::Fidelity fidelity = generate::Fidelity::Coarse;
  Computing computing;
  std::filesystem::path folder;  ///< of this case: its deck, plots
};

struct Case {
  std::string subject;  ///< head, neck, windshield
  std::string name;
  std::string purpose;
  std::function<CaseResult(const CaseContext&)> run;
};

/// All cases, closed forms first.
std::vector<Case> cases();

struct ValidateRequest {
  std::string subject;             ///< head, neck, windshield
  std::vector<std::string> names;  ///< of cases; empty: all of the subject
  generate::Fidelity fidelity = generate::Fidelity::Coarse;
  Computing computing;
  std::filesystem::path folder;
};

/// Runs the cases, prints each table as it is ready and writes everything into the folder. Returns
/// the number of closed forms missed.
int run_validation(const ValidateRequest& request);

// The cases, by file.
CaseResult sphere_torsion(const CaseContext& context);
CaseResult sphere_pressure(const CaseContext& context);
CaseResult hardy_rotation(const CaseContext& context);
CaseResult rotation_pulses(const CaseContext& context);
CaseResult nahum_37(const CaseContext& context);
CaseResult trosseille_428(const CaseContext& context);
CaseResult head_drops(const CaseContext& context);
CaseResult skull_stiffness(const CaseContext& context);
CaseResult mesh_refinement(const CaseContext& context);
CaseResult neck_levels(const CaseContext& context);
CaseResult neck_bending(const CaseContext& context);
CaseResult neck_ranges(const CaseContext& context);
CaseResult neck_lateral(const CaseContext& context);
CaseResult neck_frontal(const CaseContext& context);
CaseResult plate_impedance(const CaseContext& context);
CaseResult headform_drop(const CaseContext& context);
CaseResult headform_panel(const CaseContext& context);
CaseResult headform_laminated(const CaseContext& context);

}  // namespace crosswalk::fe::validate
