// SPDX-License-Identifier: MIT
#include "motion/steadiest_speed.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace fragmotion {
namespace {

// Speeds, the fastest first, each kSameSpeed of the one before.
class Ladder {
 public:
  Ladder(double fastest, double slowest, double step) {
    for (double speed = fastest; speed >= slowest; speed *= kSameSpeed) speeds_.push_back(speed);
    for (int rung = 0; rung < size(); ++rung) {
      const auto end = std::find_if(speeds_.begin() + rung, speeds_.end(),
                                    [&](double slower) { return speeds_[rung] - slower > step; });
      down_.push_back(std::min(size() - 1, std::max(rung + 1, static_cast<int>(end - speeds_.begin()) - 1)));
    }
    for (int rung = 0, up = 0; rung < size(); ++rung) {
      while (down_[up] < rung) ++up;
      up_.push_back(up);
    }
  }

  int size() const { return static_cast<int>(speeds_.size()); }
  double operator[](int rung) const { return speeds_[rung]; }

  // Adds to each rung's score how well a speed agrees with it: a Gaussian.
  void vote(double speed, double weight, double* scores) const {
    for (int rung = 0; rung < size(); ++rung) {
      const double off = (speed / speeds_[rung] - 1) / (1 - kSameSpeed);
      if (std::abs(off) < 3) scores[rung] += weight * std::exp(-0.5 * off * off);
    }
  }

  // Of the rungs from which another can be reached the one of the best score: itself, where others are no better.
  int best_before(int rung, const std::vector<double>& scores) const {
    int best = rung;
    for (int before = up_[rung]; before <= down_[rung]; ++before) {
      if (scores[before] > scores[best]) best = before;
    }
    return best;
  }

 private:
  std::vector<double> speeds_;
  std::vector<int> up_, down_;  // the fastest and the slowest rung that can be reached from each
};

double fastest_of(const std::vector<ToldSpeeds>& told) {
  double fastest = 0;
  for (const ToldSpeeds& point : told) {
    for (std::size_t f = 0; f < point.speeds.size(); ++f) {
      if (point.weights[f] > 0) fastest = std::max(fastest, point.speeds[f]);
    }
  }
  return fastest;
}

// The rungs that lead to the best score at the end: the best sequence of states (Viterbi 1967).
std::vector<int> best_rungs(const std::vector<ToldSpeeds>& told, const Ladder& ladder, int windows) {
  std::vector<int> from(static_cast<std::size_t>(ladder.size()) * windows, 0);
  std::vector<double> scores(ladder.size(), 0), before;
  for (int f = 0; f < windows; ++f) {
    before = scores;
    for (int rung = 0; rung < ladder.size(); ++rung) {
      const int best = from[static_cast<std::size_t>(ladder.size()) * f + rung] = ladder.best_before(rung, before);
      scores[rung] = before[best];
    }
    for (const ToldSpeeds& point : told) {
      if (point.speeds[f] > 0) ladder.vote(point.speeds[f], point.weights[f], scores.data());
    }
  }
  std::vector<int> rungs(windows);
  int rung = static_cast<int>(std::max_element(scores.begin(), scores.end()) - scores.begin());
  for (int f = windows - 1; f >= 0; --f) {
    rungs[f] = rung;
    rung = from[static_cast<std::size_t>(ladder.size()) * f + rung];
  }
  return rungs;
}

}  // namespace

std::vector<double> steadiest_speed(const std::vector<ToldSpeeds>& told, double slowest, double step) {
  const double fastest = fastest_of(told);
  if (fastest < slowest) return {};
  const Ladder ladder(fastest, slowest, step);
  std::vector<double> speeds;
  for (const int rung : best_rungs(told, ladder, static_cast<int>(told.front().speeds.size())))
    speeds.push_back(ladder[rung]);
  return speeds;
}

}  // namespace fragmotion
