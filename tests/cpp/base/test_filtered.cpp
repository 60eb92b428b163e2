// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "base/filtered.hpp"

namespace fragmotion {
namespace {

TEST(Filter, IsWhatIsFilteredWhateverWasAskedForBefore) {
  Filter filter(0.12);
  for (const double seconds : {0.0, 0.02, 0.02, 0.01, 0.02, 0.0, 1.0})
    EXPECT_EQ(filter(seconds), filtered(seconds, 0.12)) << seconds;
}

}  // namespace
}  // namespace fragmotion
