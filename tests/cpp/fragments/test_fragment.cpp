// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "fragments/fragment.hpp"

namespace fragmotion {
namespace {

TEST(Origin, HasAName) {
  EXPECT_STREQ(origin_name(Origin::captured), "captured");
  EXPECT_STREQ(origin_name(Origin::mirrored), "mirrored");
  EXPECT_STREQ(origin_name(Origin::interpolated), "interpolated");
  EXPECT_STREQ(origin_name(Origin::transformed), "transformed");
}

}  // namespace
}  // namespace fragmotion
