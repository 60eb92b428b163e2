// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "policy/answer.hpp"
#include "policy/greedy.hpp"
#include "random_quality.hpp"

namespace fragmotion {
namespace {

const Control kAhead{0, 1.2, 0, 0};

// Random qualities, evident controls, tables and stands in between.
struct Tables {
  ControlSpace space;
  Quality quality;
  std::vector<Control> evident;
  std::vector<int> bridges, strikes;
  Policy policy;

  Tables(Random& random, int classes, bool bridged) : quality(random_quality(random, classes)) {
    for (int k = 0; k < classes; ++k) evident.push_back(space.point(random.below(kPaperPoints)));
    for (int k = 0; k < classes; ++k) strikes.push_back(random.below(5) - 1);
    for (int i = 0; i < classes * classes; ++i) bridges.push_back(bridged ? random.below(5 * classes) : -1);
    for (int& bridge : bridges) bridge = bridge < classes ? bridge : -1;
    policy = {"random", classes, std::vector<int>(static_cast<std::size_t>(classes) * kPaperPoints)};
    for (int& next : policy.next) next = random.below(classes);
  }

  void answer() { answer_motion(policy, quality, space, evident, bridges, strikes); }

  // Where the control, held, leads to from a class: what plays again and again.
  std::vector<int> cycle(int from, int control) const {
    std::vector<int> way;
    while (std::find(way.begin(), way.end(), from) == way.end()) way.push_back(from), from = policy(from, control);
    return {std::find(way.begin(), way.end(), from), way.end()};
  }

