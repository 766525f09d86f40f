// Which pairs of a contact must be looked at in a step.
//
// Candidate pairs come from a grid search. A pair farther apart than anything can touch, or than
// the node is from a nearer facet, is not looked at again before the fastest node (relative to the
// mean motion of the interface) could have closed the gap from both sides, and the search is
// repeated when that motion has used up the search margin; so a pair is found from nearness alone,
// and the answer does not depend on when the search ran. What slides past costs no more than what
// stands still.
//
// Facets of elements that have failed are gone, and with them nodes that no facet is left of; where
// the surface keeps inner faces (InnerFaces::Kept) those uncovered by the failure come in.
//
// All that changes lives in the ContactHistory, so that a restart continues bit-identically.
#pragma once

#include "fe_node/contact/contact.h"
#include "fe_node/contact/search.h"

namespace crosswalk::fe {

class ContactCandidates {
 public:
  /// `memory_slots`: doubles that the contact keeps per node entry; `result_slots`: those it needs
  /// per node that is due in a step.
  ContactCandidates(std::vector<ContactPass> passes, int memory_slots, int result_slots);

  /// `margin` of the search, m; 0: half the mean facet edge.
  void initialise(ContactHistory& history, const ContactContext& context, double margin) const;
  /// Brings all up to date with the present positions; once a step.
  void update(ContactHistory& history, const ContactContext& context) const;

  /// What belongs to one pass.
  struct View {
    CandidateList list;
    double* memory;          ///< memory_slots per node entry
    double* due_nodes;       ///< travel at which a near node is due, per entry of the list
    double* due_candidates;  ///< likewise per candidate
    double* results;
    int* due_list;  ///< room for the entries that are due
  };
  View view(ContactHistory& history, int pass) const;
  /// The most that any pair can have closed since the start, m; what is due at less is due now.
  static double travel(const ContactHistory& history) { return history.values[kTravel]; }

  const std::vector<ContactPass>& passes() const { return passes_; }
  /// The farthest a node of the pass can be from a facet it touches, m.
  double reach(int pass) const { return reach_[pass]; }
  int node_entries() const { return node_entries_; }

 private:
  /// Head of the value array: the search margin; the travel so far and the one at which the next
  /// search is due; the displacement of a step that motion is measured against; then the watched
  /// positions of the last search and of the last step.
  enum ValueHead { kMargin = 0, kTravel, kSearchDue, kMeanStep, kReference = 6 };
  /// Head of the index array: failed elements that the facets reflect, then the lists' lengths.
  enum IndexHead { kFailedCount = 0, kLists = 1 };

  bool mark_what_is_there(ContactHistory& history, const ContactContext& context) const;
  void search_all(ContactHistory& history, const ContactContext& context) const;

  std::vector<ContactPass> passes_;
  int memory_slots_, result_slots_;
  int node_entries_ = 0;
  std::vector<int> watched_;   ///< mesh nodes of all passes, rising
  std::vector<double> reach_;  ///< per pass
  std::vector<std::size_t> memory_begin_;
  std::size_t due_begin_ = 0;
  /// Per pass, in the index array: a flag per facet, then one per node.
  std::vector<std::size_t> there_begin_;
  std::size_t lists_begin_ = 0;
};

}  // namespace crosswalk::fe
