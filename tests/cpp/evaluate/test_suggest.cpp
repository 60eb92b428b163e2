// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "build/build.hpp"
#include "control/simulated_players.hpp"
#include "evaluate/performance.hpp"
#include "evaluate/suggest.hpp"
#include "runtime/player.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

Trace minute() { return simulate_trace("explorer", 60, 1, ControlSpace()); }

TEST(SuggestClasses, TakesTheFewestThatFollowTheStickAsWellAsAny) {
  const Suggestion suggestion = suggest_classes(humanoid(), gait_takes(), {minute()});
  ASSERT_GE(suggestion.tried.size(), 3u);
  double least = 1e9;
  for (const ClassesTried& each : suggestion.tried) least = std::min(least, each.velocity_error);
  for (const ClassesTried& each : suggestion.tried) {
    EXPECT_TRUE(each.quality > 0 && each.quality < 1);
    if (each.classes < suggestion.classes) {
      EXPECT_GT(each.velocity_error, 1.05 * least);
    }
    if (each.classes == suggestion.classes) {
      EXPECT_LE(each.velocity_error, 1.05 * least);
    }
  }
}

TEST(SuggestClasses, JudgesTheCharacterThatABuildOfThatManyClassesGives) {
  const ClassesTried tried = suggest_classes(humanoid(), gait_takes(), {minute()}).tried[1];
  BuildOptions options;
  options.classes = tried.classes;
  const auto character = std::make_shared<const Character>(build(humanoid(), gait_takes(), {minute()}, options));
  double quality = 0;
  for (const std::string& name : simulated_players()) {
    quality += perform(Player(character), simulate_trace(name, 60, 7, character->space), 30).quality / 8;
  }
  EXPECT_NEAR(tried.quality, quality, 1e-12);
}

TEST(SuggestClasses, ContentsItselfWithFewFragments) {
  const std::vector<Clip> takes{gait_takes().front()};
  BuildOptions options;
  options.mirror = options.synthesize = false;
  const Suggestion suggestion = suggest_classes(humanoid(), takes, {minute()}, options);
  ASSERT_EQ(suggestion.tried.size(), 1u);
  EXPECT_EQ(suggestion.classes, suggestion.tried[0].classes);
  EXPECT_GE(suggestion.classes, 1);
}

TEST(SuggestClasses, CanBeCancelled) {
  const Progress at_once = [](double fraction, const std::string&) { return fraction < 0.5; };
  EXPECT_THROW(suggest_classes(humanoid(), gait_takes(), {minute()}, {}, at_once), Cancelled);
}

}  // namespace
}  // namespace fragmotion
