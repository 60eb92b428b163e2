// SPDX-License-Identifier: MIT
#include "classes/kmeans.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"

namespace fragmotion {
namespace {

// Bounds are kept in floats; so much of them is given away to rounding.
constexpr float kSlack = 1e-5F;
constexpr float kInfinite = std::numeric_limits<float>::infinity();

// The index that falls to a share of the total; where all is zero, each index is as likely.
int draw(const std::vector<double>& cumulated, double share) {
  const int count = static_cast<int>(cumulated.size());
  const double total = cumulated.back();
  if (total <= 0) return static_cast<int>(share * count);
  const auto found = std::upper_bound(cumulated.begin(), cumulated.end(), share * total);
  const auto last = std::lower_bound(cumulated.begin(), cumulated.end(), total);
  return static_cast<int>(std::min(found, last) - cumulated.begin());
}

}  // namespace

KMeans::KMeans(const Points& points, int classes, int threads)
    : points_(points),
      n_(classes),
      threads_(threads),
      width_(points.rows->width()),
      means_(n_ * width_),
      sums_(n_ * width_, 0),
      masses_(n_, 0),
      masses_of_ones_(n_, 0),
      kinds_(n_, 0),
      labels_(points.count(), 0),
      averaged_(points.count(), -1),
      upper_(points.count(), kInfinite) {}

// A point that may become a mean: how far each point is from it, or at least is where that is further than the nearest
// mean so far.
struct KMeans::Candidate {
  int point = 0;
  std::vector<float> row;
  std::vector<float> distances;
};

void KMeans::seed(Random& random) {
  const int trials = 2 + static_cast<int>(std::log(n_));
  std::vector<Candidate> candidates(trials);
  for (Candidate& candidate : candidates) candidate.distances.resize(points_.count());
  std::fill(upper_.begin(), upper_.end(), 1.0F);
  lower_.assign(static_cast<std::size_t>(points_.count()) * n_, 0);
  for (int k = 0; k < n_; ++k) {
    const std::vector<double> squares = cumulated_squares();
    const int tried = k == 0 ? 1 : trials;
    for (int c = 0; c < tried; ++c) {
      candidates[c].point = draw(squares, random.uniform());
      candidates[c].row = points_.rows->read(candidates[c].point);
    }
    if (k == 0) std::fill(upper_.begin(), upper_.end(), kInfinite);
    parallel_for(points_.count(), threads_, [&](int begin, int end) {
      for (int c = 0; c < tried; ++c) measure(candidates[c], begin, end);
    });
    std::vector<double> inertias;
    for (int c = 0; c < tried; ++c) inertias.push_back(inertia_with(candidates[c]));
    add_mean(candidates[std::min_element(inertias.begin(), inertias.end()) - inertias.begin()], k);
  }
}

std::vector<double> KMeans::cumulated_squares() const {
  std::vector<double> squares(points_.count());
  double sum = 0;
  for (int i = 0; i < points_.count(); ++i) {
    sum += static_cast<double>(points_.weights[i]) * upper_[i] * upper_[i];
    squares[i] = sum;
  }
  return squares;
}

// The triangle inequality tells of most points that they are not nearer to the candidate than to their mean.
void KMeans::measure(Candidate& candidate, int begin, int end) const {
  const float* to_means = &lower_[static_cast<std::size_t>(candidate.point) * n_];
  const auto distance = [&](int i) {
    return points_.rows->distance(i, candidate.row.data()) + apart(points_.kinds[i], points_.kinds[candidate.point]);
  };
  for (int i = begin; i < end; ++i) {
    const float least = to_means[labels_[i]] * (1 - kSlack) - upper_[i] * (1 + kSlack);
    candidate.distances[i] = least >= upper_[i] ? least : distance(i);
  }
}

double KMeans::inertia_with(const Candidate& candidate) const {
  double sum = 0;
  for (int i = 0; i < points_.count(); ++i) {
    const double d = std::min(upper_[i], candidate.distances[i]);
    sum += points_.weights[i] * d * d;
  }
  return sum;
}

void KMeans::add_mean(const Candidate& candidate, int k) {
  std::copy(candidate.row.begin(), candidate.row.end(), mean(k));
  kinds_[k] = points_.kinds[candidate.point];
  for (int i = 0; i < points_.count(); ++i) {
    const float d = lower(i, k) = candidate.distances[i];
    if (d < upper_[i]) upper_[i] = d, labels_[i] = k;
  }
}

void KMeans::start(const std::vector<int>& labels, std::vector<float> lower) {
  labels_ = labels;
  lower_ = std::move(lower);
  average();
  for (int& label : labels_) label = std::max(0, label);
  std::fill(upper_.begin(), upper_.end(), kInfinite);
  assign();
}

void KMeans::settle(int iterations, int few) {
  for (int i = 0; i < iterations; ++i) {
    const bool refilled = move_means();
    const int moved = assign();
    if (moved == 0 && !refilled) return;
    if (moved <= few) break;
  }
  move_means();
}

double KMeans::inertia() const {
  double sum = 0;
  for (int i = 0; i < points_.count(); ++i) {
    const double d = distance(i, labels_[i]);
    sum += points_.weights[i] * d * d;
  }
  return sum;
}

std::vector<int> KMeans::medoids() const {
  std::vector<int> medoids(n_, -1);
  std::vector<float> best(n_, kInfinite);
  for (int i = 0; i < points_.count(); ++i) {
    const float d = distance(i, labels_[i]);
    if (d < best[labels_[i]]) best[labels_[i]] = d, medoids[labels_[i]] = i;
  }
  return medoids;
}

// Gives every empty class the point that is furthest from its mean, of a class that has others.
bool KMeans::refill_empty_classes() {
  std::vector<int> count(n_, 0);
  for (const int label : labels_) ++count[label];
  bool refilled = false;
  for (int k = 0; k < n_; ++k) {
    if (count[k] > 0) continue;
    int furthest = -1;
    for (int i = 0; i < points_.count(); ++i) {
      if (count[labels_[i]] > 1 && (furthest < 0 || upper_[i] > upper_[furthest])) furthest = i;
    }
    --count[labels_[furthest]];
    ++count[k];
    labels_[furthest] = k;
    upper_[furthest] = kInfinite;
    refilled = true;
  }
  return refilled;
}

// New means of all classes; bounds follow by how far each mean moved. Returns whether a class was empty.
bool KMeans::move_means() {
  const bool refilled = refill_empty_classes();
  const std::vector<float> before = means_;
  const std::vector<char> kinds_before = kinds_;
  average();
  std::vector<float> shift(n_);
  for (int k = 0; k < n_; ++k) {
    const float far =
        tip_distance(&before[k * width_], mean(k), points_.rows->stride()) + apart(kinds_before[k], kinds_[k]);
    shift[k] = far * (1 + kSlack);
  }
  parallel_for(points_.count(), threads_, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      upper_[i] = upper_[i] * (1 + kSlack) + shift[labels_[i]];
      for (int k = 0; k < n_; ++k) lower(i, k) = std::max(0.0F, lower(i, k) * (1 - kSlack) - shift[k]);
    }
  });
  return refilled;
}

