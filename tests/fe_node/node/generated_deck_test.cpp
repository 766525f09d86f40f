// The coarse decks generated for the three test subjects, written and read back as a user would.
#include <gtest/gtest.h>

#include "common/scenario.h"
#include "fe_node/commands.h"
#include "fe_node/deck/deck_report.h"
#include "fe_node/deck/deck_writer.h"
#include "fe_node/fe_config.h"
#include "tests/source_folder.h"

namespace crosswalk::fe {
namespace {

class GeneratedDeck : public testing::TestWithParam<const char*> {};

TEST_P(GeneratedDeck, ChecksWithoutAWarning) {
  const std::string subject = GetParam();
  ConfigDocument document(source_folder() / "scenarios/tests" / (subject + ".toml"));
  ignore_tables_of_others(document, "fe_node");
  Scenario scenario = read_scenario(document);
  scenario.fidelity = crosswalk::Fidelity::Coarse;
  const FeConfig config = read_fe_config(document, scenario);
  document.finish();
  const std::string text = deck_text(generate::generate_head_neck(config.head_neck.spec));
  ReadDeck read = read_deck_text(text, "generated.k");
  const DeckReport report = report_deck(read, "generated.k", try_model);
  EXPECT_TRUE(report.is_sound);
  EXPECT_EQ(read.problems.warnings.total(), 0);
  if (testing::Test::HasFailure()) {
    for (const Problem& problem : read.problems.warnings.kept())
      ADD_FAILURE() << "warning " << problem.text();
    for (const Problem& problem : read.problems.errors.kept())
      ADD_FAILURE() << "error " << problem.text();
  }
}

INSTANTIATE_TEST_SUITE_P(Coarse, GeneratedDeck, testing::Values("v2370", "v2371", "v2374"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace crosswalk::fe
