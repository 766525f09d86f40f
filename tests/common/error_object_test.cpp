#include "common/error_object.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace crosswalk {
namespace {

TEST(ErrorObject, HoldsCodeAndMessageOnly) {
  const auto object = nlohmann::json::parse(error_object("no_overlap", "a \"b\"\nc"));
  EXPECT_EQ(object, (nlohmann::json{{"error", "no_overlap"}, {"message", "a \"b\"\nc"}}));
}

TEST(ErrorObject, IsSoundWhateverBytesAFileNameHolds) {
  const auto object = nlohmann::json::parse(error_object("input", "caf\xE9.csv"));
  EXPECT_EQ(object["message"], "caf\uFFFD.csv");
}

}  // namespace
}  // namespace crosswalk
