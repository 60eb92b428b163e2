// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "examined_walks.hpp"

namespace fragmotion {
namespace {

/// To and fro through a walk.
Take long_walk(int frames) {
  const Take once = walk();
  std::vector<int> order;
  for (int f = 0, step = 1; static_cast<int>(order.size()) < frames; f += step) {
    order.push_back(f);
    if (f + step < 0 || f + step >= once.frames) step = -step;
  }
  return picked(once, order);
}

// Longer than what is looked at in one piece.
TEST(Doctor, LosesNothingWhereThePiecesOfALongTakeMeet) {
  const Take clean = long_walk(9000);
  EXPECT_EQ(codes_of(clean), std::vector<std::string>{});
  for (const int at : {4095, 4096, 8190, 8191}) {
    Take torn = clean;
    for (int f = at; f < torn.frames; ++f) place(torn, f)[0] += 3;
    const std::vector<Finding> findings = findings_of(torn);
    ASSERT_EQ(codes_of(torn), std::vector<std::string>{"jump"}) << at;
    EXPECT_EQ(findings[0].begin, at - 1);
    EXPECT_EQ(findings[0].end, at);
    Take high = clean;
    for (int f = 0; f < high.frames; ++f) place(high, f)[2] += 0.3;
    for (int i = 0; i < 4; ++i) rotation(high, at, "spine")[i] = i == 1 ? 1 : 0;
    const std::vector<Finding> both = findings_of(high);
    EXPECT_EQ(codes_of(high), (std::vector<std::string>{"flip", "ground"})) << at;
    const Take mended = mend(high, both);
    EXPECT_EQ(codes_of(mended), std::vector<std::string>{});
    expect_near(mended, clean, 0.02);
  }
}

TEST(Doctor, IsStoppedInTheMiddleOfATakeOnAnyThread) {
  const std::vector<Take> takes = {walk(), long_walk(9000)};
  for (const int threads : {1, 2}) {
    int reports = 0;
    double last = 0;
    examine(takes, threads, [&](double fraction, const std::string&) {
      EXPECT_GE(fraction, last);
      EXPECT_LE(fraction, 1);
      last = fraction;
      return ++reports, true;
    });
    EXPECT_EQ(last, 1);
    int heard = 0;
    EXPECT_THROW(examine(takes, threads, [&](double, const std::string&) { return ++heard < 3; }), Cancelled);
    EXPECT_EQ(heard, 3);
    EXPECT_GT(reports, threads == 1 ? 50 : 0);
  }
  Take high = takes[1];
  for (int f = 0; f < high.frames; ++f) place(high, f)[2] += 0.3;
  int heard = 0;
  EXPECT_THROW(mend(high, findings_of(high), [&](double, const std::string&) { return ++heard < 3; }), Cancelled);
}

}  // namespace
}  // namespace fragmotion
