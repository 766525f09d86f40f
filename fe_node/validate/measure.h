// One number of a validation case: what the experiment or the closed form says, how sure that is,
// and what the model gives. Units as named, the field's own; everything else of a case is SI.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace crosswalk::fe::validate {

/// How well the reference number is known: a closed form of mechanics, or an experiment read
/// first-hand or from reviews with the confidence stated.
enum class Confidence { ClosedForm, High, Medium, Low };
const char* name(Confidence confidence);

enum class Verdict { Met, NotMet, Context };
const char* name(Verdict verdict);

struct Measure {
  std::string quantity, unit;
  double ours = std::numeric_limits<double>::quiet_NaN();
  double reference = std::numeric_limits<double>::quiet_NaN();  ///< experiment or closed form
  double low = -std::numeric_limits<double>::infinity();        ///< accepted range
  double high = std::numeric_limits<double>::infinity();
  Confidence confidence = Confidence::Low;
  std::string source;

  double ratio() const { return ours / reference; }
  bool is_inside() const { return ours >= low && ours <= high; }
  /// Low confidence decides nothing.
  Verdict verdict() const;
  /// A closed form is a gate: missing it fails the command.
  bool is_gate() const { return confidence == Confidence::ClosedForm; }
};

/// ln(stretch) of a Green-Lagrange strain; both measures rise together, so percentiles convert too.
double logarithmic(double green_lagrange);

struct Series {
  std::string label;
  std::vector<std::pair<double, double>> points;
};

struct Plot {
  std::string file;  ///< without ending
  std::string title, x_label, y_label;
  std::vector<Series> series;
};

struct CaseResult {
  std::string name, title, setup;
  std::vector<Measure> measures;
  std::vector<Plot> plots;
  std::vector<std::string> notes;
};

}  // namespace crosswalk::fe::validate
