// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <new>
#include <utility>

#include "allocations.hpp"
#include "runtime/crowd.hpp"
#include "small_character.hpp"

std::atomic<std::size_t> fragmotion::allocations{0}, fragmotion::largest_allocation{0}, fragmotion::allocated_bytes{0};

namespace {

void* allocate(std::size_t size) {
  ++fragmotion::allocations;
  fragmotion::allocated_bytes += size;
  std::size_t largest = fragmotion::largest_allocation;
  while (size > largest && !fragmotion::largest_allocation.compare_exchange_weak(largest, size)) {
  }
  return std::malloc(size == 0 ? 1 : size);
}

}  // namespace

// Watches how much memory anything in this program asks for at once. Not inlined, or GCC takes free() for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  void* memory = allocate(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return allocate(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, const std::nothrow_t& /*tag*/) noexcept { std::free(memory); }

namespace fragmotion {
namespace {

std::size_t allocations_of(const std::function<void()>& work) {
  const std::size_t before = allocations;
  work();
  return allocations - before;
}

// Twenty seconds of any controls, steps of any length, and now and then a class that is forced.
void play(Player& player, Random& random) {
  const Character& c = player.character();
  for (int i = 0; i < 1000; ++i) {
    if (i % 50 == 0) player.force(random.below(c.classes.count));
    player.step(c.space.point(random.below(kPaperPoints)), 0.04 * random.uniform());
  }
}

TEST(Allocations, AreCounted) {
  EXPECT_EQ(allocations_of([] { std::vector<int>(5).swap(*std::make_unique<std::vector<int>>(3)); }), 3U);
  EXPECT_EQ(allocations_of([] {}), 0U);
}

TEST(Allocations, AreNoneInAPlayersSteps) {
  for (const Stitching stitching : {Stitching::inertialize, Stitching::crossfade}) {
    for (const auto& [lock_feet, far_away] : {std::pair{true, false}, {false, false}, {false, true}}) {
      PlayerOptions options;
      options.stitching = stitching;
      options.lock_feet = lock_feet;
      options.far_away = far_away;
      Player player(gait_character(), options);
      Random random(1);
      EXPECT_EQ(allocations_of([&] { play(player, random); }), 0U);
      EXPECT_EQ(allocations_of([&] { player.reset(); }), 0U);
    }
  }
}

TEST(Allocations, AreNoneInACrowdsStepsOnOneThread) {
  Crowd crowd(gait_character(), 20, {}, 1);
  Random random(2);
  std::vector<Control> controls(crowd.size());
  std::vector<double> roots(std::size_t{3} * crowd.size()), rotations(std::size_t{4} * crowd.bones() * crowd.size());
  const auto play = [&] {
    for (int i = 0; i < 300; ++i) {
      for (Control& control : controls) control = gait_character()->space.point(random.below(kPaperPoints));
      crowd.step(controls.data(), 1.0 / 60, roots.data(), rotations.data());
    }
  };
  EXPECT_EQ(allocations_of(play), 0U);
}

// A player of a crowd is small: what players share is not its own.
TEST(Allocations, GrowByFewKilobytesAPlayer) {
  const auto character = gait_character();
  const auto bytes = [&](int count) {
    const std::size_t before = allocated_bytes;
    const Crowd crowd(character, count, {}, 1);
    return allocated_bytes - before;
  };
  EXPECT_LT((bytes(2000) - bytes(1000)) / 1000, 2000U);
}

}  // namespace
}  // namespace fragmotion
