// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "classes/clustering.hpp"
#include "mocap_files.hpp"
#include "policy/anticipate.hpp"
#include "policy/greedy.hpp"
#include "policy/optimal.hpp"
#include "policy/quality_table.hpp"
#include "random_quality.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

double path_quality(const Quality& quality, const std::vector<int>& path, const std::vector<int>& trace) {
  double sum = 0;
  for (std::size_t i = 0; i < trace.size(); ++i) sum += quality(path[i], path[i + 1], trace[i]);
  return sum;
}

// The best of all paths; of equally good ones the first in the dictionary's order.
OptimalPath brute_force(const Quality& quality, const std::vector<int>& trace) {
  OptimalPath best;
  best.quality = -1;
  std::vector<int> path(trace.size() + 1, 0);
  for (bool more = true; more;) {
    const double sum = path_quality(quality, path, trace);
    if (sum > best.quality) best = {path, sum};
    more = false;
    for (int i = static_cast<int>(path.size()) - 1; i >= 0 && !more; --i) {
      more = ++path[i] < quality.classes;
      if (!more) path[i] = 0;
    }
  }
  return best;
}

TEST(OptimalPath, IsTheBestOfAllPaths) {
  Random random(1);
  for (int n = 0; n < 60; ++n) {
    const Quality quality = random_quality(random, 3 + n % 2);
    const std::vector<int> trace = random_trace(random, 5 + n % 2);
    const OptimalPath found = optimal_path(quality, trace), expected = brute_force(quality, trace);
    EXPECT_EQ(found.classes, expected.classes);
    EXPECT_NEAR(found.quality, expected.quality, 1e-12);
  }
}

TEST(OptimalPath, TakesTheLowerClassOnATie) {
  Random random(2);
  for (int n = 0; n < 60; ++n) {
    const Quality quality = random_quality(random, 3, true);
    const std::vector<int> trace = random_trace(random, 6, 4);
    const OptimalPath found = optimal_path(quality, trace), expected = brute_force(quality, trace);
    EXPECT_EQ(found.classes, expected.classes);
    EXPECT_EQ(found.quality, expected.quality);
  }
  Quality flat = random_quality(random, 4, true);
  std::fill(flat.smoothness.begin(), flat.smoothness.end(), 0.5);
  std::fill(flat.match.begin(), flat.match.end(), 0.5);
  EXPECT_EQ(optimal_path(flat, {1, 2, 3}).classes, (std::vector<int>{0, 0, 0, 0}));
}

TEST(OptimalPath, AddsUpToItsQuality) {
  Random random(3);
  const Quality quality = random_quality(random, 20);
  const std::vector<int> trace = random_trace(random, 600);
  const OptimalPath found = optimal_path(quality, trace);
  ASSERT_EQ(found.classes.size(), 601U);
  EXPECT_NEAR(found.quality, path_quality(quality, found.classes, trace), 1e-9);
}

TEST(OptimalPath, OfOneClassStays) {
  Random random(4);
  EXPECT_EQ(optimal_path(random_quality(random, 1), {5, 6}).classes, (std::vector<int>{0, 0, 0}));
}

TEST(OptimalPath, RefusesEmptyTracesAndUnknownControls) {
  Random random(5);
  const Quality quality = random_quality(random, 3);
  EXPECT_NE(error_of([&] { optimal_path(quality, {}); }).find("no controls"), std::string::npos);
  EXPECT_NE(error_of([&] { optimal_path(quality, {0, 102}); }).find("102"), std::string::npos);
  EXPECT_NE(error_of([&] { optimal_path(quality, {-1}); }).find("-1"), std::string::npos);
}

