// SPDX-License-Identifier: MIT
#include "classes/clustering.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "base/ranges.hpp"
#include "classes/kmeans.hpp"

namespace fragmotion {
namespace {

constexpr int kPosesSummed = 8;
constexpr int kSampled = 100;     // fragments for each class
constexpr int kHardlyAny = 1000;  // one fragment in so many
constexpr int kMostIterations = 1000000;
const char* const kStage = "Clustering";

// Renumbers the classes by their representatives' order.
Classes ordered(const KMeans& run, int count) {
  const std::vector<float> to_means = run.to_own_means();
  const std::vector<int> medoids = run.medoids(to_means);
  std::vector<int> order(count), rank(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return medoids[a] < medoids[b]; });
  Classes classes;
  classes.count = count;
  classes.inertia = run.inertia(to_means);
  for (int k = 0; k < count; ++k) {
    rank[order[k]] = k;
    classes.representatives.push_back(medoids[order[k]]);
  }
  for (const int label : run.labels()) classes.labels.push_back(rank[label]);
  return classes;
}

// Sums of every few poses of each bone tip. Their Dis is at most that of the poses, and hardly less: neighbouring poses
// differ alike.
TipRows summed_poses(const Trajectories& t, int threads) {
  const int stride = t.whole.stride(), tips = t.tips > 0 ? t.tips : stride,
            group = t.tips > 0 ? kPosesSummed * tips : tips;
  TipRows sums(t.count, (stride + group - 1) / group * tips);
  parallel_for(t.count, threads, [&](int begin, int end) {
    std::vector<float> summed(sums.width());
    for (int fragment = begin; fragment < end; ++fragment) {
      std::fill(summed.begin(), summed.end(), 0.0F);
      const std::int16_t* from = t.whole.row(fragment);
      for (int axis = 0; axis < 3; ++axis, from += stride) {
        for (int pose = 0; pose < stride; pose += tips) {
          float* sum = &summed[axis * sums.stride() + pose / group * tips];
          for (int i = 0; i < std::min(tips, stride - pose); ++i) sum[i] += from[pose + i];
        }
      }
      for (float& sum : summed) sum *= t.whole.unit(fragment);
      sums.set(fragment, summed.data());
    }
  });
  return sums;
}

// Every few of the fragments, with one at least of each kind.
std::vector<int> even_sample(const std::vector<char>& kinds, int count) {
  const auto pool = static_cast<long long>(kinds.size());
  std::vector<int> fragments(count);
  for (int i = 0; i < count; ++i) fragments[i] = static_cast<int>(pool * i / count);
  for (const char kind : {0, 1}) {
    const auto is = [&](int i) { return kinds[i] == kind; };
    const auto first = std::find(kinds.begin(), kinds.end(), kind);
    if (first == kinds.end() || std::any_of(fragments.begin(), fragments.end(), is)) continue;
    fragments.back() = static_cast<int>(first - kinds.begin());
  }
  return fragments;
}

template <typename T>
std::vector<T> some(const std::vector<T>& values, const std::vector<int>& fragments) {
  std::vector<T> chosen;
  for (const int i : fragments) chosen.push_back(values[i]);
  return chosen;
}

Trajectories some(const Trajectories& t, const std::vector<int>& fragments) {
  Trajectories chosen;
  chosen.count = static_cast<int>(fragments.size());
  chosen.tips = t.tips;
  chosen.whole = t.whole.some(fragments);
  return chosen;
}

// Finds classes at two resolutions: first among the sums of poses, then, from there, among the poses.
class Clustering {
 public:
  Clustering(const Trajectories& t, const std::vector<float>& weights, const std::vector<char>& kinds,
             const ClusterOptions& options)
      : classes_(options.classes),
        iterations_(options.iterations),
        few_(t.count / kHardlyAny),
        sums_(summed_poses(t, thread_count(options.threads))),
        fine_{t.whole, weights.data(), kinds.data()},
        coarse_{sums_, weights.data(), kinds.data()},
        rounding_(t.whole.rounding() + sums_.rounding()) {}
  Clustering(const Clustering&) = delete;
  Clustering& operator=(const Clustering&) = delete;

  // From a random start.
  Classes operator()(Random random, int threads) const {
    KMeans coarse(coarse_, classes_, threads);
    coarse.seed(random);
    return settled(coarse, threads);
  }

  // From the labels of some of the fragments; -1 is none.
  Classes operator()(const std::vector<int>& labels, int threads) const {
    KMeans coarse(coarse_, classes_, threads);
    coarse.start(labels, std::vector<float>(labels.size() * classes_, 0));
    return settled(coarse, threads);
  }

 private:
  Classes settled(KMeans& coarse, int threads) const {
    coarse.settle(iterations_, few_);
    std::vector<float> lower = coarse.take_lower();
    for (float& bound : lower) bound -= rounding_;
    KMeans fine(fine_, classes_, threads);
    fine.start(coarse.labels(), std::move(lower));
    fine.settle(iterations_, few_);
    return ordered(fine, classes_);
  }

