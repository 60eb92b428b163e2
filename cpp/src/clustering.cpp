// SPDX-License-Identifier: MIT
#include "fragmotion/clustering.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "fragmotion/parallel.hpp"
#include "fragmotion/random.hpp"

namespace fragmotion {
namespace {

// Bounds are kept in floats; so much of them is given away to rounding.
constexpr float kSlack = 1e-5F;

// One run of k-means with Elkan's bounds ("Using the triangle inequality to accelerate k-means", ICML 2003).
class KMeans {
 public:
  KMeans(const Trajectories& t, const std::vector<float>& weights, int classes, int threads)
      : t_(t),
        weights_(weights),
        n_(classes),
        threads_(threads),
        width_(std::size_t{3} * t.stride),
        means_(n_ * width_),
        labels_(t.count, 0),
        upper_(t.count),
        lower_(static_cast<std::size_t>(t.count) * n_),
        between_(static_cast<std::size_t>(n_) * n_),
        nearest_(n_) {}

  void run(Random& random, int iterations) {
    start(random);
    for (int i = 0; i < iterations; ++i) {
      const bool moved = move_means();
      if (!assign() && !moved) break;
    }
  }

  const std::vector<int>& labels() const { return labels_; }

  double inertia() const {
    double sum = 0;
    for (int i = 0; i < t_.count; ++i) sum += weights_[i] * std::pow(static_cast<double>(distance(i, labels_[i])), 2);
    return sum;
  }

  // The member of each class nearest to its mean.
  std::vector<int> medoids() const {
    std::vector<int> medoids(n_, -1);
    std::vector<float> best(n_, std::numeric_limits<float>::infinity());
    for (int i = 0; i < t_.count; ++i) {
      const float d = distance(i, labels_[i]);
      if (d < best[labels_[i]]) best[labels_[i]] = d, medoids[labels_[i]] = i;
    }
    return medoids;
  }

 private:
  float* mean(int k) { return &means_[k * width_]; }
  const float* mean(int k) const { return &means_[k * width_]; }
  float& lower(int i, int k) { return lower_[static_cast<std::size_t>(i) * n_ + k]; }
  float& between(int a, int b) { return between_[static_cast<std::size_t>(a) * n_ + b]; }
  float distance(int i, int k) const { return tip_distance(t_.trajectory(i), mean(k), t_.stride); }

  // A fragment that may become a mean: how far each fragment is from it, or at least is where that is further than the
  // nearest mean so far.
  struct Candidate {
    int fragment = 0;
    std::vector<float> distances;
  };

  // Greedy k-means++ (Arthur and Vassilvitskii 2007): of several fragments drawn by their squared distance to the
  // nearest mean so far, the one that leaves the smallest inertia is the next mean.
  void start(Random& random) {
    upper_.assign(t_.count, 1);
    const int trials = 2 + static_cast<int>(std::log(n_));
    std::vector<Candidate> candidates(trials);
    for (Candidate& candidate : candidates) candidate.distances.resize(t_.count);
    for (int k = 0; k < n_; ++k) {
      candidates.resize(k == 0 ? 1 : trials, candidates[0]);
      for (Candidate& candidate : candidates) candidate.fragment = draw_far(random);
      parallel_for(t_.count, threads_, [&](int begin, int end) {
        for (Candidate& candidate : candidates) measure(candidate, k, begin, end);
      });
      const auto left = [&](const Candidate& candidate) { return inertia_with(candidate, k); };
      std::vector<double> inertias(candidates.size());
      std::transform(candidates.begin(), candidates.end(), inertias.begin(), left);
      add_mean(candidates[std::min_element(inertias.begin(), inertias.end()) - inertias.begin()], k);
    }
  }

  // The triangle inequality tells of most fragments that they are not nearer to the candidate than to their mean.
  void measure(Candidate& candidate, int k, int begin, int end) const {
    const float* to_means = &lower_[static_cast<std::size_t>(candidate.fragment) * n_];
    for (int i = begin; i < end; ++i) {
      const float least = k == 0 ? 0 : to_means[labels_[i]] * (1 - kSlack) - upper_[i] * (1 + kSlack);
      const bool further = k > 0 && least >= upper_[i];
      candidate.distances[i] =
          further ? least : tip_distance(t_.trajectory(i), t_.trajectory(candidate.fragment), t_.stride);
    }
  }

