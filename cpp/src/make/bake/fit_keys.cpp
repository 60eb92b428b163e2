// SPDX-License-Identifier: MIT
#include "bake/fit_keys.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fragmotion {
namespace {

constexpr double kPrior = 0.01;  // weight of the values' own slope, which decides where keys are neighbours

// The cubic Hermite basis at `t` of a segment of `frames`, slopes a frame.
struct Hermite {
  double from, from_slope, to, to_slope;

  Hermite(double t, double frames)
      : from((1 + 2 * t) * (1 - t) * (1 - t)),
        from_slope(t * (1 - t) * (1 - t) * frames),
        to(t * t * (3 - 2 * t)),
        to_slope(t * t * (t - 1) * frames) {}
};

class Fit {
 public:
  Fit(const std::vector<double>& values, int width)
      : values_(values), width_(width), frames_(static_cast<int>(values.size()) / width) {
    keys_.key_frames = frames_ > 1 ? std::vector<int>{0, frames_ - 1} : std::vector<int>{0};
  }

  FittedKeys within(double tolerance) {
    do {
      solve_slopes();
      draw();
    } while (add_keys(tolerance));
    return std::move(keys_);
  }

 private:
  double value(int frame, int k) const { return values_[static_cast<std::size_t>(frame) * width_ + k]; }
  int count() const { return static_cast<int>(keys_.key_frames.size()); }

  double own_slope(int frame, int k) const {
    const int before = std::max(frame - 1, 0), after = std::min(frame + 1, frames_ - 1);
    return after > before ? (value(after, k) - value(before, k)) / (after - before) : 0;
  }

  // Normal equations: a symmetric tridiagonal matrix, alike for all components, and a right side for each.
  void solve_slopes() {
    std::vector<double> diagonal(count(), kPrior), beside(count(), 0);
    keys_.slopes.resize(static_cast<std::size_t>(count()) * width_);
    for (int i = 0; i < count(); ++i) {
      for (int k = 0; k < width_; ++k) slope(i, k) = kPrior * own_slope(keys_.key_frames[i], k);
    }
    for (int i = 0; i + 1 < count(); ++i) add_segment(i, diagonal, beside);
    eliminate(diagonal, beside);
  }

  void add_segment(int i, std::vector<double>& diagonal, std::vector<double>& beside) {
    const int first = keys_.key_frames[i], last = keys_.key_frames[i + 1];
    for (int f = first + 1; f < last; ++f) {
      const Hermite h = basis(f, first, last);
      diagonal[i] += h.from_slope * h.from_slope;
      beside[i] += h.from_slope * h.to_slope;
      diagonal[i + 1] += h.to_slope * h.to_slope;
      for (int k = 0; k < width_; ++k) {
        const double rest = value(f, k) - h.from * value(first, k) - h.to * value(last, k);
        slope(i, k) += h.from_slope * rest;
        slope(i + 1, k) += h.to_slope * rest;
      }
    }
  }

  void eliminate(std::vector<double>& diagonal, const std::vector<double>& beside) {
    for (int i = 1; i < count(); ++i) {
      const double share = beside[i - 1] / diagonal[i - 1];
      diagonal[i] -= share * beside[i - 1];
      for (int k = 0; k < width_; ++k) slope(i, k) -= share * slope(i - 1, k);
    }
    for (int i = count() - 1; i >= 0; --i) {
      for (int k = 0; k < width_; ++k) {
        if (i + 1 < count()) slope(i, k) -= beside[i] * slope(i + 1, k);
        slope(i, k) /= diagonal[i];
      }
    }
  }

  void draw() {
    keys_.drawn = values_;
    for (int i = 0; i + 1 < count(); ++i) {
      const int first = keys_.key_frames[i], last = keys_.key_frames[i + 1];
      for (int f = first + 1; f < last; ++f) {
        const Hermite h = basis(f, first, last);
        for (int k = 0; k < width_; ++k) {
          keys_.drawn[static_cast<std::size_t>(f) * width_ + k] = h.from * value(first, k) + h.to * value(last, k) +
                                                                  h.from_slope * slope(i, k) +
                                                                  h.to_slope * slope(i + 1, k);
        }
      }
    }
  }

  // Puts a key where each segment is furthest off, if that is too far; whether it did.
  bool add_keys(double tolerance) {
    std::vector<int> more = keys_.key_frames;
    for (int i = 0; i + 1 < count(); ++i) {
      int furthest = -1;
      double most = tolerance * tolerance;
      for (int f = keys_.key_frames[i] + 1; f < keys_.key_frames[i + 1]; ++f) {
        const double off = squared_error(f);
        if (off <= most) continue;
        most = off;
        furthest = f;
      }
      if (furthest >= 0) more.push_back(furthest);
    }
    const bool added = static_cast<int>(more.size()) > count();
    std::sort(more.begin(), more.end());
    keys_.key_frames = std::move(more);
    return added;
  }

  double squared_error(int frame) const {
    double sum = 0;
    for (int k = 0; k < width_; ++k) {
      const double off = keys_.drawn[static_cast<std::size_t>(frame) * width_ + k] - value(frame, k);
      sum += off * off;
    }
    return sum;
  }

  double& slope(int key, int k) { return keys_.slopes[static_cast<std::size_t>(key) * width_ + k]; }

  static Hermite basis(int frame, int first, int last) {
    return {static_cast<double>(frame - first) / (last - first), static_cast<double>(last - first)};
  }

  const std::vector<double>& values_;
  int width_, frames_;
  FittedKeys keys_;
};

}  // namespace

FittedKeys fit_keys(const std::vector<double>& values, int width, double tolerance) {
  if (width < 1 || values.empty() || values.size() % width != 0)
    throw std::invalid_argument("values to fit keys to: frames of at least one number each expected");
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
    throw std::invalid_argument("values to fit keys to hold what is not a number");
  if (!(tolerance > 0)) throw std::invalid_argument("the tolerance of fitted keys must be above 0");
  return Fit(values, width).within(tolerance);
}

}  // namespace fragmotion