// The sums are made lane by lane where the machine can, and must be those of the plain loop.
TEST(NextClass, IsThePlainLoopToTheBit) {
  Random random(11);
  for (int n = 0; n < 200; ++n) {
    const int classes = 1 + random.below(100);
    const Quality quality = random_quality(random, classes, n % 4 == 0);
    std::vector<double> match(classes), value(classes), best(classes), same(classes);
    std::vector<int> chosen(classes);
    for (double& m : match) m = n % 4 == 0 ? 0.5 : random.uniform();
    for (double& v : value) v = n % 4 == 0 ? random.below(3) : 10 * random.uniform();
    const NextClass next(quality);
    next.values(match.data(), value.data(), best.data());
    next.values(match.data(), value.data(), same.data(), chosen.data());
    EXPECT_EQ(same, best);
    for (int from = 0; from < classes; ++from) {
      int expected = 0;
      const auto sum = [&](int to) { return quality.smoothness[from * classes + to] * match[to] + value[to]; };
      for (int to = 1; to < classes; ++to) expected = sum(to) > sum(expected) ? to : expected;
      EXPECT_EQ(best[from], sum(expected));
      EXPECT_EQ(next.after(from, match.data(), value.data()), expected);
      EXPECT_EQ(chosen[from], expected);
    }
  }
}

TEST(GreedyPolicy, TakesTheGreatestQualityAtEachStep) {
  Random random(6);
  for (const bool coarse : {false, true}) {
    const Quality quality = random_quality(random, 7, coarse);
    const Policy policy = greedy_policy(quality);
    ASSERT_EQ(policy.next.size(), 7U * kPaperPoints);
    for (int from = 0; from < 7; ++from) {
      for (int c = 0; c < kPaperPoints; ++c) {
        const int chosen = policy(from, c);
        for (int to = 0; to < 7; ++to) {
          EXPECT_LE(quality(from, to, c), quality(from, chosen, c));
          if (to < chosen) {
            EXPECT_LT(quality(from, to, c), quality(from, chosen, c));
          }
        }
      }
    }
  }
}

Policy random_policy(Random& random, int classes) {
  Policy policy{"random", classes, {}};
  for (int i = 0; i < classes * kPaperPoints; ++i) policy.next.push_back(random.below(classes));
  return policy;
}

TEST(PercentOfOptimal, IsNeverOverAHundred) {
  Random random(7);
  for (int n = 0; n < 100; ++n) {
    const int classes = 1 + random.below(8);
    const Quality quality = random_quality(random, classes, n % 2 == 0);
    const std::vector<int> trace = random_trace(random, 1 + random.below(40), 1 + random.below(kPaperPoints));
    for (const Policy& policy :
         {random_policy(random, classes), greedy_policy(quality), iterate_policy(quality, {trace})}) {
      const double percent = percent_of_optimal(quality, policy, trace);
      EXPECT_LE(percent, 100 + 1e-9) << policy.name;
      EXPECT_GT(percent, 0);
    }
  }
}

TEST(TraceQuality, AddsEq2AlongThePathOfThePolicy) {
  Random random(8);
  const Quality quality = random_quality(random, 5);
  const Policy policy = random_policy(random, 5);
  const std::vector<int> trace = random_trace(random, 30);
  std::vector<int> path{3};
  for (const int control : trace) path.push_back(policy.next[path.back() * kPaperPoints + control]);
  EXPECT_NEAR(trace_quality(quality, policy, trace, 3), path_quality(quality, path, trace), 1e-12);
}

