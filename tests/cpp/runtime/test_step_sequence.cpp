// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "fragments/successors.hpp"
#include "runtime/step_sequence.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();

// The right foot stands, and has for so long; the left one is in the air.
StepSequence right_foot_stands(double since) { return {{false, true}, 1, since}; }

TEST(StepSequence, RemembersTheFootThatCameDownLast) {
  StepSequence steps{{true, true}, -1, 0};
  steps.advance({false, true}, 0.1);
  EXPECT_EQ(steps.last, -1);
  steps.advance({true, true}, 0.1);
  EXPECT_EQ(steps.last, 0);
  EXPECT_EQ(steps.since, 0);
  steps.advance({true, false}, 0.25);
  EXPECT_EQ(steps.last, 0);
  EXPECT_DOUBLE_EQ(steps.since, 0.25);
  steps.advance({true, true}, 0.1);
  EXPECT_EQ(steps.last, 1);
}

TEST(StepSequence, TakesFeetThatAlternateForInTurn) {
  EXPECT_EQ(steps_out_of_turn(right_foot_stands(0.3), {{false, true}, {0.1F, 0.6F}}), 0);
  EXPECT_EQ(steps_out_of_turn(right_foot_stands(0.3), {{true, true}, {1.0F, 0.5F}}), 0);
  EXPECT_EQ(steps_out_of_turn(right_foot_stands(0.3), {{false, true}, {0.1F, kNever}}), 0);
}

TEST(StepSequence, CountsTheSameFootAndQuickSteps) {
  EXPECT_EQ(steps_out_of_turn(right_foot_stands(0.3), {{false, true}, {0.6F, 0.1F}}), 1) << "the right foot again";
  EXPECT_EQ(steps_out_of_turn(right_foot_stands(0.05), {{false, true}, {0.1F, 0.6F}}), 1) << "too soon after it";
  EXPECT_EQ(steps_out_of_turn(right_foot_stands(0.3), {{false, true}, {0.2F, 0.1F}}), 2) << "again, and then quickly";
}

TEST(StepSequence, GivesAFootTimeToComeDownThatAFragmentBeginsWith) {
  EXPECT_EQ(steps_out_of_turn(right_foot_stands(0.1), {{true, false}, {1.0F, 0.5F}}), 1)
      << "too soon after the right one";
  EXPECT_EQ(steps_out_of_turn(right_foot_stands(0.2), {{true, false}, {1.0F, 0.5F}}), 0);
  EXPECT_EQ(steps_out_of_turn(right_foot_stands(0.3), {{true, false}, {1.0F, 0.3F}}), 1) << "the right one soon after";
}

TEST(StepSequence, KnowsNothingOfABodyThatHasTakenNoStepOrHasNoFeet) {
  EXPECT_EQ(steps_out_of_turn({}, {{true, false}, {0.1F, 0.1F}}), 0);
  EXPECT_EQ(steps_out_of_turn(right_foot_stands(0.3), {{}, {kNever, kNever}}), 0);
  EXPECT_EQ(standing_feet({}, 3), (std::array<bool, 2>{}));
}

// Against the contacts, frame by frame, along the fragments that follow each other.
TEST(StepSequence, FindsWhenFeetComeDownAfterAFragmentsBeginning) {
  const Character& c = *gait_character();
  const std::vector<EntrySteps> all = entry_steps(c, successors(c.pool.fragments));
  ASSERT_EQ(all.size(), c.pool.fragments.size());
  const std::vector<int> next = successors(c.pool.fragments);
  int comes_down = 0, comes_round = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Fragment& f = c.pool.fragments[i];
    for (int side = 0; side < 2; ++side) {
      const std::vector<bool>& stands = c.contacts[f.clip].feet[side];
      EXPECT_EQ(all[i].stands[side], stands[f.first_played()]);
      int at = f.first_played(), playing = static_cast<int>(i);
      const auto frames = static_cast<long>(stands.size());
      for (long wait = 1; wait < frames; ++wait) {
        if (at == c.pool.fragments[playing].last_played() && next[playing] >= 0) {
          playing = next[playing];
          comes_round += c.pool.fragments[playing].first_played() != at ? 1 : 0;
          at = c.pool.fragments[playing].first_played();
        }
        if (++at >= frames) break;
        if (!stands[at] || stands[at - 1]) continue;
        EXPECT_NEAR(all[i].strikes[side], wait / c.pool.clips[f.clip].rate, 1e-6) << i;
        ++comes_down;
        break;
      }
    }
  }
  EXPECT_GT(comes_round, 10);
  EXPECT_GT(comes_down, static_cast<int>(all.size()) / 2);
}

TEST(StepSequence, TellsHowLongTheStepsOfAFragmentTake) {
  const Character& c = *gait_character();
  const std::vector<double> seconds = step_seconds(c);
  ASSERT_EQ(seconds.size(), c.pool.fragments.size());
  int walking = 0;
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    const Fragment& f = c.pool.fragments[i];
    const std::string& name = c.pool.clips[f.clip].name;
    if (name == "stand") {
      EXPECT_EQ(seconds[i], kLongestStep);
    }
    if (f.origin != Origin::captured || (name != "walk" && name != "run")) continue;
    ++walking;
    EXPECT_NEAR(seconds[i], name == "walk" ? 0.5 : 0.3, 1 / c.pool.clips[f.clip].rate);  // of two in a Gait::cycle
  }
  EXPECT_GT(walking, 20);
}

}  // namespace
}  // namespace fragmotion
