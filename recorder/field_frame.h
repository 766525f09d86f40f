// The brain's strain at one instant, read from the field frames fe_node writes beside the log
// (fields/fields.pvd and its .vtu files, raw appended data). Points in W, strains first principal
// Green-Lagrange; handed on as centroids in head axes.
#pragma once

#include <filesystem>
#include <optional>
#include <set>

#include "recorder/report/report.h"

namespace crosswalk::recording {

/// The frame nearest in time.
struct FieldFrame {
  double t = 0;  ///< s, simulated
  std::filesystem::path file;
};

/// Nothing when the folder holds no list of frames or none within `reach` (s).
std::optional<FieldFrame> nearest_frame(const std::filesystem::path& fields, double t,
                                        double reach);

/// Centroids and strains of the elements of `parts`; throws UserError when the file is not one of
/// fe_node's frames.
StrainMap read_strain_map(const std::filesystem::path& vtu, const std::set<int>& parts,
                          const Pose& X_WH);

}  // namespace crosswalk::recording
