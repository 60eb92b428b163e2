// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <atomic>

#include "base/memo.hpp"
#include "base/parallel.hpp"

namespace fragmotion {
namespace {

TEST(Memo, MakesOnceOfEachKeyWhoeverAsks) {
  for (const int threads : {1, 4}) {
    Memo<int, int> squares;
    std::atomic<int> made{0};
    const auto got = parallel_map(
        400, threads, [&](int i) { return &squares.get(i % 10, [&] { return ++made, i % 10 * (i % 10); }); });
    EXPECT_EQ(made, 10);
    for (int i = 0; i < 400; ++i) {
      EXPECT_EQ(got[i], got[i % 10]);
      EXPECT_EQ(*got[i], i % 10 * (i % 10));
    }
  }
}

}  // namespace
}  // namespace fragmotion
