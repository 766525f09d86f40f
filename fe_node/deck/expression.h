// Arithmetic of *PARAMETER_EXPRESSION: + - * / ** ( ) and the usual Fortran functions.
//
// Names are looked up by the caller (parameters, with or without a leading &). Bounded nesting, so
// that no text can exhaust the stack.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace crosswalk::fe {

struct ExpressionResult {
  double value = 0;
  std::string error;  ///< empty when the value holds
};

/// `lookup` gives the value of a name in upper case, or nothing.
ExpressionResult evaluate_expression(
    std::string_view text, const std::function<std::optional<double>(const std::string&)>& lookup);

}  // namespace crosswalk::fe
