// What is wrong or doubtful in a deck: bounded lists that go on counting when they are full.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/error.h"

namespace crosswalk::fe {

/// Problems in the order found, the same one once. Of each subject (the `what` up to its first blank) only the first
/// kPerSubject are kept, so that one broken keyword does not hide the others.
class ProblemList {
 public:
  static constexpr int kKept = 200;
  static constexpr int kPerSubject = 8;
  void add(Place place, std::string what, std::string expected, std::string found,
           std::string hint = {});
  bool empty() const { return total_ == 0; }
  long total() const { return total_; }
  const std::vector<Problem>& kept() const { return kept_; }
  /// The kept ones, and how many more there are.
  std::vector<Problem> summary() const;

 private:
  std::vector<Problem> kept_;
  std::map<std::string, long> per_subject_;
  long total_ = 0;
};

struct DeckProblems {
  ProblemList errors;    ///< the deck is not what it should be: exit code 2
  ProblemList warnings;  ///< read, but probably not as meant
};

}  // namespace crosswalk::fe