TEST(ControlModel, LearnsCountsAndItsRowsSumToOne) {
  Random random(9);
  const std::vector<std::vector<int>> traces{random_trace(random, 500, 7), random_trace(random, 300, 102), {3}, {}};
  const std::vector<double> model = control_model(traces, {3, 2});
  ASSERT_EQ(model.size(), static_cast<std::size_t>(kPaperPoints) * kPaperPoints);
  for (int c = 0; c < kPaperPoints; ++c) {
    double sum = 0;
    for (int next = 0; next < kPaperPoints; ++next) {
      const double p = model[c * kPaperPoints + next];
      EXPECT_TRUE(p >= 0 && p <= 1);
      sum += p;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST(ControlModel, AddsThePriorsCounts) {
  const std::vector<double> model = control_model({{0, 1, 1, 0, 1}}, {8, 2});  // 0 -> 1 twice; 1 -> 1 and 1 -> 0 once
  const double anywhere = 2.0 / kPaperPoints;
  EXPECT_NEAR(model[0 * kPaperPoints + 1], (2 + anywhere) / 12, 1e-12);
  EXPECT_NEAR(model[0 * kPaperPoints + 0], (8 + anywhere) / 12, 1e-12);
  EXPECT_NEAR(model[1 * kPaperPoints + 1], (9 + anywhere) / 12, 1e-12);
  EXPECT_NEAR(model[1 * kPaperPoints + 0], (1 + anywhere) / 12, 1e-12);
  EXPECT_NEAR(model[50 * kPaperPoints + 50], (8 + anywhere) / 10, 1e-12);
  EXPECT_NEAR(model[50 * kPaperPoints + 7], anywhere / 10, 1e-12);
}

TEST(ControlModel, RefusesPriorsThatAreNoCounts) {
  for (const double bad : {-1.0, std::nan(""), static_cast<double>(INFINITY), 1e308}) {
    EXPECT_THROW(control_model({}, {bad, 1}), std::invalid_argument) << bad;
    EXPECT_THROW(control_model({}, {1, bad}), std::invalid_argument) << bad;
  }
}

TEST(PercentOfOptimal, IsAllWhereNothingIsAnyGood) {
  const Quality none{1, {0}, std::vector<double>(kPaperPoints, 0)};
  EXPECT_EQ(percent_of_optimal(none, {"only", 1, std::vector<int>(kPaperPoints, 0)}, {0, 5}), 100);
}

TEST(ControlModel, ExpectsAControlOfWhichNothingIsKnownToStay) {
  const std::vector<double> model = control_model({{3, 4}}, {});
  EXPECT_EQ(model[3 * kPaperPoints + 4], 1);
  EXPECT_EQ(model[50 * kPaperPoints + 50], 1);
}

TEST(ControlModel, RefusesIndicesThatAreNoControl) {
  EXPECT_THROW(control_model({{3, kPaperPoints}}, kPersistencePrior), std::invalid_argument);
}

TEST(AnticipatePolicy, ForeseesForControlsThatWereNeverSeen) {
  // Control 5 was never seen. Iterate believes that it is kept for ever and goes where it is worth most in the long
  // run; anticipate knows that it may end, and that class 0 is better placed for all else.
  Quality quality;
  quality.classes = 2;
  quality.smoothness = {1, 0.9, 0.5, 1};
  quality.match.assign(std::size_t{2} * kPaperPoints, 0.1);
  for (int c = 0; c < kPaperPoints; ++c) quality.match[c] = 1;
  quality.match[5] = 0.6;
  quality.match[kPaperPoints + 5] = 0.63;
  const std::vector<std::vector<int>> traces{{7, 7, 7}};
  EXPECT_EQ(iterate_policy(quality, traces)(0, 5), 1);
  EXPECT_EQ(anticipate_policy(quality, traces)(0, 5), 0);
}

TEST(IteratePolicy, WithoutAFutureIsGreedy) {
  Random random(10);
  const Quality quality = random_quality(random, 6);
  IterateOptions options;
  options.discount = 0;
  EXPECT_EQ(iterate_policy(quality, {random_trace(random, 50)}, options).next, greedy_policy(quality).next);
}

TEST(IteratePolicy, UnderOneControlThatStaysFollowsTheBestLoop) {
  // From 0 the best single step stays at 0; the loop 1 -> 2 -> 1 is worth more in the long run.
  Quality quality;
  quality.classes = 3;
  quality.smoothness = {0.5, 0.4, 0.1, 0.1, 0.1, 1, 0.1, 1, 0.1};
  quality.match.assign(std::size_t{3} * kPaperPoints, 1);
  const Policy policy = iterate_policy(quality, {{7, 7, 7, 7}});
  EXPECT_EQ(greedy_policy(quality)(0, 7), 0);
  EXPECT_EQ(policy(0, 7), 1);
  EXPECT_EQ(policy(1, 7), 2);
  EXPECT_EQ(policy(2, 7), 1);
}

// Value iteration word by word.
Policy plain_iteration(const Quality& quality, const std::vector<std::vector<int>>& traces, double discount) {
  const int n = quality.classes;
  const std::vector<double> model = control_model(traces, kPersistencePrior);
  std::vector<double> value(n * kPaperPoints, 0);
  Policy policy{"plain", n, std::vector<int>(n * kPaperPoints)};
  for (double change = 1; change > 1e-4;) {
    const std::vector<double> before = value;
    change = 0;
    for (int c = 0; c < kPaperPoints; ++c) {
      std::vector<double> promise(n, 0);
      for (int to = 0; to < n; ++to) {
        for (int then = 0; then < kPaperPoints; ++then) {
          promise[to] += discount * model[c * kPaperPoints + then] * before[to * kPaperPoints + then];
        }
      }
      for (int from = 0; from < n; ++from) {
        const auto worth = [&](int to) { return quality(from, to, c) + promise[to]; };
        int best = 0;
        for (int to = 1; to < n; ++to) best = worth(to) > worth(best) ? to : best;
        policy.next[from * kPaperPoints + c] = best;
        value[from * kPaperPoints + c] = worth(best);
        change = std::max(change, std::abs(worth(best) - before[from * kPaperPoints + c]));
      }
    }
  }
  return policy;
}

TEST(IteratePolicy, IsValueIteration) {
  Random random(12);
  for (int n = 0; n < 4; ++n) {
    const Quality quality = random_quality(random, 5 + 7 * n);
    const std::vector<std::vector<int>> traces{random_trace(random, 200, 20), random_trace(random, 100)};
    IterateOptions options;
    options.discount = 0.5 + 0.1 * n;
    EXPECT_EQ(iterate_policy(quality, traces, options).next, plain_iteration(quality, traces, options.discount).next);
  }
}

TEST(IteratePolicy, RefusesOptionsThatHaveNoEnd) {
  Random random(13);
  const Quality quality = random_quality(random, 3);
  const auto error = [&](double discount, double tolerance) {
    return error_of([&] { iterate_policy(quality, {{1, 2}}, {discount, tolerance}); });
  };
  for (const double discount : {1.0, 2.0, -0.1, std::nan("")}) {
    EXPECT_NE(error(discount, 1e-4).find("discount"), std::string::npos) << discount;
  }
  for (const double tolerance : {0.0, -1.0, 1.1, std::nan("")}) {
    EXPECT_NE(error(0.9, tolerance).find("tolerance"), std::string::npos) << tolerance;
  }
  EXPECT_EQ(error(0, 1e-4), "no error");
}

TEST(IteratePolicy, EndsHoweverFarTheValues) {
  Random random(14);
  const Quality quality = random_quality(random, 6);
  const std::vector<std::vector<int>> traces{random_trace(random, 50)};
  EXPECT_EQ(iterate_policy(quality, traces, {0.999999999, 1e-300}).next.size(), 6U * kPaperPoints);
}

TEST(QualityTable, IsEq2ForTheRepresentatives) {
  const FragmentPool pool = gait_pool(gait_takes());
  const Trajectories t = trajectories(pool);
  ClusterOptions options;
  options.classes = 12;
  const Classes classes = cluster(t, std::vector<float>(t.count, 1), options);
  const ControlSpace space(1.1, 3, 1, 0.9, {1.5, 0.5, 2});
  const Quality quality = quality_table(pool.fragments, t, classes, space);
  ASSERT_EQ(quality.classes, 12);
  for (int from = 0; from < 12; ++from) {
    for (int to = 0; to < 12; ++to) {
      const int f = classes.representatives[from], g = classes.representatives[to];
      const double smooth = 1 / (1 + double(transition_distance(t, f, g)));
      for (int c = 0; c < kPaperPoints; ++c) {
        const Control &ev = pool.fragments[g].evident, &want = space.point(c);
        const double dx = 1.5 * 0.9 * (ev.x - want.x), dy = 1.5 * 0.9 * (ev.y - want.y),
                     dt = 0.5 * (ev.turn - want.turn), dj = 2 * (ev.jump - want.jump);
        const double expected = smooth / (1 + std::sqrt(dx * dx + dy * dy + dt * dt + dj * dj));
        EXPECT_NEAR(quality(from, to, c), expected, 1e-12);
        EXPECT_GT(quality(from, to, c), 0);
        EXPECT_LE(quality(from, to, c), 1);
      }
    }
  }
}

}  // namespace
}  // namespace fragmotion
