// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "base/progress.hpp"
#include "classes/classes.hpp"
#include "fragments/distance.hpp"

namespace fragmotion {

/// Classes that there may be: their table of qualities takes 0.8 GB, and the paper has 97.
constexpr int kMostClasses = 10000;

/// Restarts that there may be: 8 do.
constexpr int kMostRestarts = 10000;

struct ClusterOptions {
  int classes = 97;  ///< The paper's, "based on several experiment results"; 1 .. kMostClasses.
  int restarts = 4;  ///< Runs from different starts, of which the best counts: up to kMostRestarts; at least 1 is made.
  int iterations = 100;  ///< At most, a run at each resolution; 1 .. 1,000,000.
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0 or less: as many as the machine has.
  /// 0 or 1 for each fragment: of two classes or more, none holds fragments of both kinds. Empty: all are of one.
  std::vector<char> kinds;
};

/// How many fragments differ from all others, or `most` where there are more.
int distinct_fragments(const Trajectories& t, int most);

/// What makes one clustering better than another: the greater score. By default the smaller inertia. Threads ask at the
/// same time.
using ClassScore = std::function<double(const Classes&)>;

/// k-means under Dis: k-means++ starts, Elkan's lower bounds (exact, since Dis is a norm), empty classes refilled with
/// the fragment furthest from its mean. Classes are sought among sums of neighbouring poses, then settled among the
/// poses, until no more than one fragment in a thousand changes its class. Of more than 100 fragments a class, each
/// restart first looks at as many, evenly spaced: time is linear in the number of fragments.
/// `weights` (> 0, one a fragment) say how much each counts. Classes are numbered by their representatives' order in
/// the pool. Throws std::invalid_argument on an option out of its range, on fewer distinct fragments than classes, on a
/// weight that is no number or not over 0, and on kinds that are not one a fragment.
Classes cluster(const Trajectories& t, const std::vector<float>& weights, const ClusterOptions& options,
                const ClassScore& score = {}, const Progress& progress = {});

}  // namespace fragmotion
