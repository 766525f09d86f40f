// Arithmetic formulas in data files: "0.98*c25, z_hip - 0.045*H".
//
// Numbers, names, + - * / ^ (right-associative), unary minus, parentheses and min(a, b), max(a, b);
// commas at the top level make a list. Used where a body's geometry is stated in body measures.
#pragma once

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace crosswalk {

using Variables = std::map<std::string, double, std::less<>>;

class FormulaError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// All values of the list; throws FormulaError naming the fault and its column.
std::vector<double> evaluate_formula(std::string_view text, const Variables& variables);

}  // namespace crosswalk