// The means follow the points whose class is not what it was the last time.
void KMeans::average() {
  std::vector<int> moved;
  std::vector<char> changed(n_, 0);
  const auto count = [&](int label, double weight, char kind) {
    if (label < 0) return;
    changed[label] = 1;
    masses_[label] += weight;
    masses_of_ones_[label] += weight * kind;
  };
  for (int i = 0; i < points_.count(); ++i) {
    if (labels_[i] == averaged_[i]) continue;
    moved.push_back(i);
    count(averaged_[i], -points_.weights[i], points_.kinds[i]);
    count(labels_[i], points_.weights[i], points_.kinds[i]);
  }
  for (int k = 0; k < n_; ++k) kinds_[k] = masses_of_ones_[k] > masses_[k] / 2 ? 1 : 0;
  parallel_for(static_cast<int>(width_), threads_, [&](int begin, int end) {
    for (const int i : moved) {
      add(averaged_[i], -points_.weights[i], i, begin, end);
      add(labels_[i], points_.weights[i], i, begin, end);
    }
    for (int k = 0; k < n_; ++k) {
      if (changed[k] == 0) continue;
      for (int j = begin; j < end; ++j) mean(k)[j] = static_cast<float>(sums_[k * width_ + j] / masses_[k]);
    }
  });
  averaged_ = labels_;
}

void KMeans::add(int label, double weight, int point, int begin, int end) {
  if (label < 0) return;
  const std::int16_t* row = points_.rows->row(point);
  const double unit = weight * points_.rows->unit(point);
  double* sums = &sums_[label * width_];
  for (int j = begin; j < end; ++j) sums[j] += unit * row[j];
}

// Moves each point to its nearest mean. Returns how many moved.
int KMeans::assign() {
  std::vector<char> changed(points_.count(), 0);
  parallel_for(points_.count(), threads_, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) changed[i] = assign(i) ? 1 : 0;
  });
  return static_cast<int>(std::count(changed.begin(), changed.end(), 1));
}

bool KMeans::assign(int i) {
  const int before = labels_[i];
  bool exact = false;
  for (int k = 0; k < n_; ++k) {
    if (k == labels_[i] || upper_[i] <= lower(i, k)) continue;
    if (!exact) {
      upper_[i] = lower(i, labels_[i]) = distance(i, labels_[i]);
      exact = true;
      if (upper_[i] <= lower(i, k)) continue;
    }
    const float d = lower(i, k) = distance(i, k);
    if (d < upper_[i]) upper_[i] = d, labels_[i] = k;
  }
  return labels_[i] != before;
}

}  // namespace fragmotion
