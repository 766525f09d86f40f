// libFuzzer target of the whole way from a deck to a model: whatever the bytes, reading ends in a
// deck and a bounded list of problems; a deck read without errors is written and read back to the
// same text, and again after it has been renumbered, converted and moved as *INCLUDE_TRANSFORM
// does; one that passes the whole-deck checks becomes a model or a UserError, and the model takes
// three steps or stops with a NumericalError.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "common/error.h"
#include "fe_node/deck/deck_report.h"
#include "fe_node/deck/deck_writer.h"
#include "fe_node/deck/include_transform.h"
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

/// As a file included with every kind of change, by the deck's own first transformation.
void transform(const fe::Deck& deck, const std::string& text) {
  fe::TransformedInclude include;
  include.card.offsets = {.node = 1000,
                          .element = 2000,
                          .part = 3000,
                          .material = 4000,
                          .set = 5000,
                          .curve = 6000,
                          .definition = 7000,
                          .other = 8000};
  include.card.factors = {.length = 1e-3, .mass = 1e3, .time = 2};
  fe::Deck outer;
  outer.files = deck.files;
  outer.transformations = deck.transformations;
  if (!deck.transformations.empty()) include.card.transformation = deck.transformations[0].id;
  include.content = deck;
  fe::DeckProblems problems;
  fe::add_transformed(outer, std::move(include), problems);
  if (!problems.errors.empty()) return;
  // computed numbers are rounded by the first writing; from then on the text is stable
  const std::string written = fe::deck_text(outer);
  const fe::ReadDeck again = fe::read_deck_text(written, "transformed", kNoIncludes);
  if (!again.problems.errors.empty())
    fail(again.problems.errors.kept().front().text().c_str(), text, written);
  write_and_read_back(again.deck, text);
}

void run(const fe::Model& model, fe::State state, double step) {
  constexpr int kSteps = 3;
  fe::Scratch scratch(model, 1);
  try {
    for (int i = 0; i < kSteps; ++i) fe::advance_step(model, state, scratch, step);
  } catch (const crosswalk::NumericalError&) {
  }
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
  constexpr double kStepOfRigidModels = 1e-6;  // s
  run(built.model, state, std::isfinite(step) ? 0.5 * step : kStepOfRigidModels);
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  fe::ReadDeck read = fe::read_deck_text(text, "fuzz", kNoIncludes);
  if (read.problems.errors.kept().size() > fe::ProblemList::kKept) std::abort();
  if (read.problems.errors.empty()) write_and_read_back(read.deck, text);
  if (read.problems.errors.empty()) transform(read.deck, text);
  if (fe::report_deck(read, "fuzz").text.empty()) std::abort();
  if (read.problems.errors.empty()) build(read.deck, text);
  return 0;
}
