#include "fe_node/deck/expression.h"

#include <cctype>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "common/units.h"
#include "fe_node/deck/number.h"

namespace crosswalk::fe {

namespace {

constexpr int kMaxDepth = 100;

struct Function {
  const char* name;
  double (*one)(double);
  double (*two)(double, double);
};

double sign_of(double a, double b) { return std::copysign(std::abs(a), b); }
double smaller(double a, double b) { return std::fmin(a, b); }
double larger(double a, double b) { return std::fmax(a, b); }

constexpr Function kFunctions[] = {
    {"ABS", [](double x) { return std::abs(x); }, nullptr},
    {"SQRT", [](double x) { return std::sqrt(x); }, nullptr},
    {"EXP", [](double x) { return std::exp(x); }, nullptr},
    {"LOG", [](double x) { return std::log(x); }, nullptr},
    {"LN", [](double x) { return std::log(x); }, nullptr},
    {"LOG10", [](double x) { return std::log10(x); }, nullptr},
    {"SIN", [](double x) { return std::sin(x); }, nullptr},
    {"COS", [](double x) { return std::cos(x); }, nullptr},
    {"TAN", [](double x) { return std::tan(x); }, nullptr},
    {"ASIN", [](double x) { return std::asin(x); }, nullptr},
    {"ACOS", [](double x) { return std::acos(x); }, nullptr},
    {"ATAN", [](double x) { return std::atan(x); }, nullptr},
    {"SINH", [](double x) { return std::sinh(x); }, nullptr},
    {"COSH", [](double x) { return std::cosh(x); }, nullptr},
    {"TANH", [](double x) { return std::tanh(x); }, nullptr},
    {"INT", [](double x) { return std::trunc(x); }, nullptr},
    {"AINT", [](double x) { return std::trunc(x); }, nullptr},
    {"NINT", [](double x) { return std::round(x); }, nullptr},
    {"ANINT", [](double x) { return std::round(x); }, nullptr},
    {"FLOAT", [](double x) { return x; }, nullptr},
    {"ATAN2", nullptr, [](double y, double x) { return std::atan2(y, x); }},
    {"MOD", nullptr, [](double a, double b) { return std::fmod(a, b); }},
    {"SIGN", nullptr, sign_of},
    {"MIN", nullptr, smaller},
    {"MAX", nullptr, larger},
};

class Parser {
 public:
  using Lookup = std::function<std::optional<double>(const std::string&)>;
  Parser(std::string_view text, const Lookup& lookup) : text_(text), lookup_(lookup) {}

  ExpressionResult run() {
    const double value = sum(0);
    if (error_.empty() && !at_end()) fail(fmt::format("unexpected '{}'", text_[at_]));
    if (error_.empty() && !std::isfinite(value)) fail("the value is not finite");
    return {value, error_};
  }

 private:
  double sum(int depth) {
    double value = product(depth);
    while (error_.empty()) {
      if (take('+')) {
        value += product(depth);
      } else if (take('-')) {
        value -= product(depth);
      } else {
        break;
      }
    }
    return value;
  }

  double product(int depth) {
    double value = signed_power(depth);
    while (error_.empty()) {
      if (take('*')) {
        value *= signed_power(depth);
      } else if (take('/')) {
        const double divisor = signed_power(depth);
        if (error_.empty() && divisor == 0) return fail("division by zero");
        value /= divisor;
      } else {
        break;
      }
    }
    return value;
  }

  /// As in Fortran, -2**2 is -(2**2), and ** groups to the right.
  double signed_power(int depth) {
    if (depth > kMaxDepth) return fail("nested too deeply");
    if (take('-')) return -signed_power(depth + 1);
    if (take('+')) return signed_power(depth + 1);
    const double base = atom(depth);
    if (!take_power()) return base;
    return std::pow(base, signed_power(depth + 1));
  }

  double atom(int depth) {
    if (depth > kMaxDepth) return fail("nested too deeply");
    if (at_end()) return fail("the expression ends early");
    const char c = text_[at_];
    if (take('(')) return closed(sum(depth + 1));
    if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') return number();
    if (std::isalpha(static_cast<unsigned char>(c)) || c == '_' || c == '&') return name(depth);
    return fail(fmt::format("unexpected '{}'", c));
  }

  double number() {
    const std::size_t begin = at_;
    const auto digits = [&] {
      while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_]))) ++at_;
    };
    digits();
    if (at_ < text_.size() && text_[at_] == '.') ++at_;
    digits();
    if (at_ < text_.size() && std::string_view("eEdD").find(text_[at_]) != std::string_view::npos) {
      const std::size_t mark = at_++;
      if (at_ < text_.size() && (text_[at_] == '+' || text_[at_] == '-')) ++at_;
      if (at_ == text_.size() || !std::isdigit(static_cast<unsigned char>(text_[at_]))) at_ = mark;
      digits();
    }
    const std::optional<double> value = parse_real(text_.substr(begin, at_ - begin));
    return value ? *value : fail("not a number");
  }

  double name(int depth) {
    if (text_[at_] == '&') ++at_;
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_'))
      ++at_;
    const std::string word = upper_case(text_.substr(begin, at_ - begin));
    if (take('(')) return call(word, depth);
    if (const std::optional<double> value = lookup_(word)) return *value;
    if (word == "PI") return kPi;
    return fail(fmt::format("'{}' is not defined", word));
  }

  double call(const std::string& word, int depth) {
    std::vector<double> arguments{sum(depth + 1)};
    while (error_.empty() && take(',')) arguments.push_back(sum(depth + 1));
    closed(0);
    if (!error_.empty()) return 0;
    for (const Function& function : kFunctions) {
      if (word != function.name) continue;
      if (function.one != nullptr && arguments.size() == 1) return function.one(arguments[0]);
      if (function.two == nullptr || arguments.size() < 2) break;
      double value = arguments[0];
      for (std::size_t i = 1; i < arguments.size(); ++i) value = function.two(value, arguments[i]);
      return value;
    }
    return fail(fmt::format("no function {} of {} arguments", word, arguments.size()));
  }

  double closed(double value) { return take(')') ? value : fail("a ) is missing"); }

  bool at_end() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    return at_ == text_.size();
  }
  bool take(char c) {
    if (at_end() || text_[at_] != c) return false;
    if (c == '*' && at_ + 1 < text_.size() && text_[at_ + 1] == '*') return false;
    ++at_;
    return true;
  }
  bool take_power() {
    if (at_end()) return false;
    if (text_[at_] == '^') return ++at_, true;
    if (text_.substr(at_, 2) != "**") return false;
    at_ += 2;
    return true;
  }
  double fail(std::string message) {
    if (error_.empty()) error_ = std::move(message);
    at_ = text_.size();
    return 0;
  }

  std::string_view text_;
  const Lookup& lookup_;
  std::size_t at_ = 0;
  std::string error_;
};

}  // namespace

ExpressionResult evaluate_expression(
    std::string_view text, const std::function<std::optional<double>(const std::string&)>& lookup) {
  return Parser(trimmed(text), lookup).run();
}

}  // namespace crosswalk::fe
