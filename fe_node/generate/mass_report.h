// Mass, centre and inertia of groups of parts, and the trim that brings the head to a target.
//
// Trim [E]: a head too heavy loses face density (down to 1150 kg/m3), then mass is spread over
// patches of skull nodes at both ends of the three axes through the head's centre, as much as mass
// and moments ask for; masses never go below zero. What the target leaves open or cannot reach is
// reported.
#pragma once

#include <string>
#include <vector>

#include "fe_node/generate/part_spec.h"

namespace crosswalk::fe::generate {

enum class MassPreset {
  Untrimmed,   ///< as the densities give it
  Literature,  ///< 4.3 kg; 0.0200, 0.0220, 0.0150 kg m2 at the reference size
  SeedA1,      ///< moments of the THUMS head-neck [yu2020, Table A1], total 5.66 kg
  Measured     ///< given numbers
};

struct MassTarget {
  MassPreset preset = MassPreset::Literature;
  double head_mass = 0;              ///< kg, Measured
  Vec3 head_moments = Vec3::Zero();  ///< kg m2 about the head's centre, Measured
};

struct MassRow {
  std::string name;
  Inertia inertia;  ///< about its own centre, frame N
};

struct MassReport {
  std::vector<MassRow> rows;  ///< head, neck, blocks, assembly
  double target_mass = 0;     ///< of the head; 0: none
  Vec3 target_moments = Vec3::Zero();
  double face_density = 0;   ///< kg/m3, after trim
  double flesh_density = 0;  ///< kg/m3
  double added_mass = 0;     ///< kg of point masses
  const MassRow& row(const std::string& name) const;
  /// Lines of text: ours beside [yu2020, Table A1].
  std::string text() const;
};

/// Sum over the parts named and, when `with_points`, point masses.
Inertia inertia_of(const ModelDraft& draft, const std::vector<int>& parts, bool with_points);

/// Moves densities and adds point masses on `skull_nodes`; fills the report's trim fields.
void trim_head(ModelDraft& draft, const std::vector<int>& head_parts,
               const std::vector<int>& skull_nodes, double mass, const Vec3& moments,
               MassReport& report);

}  // namespace crosswalk::fe::generate
