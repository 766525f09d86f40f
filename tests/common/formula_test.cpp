#include "common/formula.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace crosswalk {
namespace {

const Variables kVariables = {{"H", 1.8}, {"z_hip", 0.9}};

double value(const char* text) { return evaluate_formula(text, kVariables).at(0); }

TEST(Formula, FollowsTheRulesOfArithmetic) {
  EXPECT_DOUBLE_EQ(value("1 + 2*3 - 8/4"), 5);
  EXPECT_DOUBLE_EQ(value("-2^2"), -4);
  EXPECT_DOUBLE_EQ(value("2^3^2"), 512);
  EXPECT_DOUBLE_EQ(value("(1 + 2)*-3"), -9);
  EXPECT_DOUBLE_EQ(value("1.5e-3*2"), 3e-3);
  EXPECT_DOUBLE_EQ(value("z_hip - 0.045*H"), 0.9 - 0.045 * 1.8);
  EXPECT_DOUBLE_EQ(value("max(H, 2) + min(H, 2)"), 3.8);
}

TEST(Formula, ReadsLists) {
  EXPECT_THAT(evaluate_formula("0, H, -z_hip", kVariables), testing::ElementsAre(0, 1.8, -0.9));
}

TEST(Formula, NamesTheFault) {
  const auto fault = [](const char* text) -> std::string {
    try {
      evaluate_formula(text, kVariables);
    } catch (const FormulaError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(fault("z_hp + 1"), testing::HasSubstr("did you mean `z_hip`"));
  EXPECT_THAT(fault("(1 + 2"), testing::HasSubstr("expected `)`"));
  EXPECT_THAT(fault("1 + "), testing::HasSubstr("expected a number"));
  EXPECT_THAT(fault("2 3"), testing::HasSubstr("unexpected `3` at column 3"));
}

}  // namespace
}  // namespace crosswalk
