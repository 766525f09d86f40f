// Formulas of a subject file: the same text gives another number for every set of body measures.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/config.h"
#include "common/formula.h"
#include "common/spatial.h"

namespace crosswalk {

/// Evaluates the formulas of one subject; a bad one becomes a problem of its table, with ones in
/// its place. Lengths in m, masses in kg.
class BodyFormulas {
 public:
  BodyFormulas() = default;
  /// `reference`: the same measures of the person that the file's numbers belong to.
  BodyFormulas(Variables now, Variables reference);

  /// `count` values, any number when 0.
  std::vector<double> list(ConfigTable& table, std::string_view key, std::size_t count,
                           const std::string& doc) const;
  double scalar(ConfigTable& table, std::string_view key, const std::string& doc) const;
  Vec3 vector(ConfigTable& table, std::string_view key, const std::string& doc) const;
  /// Moments of inertia, kg m2, that may use the body's mass `m`.
  Vec3 moments(ConfigTable& table, std::string_view key, const std::string& doc, double m) const;

  /// Subject's value over the reference person's.
  double ratio(ConfigTable& table, std::string_view key, const std::string& doc) const;
  /// Ratio of girths, held between 0.88 and 1.12: single girths are unreliable [E].
  double girth(ConfigTable& table, std::string_view key = "girth") const;
  double length_ratio(ConfigTable& table) const;

 private:
  Variables now_, reference_;
};

}  // namespace crosswalk