  int classes_, iterations_;
  int few_;  // fragments of which it does not matter that they still move
  TipRows sums_;
  Points fine_, coarse_;
  float rounding_;  // by which a distance of sums of poses may exceed that of the poses
};

// What find(run, threads) finds in each run, which is on one thread, unless there are more threads than runs.
template <typename Find>
std::vector<Classes> in_runs(std::size_t count, int threads, const Find& find, const Progress& progress) {
  const int runs = static_cast<int>(count);
  std::vector<Classes> found(runs);
  parallel_for(runs, threads, [&](int begin, int end) {
    const bool calling = begin == 0;
    for (int run = begin; run < end; ++run) {
      if (calling) report(progress, static_cast<double>(run) / end, kStage);
      found[run] = find(run, std::max(1, threads / runs));
    }
  });
  return found;
}

// Finds classes among some of the fragments.
std::vector<Classes> among(const std::vector<int>& fragments, const Trajectories& t, const std::vector<float>& weights,
                           const std::vector<char>& kinds, const ClusterOptions& options,
                           const std::vector<Random>& starts, const Progress& progress) {
  const Trajectories chosen = some(t, fragments);
  const std::vector<float> chosen_weights = some(weights, fragments);
  const std::vector<char> chosen_kinds = some(kinds, fragments);
  const Clustering clustering(chosen, chosen_weights, chosen_kinds, options);
  return in_runs(
      starts.size(), thread_count(options.threads),
      [&](int run, int threads) { return clustering(starts[run], threads); }, progress);
}

// The same among all; where these are many, it begins with the classes of an even sample.
std::vector<Classes> among_all(const Trajectories& t, const std::vector<float>& weights, const std::vector<char>& kinds,
                               const ClusterOptions& options, const std::vector<Random>& starts,
                               const Progress& progress) {
  const bool many = t.count / kSampled >= options.classes;
  const std::vector<int> sample = many ? even_sample(kinds, kSampled * options.classes) : std::vector<int>();
  const std::vector<Classes> first =
      many ? among(sample, t, weights, kinds, options, starts, part_of(progress, 0, 0.5)) : std::vector<Classes>();
  const Clustering clustering(t, weights, kinds, options);
  const auto find = [&](int run, int threads) {
    if (!many) return clustering(starts[run], threads);
    std::vector<int> labels(t.count, -1);
    for (std::size_t i = 0; i < sample.size(); ++i) labels[sample[i]] = first[run].labels[i];
    return clustering(labels, threads);
  };
  return in_runs(starts.size(), thread_count(options.threads), find, many ? part_of(progress, 0.5, 1) : progress);
}

// The best of all restarts.
const Classes& best_of(const std::vector<Classes>& found, const ClassScore& score, int threads) {
  const std::vector<double> scores = parallel_map(static_cast<int>(found.size()), threads, [&](int run) {
    return score ? score(found[run]) : -found[run].inertia;
  });
  return found[std::max_element(scores.begin(), scores.end()) - scores.begin()];
}

void check(const Trajectories& t, const std::vector<float>& weights, const std::vector<char>& kinds) {
  if (t.whole.stride() < 1) throw std::invalid_argument("a fragment needs at least one point");
  if (t.whole.count() != t.count) throw std::invalid_argument("every fragment needs a trajectory");
  if (static_cast<int>(weights.size()) != t.count) throw std::invalid_argument("every fragment needs a weight");
  if (static_cast<int>(kinds.size()) != t.count ||
      std::any_of(kinds.begin(), kinds.end(), [](char kind) { return kind != 0 && kind != 1; })) {
    throw std::invalid_argument("every fragment needs a kind, 0 or 1");
  }
  for (int i = 0; i < t.count; ++i) {
    if (!(weights[i] > 0 && std::isfinite(weights[i]))) {
      throw std::invalid_argument("fragment " + std::to_string(i) + ": its weight must be a number over 0");
    }
  }
}

void check_count(const Trajectories& t, int classes) {
  require_range("the number of classes", classes, 1, kMostClasses);
  const auto too_few = [&](const char* kind, int count) {
    return std::invalid_argument(std::to_string(classes) + " classes need as many " + kind + ", but there are only " +
                                 std::to_string(count) + ": ask for fewer classes or add takes");
  };
  if (classes > t.count) throw too_few("fragments", t.count);
  const int different = distinct_fragments(t, classes);
  if (classes > different) throw too_few("distinct fragments", different);
}

}  // namespace

int distinct_fragments(const Trajectories& t, int most) {
  const TipRows& rows = t.whole;
  const auto before = [&](int a, int b) {
    if (rows.unit(a) != rows.unit(b)) return rows.unit(a) < rows.unit(b);
    return std::lexicographical_compare(rows.row(a), rows.row(a) + rows.width(), rows.row(b),
                                        rows.row(b) + rows.width());
  };
  std::set<int, decltype(before)> different(before);
  for (int i = 0; i < t.count && static_cast<int>(different.size()) < most; ++i) different.insert(i);
  return static_cast<int>(different.size());
}

Classes cluster(const Trajectories& t, const std::vector<float>& weights, const ClusterOptions& options,
                const ClassScore& score, const Progress& progress) {
  const std::vector<char> kinds = options.kinds.empty() ? std::vector<char>(t.count, 0) : options.kinds;
  require_range("the number of restarts", std::max(1, options.restarts), 1, kMostRestarts);
  require_range("the number of iterations", options.iterations, 1, kMostIterations);
  check(t, weights, kinds);
  check_count(t, options.classes);
  Random seeds(options.seed);
  std::vector<Random> starts;
  for (int run = 0; run < std::max(1, options.restarts); ++run) starts.emplace_back(seeds.next());
  const std::vector<Classes> found = among_all(t, weights, kinds, options, starts, progress);
  report(progress, 1, kStage);
  return best_of(found, score, thread_count(options.threads));
}

}  // namespace fragmotion
