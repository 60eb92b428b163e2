// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "fragments/tip_rows.hpp"

namespace fragmotion {

/// A point's bone tips summed, m, and how far its kind is from the first: by the triangle inequality two of these are
/// no further apart than the points.
using TipSum = std::array<double, 4>;

/// Fragments as points of a space in which tip_distance is a norm, each with what it counts (> 0). Points of two kinds
/// are a thousand kilometres further apart.
class Points {
 public:
  /// [count] each, which must outlive it; kinds are 0 or 1.
  Points(const TipRows& rows, const float* weights, const char* kinds);

  int count() const { return rows_->count(); }
  const TipRows& rows() const { return *rows_; }
  float weight(int i) const { return weights_[i]; }
  char kind(int i) const { return kinds_[i]; }
  TipSum sum(int i) const { return {sums_[0][i], sums_[1][i], sums_[2][i], sums_[3][i]}; }

  static float apart(char kind, char other) { return kind == other ? 0 : kKindsApart; }
  /// The sum of `stride` tips [3, stride] of a kind.
  static TipSum sum(const float* tips, int stride, char kind);
  /// Writes how far each point is at least from what has this sum, m, [count].
  void at_least(const TipSum& from, float* to) const;
  float at_least(int i, const TipSum& from) const;

 private:
  static constexpr float kKindsApart = 1e6F;  // m

  const TipRows* rows_;
  const float* weights_;
  const char* kinds_;
  std::array<std::vector<double>, 4> sums_;  // [count] along each axis of TipSum
};

/// k-means with the lower bounds of Elkan ("Using the triangle inequality to accelerate k-means", ICML 2003).
/// The result does not depend on the number of threads.
class KMeans {
 public:
  /// The points must outlive it.
  KMeans(const Points& points, int classes, int threads);

  /// Greedy k-means++ (Arthur and Vassilvitskii 2007): of several points drawn by their weighted squared distance to
  /// the nearest mean so far, the one that leaves the smallest inertia is the next mean.
  void seed(Random& random);

  /// Starts from labels instead; -1 is none yet, and every class needs a label. `lower` are lower bounds [count,
  /// classes] of the distances between the points and the labels' means; 0 where nothing is known.
  void start(const std::vector<int>& labels, std::vector<float> lower);

  /// Moves means and points in turns until no more than `few` points move, or `iterations` times. Then the means are
  /// those of the labels, and no class is empty: one that was has got the point furthest from its mean.
  void settle(int iterations, int few);

  const std::vector<int>& labels() const { return labels_; }
  /// Lower bounds [count, classes] of the distances between points and means, which it then no longer has.
  std::vector<float> take_lower() { return std::move(lower_); }
  /// How far each point is from the own mean, m.
  std::vector<float> to_own_means() const;
  /// By to_own_means(): the sum over points of weight times its square,
  double inertia(const std::vector<float>& to_own) const;
  /// and the member of each class that is nearest to its mean.
  std::vector<int> medoids(const std::vector<float>& to_own) const;

 private:
  struct Candidate;

  float* mean(int k) { return &means_[k * width_]; }
  const float* mean(int k) const { return &means_[k * width_]; }
  float& lower(int i, int k) { return lower_[static_cast<std::size_t>(i) * n_ + k]; }
  float distance(int i, int k) const {
    return points_.rows().distance(i, mean(k)) + Points::apart(points_.kind(i), kinds_[k]);
  }

  std::vector<double> cumulated_squares() const;
  void measure(Candidate& candidate) const;
  void add_mean(const Candidate& candidate, int k);

  bool refill_empty_classes();
  void average();
  void add(int label, double weight, int point, int begin, int end);
  bool move_means();
  int assign();
  bool assign(int i);

  const Points& points_;
  int n_, threads_;
  std::size_t width_;
  std::vector<float> means_;            // [n, 3, stride]
  std::vector<TipSum> mean_sums_;       // [n]
  std::vector<double> sums_;            // [n, 3, stride] of what averaged_ has in each class, by weight,
  std::vector<double> masses_;          // [n] its weights,
  std::vector<double> masses_of_ones_;  // [n] and those of the second kind
  std::vector<char> kinds_;             // [n] of means
  std::vector<int> labels_;             // [points]
  std::vector<int> averaged_;           // [points] the labels whose means these are, -1 none
  std::vector<float> upper_;            // [points] at least the distance to the own mean
  std::vector<float> lower_;            // [points, n] at most the distance to each mean
};

}  // namespace fragmotion
