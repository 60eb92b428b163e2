// SPDX-License-Identifier: MIT
#include "classes/kmeans.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.hpp"
#include "base/vectorised.hpp"

namespace fragmotion {
namespace {

// Bounds are kept in floats; so much of them is given away to rounding.
constexpr float kSlack = 1e-5F;

// The index that falls to a share of the total; where all is zero, each index is as likely.
int draw(const std::vector<double>& cumulated, double share) {
  const int count = static_cast<int>(cumulated.size());
  const double total = cumulated.back();
  if (total <= 0) return static_cast<int>(share * count);
  const auto found = std::upper_bound(cumulated.begin(), cumulated.end(), share * total);
  const auto last = std::lower_bound(cumulated.begin(), cumulated.end(), total);
  return static_cast<int>(std::min(found, last) - cumulated.begin());
}

// How far two sums are apart, less what rounding may have added.
inline float apart_at_least(double x, double y, double z, double kind) {
  return static_cast<float>(std::sqrt(x * x + y * y + z * z + kind * kind)) * (1 - kSlack);
}

FRAGMOTION_VECTORISED void write_at_least(const double* x, const double* y, const double* z, const double* kind,
                                          int count, const TipSum& from, float* to) {
  for (int i = 0; i < count; ++i)
    to[i] = apart_at_least(x[i] - from[0], y[i] - from[1], z[i] - from[2], kind[i] - from[3]);
}

// How many values are under a limit.
FRAGMOTION_VECTORISED int count_under(const float* values, int count, float limit) {
  int under = 0;
  for (int i = 0; i < count; ++i) under += values[i] < limit ? 1 : 0;
  return under;
}

FRAGMOTION_VECTORISED void add_row(const std::int16_t* row, double unit, int count, double* sums) {
  for (int i = 0; i < count; ++i) sums[i] += unit * row[i];
}

// What means that moved so far leave of lower bounds.
FRAGMOTION_VECTORISED void lower_by(const float* shift, int count, float* lower) {
  for (int k = 0; k < count; ++k) lower[k] = std::max(0.0F, lower[k] * (1 - kSlack) - shift[k]);
}

}  // namespace

Points::Points(const TipRows& rows, const float* weights, const char* kinds)
    : rows_(&rows), weights_(weights), kinds_(kinds) {
  for (int i = 0; i < count(); ++i) {
    const std::int16_t* row = rows.row(i);
    for (int axis = 0; axis < 3; ++axis, row += rows.stride()) {
      sums_[axis].push_back(static_cast<double>(rows.unit(i)) * std::accumulate(row, row + rows.stride(), 0LL));
    }
    sums_[3].push_back(apart(kinds[i], 0));
  }
}

TipSum Points::sum(const float* tips, int stride, char kind) {
  TipSum sum{0, 0, 0, apart(kind, 0)};
  for (int axis = 0; axis < 3; ++axis, tips += stride) sum[axis] = std::accumulate(tips, tips + stride, 0.0);
  return sum;
}

void Points::at_least(const TipSum& from, float* to) const {
  write_at_least(sums_[0].data(), sums_[1].data(), sums_[2].data(), sums_[3].data(), count(), from, to);
}

float Points::at_least(int i, const TipSum& from) const {
  return apart_at_least(sums_[0][i] - from[0], sums_[1][i] - from[1], sums_[2][i] - from[2], sums_[3][i] - from[3]);
}

KMeans::KMeans(const Points& points, int classes, int threads)
    : points_(points),
      n_(classes),
      threads_(threads),
      width_(points.rows().width()),
      means_(n_ * width_),
      mean_sums_(n_),
      sums_(n_ * width_, 0),
      masses_(n_, 0),
      masses_of_ones_(n_, 0),
      kinds_(n_, 0),
      labels_(points.count(), 0),
      averaged_(points.count(), -1),
      upper_(points.count(), INFINITY) {}

// A point that may become a mean: how far each point is from it, or at least is where that is no nearer than the
// nearest mean so far, and by how much less the inertia would be.
struct KMeans::Candidate {
  int point = 0;
  std::vector<float> row;
  std::vector<float> distances;
  double gain = 0;
};

void KMeans::seed(Random& random) {
  const int trials = 2 + static_cast<int>(std::log(n_));
  std::vector<Candidate> candidates(trials);
  for (Candidate& candidate : candidates) candidate.distances.resize(points_.count());
  std::fill(upper_.begin(), upper_.end(), 1.0F);
  lower_.assign(static_cast<std::size_t>(points_.count()) * n_, 0);
  for (int k = 0; k < n_; ++k) {
    const std::vector<double> squares = cumulated_squares();
    if (k == 0) std::fill(upper_.begin(), upper_.end(), INFINITY);
    const auto tried = candidates.begin() + (k == 0 ? 1 : trials);
    for (auto candidate = candidates.begin(); candidate != tried; ++candidate) {
      candidate->point = draw(squares, random.uniform());
      measure(*candidate);
    }
    const auto gains_less = [](const Candidate& a, const Candidate& b) { return a.gain < b.gain; };
    add_mean(*std::max_element(candidates.begin(), tried, gains_less), k);
  }
}

std::vector<double> KMeans::cumulated_squares() const {
  std::vector<double> squares(points_.count());
  double sum = 0;
  for (int i = 0; i < points_.count(); ++i) {
    sum += static_cast<double>(points_.weight(i)) * upper_[i] * upper_[i];
    squares[i] = sum;
  }
  return squares;
}

// Of most points their sums tell that they are not nearer to the candidate than to their mean.
void KMeans::measure(Candidate& candidate) const {
  const char kind = points_.kind(candidate.point);
  candidate.row = points_.rows().read(candidate.point);
  candidate.gain = 0;
  float* distances = candidate.distances.data();
  points_.at_least(points_.sum(candidate.point), distances);
  const float* upper = upper_.data();
  for (int i = 0, count = points_.count(); i < count; ++i) {
    const float nearest = upper[i];
    if (distances[i] >= nearest) continue;
    const float d = points_.rows().distance(i, candidate.row.data()) + Points::apart(points_.kind(i), kind);
    distances[i] = d;
    if (d >= nearest) continue;
    candidate.gain += points_.weight(i) * (static_cast<double>(nearest) * nearest - static_cast<double>(d) * d);
  }
}

void KMeans::add_mean(const Candidate& candidate, int k) {
  std::copy(candidate.row.begin(), candidate.row.end(), mean(k));
  kinds_[k] = points_.kind(candidate.point);
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
  std::fill(upper_.begin(), upper_.end(), INFINITY);
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

std::vector<float> KMeans::to_own_means() const {
  std::vector<float> distances;
  for (int i = 0; i < points_.count(); ++i) distances.push_back(distance(i, labels_[i]));
  return distances;
}

double KMeans::inertia(const std::vector<float>& to_own) const {
  double sum = 0;
  for (int i = 0; i < points_.count(); ++i) {
    const double d = to_own[i];
    sum += points_.weight(i) * d * d;
  }
  return sum;
}

std::vector<int> KMeans::medoids(const std::vector<float>& to_own) const {
  std::vector<int> medoids(n_, -1);
  for (int i = 0; i < points_.count(); ++i) {
    int& medoid = medoids[labels_[i]];
    if (medoid < 0 || to_own[i] < to_own[medoid]) medoid = i;
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
    upper_[furthest] = INFINITY;
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
        tip_distance(&before[k * width_], mean(k), points_.rows().stride()) + Points::apart(kinds_before[k], kinds_[k]);
    shift[k] = far * (1 + kSlack);
  }
  parallel_for(points_.count(), threads_, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      upper_[i] = upper_[i] * (1 + kSlack) + shift[labels_[i]];
      lower_by(shift.data(), n_, &lower(i, 0));
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
    count(averaged_[i], -points_.weight(i), points_.kind(i));
    count(labels_[i], points_.weight(i), points_.kind(i));
  }
  for (int k = 0; k < n_; ++k) kinds_[k] = masses_of_ones_[k] > masses_[k] / 2 ? 1 : 0;
  parallel_for(static_cast<int>(width_), threads_, [&](int begin, int end) {
    for (const int i : moved) {
      add(averaged_[i], -points_.weight(i), i, begin, end);
      add(labels_[i], points_.weight(i), i, begin, end);
    }
    for (int k = 0; k < n_; ++k) {
      if (changed[k] == 0) continue;
      for (int j = begin; j < end; ++j) mean(k)[j] = static_cast<float>(sums_[k * width_ + j] / masses_[k]);
    }
  });
  for (int k = 0; k < n_; ++k) {
    if (changed[k] != 0) mean_sums_[k] = Points::sum(mean(k), points_.rows().stride(), kinds_[k]);
  }
  averaged_ = labels_;
}

void KMeans::add(int label, double weight, int point, int begin, int end) {
  if (label < 0) return;
  add_row(points_.rows().row(point) + begin, weight * points_.rows().unit(point), end - begin,
          &sums_[label * width_ + begin]);
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
  const int own = lower(i, before) < upper_[i] ? 1 : 0;
  if (count_under(&lower(i, 0), n_, upper_[i]) == own) return false;
  bool exact = false;
  for (int k = 0; k < n_; ++k) {
    if (k == labels_[i] || upper_[i] <= lower(i, k)) continue;
    if (!exact) {
      upper_[i] = lower(i, labels_[i]) = distance(i, labels_[i]);
      exact = true;
      if (upper_[i] <= lower(i, k)) continue;
    }
    float& d = lower(i, k) = points_.at_least(i, mean_sums_[k]);
    if (upper_[i] <= d) continue;
    d = distance(i, k);
    if (d < upper_[i]) upper_[i] = d, labels_[i] = k;
  }
  return labels_[i] != before;
}

}  // namespace fragmotion
