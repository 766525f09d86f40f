#include "common/interrupt.h"

#include <csignal>

#include <gtest/gtest.h>

namespace crosswalk {
namespace {

// In a child, because the flag stays up for the rest of the process.
TEST(InterruptDeathTest, FirstSignalRaisesTheFlagSecondEndsTheProcess) {
  EXPECT_EXIT(
      {
        catch_interrupts();
        if (is_interrupted()) std::_Exit(1);
        std::raise(SIGTERM);
        if (!is_interrupted()) std::_Exit(2);
        std::raise(SIGTERM);
        std::_Exit(3);
      },
      testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace crosswalk
