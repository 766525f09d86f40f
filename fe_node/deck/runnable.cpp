#include "fe_node/deck/runnable.h"

#include <fmt/format.h>

#include "fe_node/deck/deck_check.h"

namespace crosswalk::fe {

void require_runnable(ReadDeck& read, MissingPolicy policy) {
  const Deck& deck = read.deck;
  check_deck(DeckIndex(deck), read.problems);
  std::vector<Problem> problems = read.problems.errors.summary();
  if (policy == MissingPolicy::Refuse) {
    ProblemList missing;
    for (const MissingInclude& include : deck.missing_includes)
      missing.add(deck.place(include.source), "*INCLUDE", "a file",
                  fmt::format("no '{}'", include.name), "give its folder with --include-path");
    for (const UnreadKeyword& unread : deck.unread)
      if (unread.effect == Effect::Physics)
        missing.add(deck.place(unread.source), "*" + unread.keyword, {},
                    "changes the physics: " + unread.reason, "run without it by --accept-missing");
    for (Problem& problem : missing.summary()) problems.push_back(std::move(problem));
  }
  if (!problems.empty()) throw UserError(std::move(problems));
}

}  // namespace crosswalk::fe
