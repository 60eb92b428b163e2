// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "build/exclude_classes.hpp"
#include "character/policy_file.hpp"
#include "evaluate/explain.hpp"
#include "runtime/player.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

constexpr int kPoints = kPaperPoints;

// The classes that the driving table says most often.
std::vector<int> popular(const Character& c, int count) {
  std::vector<int> uses(c.classes.count, 0), order(c.classes.count);
  for (const int next : c.policy().next) ++uses[next];
  for (int k = 0; k < c.classes.count; ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return uses[a] > uses[b]; });
  order.resize(count);
  return order;
}

bool among(const std::vector<int>& classes, int k) {
  return std::find(classes.begin(), classes.end(), k) != classes.end();
}

TEST(WithoutClasses, TakesTheBestOfTheOthersAndChangesNothingElse) {
  const auto whole = gait_character();
  const std::vector<int> excluded = popular(*whole, 5);
  Character expected = *whole;
  for (Policy& policy : expected.policies) {
    const Explainer explain(whole, policy.name);
    for (int from = 0; from < policy.classes; ++from) {
      for (int control = 0; control < kPoints; ++control) {
        int& next = policy.next[static_cast<std::size_t>(from) * kPoints + control];
        if (!among(excluded, next)) continue;
        const std::vector<Alternative> ranked = explain(from, control);
        next = std::find_if(ranked.begin(), ranked.end(), [&](const Alternative& each) {
                 return !among(excluded, each.next);
               })->next;
      }
    }
  }
  repair_policies(expected);
  const Character left = without_classes(*whole, excluded);
  for (const Policy& policy : expected.policies) EXPECT_EQ(left.policy(policy.name).next, policy.next) << policy.name;
}

// What a player of ten thousand random controls has played.
std::vector<int> played(const std::shared_ptr<const Character>& character) {
  PlayerOptions at_once;
  at_once.seed = 3;
  at_once.responsiveness = 1;
  Player player(character, at_once);
  Random random(5);
  std::vector<int> classes{player.playing_class()};
  for (int i = 0; i < 10000; ++i) {
    player.step(character->space.point(random.below(kPoints)), 0.1);
    classes.push_back(player.playing_class());
  }
  return classes;
}

TEST(WithoutClasses, NeverPlaysAnExcludedOneNotEvenStanding) {
  const auto whole = gait_character();
  std::vector<int> excluded = popular(*whole, 8);
  excluded.push_back(Player(whole).playing_class());
  const std::vector<int> before = played(whole);
  const auto left = std::make_shared<Character>(without_classes(*whole, excluded));
  const std::vector<int> after = played(left);
  for (const int k : excluded) {
    EXPECT_TRUE(among(before, k)) << k;
    EXPECT_FALSE(among(after, k)) << k;
  }
}

TEST(WithoutClasses, StandsInPlaceByNoExcludedOne) {
  Character whole = *gait_character();
  std::fill(whole.bridges.begin(), whole.bridges.end(), 4);
  EXPECT_FALSE(among(without_classes(whole, {4}).bridges, 4));
}

TEST(WithoutClasses, OfNoneIsTheSame) {
  EXPECT_EQ(to_bytes(without_classes(*gait_character(), {})), to_bytes(*gait_character()));
}

TEST(WithoutClasses, IsAPolicyFileLikeAnyOther) {
  const Character left = without_classes(*gait_character(), {1, 2, 3});
  EXPECT_EQ(to_bytes(from_bytes(to_bytes(left))), to_bytes(left));
}

TEST(WithoutClasses, RefusesAllAndWhatDoesNotExist) {
  const auto character = gait_character();
  std::vector<int> all;
  for (int k = 0; k < character->classes.count; ++k) all.push_back(k);
  EXPECT_THROW(without_classes(*character, all), std::invalid_argument);
  EXPECT_THROW(without_classes(*character, {-1}), std::invalid_argument);
  EXPECT_THROW(without_classes(*character, {character->classes.count}), std::invalid_argument);
}

}  // namespace
}  // namespace fragmotion