  double inertia_with(const Candidate& candidate, int k) const {
    double sum = 0;
    for (int i = 0; i < t_.count; ++i) {
      const double d = k == 0 ? candidate.distances[i] : std::min(upper_[i], candidate.distances[i]);
      sum += weights_[i] * d * d;
    }
    return sum;
  }

  void add_mean(const Candidate& candidate, int k) {
    std::copy_n(t_.trajectory(candidate.fragment), width_, mean(k));
    for (int i = 0; i < t_.count; ++i) {
      const float d = lower(i, k) = candidate.distances[i];
      if (k == 0 || d < upper_[i]) upper_[i] = d, labels_[i] = k;
    }
  }

  int draw_far(Random& random) const {
    double total = 0;
    for (int i = 0; i < t_.count; ++i) total += squared(i);
    if (total == 0) throw std::invalid_argument("there are fewer distinct fragments than classes");
    double rest = random.uniform() * total;
    int last = 0;
    for (int i = 0; i < t_.count; ++i) {
      if (upper_[i] == 0) continue;
      last = i;
      rest -= squared(i);
      if (rest < 0) break;
    }
    return last;
  }

  double squared(int i) const { return static_cast<double>(weights_[i]) * upper_[i] * upper_[i]; }

  std::vector<int> sizes() const {
    std::vector<int> sizes(n_, 0);
    for (const int label : labels_) ++sizes[label];
    return sizes;
  }

  // Gives every empty class the fragment that is furthest from its mean, of a class that has others.
  bool refill_empty_classes() {
    std::vector<int> count = sizes();
    bool refilled = false;
    for (int k = 0; k < n_; ++k) {
      if (count[k] > 0) continue;
      int furthest = -1;
      for (int i = 0; i < t_.count; ++i) {
        if (count[labels_[i]] > 1 && (furthest < 0 || upper_[i] > upper_[furthest])) furthest = i;
      }
      --count[labels_[furthest]];
      ++count[k];
      labels_[furthest] = k;
      upper_[furthest] = std::numeric_limits<float>::infinity();
      refilled = true;
    }
    return refilled;
  }

  // New means of all classes; bounds follow by how far each mean moved. Returns whether a class was empty.
  bool move_means() {
    const bool refilled = refill_empty_classes();
    const std::vector<float> before = means_;
    std::vector<float> total(n_, 0);
    for (int i = 0; i < t_.count; ++i) total[labels_[i]] += weights_[i];
    parallel_for(static_cast<int>(width_), threads_, [&](int begin, int end) { average_columns(total, begin, end); });
    std::vector<float> shift(n_);
    for (int k = 0; k < n_; ++k) shift[k] = tip_distance(&before[k * width_], mean(k), t_.stride) * (1 + kSlack);
    parallel_for(t_.count, threads_, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        upper_[i] = upper_[i] * (1 + kSlack) + shift[labels_[i]];
        for (int k = 0; k < n_; ++k) lower(i, k) = std::max(0.0F, lower(i, k) * (1 - kSlack) - shift[k]);
      }
    });
    return refilled;
  }

  void average_columns(const std::vector<float>& total, int begin, int end) {
    for (int k = 0; k < n_; ++k) std::fill(mean(k) + begin, mean(k) + end, 0.0F);
    for (int i = 0; i < t_.count; ++i) {
      float* sum = mean(labels_[i]);
      const float* x = t_.trajectory(i);
      for (int j = begin; j < end; ++j) sum[j] += weights_[i] * x[j];
    }
    for (int k = 0; k < n_; ++k) {
      for (int j = begin; j < end; ++j) mean(k)[j] /= total[k];
    }
  }

