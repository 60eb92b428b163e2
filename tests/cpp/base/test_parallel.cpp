// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <system_error>

#include "base/parallel.hpp"

namespace fragmotion {
namespace {

std::vector<int> visits(int count, int threads) {
  std::vector<int> visits(count, 0);
  parallel_for(count, threads, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) ++visits[i];
  });
  return visits;
}

// While it lives no thread can be started: each would ask for more stack than there is memory to address.
class NoMoreThreads {
 public:
  NoMoreThreads() {
    pthread_getattr_default_np(&before_);
    pthread_attr_t huge;
    pthread_attr_init(&huge);
    pthread_attr_setstacksize(&huge, std::size_t{1} << 60);
    pthread_setattr_default_np(&huge);
    pthread_attr_destroy(&huge);
  }
  NoMoreThreads(const NoMoreThreads&) = delete;
  NoMoreThreads& operator=(const NoMoreThreads&) = delete;
  ~NoMoreThreads() {
    pthread_setattr_default_np(&before_);
    pthread_attr_destroy(&before_);
  }

 private:
  pthread_attr_t before_;
};

TEST(ParallelFor, VisitsEveryIndexOnce) {
  for (const int count : {0, 1, 2, 7, 1000}) {
    for (const int threads : {-1, 0, 1, 2, 3, 16, 5000}) EXPECT_EQ(visits(count, threads), std::vector<int>(count, 1));
  }
}

TEST(ParallelFor, RunsTheFirstPartOnTheCallingThread) {
  std::thread::id first;
  parallel_for(8, 4, [&](int begin, int) {
    if (begin == 0) first = std::this_thread::get_id();
  });
  EXPECT_EQ(first, std::this_thread::get_id());
}

TEST(ParallelFor, StartsNoMoreThreadsThanAreSane) {
  std::atomic<int> parts{0};
  parallel_for(1'000'000, 1'000'000, [&](int, int) { ++parts; });
  EXPECT_LE(parts, kMostThreads);
  EXPECT_LE(thread_count(1'000'000), kMostThreads);
  EXPECT_GE(thread_count(0), 1);
  EXPECT_GE(thread_count(-5), 1);
}

TEST(ParallelFor, DoesTheWorkItselfWhereNoThreadCanBeStarted) {
  const NoMoreThreads limit;
  EXPECT_THROW(std::thread([] {}).join(), std::system_error);
  EXPECT_EQ(visits(100, 4), std::vector<int>(100, 1));
}

TEST(ParallelFor, ThrowsTheLowestPartsException) {
  for (const int threads : {1, 3}) {
    try {
      parallel_for(3, threads, [](int begin, int end) {
        for (int i = begin; i < end; ++i) throw std::runtime_error(std::to_string(i));
      });
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "0");
    }
  }
}

TEST(ParallelMap, ReturnsWhatIsMadeOfEachIndexInOrder) {
  for (const int threads : {1, 3, 16}) {
    EXPECT_EQ(parallel_map(5, threads, [](int i) { return std::to_string(i * i); }),
              (std::vector<std::string>{"0", "1", "4", "9", "16"}));
  }
  EXPECT_TRUE(parallel_map(0, 3, [](int i) { return i; }).empty());
}

TEST(ParallelMap, LetsOthersGoOnWhileOneLasts) {
  std::atomic<int> made{0};
  parallel_map(8, 2, [&](int i) {
    while (i == 0 && made < 7) std::this_thread::yield();
    return ++made;
  });
  EXPECT_EQ(made, 8);
}

TEST(ParallelMap, ThrowsTheFirstException) {
  for (const int threads : {1, 3}) {
    try {
      parallel_map(8, threads, [](int i) { return i < 2 ? i : throw std::runtime_error(std::to_string(i)); });
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "2");
    }
  }
}

}  // namespace
}  // namespace fragmotion
