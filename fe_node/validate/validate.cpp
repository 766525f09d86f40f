#include "fe_node/validate/validate.h"

#include <algorithm>
#include <iostream>

#include <fmt/format.h>

#include "common/error.h"
#include "fe_node/validate/report.h"

namespace crosswalk::fe::validate {

std::vector<Case> cases() {
  return {
      {"head", "sphere_torsion", "closed form: viscoelastic ball in an oscillating shell",
       sphere_torsion},
      {"head", "sphere_pressure", "closed form: pressure in an accelerated ball", sphere_pressure},
      {"head", "hardy_rotation", "brain against skull in sagittal rotation", hardy_rotation},
      {"head", "rotation_pulses", "brain strain in rotations, against DAMAGE", rotation_pulses},
      {"head", "nahum_37", "pressure in the brain under a frontal blow", nahum_37},
      {"head", "trosseille_428", "pressure under a long blow to the face", trosseille_428},
      {"head", "skull_stiffness", "rigid hemisphere pressed into the skull", skull_stiffness},
      {"head", "head_drops", "acceleration against drop height", head_drops},
      {"head", "mesh_refinement", "one drop at growing fineness", mesh_refinement},
      {"neck", "neck_ranges", "angles of each level at 1 N m", neck_ranges},
      {"neck", "neck_levels", "moment and angle of each level", neck_levels},
      {"neck", "neck_bending", "moment and angle of the whole neck", neck_bending},
      {"neck", "neck_lateral", "lateral sled of 7 g", neck_lateral},
      {"neck", "neck_frontal", "frontal sled of 15 g", neck_frontal},
      {"windshield", "plate_impedance", "closed form: mass on a plate", plate_impedance},
      {"windshield", "headform_drop", "headform on its certification plate", headform_drop},
      {"windshield", "headform_panel", "headform at 35 and 40 km/h, steel panel", headform_panel},
      {"windshield", "headform_laminated", "the same, laminated glass", headform_laminated},
  };
}

namespace {

std::vector<Case> chosen(const ValidateRequest& request) {
  std::vector<Case> all = cases(), out;
  std::vector<std::string> names;
  for (const Case& c : all)
    if (c.subject == request.subject) names.push_back(c.name);
  for (const std::string& name : request.names)
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      std::string known;
      for (const std::string& n : names) known += (known.empty() ? "" : ", ") + n;
      throw UserError(
          Problem{{}, "case `" + name + "` of " + request.subject, known, "an unknown case", {}});
    }
  for (const Case& c : all) {
    const bool is_wanted =
        request.names.empty() ||
        std::find(request.names.begin(), request.names.end(), c.name) != request.names.end();
    if (c.subject == request.subject && is_wanted) out.push_back(c);
  }
  return out;
}

}  // namespace

int run_validation(const ValidateRequest& request) {
  std::vector<CaseResult> results;
  for (const Case& c : chosen(request)) {
    const std::filesystem::path folder = request.folder / c.name;
    std::filesystem::create_directories(folder);
    results.push_back(c.run({request.fidelity, request.computing, folder}));
    std::cout << table_text(results.back()) << std::flush;
  }
  for (const std::string& remark : write_results(results, request.folder))
    std::cout << remark << '\n';
  const int failed = failed_gates(results);
  fmt::print("\nresults: {}; closed forms missed: {}\n",
             (request.folder / "validation.csv").string(), failed);
  return failed;
}

}  // namespace crosswalk::fe::validate
