// SPDX-License-Identifier: MIT
#include "control/control.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "control/gaits.hpp"
#include "motion/contacts.hpp"

namespace fragmotion {

namespace {

void require(bool valid, const char* name, double value, const char* expected) {
  if (valid) return;
  std::ostringstream text;
  text << "control space: " << name << " is " << value << ", expected " << expected;
  throw std::invalid_argument(text.str());
}

void require_positive(const char* name, double value) {
  require(value > 0 && value <= kMostOfSpace, name, value, "a number above 0, up to 1e9");
}

void require_weight(const char* name, double value) {
  require(value >= 0 && value <= kMostOfSpace, name, value, "a number from 0 to 1e9");
}

/// Unit vectors counter-clockwise from forward, of kMostDirections; a table, so that the axes are exact and all others
/// the same everywhere; zeros are positive.
Vector2 direction(int sixteenth) {
  const double d = std::sqrt(0.5), near = 0.92387953251128674, far = 0.38268343236508977;  // cosines of 22.5, 67.5 deg
  const double quarter[4][2] = {{0, 1}, {-far, near}, {-d, d}, {-near, far}};
  const double x = quarter[sixteenth % 4][0], y = quarter[sixteenth % 4][1];
  switch (sixteenth / 4) {
    case 0:
      return {x, y};
    case 1:
      return {0 - y, x};
    case 2:
      return {0 - x, 0 - y};
    default:
      return {y, 0 - x};
  }
}

Vector2 velocity(const ControlLayout& layout, const std::vector<double>& speeds, int number) {
  if (number == 0) return Vector2::Zero();
  return speeds[layout.speed_of(number)] *
         direction(layout.direction_of(number) * (kMostDirections / layout.directions));
}

double square(double value) { return value * value; }

/// The index below `count` whose value is least; the lower one on a tie.
template <typename Value>
int least(int count, const Value& value) {
  int best = 0;
  double best_value = value(0);
  for (int i = 1; i < count; ++i) {
    const double candidate = value(i);
    const bool better = candidate < best_value;
    best = better ? i : best;
    best_value = better ? candidate : best_value;
  }
  return best;
}

constexpr double kQuickest = 170 * kPi / 180;  // rad/s

void check_speeds(const std::vector<double>& speeds) {
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const char* name = speeds.size() != 2 ? "speed (m/s)" : i == 0 ? "walk (m/s)" : "run (m/s)";
    require_positive(name, speeds[i]);
    if (i > 0) require(speeds[i] > speeds[i - 1], name, speeds[i], "more than what is slower");
  }
}

std::vector<double> scaled(std::vector<double> speeds, double scale) {
  for (double& speed : speeds) speed *= scale;
  return speeds;
}

// The number of the speed that is a walk, or else of the first that is faster, or of the fastest.
std::size_t nearest_to_walk(const std::vector<int>& gaits) {
  std::size_t number = 0;
  while (number + 1 < gaits.size() && gaits[number] < kWalk) ++number;
  return number;
}

}  // namespace

void check(const ControlLayout& layout) {
  require(layout.speeds >= 1 && layout.speeds <= kMostSpeeds, "number of speeds", layout.speeds, "1 to 4");
  require(layout.directions == 4 || layout.directions == 8 || layout.directions == kMostDirections,
          "number of directions", layout.directions, "4, 8 or 16");
}

ControlSpace::ControlSpace(double walk, double run, double turn_rate, double scale, ControlWeights weights)
    : ControlSpace(ControlLayout(), {walk, run}, turn_rate, scale, weights) {}

[[gnu::cold]] ControlSpace::ControlSpace(const ControlLayout& layout, std::vector<double> speeds, double turn_rate,
                                         double scale, ControlWeights weights)
    : layout_(layout), speeds_(std::move(speeds)), turn_rate_(turn_rate), scale_(scale), weights_(weights) {
  check(layout);
  require(static_cast<int>(speeds_.size()) == layout.speeds, "number of speeds", static_cast<double>(speeds_.size()),
          "as many as the layout has");
  check_speeds(speeds_);
  require_positive("turn rate (rad/s)", turn_rate);
  require_positive("scale", scale);
  require_weight("velocity weight", weights.velocity);
  require_weight("turn weight", weights.turn);
  require_weight("jump weight", weights.jump);
  gaits_ = gaits_of(scaled(speeds_, scale));
  walk_ = speeds_[nearest_to_walk(gaits_)];
  for (int i = 0; i < layout.size(); ++i) {
    const Vector2 v = velocity(layout, speeds_, layout.velocity_of(i));
    points_.push_back({v.x(), v.y(), static_cast<double>(layout.turn_of(i)), layout.is_jump(i) ? 1.0 : 0.0});
  }
}

// The squared distance is a sum of what velocity, turn and jump differ, and the points are all combinations of them, so
// that the nearest of each make the nearest point.
int ControlSpace::nearest(const Control& control) const {
  const double velocity_weight = square(weights_.velocity * scale_);
  const Control* points = points_.data();
  const int stride = layout_.turns() * layout_.jumps();
  const int velocity = least(layout_.velocities(), [&](int i) {
    const Control& point = points[i * stride];
    return velocity_weight * (square(point.x - control.x) + square(point.y - control.y));
  });
  const int turn = least(3, [&](int i) { return square(weights_.turn * (i - 1 - control.turn)); });
  const int jump = least(2, [&](int i) { return square(weights_.jump * (i - control.jump)); });
  return layout_.index(velocity, turn - 1, jump == 1);
}

bool ControlSpace::asks_to_go(const Control& control) const { return control.speed() * scale_ > 0.8 * kMoving; }

Control ControlSpace::rounded(const Control& control) const {
  const Control steps = this->steps();
  const auto round = [](double value, double step) { return std::round(value / step) * step; };
  return {round(control.x, steps.x), round(control.y, steps.y), round(control.turn, steps.turn),
          round(control.jump, steps.jump)};
}

double ControlSpace::quickest_turn() const { return std::clamp(kQuickest / turn_rate_, 1.0, kMostTurn); }

double ControlSpace::turn_towards(double off) const {
  return std::clamp(off / kFacing / turn_rate_, -quickest_turn(), quickest_turn());
}

}  // namespace fragmotion
