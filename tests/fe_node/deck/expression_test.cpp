#include "fe_node/deck/expression.h"

#include <gtest/gtest.h>

#include "common/units.h"

namespace crosswalk::fe {
namespace {

ExpressionResult evaluate(const std::string& text) {
  return evaluate_expression(text, [](const std::string& name) -> std::optional<double> {
    if (name == "SEX") return 1.0;
    if (name == "T") return 2.5;
    return std::nullopt;
  });
}

TEST(DeckExpression, FollowsTheUsualPrecedence) {
  EXPECT_DOUBLE_EQ(evaluate("1+2*3").value, 7);
  EXPECT_DOUBLE_EQ(evaluate("(1+2)*3").value, 9);
  EXPECT_DOUBLE_EQ(evaluate("-2**2").value, -4);
  EXPECT_DOUBLE_EQ(evaluate("2**3**2").value, 512);
  EXPECT_DOUBLE_EQ(evaluate("2**-1").value, 0.5);
  EXPECT_DOUBLE_EQ(evaluate("8/4/2").value, 1);
  EXPECT_DOUBLE_EQ(evaluate("7-2-1").value, 4);
  EXPECT_DOUBLE_EQ(evaluate("2^3").value, 8);
}

TEST(DeckExpression, KnowsParametersWithAndWithoutMark) {
  EXPECT_DOUBLE_EQ(evaluate("0.4182+sex*0.0703").value, 0.4885);
  EXPECT_DOUBLE_EQ(evaluate("&T*2").value, 5);
  EXPECT_DOUBLE_EQ(evaluate("364.2+SEX*49.").value, 413.2);
  EXPECT_DOUBLE_EQ(evaluate("1.0e-6+SEX*0.07e-6").value, 1.07e-6);
}

TEST(DeckExpression, KnowsTheFunctions) {
  EXPECT_DOUBLE_EQ(evaluate("abs(-3)").value, 3);
  EXPECT_DOUBLE_EQ(evaluate("max(1,2,T)").value, 2.5);
  EXPECT_DOUBLE_EQ(evaluate("mod(7,4)").value, 3);
  EXPECT_DOUBLE_EQ(evaluate("sqrt(16)+int(2.9)").value, 6);
  EXPECT_DOUBLE_EQ(evaluate("atan2(1,1)").value, kPi / 4);
  EXPECT_DOUBLE_EQ(evaluate("sign(2,-1)").value, -2);
}

TEST(DeckExpression, SaysWhatIsWrong) {
  EXPECT_EQ(evaluate("1/0").error, "division by zero");
  EXPECT_EQ(evaluate("(1+2").error, "a ) is missing");
  EXPECT_EQ(evaluate("UNKNOWN+1").error, "'UNKNOWN' is not defined");
  EXPECT_EQ(evaluate("1 2").error, "unexpected '2'");
  EXPECT_EQ(evaluate("").error, "the expression ends early");
  EXPECT_EQ(evaluate("sqrt(1,2)").error, "no function SQRT of 2 arguments");
  EXPECT_EQ(evaluate("sqrt(-1)").error, "the value is not finite");
}

TEST(DeckExpression, DeepNestingIsRefused) {
  EXPECT_EQ(evaluate(std::string(100000, '(')).error, "nested too deeply");
  EXPECT_EQ(evaluate(std::string(100000, '-') + "1").error, "nested too deeply");
}

}  // namespace
}  // namespace crosswalk::fe
