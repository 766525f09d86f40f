#include "common/error.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace crosswalk {

std::string Place::text() const {
  if (line == 0) return file;
  if (column == 0) return fmt::format("{}:{}", file, line);
  return fmt::format("{}:{}:{}", file, line, column);
}

std::string Problem::text() const {
  std::string out = place.text();
  if (!what.empty()) out += (out.empty() ? "" : ": ") + what;
  if (!expected.empty()) out += ": expected " + expected;
  if (!found.empty()) out += (expected.empty() ? ": " : ", ") + std::string("found ") + found;
  if (!hint.empty()) out += "; " + hint;
  return out;
}

namespace {
std::string join(const std::vector<Problem>& problems) {
  std::string out;
  for (const Problem& problem : problems) {
    if (!out.empty()) out += '\n';
    out += problem.text();
  }
  return out;
}
}  // namespace

UserError::UserError(Problem problem) : UserError(std::vector<Problem>{std::move(problem)}) {}

UserError::UserError(std::vector<Problem> problems)
    : std::runtime_error(join(problems)), problems_(std::move(problems)) {}

void Diagnostics::add(Problem problem) {
  problems_.push_back(std::move(problem));
  if (static_cast<int>(problems_.size()) >= kMaxProblems) finish();
}

void Diagnostics::finish() const {
  if (!problems_.empty()) throw UserError(problems_);
}

NumericalError::NumericalError(double time_s, const std::string& message)
    : std::runtime_error(fmt::format("t = {:.3f} ms: {}", time_s * 1e3, message)),
      time_s_(time_s) {}

ProtocolError::ProtocolError(ExitCode code, const std::string& message)
    : std::runtime_error(message), code_(code) {}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  // Levenshtein distance; a candidate counts when at most a third of the word differs.
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    std::vector<std::size_t> row(candidate.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < word.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i + 1;
      for (std::size_t j = 0; j < candidate.size(); ++j) {
        const std::size_t substituted = diagonal + (word[i] == candidate[j] ? 0 : 1);
        diagonal = row[j + 1];
        row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
      }
    }
    if (row.back() < best_distance) {
      best_distance = row.back();
      best = candidate;
    }
  }
  return best;
}

void assertion_failed(const char* condition, const std::source_location& where) {
  throw std::logic_error(fmt::format("internal error: {} does not hold at {}:{} ({})", condition,
                                     where.file_name(), where.line(), where.function_name()));
}

}  // namespace crosswalk
