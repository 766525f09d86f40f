// libFuzzer target of the whole way from a deck to a model: whatever the bytes, reading ends in a
// deck and a bounded list of problems; a deck read without errors is written and read back to the
// same text; one that passes the whole-deck checks becomes a model or a UserError.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "fe_node/deck/deck_report.h"
#include "fe_node/deck/deck_writer.h"
#include "fe_node/deck/runnable.h"
#include "fe_node/model_builder/model_builder.h"
#include "fe_node/solver.h"

namespace fe = crosswalk::fe;

namespace {
const fe::ReadOptions kNoIncludes{.includes = fe::ReadOptions::Includes::Ignore,
                                  .include_paths = {}};

void fail(const char* what, const std::string& first, const std::string& second) {
  std::cerr << what << "\n--- first\n" << first << "\n--- second\n" << second << '\n';
  std::abort();
}

void write_and_read_back(const fe::Deck& deck, const std::string& text) {
  const std::string written = fe::deck_text(deck);
  const fe::ReadDeck again = fe::read_deck_text(written, "written", kNoIncludes);
  if (!again.problems.errors.empty())
    fail(again.problems.errors.kept().front().text().c_str(), text, written);
  const std::string rewritten = fe::deck_text(again.deck);
  if (rewritten != written) fail("not stable", written, rewritten);
}

void build(const fe::Deck& deck, const std::string& text) {
  fe::BuildOptions options;
  options.units = deck.units == fe::UnitSystem::Unknown ? fe::UnitSystem::MmKgMs : deck.units;
  fe::BuiltModel built;
  try {
    built = fe::build_model(deck, options);
    fe::finish_model(built);
  } catch (const crosswalk::UserError&) {
    return;
  }
  const double step = fe::initial_stable_step(built.model);
  const fe::State state = fe::initial_state(built.model);
  if (!(step > 0)) fail("no stable step", text, "");
  for (const fe::NodeRecord& node : state.nodes)
    if (!node.position().allFinite() || !std::isfinite(node.inverse_mass))
      fail("a node without place or mass", text, "");
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  fe::ReadDeck read = fe::read_deck_text(text, "fuzz", kNoIncludes);
  if (read.problems.errors.kept().size() > fe::ProblemList::kKept) std::abort();
  if (read.problems.errors.empty()) write_and_read_back(read.deck, text);
  if (fe::report_deck(read, "fuzz").text.empty()) std::abort();
  if (read.problems.errors.empty()) build(read.deck, text);
  return 0;
}
