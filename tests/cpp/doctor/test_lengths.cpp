// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "doctor/lengths.hpp"

namespace fragmotion {
namespace {

TEST(Lengths, NumbersHaveFewDigitsAndNoExponent) {
  EXPECT_EQ(short_number(6789.4), "6789");
  EXPECT_EQ(short_number(679.4), "679");
  EXPECT_EQ(short_number(67.94), "67.9");
  EXPECT_EQ(short_number(-1.5), "-1.5");
  EXPECT_EQ(short_number(100), "100");
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(0.00001234), "0.0000123");
}

TEST(Lengths, AreToldInTheUnitThatFits) {
  EXPECT_EQ(length_text(0.0213), "2.13 cm");
  EXPECT_EQ(length_text(0.25), "25 cm");
  EXPECT_EQ(length_text(67.894), "67.9 m");
  EXPECT_EQ(length_text(-3), "-3 m");
}

}  // namespace
}  // namespace fragmotion
