#include "common/formula.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "common/error.h"

namespace crosswalk {
namespace {

// Recursive descent: list = sum {"," sum}; sum = product {(+|-) product};
// product = power {(*|/) power}; power = ["-"] atom ["^" power].
class Parser {
 public:
  Parser(std::string_view text, const Variables& variables) : text_(text), variables_(variables) {}

  std::vector<double> list() {
    std::vector<double> values = {sum()};
    while (accept(',')) values.push_back(sum());
    if (at_ != text_.size()) fail(fmt::format("unexpected `{}`", text_[at_]));
    return values;
  }

 private:
  double sum() {
    double value = product();
    while (true) {
      if (accept('+')) {
        value += product();
      } else if (accept('-')) {
        value -= product();
      } else {
        return value;
      }
    }
  }

  double product() {
    double value = power();
    while (true) {
      if (accept('*')) {
        value *= power();
      } else if (accept('/')) {
        value /= power();
      } else {
        return value;
      }
    }
  }

  double power() {
    if (accept('-')) return -power();
    const double base = atom();
    return accept('^') ? std::pow(base, power()) : base;
  }

  double atom() {
    if (accept('(')) {
      const double value = sum();
      expect(')');
      return value;
    }
    skip_blanks();
    if (at_ < text_.size() && (std::isdigit(at()) || text_[at_] == '.')) return number();
    const std::string name = word();
    if (name.empty()) fail("expected a number, a name or `(`");
    if (accept('(')) return function(name);
    const auto found = variables_.find(name);
    if (found == variables_.end()) fail(unknown(name));
    return found->second;
  }

  double function(const std::string& name) {
    const double a = sum();
    expect(',');
    const double b = sum();
    expect(')');
    if (name == "min") return std::min(a, b);
    if (name == "max") return std::max(a, b);
    fail(fmt::format("unknown function `{}`; there are min and max", name));
  }

  double number() {
    const std::string rest(text_.substr(at_));
    char* end = nullptr;
    const double value = std::strtod(rest.c_str(), &end);
    at_ += static_cast<std::size_t>(end - rest.c_str());
    return value;
  }

  std::string word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(at()) || text_[at_] == '_')) ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }

  std::string unknown(const std::string& name) const {
    std::vector<std::string> names;
    for (const auto& [key, value] : variables_) names.push_back(key);
    const std::string near = did_you_mean(name, names);
    return fmt::format("unknown name `{}`{}", name,
                       near.empty() ? "" : fmt::format("; did you mean `{}`?", near));
  }

  unsigned char at() const { return static_cast<unsigned char>(text_[at_]); }
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(at())) ++at_;
  }
  bool accept(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail(fmt::format("expected `{}`", c));
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw FormulaError(fmt::format("{} at column {} of \"{}\"", what, at_ + 1, text_));
  }

  std::string_view text_;
  const Variables& variables_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<double> evaluate_formula(std::string_view text, const Variables& variables) {
  return Parser(text, variables).list();
}

}  // namespace crosswalk
