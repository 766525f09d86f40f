#include "fe_node/contact/candidates.h"

#include <algorithm>
#include <cmath>

namespace crosswalk::fe {
namespace {

double mean_edge(const std::vector<ContactPass>& passes, std::span<const NodeRecord> nodes) {
  double sum = 0, count = 0;
  for (const ContactPass& pass : passes)
    for (const ContactFacet& facet : pass.facets)
      for (int i = 0; i < 2; ++i) {
        sum += (nodes[facet.node[i]].position() - nodes[facet.node[i + 1]].position()).norm();
        count += 1;
      }
  return sum / std::max(count, 1.0);
}

}  // namespace

ContactCandidates::ContactCandidates(std::vector<ContactPass> passes, int memory_slots,
                                     int result_slots)
    : passes_(std::move(passes)), memory_slots_(memory_slots), result_slots_(result_slots) {
  for (const ContactPass& pass : passes_) {
    node_entries_ += static_cast<int>(pass.nodes.size());
    for (const ContactNode& node : pass.nodes) watched_.push_back(node.node);
    for (const ContactFacet& facet : pass.facets)
      watched_.insert(watched_.end(), facet.node.begin(), facet.node.end());
  }
  std::sort(watched_.begin(), watched_.end());
  watched_.erase(std::unique(watched_.begin(), watched_.end()), watched_.end());
  std::size_t place = kReference + 6 * watched_.size(), flags = kLists + passes_.size();
  for (const ContactPass& pass : passes_) {
    reach_.push_back(pass.reach());
    memory_begin_.push_back(place);
    place += static_cast<std::size_t>(memory_slots_) * pass.nodes.size();
    there_begin_.push_back(flags);
    flags += pass.facets.size() + pass.nodes.size();
  }
  due_begin_ = place;
  lists_begin_ = flags;
}

void ContactCandidates::initialise(ContactHistory& history, const ContactContext& context,
                                   double margin) const {
  history.values.assign(due_begin_, 0.0);
  history.values[kMargin] = margin > 0 ? margin : 0.5 * mean_edge(passes_, context.nodes);
  double* last = history.values.data() + kReference + 3 * watched_.size();
  for (const int n : watched_)
    for (int axis = 0; axis < 3; ++axis) *last++ = context.nodes[n].x[axis];
  history.indices.assign(lists_begin_, 1);
  history.indices[kFailedCount] = -1;
  mark_what_is_there(history, context);
  search_all(history, context);
}

ContactCandidates::View ContactCandidates::view(ContactHistory& history, int pass) const {
  std::size_t due = due_begin_, work = lists_begin_, results = due_begin_;
  CandidateList mine({});
  for (int p = 0; p < static_cast<int>(passes_.size()); ++p) {
    const CandidateList list({history.indices.data() + work, history.indices.size() - work});
    if (p == pass) {
      mine = list;
      due = results;
    }
    work += history.indices[kLists + p];
    results += list.count() + list.candidate_count();
  }
  double* values = history.values.data();
  return {mine,
          values + memory_begin_[pass],
          values + due,
          values + due + mine.count(),
          values + results,
          history.indices.data() + work};
}

/// Flags what has failed. True when that has changed since the flags were set.
bool ContactCandidates::mark_what_is_there(ContactHistory& history,
                                           const ContactContext& context) const {
  const int failed = context.failed == nullptr ? 0 : context.failed->count;
  if (failed == history.indices[kFailedCount]) return false;
  history.indices[kFailedCount] = failed;
  const auto is_dead = [&](const ContactFacet& facet) {
    return failed > 0 && context.failed->contains(facet.kind, facet.element);
  };
  for (std::size_t p = 0; p < passes_.size(); ++p) {
    const std::vector<ContactFacet>& facets = passes_[p].facets;
    int* there = history.indices.data() + there_begin_[p];
    for (std::size_t f = 0; f < facets.size(); ++f) {
      const bool is_covered = facets[f].twin >= 0 && !is_dead(facets[facets[f].twin]);
      there[f] = !is_dead(facets[f]) && !is_covered ? 1 : 0;
    }
  }
  for (std::size_t p = 0; p < passes_.size(); ++p) {
    const ContactPass& pass = passes_[p];
    if (pass.surface_of_nodes < 0) continue;
    const std::vector<ContactFacet>& facets = passes_[pass.surface_of_nodes].facets;
    const int* facet_there = history.indices.data() + there_begin_[pass.surface_of_nodes];
    std::vector<char> is_held(context.nodes.size(), 0);
    for (std::size_t f = 0; f < facets.size(); ++f)
      if (facet_there[f] != 0)
        for (int n : facets[f].node) is_held[n] = 1;
    int* there = history.indices.data() + there_begin_[p] + pass.facets.size();
    for (std::size_t i = 0; i < pass.nodes.size(); ++i) there[i] = is_held[pass.nodes[i].node];
  }
  return true;
}

void ContactCandidates::search_all(ContactHistory& history, const ContactContext& context) const {
  double* reference = history.values.data() + kReference;
  for (std::size_t i = 0; i < watched_.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      reference[3 * i + axis] = context.nodes[watched_[i]].x[axis];
  const std::vector<int> there(history.indices.begin(), history.indices.begin() + lists_begin_);
  history.indices.resize(lists_begin_);
  std::size_t near = 0, due = 0;
  for (std::size_t p = 0; p < passes_.size(); ++p) {
    const std::size_t before = history.indices.size();
    const std::span<const int> flags(there.data() + there_begin_[p],
                                     passes_[p].facets.size() + passes_[p].nodes.size());
    search(passes_[p], context.nodes, history.values[kMargin],
           flags.first(passes_[p].facets.size()), flags.last(passes_[p].nodes.size()),
           history.indices);
    history.indices[kLists + p] = static_cast<int>(history.indices.size() - before);
    const CandidateList list({history.indices.data() + before, history.indices.size() - before});
    near = std::max(near, static_cast<std::size_t>(list.count()));
    due += static_cast<std::size_t>(list.count() + list.candidate_count());
  }
  // everything is due at once; behind: results of a pass, and the list of its nodes that are due
  history.values.resize(due_begin_ + due + static_cast<std::size_t>(result_slots_) * near);
  std::fill(history.values.begin() + due_begin_, history.values.end(), 0.0);
  history.indices.resize(history.indices.size() + near);
  history.values[kSearchDue] = history.values[kTravel] + history.values[kMargin];
}

/// Adds to the travel what a pair can have closed in the last step at most, and searches again when
/// that, or the motion since the last search that it overestimates, has used up the margin.
void ContactCandidates::update(ContactHistory& history, const ContactContext& context) const {
  double* values = history.values.data();
  const Vec3 frame = Eigen::Map<const Vec3>(values + kMeanStep);
  Vec3 sum = Vec3::Zero();
  double farthest2 = 0;
  double* last = values + kReference + 3 * watched_.size();
  for (const int n : watched_) {
    Eigen::Map<Vec3> before(last);
    const Vec3 now = context.nodes[n].position(), moved = now - before;
    before = now;
    last += 3;
    sum += moved;
    farthest2 = std::max(farthest2, (moved - frame).squaredNorm());
  }
  const double count = static_cast<double>(std::max<std::size_t>(watched_.size(), 1));
  Eigen::Map<Vec3>(values + kMeanStep) = sum / count;
  values[kTravel] += 2 * std::sqrt(farthest2);
  if (mark_what_is_there(history, context) || !std::isfinite(values[kTravel])) {
    search_all(history, context);
    return;
  }
  if (values[kTravel] < values[kSearchDue]) return;
  const double* reference = values + kReference;
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < watched_.size(); ++i)
    mean += context.nodes[watched_[i]].position() - Eigen::Map<const Vec3>(reference + 3 * i);
  mean /= count;
  double moved2 = 0;
  for (std::size_t i = 0; i < watched_.size(); ++i)
    moved2 = std::max(moved2, (context.nodes[watched_[i]].position() -
                               Eigen::Map<const Vec3>(reference + 3 * i) - mean)
                                  .squaredNorm());
  const double left = values[kMargin] - 2 * std::sqrt(moved2);
  constexpr double kWorthWaiting = 0.1;  // of the margin
  if (left > kWorthWaiting * values[kMargin])
    values[kSearchDue] = values[kTravel] + left;
  else
    search_all(history, context);
}

}  // namespace crosswalk::fe
