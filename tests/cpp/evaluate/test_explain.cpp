// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "evaluate/explain.hpp"
#include "policy/anticipate.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

constexpr int kPoints = kPaperPoints;

TEST(Explainer, RanksEveryClassOnceByItsValue) {
  const auto character = gait_character();
  const Explainer explain(character);
  for (int control = 0; control < kPoints; control += 17) {
    const std::vector<Alternative> ranked = explain(3, control);
    std::set<int> classes;
    for (std::size_t i = 0; i < ranked.size(); ++i) {
      classes.insert(ranked[i].next);
      EXPECT_NEAR(ranked[i].smoothness * ranked[i].match, character->quality(3, ranked[i].next, control), 1e-12);
      if (i > 0) {
        EXPECT_GE(ranked[i - 1].value(), ranked[i].value());
      }
    }
    EXPECT_EQ(static_cast<int>(classes.size()), character->classes.count);
  }
}

// The traces that taught gait_character(), as control indices.
std::vector<std::vector<int>> gait_traces(const ControlSpace& space) {
  const ControlSpace standard;
  return {snap(space, simulate_trace("explorer", 30, 1, standard)),
          snap(space, simulate_trace("walker", 30, 2, standard))};
}

TEST(Explainer, ShowsThatAnticipateTakesTheBest) {
  const auto character = std::make_shared<Character>(*gait_character());
  const Policy anticipated = anticipate_policy(character->quality, gait_traces(character->space));  // not repaired
  character->policies = {anticipated};
  const Explainer explain(character);
  for (int from = 0; from < character->classes.count; ++from) {
    for (int control = 0; control < kPoints; ++control) {
      const std::vector<Alternative> ranked = explain(from, control);
      const int chosen = anticipated(from, control);
      for (const Alternative& each : ranked) {
        if (each.next == chosen) {
          EXPECT_NEAR(each.value(), ranked[0].value(), 2e-3) << from << " " << control;
        }
      }
    }
  }
}

// Plays the policy against controls drawn from the model.
double played(const Character& c, const Policy& policy, int now, int control, Random& random) {
  double sum = 0, weight = 1;
  for (int step = 0; step < 120; ++step) {
    double rest = random.uniform();
    int next = 0;
    while (next < kPoints - 1 && (rest -= c.control_model[control * kPoints + next]) > 0) ++next;
    control = next;
    weight *= 0.9;
    const int following = policy(now, control);
    sum += weight * c.quality(now, following, control);
    now = following;
  }
  return sum;
}

TEST(Explainer, ExpectsWhatPlayingGivesOnAverage) {
  const auto character = gait_character();
  const std::vector<Alternative> ranked = Explainer(character, "svm")(0, 10);
  Random random(3);
  for (const std::size_t rank : {0, 20, 39}) {
    double mean = 0;
    for (int n = 0; n < 4000; ++n) {
      mean += played(*character, character->policy("svm"), ranked[rank].next, 10, random) / 4000;
    }
    EXPECT_NEAR(ranked[rank].future_value, mean, 0.02 * mean);
  }
}

TEST(Explainer, NamesTheFragmentsOfTheGreatestQuality) {
  const auto character = gait_character();
  const Explainer explain(character);
  const auto members = character->classes.members();
  const Trajectories t = trajectories(character->pool);
  const int from = 5, control = 20;
  const auto quality = [&](int f) {
    const double off = character->space.distance(character->pool.fragments[f].evident, character->space.point(control));
    return 1 / (1 + off) / (1 + transition_distance(t, character->classes.representatives[from], f));
  };
  for (const Alternative& each : explain(from, control)) {
    const std::vector<int>& all = members[each.next];
    ASSERT_EQ(each.fragments.size(), std::min<std::size_t>(kNearest, all.size()));
    int better = 0;
    for (const int f : all) better += quality(f) > quality(each.fragments.back()) * (1 + 1e-6) ? 1 : 0;
    EXPECT_LT(better, kNearest);
    EXPECT_TRUE(std::is_sorted(each.fragments.begin(), each.fragments.end(),
                               [&](int f, int g) { return quality(f) > quality(g) * (1 + 1e-6); }));
  }
}

TEST(Explainer, RefusesWhatDoesNotExist) {
  const Explainer explain(gait_character());
  EXPECT_THROW(explain(-1, 0), std::invalid_argument);
  EXPECT_THROW(explain(40, 0), std::invalid_argument);
  EXPECT_THROW(explain(0, kPoints), std::invalid_argument);
  EXPECT_THROW(Explainer(gait_character(), "wise"), std::invalid_argument);
}

}  // namespace
}  // namespace fragmotion
