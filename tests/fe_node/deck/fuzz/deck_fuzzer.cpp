// libFuzzer target of the deck reader: whatever the bytes, reading ends in a deck and a bounded
// list of problems; a deck read without errors is written and read back to the same text.
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "fe_node/deck/deck_writer.h"
#include "fe_node/deck/keyword_reader.h"

namespace fe = crosswalk::fe;

namespace {
const fe::ReadOptions kNoIncludes{.includes = fe::ReadOptions::Includes::Ignore,
                                  .include_paths = {}};

void fail(const char* what, const std::string& first, const std::string& second) {
  std::cerr << what << "\n--- first\n" << first << "\n--- second\n" << second << '\n';
  std::abort();
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const fe::ReadDeck read = fe::read_deck_text(text, "fuzz", kNoIncludes);
  if (read.problems.errors.kept().size() > fe::ProblemList::kKept) std::abort();
  if (!read.problems.errors.empty()) return 0;
  const std::string written = fe::deck_text(read.deck);
  const fe::ReadDeck again = fe::read_deck_text(written, "written", kNoIncludes);
  if (!again.problems.errors.empty())
    fail(again.problems.errors.kept().front().text().c_str(), text, written);
  const std::string rewritten = fe::deck_text(again.deck);
  if (rewritten != written) fail("not stable", written, rewritten);
  return 0;
}
