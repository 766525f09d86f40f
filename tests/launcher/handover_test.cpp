#include "launcher/handover.h"

#include <gtest/gtest.h>

#include "common/error.h"

namespace crosswalk {
namespace {

TEST(Handover, CommandsFindTheirProgram) {
  EXPECT_EQ(program_for("rate", {}), "recorder");
  EXPECT_EQ(program_for("solve", {"x.k"}), "fe_node");
  EXPECT_EQ(program_for("model", {"v2370"}), "fe_node");
  EXPECT_EQ(program_for("bench", {}), "fe_node");
  EXPECT_EQ(program_for("bench", {"coupling"}), "coupler");
  EXPECT_EQ(program_for("check", {"--include-path", "meshes", "car.key"}), "fe_node");
  EXPECT_EQ(program_for("check", {"v2370.toml"}), "");
  EXPECT_EQ(program_for("check", {"v2370"}), "");
  EXPECT_EQ(program_for("run", {}), "");
  EXPECT_EQ(program_for("frobnicate", {}), "");
}

TEST(Handover, MissingProgramIsAUserError) {
  EXPECT_THROW(sibling_program("no_such_program"), UserError);
}

}  // namespace
}  // namespace crosswalk
