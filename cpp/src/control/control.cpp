// SPDX-License-Identifier: MIT
#include "fragmotion/control/control.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace fragmotion {

namespace {

void require(bool valid, const char* name, double value, const char* expected) {
  if (valid) return;
  std::ostringstream text;
  text << "control space: " << name << " is " << value << ", expected " << expected;
  throw std::invalid_argument(text.str());
}

// Squares of what is within these are numbers still; characters from a micrometre to a thousand kilometres are.
constexpr double kMost = 1e9;

void require_positive(const char* name, double value) {
  require(value > 0 && value <= kMost, name, value, "a number above 0, up to 1e9");
}

void require_weight(const char* name, double value) {
  require(value >= 0 && value <= kMost, name, value, "a number from 0 to 1e9");
}

/// Unit vectors counter-clockwise from forward; a table, so that the axes are exact.
Vector2 direction(int index) {
  const double d = std::sqrt(0.5);
  const double directions[8][2] = {{0, 1}, {-d, d}, {-1, 0}, {-d, -d}, {0, -1}, {d, -d}, {1, 0}, {d, d}};
  return {directions[index][0], directions[index][1]};
}

Vector2 velocity(int number, double walk, double run) {
  if (number == 0) return Vector2::Zero();
  return (ControlSpace::runs(number) ? run : walk) * direction(ControlSpace::direction_of(number));
}

double square(double value) { return value * value; }

/// The index below `count` whose value is least; the lower one on a tie.
template <int count, typename Value>
int least(const Value& value) {
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

constexpr double kLeap = 0.9;                  // evident jump of what is no run
constexpr double kQuickest = 170 * kPi / 180;  // rad/s
constexpr double kMostTurn = 6;                // turn rates
constexpr double kFacing = 0.25;               // s: time constant of the last of a turn

}  // namespace

bool matches_jump(const Control& evident, const Control& wanted) {
  return wanted.jumps() ? evident.jumps() : evident.jump < kLeap;
}

ControlSpace::ControlSpace(double walk, double run, double turn_rate, double scale, ControlWeights weights)
    : walk_(walk), run_(run), turn_rate_(turn_rate), scale_(scale), weights_(weights) {
  require_positive("walk (m/s)", walk);
  require_positive("run (m/s)", run);
  require(run > walk, "run (m/s)", run, "more than walk");
  require_positive("turn rate (rad/s)", turn_rate);
  require_positive("scale", scale);
  require_weight("velocity weight", weights.velocity);
  require_weight("turn weight", weights.turn);
  require_weight("jump weight", weights.jump);
  for (int i = 0; i < kPoints; ++i) {
    const Vector2 v = velocity(velocity_of(i), walk, run);
    points_[i] = {v.x(), v.y(), static_cast<double>(turn_of(i)), jumps(i) ? 1.0 : 0.0};
  }
}

// The squared distance is a sum of what velocity, turn and jump differ, and the points are all combinations of them, so
// that the nearest of each make the nearest point.
int ControlSpace::nearest(const Control& control) const {
  const double velocity_weight = square(weights_.velocity * scale_);
  const int velocity = least<kVelocities>([&](int i) {
    const Control& point = points_[index(i, 0, false)];
    return velocity_weight * (square(point.x - control.x) + square(point.y - control.y));
  });
  const int turn = least<kTurns>([&](int i) { return square(weights_.turn * (i - 1 - control.turn)); });
  const int jump = least<kJumps>([&](int i) { return square(weights_.jump * (i - control.jump)); });
  return index(velocity, turn - 1, jump == 1);
}

double ControlSpace::quickest_turn() const { return std::clamp(kQuickest / turn_rate_, 1.0, kMostTurn); }

double ControlSpace::turn_towards(double off) const {
  return std::clamp(off / kFacing / turn_rate_, -quickest_turn(), quickest_turn());
}

double ControlSpace::distance(const Control& a, const Control& b) const {
  return std::sqrt(square(weights_.velocity * scale_) * (square(a.x - b.x) + square(a.y - b.y)) +
                   square(weights_.turn * (a.turn - b.turn)) + square(weights_.jump * (a.jump - b.jump)));
}

}  // namespace fragmotion
