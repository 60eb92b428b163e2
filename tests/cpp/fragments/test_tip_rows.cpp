// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.hpp"
#include "fragments/tip_rows.hpp"
#include "mocap_files.hpp"

namespace fragmotion {
namespace {

// Coordinates of one fragment, up to `size` m.
std::vector<float> random_row(Random& random, std::size_t width, double size) {
  std::vector<float> row(width);
  for (float& value : row) value = static_cast<float>(size * (2 * random.uniform() - 1));
  return row;
}

TEST(TipRows, KeepWhatTheyTakeToHalfAUnit) {
  Random random(1);
  TipRows rows(5, 13);
  EXPECT_EQ(rows.stride(), 16);
  for (const double size : {1e-3, 0.5, 3.0, 1e8}) {
    for (int i = 0; i < rows.count(); ++i) {
      const std::vector<float> from = random_row(random, rows.width(), size);
      rows.set(i, from.data());
      const std::vector<float> kept = rows.read(i);
      const double unit = rows.unit(i);
      EXPECT_LE(unit, 2 * size / 32767);
      for (std::size_t j = 0; j < from.size(); ++j) EXPECT_LE(std::abs(double{kept[j]} - from[j]), 0.5001 * unit);
      rows.set(i, kept.data());
      EXPECT_EQ(rows.read(i), kept);
    }
  }
}

TEST(TipRows, MeasureWhatIsKept) {
  Random random(2);
  TipRows rows(40, 21 * 16);
  const std::size_t stride = rows.stride();
  for (int i = 0; i < rows.count(); ++i) {
    const std::vector<float> from = random_row(random, rows.width(), 3), to = random_row(random, rows.width(), 3);
    rows.set(i, from.data());
    const std::vector<float> kept = rows.read(i);
    double sum = 0, exact = 0;
    for (std::size_t j = 0; j < stride; ++j) {
      const auto length = [&](const std::vector<float>& row) {
        return std::hypot(double{row[j]} - to[j], double{row[stride + j]} - to[stride + j],
                          double{row[2 * stride + j]} - to[2 * stride + j]);
      };
      sum += length(kept);
      exact += length(from);
    }
    EXPECT_NEAR(rows.distance(i, to.data()), sum, 1e-6 * sum);
    EXPECT_NEAR(rows.distance(i, to.data()), exact, rows.rounding());
    EXPECT_EQ(rows.distance(i, kept.data()), 0);
  }
}

TEST(TipRows, AreOfAnySizeAndBlurNoOther) {
  TipRows rows(4, 8);
  std::vector<float> row(rows.width(), 0);
  rows.set(0, row.data());
  EXPECT_EQ(rows.read(0), row);
  row[3] = 1e9F;
  rows.set(1, row.data());
  row[3] = 1e-39F;
  rows.set(2, row.data());
  EXPECT_NEAR(rows.read(2)[3], 1e-39F, 1e-43F);
  row[3] = -0.25F, row[4] = 0.125F;
  rows.set(3, row.data());
  EXPECT_NEAR(rows.read(3)[4], 0.125, 4e-6);
  rows.set(1, std::vector<float>(rows.width(), 0).data());
  EXPECT_EQ(rows.read(1), std::vector<float>(rows.width(), 0));
  EXPECT_TRUE(rows.some({3, 3}) == rows.some({3, 3}));
  EXPECT_FALSE(rows.some({3, 2}) == rows.some({3, 3}));
}

TEST(TipRows, RefuseCoordinatesThatAreOutOfAllProportion) {
  TipRows rows(9, 2);
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float coordinate : {std::nanf(""), infinite, -infinite, 1e25F}) {
    std::vector<float> row(rows.width(), 1);
    row[5] = coordinate;
    const std::string error = error_of([&] { rows.set(7, row.data()); });
    EXPECT_NE(error.find("fragment 7"), std::string::npos) << coordinate;
    EXPECT_NE(error.find("coordinate"), std::string::npos) << coordinate;
    EXPECT_EQ(rows.read(7), std::vector<float>(rows.width(), 0));
  }
}

}  // namespace
}  // namespace fragmotion
