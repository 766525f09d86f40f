#include "fe_node/validate/measure.h"

#include <cmath>

namespace crosswalk::fe::validate {

const char* name(Confidence confidence) {
  switch (confidence) {
    case Confidence::ClosedForm:
      return "closed form";
    case Confidence::High:
      return "high";
    case Confidence::Medium:
      return "medium";
    case Confidence::Low:
      break;
  }
  return "low";
}

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::Met:
      return "met";
    case Verdict::NotMet:
      return "NOT met";
    case Verdict::Context:
      break;
  }
  return "context";
}

double logarithmic(double green_lagrange) { return 0.5 * std::log(1 + 2 * green_lagrange); }

Verdict Measure::verdict() const {
  if (confidence == Confidence::Low) return Verdict::Context;
  return is_inside() ? Verdict::Met : Verdict::NotMet;
}

}  // namespace crosswalk::fe::validate
