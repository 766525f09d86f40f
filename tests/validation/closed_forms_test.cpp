// The closed forms of `crosswalk validate head` and `windshield` hold: they are gates.
#include <filesystem>

#include <gtest/gtest.h>

#include "fe_node/validate/report.h"
#include "fe_node/validate/validate.h"

namespace crosswalk::fe::validate {
namespace {

void expect_gates(CaseResult (*run)(const CaseContext&), const char* name) {
  CaseContext context;
  context.folder = std::filesystem::path(testing::TempDir()) / name;
  const CaseResult result = run(context);
  for (const Measure& m : result.measures) {
    if (!m.is_gate()) continue;
    EXPECT_TRUE(m.is_inside()) << m.quantity << ": " << m.ours << ", closed form " << m.reference;
  }
  EXPECT_EQ(failed_gates({result}), 0);
}

TEST(ClosedForms, OscillatingBall) { expect_gates(sphere_torsion, "sphere_torsion"); }
TEST(ClosedForms, AcceleratedBall) { expect_gates(sphere_pressure, "sphere_pressure"); }
TEST(ClosedForms, MassOnAPlate) { expect_gates(plate_impedance, "plate_impedance"); }

}  // namespace
}  // namespace crosswalk::fe::validate
