#include "common/protocol.h"

#include <regex>

#include <gtest/gtest.h>

namespace crosswalk {
namespace {

TEST(Protocol, ChannelNamesAreUniquePerKindAndRoleAndMatchTheirPatterns) {
  const std::int64_t run = run_digest("v2370-1");
  std::vector<std::string> seen;
  for (const KindRule& rule : kind_rules()) {
    for (const Role role : {Role::Coupler, Role::Mb, Role::Fe, Role::Recorder}) {
      const std::string name = channel_name(run, rule.kind, role);
      EXPECT_LE(name.size(), 63U) << "longest channel LCM accepts";
      EXPECT_EQ(std::count(seen.begin(), seen.end(), name), 0);
      seen.push_back(name);
      EXPECT_TRUE(std::regex_match(name, std::regex(channel_pattern(run, rule.kind))));
      EXPECT_TRUE(std::regex_match(name, std::regex(channel_pattern(run))));
      EXPECT_FALSE(std::regex_match(name, std::regex(channel_pattern(run_digest("other")))));
    }
  }
}

TEST(Protocol, DigestIsFnv1a) {
  EXPECT_EQ(fnv1a(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(fnv1a("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(fnv1a("foobar"), 0x85944171f73967e8ULL);
}

TEST(Protocol, EveryRunHasItsOwnPortInTheStatedRange) {
  EXPECT_NE(default_port("a"), default_port("b"));
  for (const char* id : {"a", "b", "v2370-20261125"}) {
    EXPECT_GE(default_port(id), 20000);
    EXPECT_LT(default_port(id), 40000);
  }
}

}  // namespace
}  // namespace crosswalk
