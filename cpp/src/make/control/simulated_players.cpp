// SPDX-License-Identifier: MIT
#include "control/simulated_players.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/random.hpp"
#include "base/ranges.hpp"

namespace fragmotion {

namespace {

constexpr int kSteps = 10;  // of the stick's spring, between two controls

/// What a player does with the pad. Probabilities are per choice, times in seconds.
struct Habits {
  const char* name;
  double stand, walk;        ///< Probabilities of letting go and of walking; else running.
  double shortest, longest;  ///< How long a target of the stick is held.
  double redirect;           ///< Probability that a new target has a new direction.
  double forward, back;      ///< Probabilities that it is forward and back; else sidewards.
  double spread;             ///< How far it strays: the part across for each part along.
  double turn, left;         ///< Probability of pressing a turn button, and that it is the left one.
  double jumps;              ///< A second.
  double lag;                ///< Time constant of the stick.
};

// clang-format off
constexpr Habits kPlayers[] = {
    // name      stand walk  hold        redirect fwd   back  spread turn  left  jumps lag
    {"walker",   0.15, 0.80, 1.5, 4.0,   0.50,    0.80, 0.05, 0.35,  0.35, 0.50, 0.01, 0.20},
    {"stroller", 0.35, 0.65, 2.0, 5.0,   0.40,    0.75, 0.10, 0.50,  0.30, 0.50, 0.00, 0.30},
    {"runner",   0.08, 0.17, 1.5, 4.0,   0.45,    0.85, 0.03, 0.30,  0.40, 0.50, 0.05, 0.15},
    {"sprinter", 0.20, 0.05, 2.0, 6.0,   0.35,    0.92, 0.02, 0.20,  0.25, 0.50, 0.08, 0.10},
    {"twitcher", 0.20, 0.40, 0.3, 0.9,   0.85,    0.45, 0.20, 0.60,  0.55, 0.50, 0.10, 0.10},
    {"jumper",   0.25, 0.40, 0.8, 2.5,   0.50,    0.75, 0.08, 0.40,  0.30, 0.50, 0.45, 0.15},
    {"circler",  0.05, 0.60, 2.0, 5.0,   0.30,    0.85, 0.03, 0.30,  0.85, 0.85, 0.02, 0.20},
    {"explorer", 0.20, 0.50, 0.8, 3.5,   0.70,    0.55, 0.15, 0.60,  0.50, 0.50, 0.12, 0.20},
};
// clang-format on

const Habits& find_habits(const std::string& player) {
  std::string known;
  for (const Habits& habits : kPlayers) {
    if (player == habits.name) return habits;
    known += std::string(known.empty() ? "" : ", ") + habits.name;
  }
  throw std::invalid_argument("no simulated player '" + player + "'; known are " + known);
}

/// A player at the pad. Only + - * / and square roots: those are the same everywhere, sines are not.
class PlayerSimulation {
 public:
  PlayerSimulation(const Habits& habits, std::uint64_t seed, const ControlSpace& space)
      : habits_(habits), random_(seed), space_(space) {}

  Control next() {
    if (expired(stick_left_)) choose_target();
    if (expired(turn_left_)) choose_turn();
    if (expired(jump_left_) && chance(habits_.jumps / kTraceRate)) jump_left_ = between(0.3, 0.6);
    for (int i = 0; i < kSteps; ++i) move_stick();
    const ControlLayout& layout = space_.layout();
    const int velocity = layout.velocity_of(space_.nearest({stick_.x(), stick_.y(), 0, 0}));
    return space_.point(layout.index(velocity, turn_, jump_left_ > 0));
  }

 private:
  bool chance(double probability) { return random_.uniform() < probability; }
  double between(double low, double high) { return low + (high - low) * random_.uniform(); }

  /// Counts a time down by one control.
  static bool expired(double& left) {
    left -= 1 / kTraceRate;
    return left <= 0;
  }

  void choose_target() {
    stick_left_ = between(habits_.shortest, habits_.longest);
    if (chance(habits_.redirect)) choose_direction();
    target_ = choose_speed() * direction_;
  }

  /// Whoever walks goes at one of the slower half of the speeds, and whoever runs at one of the faster half, each as
  /// often; the one in the middle is of both.
  double choose_speed() {
    const double pace = random_.uniform(), walk = habits_.stand + habits_.walk;
    if (pace < habits_.stand) return 0;
    const bool walks = pace < walk;
    const double share = walks ? (pace - habits_.stand) / habits_.walk : (pace - walk) / (1 - walk);
    const int count = space_.layout().speeds, half = (count + 1) / 2;
    return space_.speeds()[(walks ? 0 : count - half) + std::min(static_cast<int>(share * half), half - 1)];
  }

  void choose_direction() {
    const double way = random_.uniform();
    const double across = between(-habits_.spread, habits_.spread);
    if (way < habits_.forward)
      direction_ = {across, 1};
    else if (way < habits_.forward + habits_.back)
      direction_ = {across, -1};
    else
      direction_ = {chance(0.5) ? 1 : -1, across};
    direction_ /= std::sqrt(direction_.x() * direction_.x() + direction_.y() * direction_.y());
  }

  void choose_turn() {
    turn_left_ = between(0.5, 2);
    turn_ = !chance(habits_.turn) ? 0 : chance(habits_.left) ? 1 : -1;
  }

  /// One step of a critically damped spring from the stick to the target.
  void move_stick() {
    const double step = 1 / (kTraceRate * kSteps);
    const double frequency = 1 / habits_.lag;
    motion_ += step * (frequency * frequency * (target_ - stick_) - 2 * frequency * motion_);
    stick_ += step * motion_;
  }

  const Habits& habits_;
  Random random_;
  const ControlSpace& space_;
  Vector2 direction_{0, 1};
  Vector2 target_{0, 0}, stick_{0, 0}, motion_{0, 0};  // m/s, m/s^2
  int turn_ = 0;
  double stick_left_ = 0, turn_left_ = 0, jump_left_ = 0;  // s
};

}  // namespace

const std::vector<std::string>& simulated_players() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Habits& habits : kPlayers) all.emplace_back(habits.name);
    return all;
  }();
  return names;
}

Trace simulate_trace(const std::string& player, double seconds, std::uint64_t seed, const ControlSpace& space) {
  const Habits& habits = find_habits(player);
  if (!(seconds * kTraceRate >= 1.5 && seconds <= kDay))
    throw std::invalid_argument("a trace of " + std::to_string(seconds) + " s, expected 0.2 to 86400");
  PlayerSimulation simulation(habits, seed, space);
  Trace trace(std::lround(seconds * kTraceRate));
  for (Control& control : trace) control = simulation.next();
  return trace;
}

}  // namespace fragmotion
