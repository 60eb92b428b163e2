// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "policy/repair.hpp"
#include "random_quality.hpp"

namespace fragmotion {
namespace {

enum : int { stand, forward, back, jump, kClasses };

// Classes that stand, go forward and backward at a walk, and hop on the spot.
struct Acts {
  ControlSpace space;
  Quality quality{kClasses, std::vector<double>(kClasses* kClasses, 0.5),
                  std::vector<double>(kClasses* std::size_t{kPaperPoints}, 0.5)};
  std::vector<Control> evident{{0, 0, 0, 0}, {0, 1.2, 0, 0}, {0, -1.2, 0, 0}, {0, 0, 0, 1}};

  Policy repaired(Policy policy) const {
    repair_policy(policy, quality, space, evident);
    return policy;
  }
};

// Leads to every class from each, by turns over the controls.
Policy any_policy() {
  Policy policy{"any", kClasses, std::vector<int>(kClasses * std::size_t{kPaperPoints})};
  for (std::size_t i = 0; i < policy.next.size(); ++i) policy.next[i] = static_cast<int>(i % kClasses);
  return policy;
}

TEST(RepairPolicy, JumpsWhereAJumpIsAskedForAndNowhereElse) {
  const Acts acts;
  const Policy policy = acts.repaired(any_policy());
  for (int from = 0; from < kClasses; ++from) {
    for (int c = 0; c < kPaperPoints; ++c) {
      EXPECT_EQ(policy(from, c) == jump, acts.space.point(c).jumps()) << from << " at control " << c;
    }
  }
}

TEST(RepairPolicy, DoesNotTurnBackFromWhereItIsToGo) {
  const Acts acts;
  const Policy policy = acts.repaired(any_policy());
  for (int c = 0; c < kPaperPoints; ++c) {
    if (acts.space.point(c).y > 0) EXPECT_NE(policy(forward, c), back) << "at control " << c;
    if (acts.space.point(c).y < 0) EXPECT_NE(policy(back, c), forward) << "at control " << c;
  }
}

TEST(RepairPolicy, TakesTheBestClassThatSuits) {
  Acts acts;
  Policy policy = any_policy();
  const int ahead = acts.space.nearest({0, 1.2, 0, 0});
  policy.next[forward * kPaperPoints + ahead] = back;
  acts.quality.match[std::size_t{stand} * kPaperPoints + ahead] = 0.6;
  EXPECT_EQ(acts.repaired(policy)(forward, ahead), stand);
  acts.quality.match[std::size_t{forward} * kPaperPoints + ahead] = 0.7;
  EXPECT_EQ(acts.repaired(policy)(forward, ahead), forward);
}

TEST(RepairPolicy, LeadsToNoClassThatTheTableDoesNotLeadTo) {
  const Acts acts;
  Policy policy = any_policy();
  for (int& next : policy.next) next = next == jump ? stand : next;
  EXPECT_FALSE(acts.repaired(policy).leads_to(jump));
}

TEST(RepairPolicy, LeavesWhatIsRepaired) {
  const ControlSpace space;
  Random random(4);
  for (int n = 0; n < 20; ++n) {
    const int classes = 2 + random.below(9);
    const Quality quality = random_quality(random, classes);
    std::vector<Control> evident;
    for (int k = 0; k < classes; ++k) evident.push_back(space.point(random.below(kPaperPoints)));
    Policy policy{"random", classes, std::vector<int>(static_cast<std::size_t>(classes) * kPaperPoints)};
    for (int& next : policy.next) next = random.below(classes);
    repair_policy(policy, quality, space, evident);
    const std::vector<int> once = policy.next;
    repair_policy(policy, quality, space, evident);
    EXPECT_EQ(policy.next, once);
  }
}

}  // namespace
}  // namespace fragmotion