  Control mean(const std::vector<int>& classes) const {
    Control mean;
    for (const int k : classes) {
      mean.x += evident[k].x / static_cast<double>(classes.size());
      mean.y += evident[k].y / static_cast<double>(classes.size());
    }
    return mean;
  }
};

TEST(Answers, GoesAtHalfTheSpeedWithin45DegreesWithoutAJump) {
  EXPECT_TRUE(answers(kAhead, kAhead));
  EXPECT_TRUE(answers({0, 0.6, 0, 0}, kAhead));
  EXPECT_TRUE(answers({0.9, 0.91, 1, 0}, kAhead));
  EXPECT_TRUE(answers({0, 3, 0, 0}, kAhead));
  EXPECT_FALSE(answers({0, 0.59, 0, 0}, kAhead));
  EXPECT_FALSE(answers({0.91, 0.9, 0, 0}, kAhead));
  EXPECT_FALSE(answers({0, -1.2, 0, 0}, kAhead));
  EXPECT_FALSE(answers({0, 0, 0, 0}, kAhead));
  EXPECT_FALSE(answers({0, 1.2, 0, 1}, kAhead));
}

TEST(AnswerMotion, LeadsFromEveryClassToMotionThatIsAskedFor) {
  Random random(7);
  for (int n = 0; n < 60; ++n) {
    Tables tables(random, 1 + random.below(12), false);
    tables.answer();
    const std::vector<int> performed = answered_controls(tables.quality, tables.space, tables.evident);
    for (int c = 0; c < kPaperPoints; ++c) {
      const Control& wanted = tables.space.point(performed[c]);
      const auto does = [&](const Control& evident) { return answers(evident, wanted); };
      const bool asks = wanted.speed() > 0 && !wanted.jumps();
      if (!asks || std::none_of(tables.evident.begin(), tables.evident.end(), does)) continue;
      for (int from = 0; from < tables.policy.classes; ++from) {
        EXPECT_TRUE(does(tables.mean(tables.cycle(from, c)))) << "from " << from << " at control " << c;
      }
    }
  }
}

// Or the body glides, or hops on one leg.
TEST(AnswerMotion, LeadsToWhereEachFootComesDown) {
  constexpr int kBoth = 3;
  Random random(13);
  int stepping = 0;
  for (int n = 0; n < 60; ++n) {
    Tables tables(random, 2 + random.below(20), false);
    for (int& feet : tables.strikes) feet = std::max(feet, 0);
    tables.strikes[0] = kBoth;
    tables.answer();
    const std::vector<int> performed = answered_controls(tables.quality, tables.space, tables.evident);
    for (int c = 0; c < kPaperPoints; ++c) {
      const Control& wanted = tables.space.point(performed[c]);
      if (wanted.speed() == 0 || wanted.jumps()) continue;
      int feet = 0;
      for (std::size_t k = 0; k < tables.evident.size(); ++k)
        feet |= answers(tables.evident[k], wanted) ? tables.strikes[k] : 0;
      if (feet != kBoth) continue;
      for (int from = 0; from < tables.policy.classes; ++from) {
        int in_cycle = 0;
        for (const int k : tables.cycle(from, c)) in_cycle |= tables.strikes[k];
        EXPECT_EQ(in_cycle, kBoth) << "from " << from << " at control " << c;
        ++stepping;
      }
    }
  }
  EXPECT_GT(stepping, 1000);
}

TEST(AnswerMotion, DoesTheNearestThatThereIsForWhatThereIsNot) {
  Random random(8);
  Tables tables(random, 3, false);
  tables.evident = {{}, {0, 1.2, 0, 0}, {0, -1.2, 0, 0}};
  std::fill(tables.policy.next.begin(), tables.policy.next.end(), 0);
  tables.answer();
  const ControlSpace& space = tables.space;
  const std::vector<int> performed = answered_controls(tables.quality, space, tables.evident);
  const int run = space.nearest({0, 3.3, 0, 0}), walk = space.nearest(kAhead);
  EXPECT_EQ(performed[walk], walk);
  EXPECT_EQ(performed[run], walk);
  EXPECT_EQ(performed[space.nearest({})], space.nearest({}));
  for (int from = 0; from < 3; ++from) {
    EXPECT_EQ(tables.policy(from, run), tables.policy(from, walk));
    EXPECT_EQ(tables.cycle(from, run), std::vector<int>{1});
  }
}

TEST(AnswerMotion, LeadsFromEveryClassToAStandThatIsAskedFor) {
  Random random(12);
  for (int n = 0; n < 60; ++n) {
    Tables tables(random, 1 + random.below(12), false);
    const ControlSpace& space = tables.space;
    const auto stands = [&](const Control& evident) {
      return !evident.jumps() && !space.asks_to_go(evident) && evident.turn == 0;
    };
    tables.answer();
    if (std::none_of(tables.evident.begin(), tables.evident.end(), stands)) continue;
    for (int from = 0; from < tables.policy.classes; ++from) {
      const std::vector<int> cycle = tables.cycle(from, space.nearest({}));
      double speeds = 0, turns = 0;
      for (const int k : cycle) speeds += tables.evident[k].speed(), turns += std::abs(tables.evident[k].turn);
      EXPECT_LT(turns, 0.5 * static_cast<double>(cycle.size())) << "from " << from;
      EXPECT_FALSE(space.asks_to_go({0, speeds / static_cast<double>(cycle.size()), 0, 0})) << "from " << from;
    }
  }
}

TEST(AnswerMotion, LeavesTurnsOnTheSpotAndJumpsAndWhatIsAnswered) {
  Random random(9);
  for (int n = 0; n < 20; ++n) {
    Tables tables(random, 2 + random.below(9), true);
    const Policy before = tables.policy;
    tables.answer();
    for (int from = 0; from < before.classes; ++from) {
      for (int c = 0; c < kPaperPoints; ++c) {
        const Control& wanted = tables.space.point(c);
        if ((wanted.speed() > 0 || wanted.turn == 0) && !wanted.jumps()) continue;
        EXPECT_EQ(tables.policy(from, c), before(from, c)) << c;
      }
    }
    const std::vector<int> once = tables.policy.next;
    tables.answer();
    EXPECT_EQ(tables.policy.next, once);
  }
}

TEST(AnswerMotion, PlaysNoClassThatIsLeftOut) {
  Random random(10);
  Tables tables(random, 4, false);
  tables.evident = {{}, {0, 1.2, 0, 0}, {0, 1.2, 0, 0}, {}};
  std::fill_n(&tables.quality.match[std::size_t{1} * kPaperPoints], kPaperPoints, 0.0);
  std::fill(tables.policy.next.begin(), tables.policy.next.end(), 0);
  tables.answer();
  EXPECT_FALSE(tables.policy.leads_to(1));
  EXPECT_EQ(tables.policy(0, tables.space.nearest(kAhead)), 2);
}

// The best next class by Eq. 2 is to stay, which joins perfectly: 1 * .196 > .173 * .366.
TEST(AnswerMotion, EndsAStandThatGreedyPrefersForEver) {
  const int stand = 0, walk = 1;
  Random random(11);
  Tables tables(random, 2, false);
  tables.evident = {{}, kAhead};
  tables.strikes[walk] = 3;
  tables.quality.smoothness = {1, 0.173, 0.173, 1};
  const int ahead = tables.space.nearest(kAhead);
  std::fill_n(&tables.quality.match[0], kPaperPoints, 0.196);
  std::fill_n(&tables.quality.match[kPaperPoints], kPaperPoints, 0.366);
  tables.policy = greedy_policy(tables.quality);
  ASSERT_EQ(tables.policy(stand, ahead), stand);
  tables.answer();
  EXPECT_EQ(tables.policy(stand, ahead), walk);
  EXPECT_EQ(tables.policy(stand, tables.space.nearest({})), stand);
}

}  // namespace
}  // namespace fragmotion
