// The three kinds of failure, and the collector of user errors.
//
// UserError       something the user wrote is wrong: place, what was expected, what was found, how
// to cure it. NumericalError  the computation left its valid range: time, and the element or body.
// ProtocolError   a peer process is missing, silent, foreign or wrong.
// CW_ASSERT       our own bugs; active in every build, never inside kernels.
#pragma once

#include <source_location>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace crosswalk {

/// Where a user error stands in a file; line and column count from 1, 0 means unknown.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
  /// "file:line:column", without the parts that are unknown.
  std::string text() const;
};

/// One user error. Printed as "place: what: expected E, found F; hint".
struct Problem {
  Place place;
  std::string what;      ///< key, keyword or argument
  std::string expected;  ///< may be empty
  std::string found;     ///< may be empty
  std::string hint;      ///< may be empty
  std::string text() const;
};

class UserError : public std::runtime_error {
 public:
  explicit UserError(Problem problem);
  explicit UserError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// Gathers user errors so that a user sees all of them at once; throws after 20 or at finish().
class Diagnostics {
 public:
  static constexpr int kMaxProblems = 20;
  void add(Problem problem);
  bool empty() const { return problems_.empty(); }
  /// Throws UserError with everything gathered; does nothing when there is nothing.
  void finish() const;

 private:
  std::vector<Problem> problems_;
};

class NumericalError : public std::runtime_error {
 public:
  NumericalError(double time_s, const std::string& message);
  double time_s() const { return time_s_; }

 private:
  double time_s_;
};

/// Exit codes of every program.
enum class ExitCode : int {
  Done = 0,
  UserError = 2,
  NodeFailed = 3,
  TimeOut = 4,
  RecordIncomplete = 5,
  NumericalLimit = 6,
  CheckpointMismatch = 7,
  NoTransport = 10,
  VersionMismatch = 11,
  CouplerPresent = 12,
  RoleTaken = 13,
  Bug = 70,
  Interrupted = 130
};

class ProtocolError : public std::runtime_error {
 public:
  ProtocolError(ExitCode code, const std::string& message);
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// The closest candidate by edit distance, or an empty string when none is near enough.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

[[noreturn]] void assertion_failed(const char* condition, const std::source_location& where);

}  // namespace crosswalk

#define CW_ASSERT(condition)    \
  (static_cast<bool>(condition) \
       ? static_cast<void>(0)   \
       : ::crosswalk::assertion_failed(#condition, std::source_location::current()))
