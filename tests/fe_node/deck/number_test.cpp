#include "fe_node/deck/number.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace crosswalk::fe {
namespace {

TEST(DeckNumber, ReadsWhatDecksWrite) {
  const std::pair<const char*, double> cases[] = {
      {"1.5", 1.5},          {"+4", 4},       {" 2. ", 2},
      {".25", 0.25},         {"-.5", -0.5},   {"1.0-3", 1e-3},
      {"1.00000+4", 1e4},    {"1.D+02", 100}, {"1.d2", 100},
      {"7.83E-06", 7.83e-6}, {"3e5", 3e5},    {"-8333.0", -8333},
      {"1.000000E8", 1e8},   {"00012", 12},   {"-1-2", -0.01},
      {"5.E+00", 5},         {"1e-400", 0},
  };
  for (const auto& [text, value] : cases) {
    ASSERT_TRUE(parse_real(text).has_value()) << text;
    EXPECT_DOUBLE_EQ(*parse_real(text), value) << text;
  }
}

TEST(DeckNumber, RefusesWhatIsNoNumber) {
  for (const char* text :
       {"",     " ",   "abc", "1.0x",  "1 2", "--1", "1..2", "1e",   "1e+", "1+",
        "0x10", "nan", "inf", "1e400", ".",   "+",   "e5",   "1.0-", "1,0", "&A"})
    EXPECT_FALSE(parse_real(text).has_value()) << text;
}

TEST(DeckNumber, IntegersMayBeWrittenAsReals) {
  EXPECT_EQ(parse_integer("2."), 2);
  EXPECT_EQ(parse_integer("-2008010."), -2008010);
  EXPECT_EQ(parse_integer("+7"), 7);
  EXPECT_EQ(parse_integer(" 89999999 "), 89999999);
  EXPECT_EQ(parse_integer("1.0+3"), 1000);
}

TEST(DeckNumber, IntegersKeepTheirRange) {
  EXPECT_EQ(parse_integer("2147483647"), 2147483647);
  EXPECT_FALSE(parse_integer("2147483648").has_value());
  EXPECT_EQ(parse_integer("-2147483647"), -2147483647);
  EXPECT_FALSE(parse_integer("-2147483648").has_value());  // the manual keeps sign and number apart
  EXPECT_FALSE(parse_integer("99999999999999999999").has_value());
  EXPECT_FALSE(parse_integer("2.5").has_value());
  EXPECT_FALSE(parse_integer("1-3").has_value());
  EXPECT_FALSE(parse_integer("x").has_value());
}

TEST(DeckNumber, LongTextsAreRefusedNotCut) {
  EXPECT_FALSE(parse_real(std::string(5000, '1')).has_value());
  EXPECT_FALSE(parse_integer(std::string(5000, '1')).has_value());
}

TEST(DeckNumber, FormattedNumbersFitAndReadBack) {
  for (const double value : {0.0, 1.0, -1.0, 7.83e-6, 207.0, -8333.0, 1e20, 1.0 / 3, 2.19e9,
                             0.49998, -123.45678901234, 1e-12, 12345678.0, 0.001, 1e28}) {
    const std::string text = format_real(value, 10);
    EXPECT_LE(text.size(), 10U);
    ASSERT_TRUE(parse_real(text).has_value()) << text;
    // Ten columns hold at least five digits of any of these.
    EXPECT_NEAR(*parse_real(text), value, 1e-5 * std::abs(value)) << text;
  }
  EXPECT_EQ(format_real(7.83e-6, 10), "7.83E-6");
  EXPECT_EQ(format_real(210.0, 10), "210.0");
}

TEST(DeckNumber, TwentyColumnsKeepFourteenDigits) {
  for (const double value : {1.0 / 3, -2.0 / 7 * 1e-9, 123456.78901234567, 6.02214076e23})
    EXPECT_NEAR(*parse_real(format_real(value, 20)), value, 1e-13 * std::abs(value));
}

TEST(DeckNumber, WhatNoFieldHoldsIsTheLargestNumber) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double value : {infinity, std::nan(""), 1.7976931348623157e308})
    EXPECT_EQ(format_real(value, 10), "1.7E+308");
  EXPECT_EQ(format_real(-infinity, 10), "-1.7E+308");
}

}  // namespace
}  // namespace crosswalk::fe
