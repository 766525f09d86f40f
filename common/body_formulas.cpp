#include "common/body_formulas.h"

#include <algorithm>

#include <fmt/format.h>

namespace crosswalk {
namespace {

constexpr double kGirthMin = 0.88, kGirthMax = 1.12;

std::vector<double> evaluate(ConfigTable& table, std::string_view key, std::size_t count,
                             const std::string& doc, const Variables& variables) {
  const std::string text = table.text(key, doc);
  std::vector<double> values(count == 0 ? 1 : count, 1.0);
  if (text.empty()) return values;
  try {
    values = evaluate_formula(text, variables);
    if (count != 0 && values.size() != count) {
      table.problem(key, fmt::format("{} formulas", count), fmt::format("{}", values.size()));
      values.assign(count, 1.0);
    }
  } catch (const FormulaError& error) {
    table.problem(key, "a formula in body measures", error.what());
  }
  return values;
}

Vec3 as_vector(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

BodyFormulas::BodyFormulas(Variables now, Variables reference)
    : now_(std::move(now)), reference_(std::move(reference)) {}

std::vector<double> BodyFormulas::list(ConfigTable& table, std::string_view key, std::size_t count,
                                       const std::string& doc) const {
  return evaluate(table, key, count, doc, now_);
}

double BodyFormulas::scalar(ConfigTable& table, std::string_view key,
                            const std::string& doc) const {
  return evaluate(table, key, 1, doc, now_)[0];
}

Vec3 BodyFormulas::vector(ConfigTable& table, std::string_view key, const std::string& doc) const {
  return as_vector(evaluate(table, key, 3, doc, now_));
}

Vec3 BodyFormulas::moments(ConfigTable& table, std::string_view key, const std::string& doc,
                           double m) const {
  Variables variables = now_;
  variables["m"] = m;
  return as_vector(evaluate(table, key, 3, doc, variables));
}

double BodyFormulas::ratio(ConfigTable& table, std::string_view key, const std::string& doc) const {
  const double now = evaluate(table, key, 1, doc, now_)[0];
  return now / evaluate(table, key, 1, doc, reference_)[0];
}

double BodyFormulas::girth(ConfigTable& table, std::string_view key) const {
  return std::clamp(scalar(table, key, "girth ratio to the reference person"), kGirthMin,
                    kGirthMax);
}

double BodyFormulas::length_ratio(ConfigTable& table) const {
  return scalar(table, "length", "length ratio to the reference person");
}

}  // namespace crosswalk
