#include "common/error.h"

#include <gtest/gtest.h>

namespace crosswalk {
namespace {

TEST(Problem, ReadsAsPlaceExpectedFoundHint) {
  const Problem problem{{"a.toml", 2, 21}, "subject.mass_kg", "a mass", "-3", "write 75.0"};
  EXPECT_EQ(problem.text(), "a.toml:2:21: subject.mass_kg: expected a mass, found -3; write 75.0");
}

TEST(Diagnostics, ThrowsEverythingGathered) {
  Diagnostics diagnostics;
  EXPECT_NO_THROW(diagnostics.finish());
  diagnostics.add({{"a", 1, 1}, "x", "", "", ""});
  diagnostics.add({{"a", 2, 1}, "y", "", "", ""});
  try {
    diagnostics.finish();
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.problems().size(), 2u);
    EXPECT_STREQ(error.what(), "a:1:1: x\na:2:1: y");
  }
}

TEST(DidYouMean, FindsTheNearKeyAndNothingFar) {
  EXPECT_EQ(did_you_mean("standing_heigth", {"seated_height", "standing_height"}),
            "standing_height");
  EXPECT_EQ(did_you_mean("banana", {"standing_height"}), "");
}

}  // namespace
}  // namespace crosswalk