  void measure_means() {
    parallel_for(n_, threads_, [&](int begin, int end) {
      for (int a = begin; a < end; ++a) {
        nearest_[a] = std::numeric_limits<float>::infinity();
        for (int b = 0; b < n_; ++b) {
          between(a, b) = tip_distance(mean(a), mean(b), t_.stride);
          if (a != b) nearest_[a] = std::min(nearest_[a], between(a, b));
        }
      }
    });
  }

  // Moves each fragment to its nearest mean. Returns whether any moved.
  bool assign() {
    measure_means();
    std::vector<char> changed(t_.count, 0);
    parallel_for(t_.count, threads_, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) changed[i] = assign(i) ? 1 : 0;
    });
    return std::find(changed.begin(), changed.end(), 1) != changed.end();
  }

  bool assign(int i) {
    const int before = labels_[i];
    if (upper_[i] <= 0.5F * nearest_[before] * (1 - kSlack)) return false;
    bool exact = false;
    for (int k = 0; k < n_; ++k) {
      const auto ruled_out = [&] {
        return upper_[i] <= lower(i, k) || upper_[i] <= 0.5F * between(labels_[i], k) * (1 - kSlack);
      };
      if (k == labels_[i] || ruled_out()) continue;
      if (!exact) {
        upper_[i] = lower(i, labels_[i]) = distance(i, labels_[i]);
        exact = true;
        if (ruled_out()) continue;
      }
      const float d = lower(i, k) = distance(i, k);
      if (d < upper_[i]) upper_[i] = d, labels_[i] = k;
    }
    return labels_[i] != before;
  }

  const Trajectories& t_;
  const std::vector<float>& weights_;
  int n_, threads_;
  std::size_t width_;
  std::vector<float> means_;    // [n, 3, stride]
  std::vector<int> labels_;     // [fragments]
  std::vector<float> upper_;    // [fragments] at least the distance to the own mean
  std::vector<float> lower_;    // [fragments, n] at most the distance to each mean
  std::vector<float> between_;  // [n, n] distances of the means
  std::vector<float> nearest_;  // [n] from each mean to the nearest other one
};

// Renumbers the classes by their representatives' order.
Classes ordered(const KMeans& run, int count, double inertia) {
  const std::vector<int> medoids = run.medoids();
  std::vector<int> order(count), rank(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return medoids[a] < medoids[b]; });
  Classes classes;
  classes.count = count;
  classes.inertia = inertia;
  for (int k = 0; k < count; ++k) {
    rank[order[k]] = k;
    classes.representatives.push_back(medoids[order[k]]);
  }
  for (const int label : run.labels()) classes.labels.push_back(rank[label]);
  return classes;
}

}  // namespace

std::vector<std::vector<int>> Classes::members() const {
  std::vector<std::vector<int>> members(count);
  for (std::size_t i = 0; i < labels.size(); ++i) members[labels[i]].push_back(static_cast<int>(i));
  return members;
}

Classes cluster(const Trajectories& t, const std::vector<float>& weights, const ClusterOptions& options,
                const ClassScore& score, const Progress& progress) {
  if (static_cast<int>(weights.size()) != t.count) throw std::invalid_argument("every fragment needs a weight");
  if (options.classes < 1) throw std::invalid_argument("the number of classes must be at least 1");
  if (options.classes > t.count) {
    throw std::invalid_argument(std::to_string(options.classes) +
                                " classes need as many fragments, but there are only " + std::to_string(t.count) +
                                ": ask for fewer classes or add takes");
  }
  Random random(options.seed);
  Classes best;
  double best_score = -std::numeric_limits<double>::infinity();
  for (int restart = 0; restart < std::max(1, options.restarts); ++restart) {
    report(progress, static_cast<double>(restart) / options.restarts, "Clustering");
    KMeans run(t, weights, options.classes, thread_count(options.threads));
    run.run(random, options.iterations);
    Classes found = ordered(run, options.classes, run.inertia());
    const double found_score = score ? score(found) : -found.inertia;
    if (found_score > best_score) best_score = found_score, best = std::move(found);
  }
  return best;
}

}  // namespace fragmotion
