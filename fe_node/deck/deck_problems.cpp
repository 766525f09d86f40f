#include "fe_node/deck/deck_problems.h"

#include <algorithm>

#include <fmt/format.h>

namespace crosswalk::fe {

void ProblemList::add(Place place, std::string what, std::string expected, std::string found,
                      std::string hint) {
  const auto is_known = [&](const Problem& known) {
    return known.place.line == place.line && known.what == what && known.found == found &&
           known.expected == expected && known.place.file == place.file;
  };
  if (std::any_of(kept_.begin(), kept_.end(), is_known)) return;
  ++total_;
  const long seen = ++per_subject_[what.substr(0, what.find(' '))];
  if (seen > kPerSubject || static_cast<int>(kept_.size()) >= kKept) return;
  Problem& problem = kept_.emplace_back();
  problem.place = std::move(place);
  problem.what = std::move(what);
  problem.expected = std::move(expected);
  problem.found = std::move(found);
  problem.hint = std::move(hint);
}

std::vector<Problem> ProblemList::summary() const {
  std::vector<Problem> out = kept_;
  std::string left_off;
  for (const auto& [subject, count] : per_subject_)
    if (count > kPerSubject && left_off.size() < 400)
      left_off += fmt::format("{}{} {}", left_off.empty() ? "" : ", ", count, subject);
  const long more = total_ - static_cast<long>(kept_.size());
  if (more > 0) {
    Problem rest;
    rest.what = fmt::format("{} more problems are not listed", more);
    if (!left_off.empty()) rest.hint = "in all " + left_off;
    out.push_back(std::move(rest));
  }
  return out;
}

}  // namespace crosswalk::fe
