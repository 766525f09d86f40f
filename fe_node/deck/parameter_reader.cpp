#include "fe_node/deck/parameter_reader.h"

#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "fe_node/deck/expression.h"
#include "fe_node/deck/number.h"

namespace crosswalk::fe {

namespace {

constexpr std::size_t kNameWidth = 10;
constexpr std::size_t kMaxExpression = 4000;

class ParameterReader {
 public:
  ParameterReader(CardReader& io, Parameters& parameters, DeckProblems& problems, const Deck& deck,
                  bool is_local)
      : io_(io), parameters_(parameters), problems_(problems), deck_(deck), is_local_(is_local) {}

  /// Up to four pairs of name and value a line, in columns or separated by commas.
  void read_values() {
    while (io_.has_content()) {
      io_.card();
      for (int i = 0; i < 4; ++i) {
        std::string name, value;
        io_.text("PRMR", name, CardIo::kWidth);
        io_.text("VAL", value, CardIo::kWidth);
        if (name.empty()) continue;
        define(name, value, value);
      }
    }
  }

  /// A name in 10 columns, then the expression; a line with a blank name continues the one before.
  void read_expressions() {
    while (io_.has_content()) {
      std::string line;
      io_.raw_line(line);
      std::string name(trimmed(std::string_view(line).substr(0, kNameWidth)));
      std::string expression(
          trimmed(std::string_view(line).substr(std::min(kNameWidth, line.size()))));
      if (const std::size_t comma = line.find(','); comma <= kNameWidth) {
        name = trimmed(std::string_view(line).substr(0, comma));
        expression = trimmed(std::string_view(line).substr(comma + 1));
      }
      while (is_continuation(io_.next_line()) && expression.size() < kMaxExpression) {
        std::string more;
        io_.raw_line(more);
        expression += ' ';
        expression += trimmed(more);
      }
      define(name, expression, {});
    }
  }

 private:
  static bool is_continuation(std::string_view line) {
    return line.size() > kNameWidth && trimmed(line.substr(0, kNameWidth)).empty();
  }

  /// "R name", "Iname", "c name": a letter for the kind, then the name.
  void define(const std::string& typed_name, const std::string& expression,
              const std::string& plain) {
    if (typed_name.size() < 2) return problem(typed_name, "a letter R, I or C and a name");
    Parameter parameter;
    parameter.source = io_.source();
    const std::string name = upper_case(trimmed(std::string_view(typed_name).substr(1)));
    switch (std::toupper(static_cast<unsigned char>(typed_name.front()))) {
      case 'R':
        parameter.kind = Parameter::Kind::Real;
        break;
      case 'I':
        parameter.kind = Parameter::Kind::Integer;
        break;
      case 'C':
        parameter.kind = Parameter::Kind::Text;
        parameter.text = expression;
        break;
      default:
        return problem(typed_name, "a letter R, I or C and a name");
    }
    if (parameter.kind != Parameter::Kind::Text && !evaluate(name, expression, plain, parameter))
      return;
    add(name, parameter);
  }

  bool evaluate(const std::string& name, const std::string& expression, const std::string& plain,
                Parameter& parameter) {
    if (const std::optional<double> number = parse_real(plain)) {
      parameter.value = *number;
    } else {
      const ExpressionResult result =
          evaluate_expression(expression, [this](const std::string& word) -> std::optional<double> {
            const Parameter* known = parameters_.find(word);
            if (known == nullptr || known->kind == Parameter::Kind::Text) return std::nullopt;
            return known->value;
          });
      if (!result.error.empty()) {
        problem(name, "a value or an expression",
                fmt::format("'{:.60}' ({})", expression, result.error));
        return false;
      }
      parameter.value = result.value;
    }
    if (parameter.kind == Parameter::Kind::Integer) parameter.value = std::trunc(parameter.value);
    return true;
  }

  void add(const std::string& name, const Parameter& parameter) {
    const Parameter* earlier = is_local_ ? parameters_.define_local(name, parameter)
                                         : parameters_.define_global(name, parameter);
    if (earlier == nullptr) return;
    problems_.warnings.add(
        deck_.place(parameter.source), "*PARAMETER " + name, {}, "a second definition",
        fmt::format("the first one, at {}, holds", deck_.place(earlier->source).text()));
  }

  void problem(const std::string& name, const char* expected, std::string found = {}) {
    problems_.errors.add(deck_.place(io_.source()), "*PARAMETER " + name, expected,
                         found.empty() ? fmt::format("'{:.40}'", name) : std::move(found));
  }

  CardReader& io_;
  Parameters& parameters_;
  DeckProblems& problems_;
  const Deck& deck_;
  bool is_local_;
};

}  // namespace

bool read_parameter_keyword(const std::string& keyword, CardReader& io, Parameters& parameters,
                            DeckProblems& problems, const Deck& deck) {
  if (!keyword.starts_with("PARAMETER")) return false;
  const std::string_view rest = std::string_view(keyword).substr(9);
  if (rest == "_DUPLICATION") {
    io.skip_rest();  // the first definition holds, with a warning, whatever is asked for
    return true;
  }
  const bool is_local = rest.ends_with("_LOCAL");
  const std::string_view form = rest.substr(0, rest.size() - (is_local ? 6 : 0));
  ParameterReader reader(io, parameters, problems, deck, is_local);
  if (form == "_EXPRESSION") {
    reader.read_expressions();
  } else if (form.empty()) {
    reader.read_values();
  } else {
    return false;
  }
  return true;
}

}  // namespace crosswalk::fe
