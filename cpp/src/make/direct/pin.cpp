// SPDX-License-Identifier: MIT
#include "direct/pin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "base/ranges.hpp"
#include "base/rates.hpp"
#include "base/rounding.hpp"

namespace fragmotion {
namespace {

constexpr int kBumps = 3;
constexpr int kParts = 3;  // of a change: speed, direction, turn
constexpr std::array<double, kParts> kMost = {0.4, 20 * kPi / 180, 0.6};
constexpr int kRound = 64, kBest = 8;    // tries of a round, and those of them that the next is drawn about
constexpr double kWide = 0.4;            // of kMost: the spread of a first round,
constexpr double kNear = 0.12;           // and of one about the best so far
constexpr double kSettledSpread = 0.01;  // of kMost: the spread at which a search has settled

using Change = std::array<double, kBumps * kParts>;

// About where a round's changes are drawn, and how far around it.
struct Cloud {
  Change middle{}, spread{};

  Cloud(const Change& about, double wide) : middle(about) {
    for (std::size_t i = 0; i < spread.size(); ++i) spread[i] = wide * kMost[i % kParts];
  }

  bool settled() const {
    double widest = 0;
    for (std::size_t i = 0; i < spread.size(); ++i) widest = std::max(widest, spread[i] / kMost[i % kParts]);
    return widest < kSettledSpread;
  }

  Change draw(Random& random) const {
    Change change;
    for (std::size_t i = 0; i < change.size(); ++i) {
      const double sum = random.uniform() + random.uniform() + random.uniform() + random.uniform() - 2;
      const double most = kMost[i % kParts];
      change[i] = std::clamp(middle[i] + std::sqrt(3.0) * sum * spread[i], -most, most);
    }
    return change;
  }

  void follow(const std::vector<Change>& best) {
    for (std::size_t i = 0; i < middle.size(); ++i) {
      double sum = 0, squares = 0;
      for (const Change& change : best) sum += change[i];
      middle[i] = sum / static_cast<double>(best.size());
      for (const Change& change : best) squares += (change[i] - middle[i]) * (change[i] - middle[i]);
      spread[i] = std::sqrt(squares / static_cast<double>(best.size()));
    }
  }
};

struct Trial {
  Change change{};
  std::uint64_t seed = 0;
  CharacterFrame reached;
  double cost = std::numeric_limits<double>::infinity();
};

// The height of a bump at a share of the way, 0 at both ends of it.
double bump(int number, double share) { return ease_in_ease_out(1 - std::abs(share * (kBumps + 1) - (number + 1))); }

class PinSearch {
 public:
  PinSearch(const std::shared_ptr<const Character>& character, const PlayerOptions& player, const CharacterFrame& start,
            const Trace& trace, const PinGoal& goal, const PinOptions& options)
      : options_(options),
        seed_(player.seed),
        start_(start),
        trace_(trace),
        goal_(goal.frame),
        first_(static_cast<int>(std::ceil(options.begin * kTraceRate - kRounding))),
        frames_(static_cast<int>(std::lround(goal.seconds * kGameRate))),
        end_(static_cast<int>(std::ceil(frames_ / (kGameRate / kTraceRate) - kRounding))),
        walk_(character->space.walk()) {
    for (int i = 0; i < thread_count(options.threads); ++i) {
      players_.emplace_back(character, player);
      Player& begun = players_.back();
      begun.reset(start);
      for (int f = 0; f < begin_frame(); ++f) begun.step(trace_[f / kFramesAControl], 1 / kGameRate);
    }
  }

  Pin run(const Progress& progress) {
    std::vector<Trial> trials(1);
    trials[0].seed = seed_;
    make(trials);
    Trial best = trials[0];
    const Trial before = best;
    int tries = 1;
    Cloud cloud({}, kWide);
    std::uint64_t seed = seed_;
    for (int round = 0, turn = 0; tries < options_.tries && !fits(best); ++round) {
      report(progress, static_cast<double>(tries) / options_.tries, "Looking for a way to the pin");
      trials = draw(cloud, round, seed);
      make(trials);
      tries += kRound;
      const auto cheaper = [](const Trial& a, const Trial& b) { return a.cost < b.cost; };
      std::stable_sort(trials.begin(), trials.end(), cheaper);
      if (trials[0].cost < best.cost) best = trials[0];
      narrow(cloud, trials);
      if (!cloud.settled()) continue;
      // In turn about the best so far and, with another seed where that may change, anywhere.
      const bool about_best = ++turn % 2 == 1;
      cloud = about_best ? Cloud(best.change, kNear) : Cloud({}, kWide);
      seed = about_best ? best.seed : seed_ + (first_ == 0 ? static_cast<std::uint64_t>(turn) : 0);
    }
    return result(before, best, tries);
  }

 private:
  static constexpr int kFramesAControl = static_cast<int>(kGameRate / kTraceRate);

  int begin_frame() const { return first_ * kFramesAControl; }

  static void narrow(Cloud& cloud, const std::vector<Trial>& sorted) {
    std::vector<Change> best;
    for (int i = 0; i < kBest; ++i) best.push_back(sorted[i].change);
    cloud.follow(best);
  }

  static std::vector<Trial> draw(const Cloud& cloud, int round, std::uint64_t seed) {
    std::vector<Trial> trials(kRound);
    Random random(static_cast<std::uint64_t>(round) + 1);
    for (Trial& trial : trials) {
      trial.change = cloud.draw(random);
      trial.seed = seed;
    }
    return trials;
  }

  // Plays all trials, each of n players every n-th.
  void make(std::vector<Trial>& trials) {
    const int count = static_cast<int>(trials.size()), players = static_cast<int>(players_.size());
    parallel_for(players, players, [&](int begin, int end) {
      for (int p = begin; p < end; ++p) {
        for (int i = p; i < count; i += players) play(players_[p], trials[i]);
      }
    });
  }

  void play(Player& begun, Trial& trial) const {
    Player player = begun.branch();
    if (first_ == 0) {
      player.reseed(trial.seed);
      player.reset(start_);
    }
    for (int f = begin_frame(); f < frames_; ++f) {
      player.step(changed(f / kFramesAControl, trial.change), 1 / kGameRate);
    }
    trial.reached = player.frame();
    trial.cost = std::hypot(distance(trial) / std::max(options_.distance, kRounding),
                            angle(trial) / std::max(options_.angle, kRounding));
  }

  // A control of the trace, changed: who stands does not begin to go or to turn.
  Control changed(int at, const Change& change) const {
    Control control = trace_[at];
    const double share = (at - first_ + 0.5) / (end_ - first_);
    std::array<double, kParts> by{};
    for (int b = 0; b < kBumps; ++b) {
      for (int part = 0; part < kParts; ++part) by[part] += bump(b, share) * change[b * kParts + part];
    }
    const double moves = std::min(1.0, std::max(control.speed() / walk_, std::abs(control.turn)));
    const Vector2 velocity = (1 + by[0]) * (Eigen::Rotation2Dd(by[1]) * Vector2{control.x, control.y});
    const double turn =
        std::clamp(control.turn + moves * by[2], std::min(-kMostTurn, control.turn), std::max(kMostTurn, control.turn));
    return {velocity.x(), velocity.y(), turn, control.jump};
  }

  double distance(const Trial& trial) const { return (trial.reached.position - goal_.position).norm(); }
  double angle(const Trial& trial) const { return std::abs(wrapped(trial.reached.heading - goal_.heading)); }
  bool fits(const Trial& trial) const { return distance(trial) <= options_.distance && angle(trial) <= options_.angle; }

  Pin result(const Trial& before, const Trial& best, int tries) const {
    Pin pin{trace_,         best.seed,   best.reached, distance(before), angle(before),
            distance(best), angle(best), tries,        fits(best)};
    for (int i = first_; i < end_; ++i) pin.trace[i] = changed(i, best.change);
    return pin;
  }

  PinOptions options_;
  std::uint64_t seed_;
  CharacterFrame start_;
  Trace trace_;
  CharacterFrame goal_;
  int first_, frames_, end_;  // controls, frames, controls: where the changes begin, the pin, where they end
  double walk_;
  std::vector<Player> players_;  // a thread each, before the changes
};

void check(const CharacterFrame& start, const Trace& trace, const PinGoal& goal, const PinOptions& options) {
  if (trace.empty()) throw std::invalid_argument("the trace has no controls");
  require_range("the pin's time", goal.seconds, 1 / kTraceRate, static_cast<double>(trace.size()) / kTraceRate);
  require_range("the time from which controls change", options.begin, 0, goal.seconds - 1 / kTraceRate);
  require_range("the distance that is near enough", options.distance, 0, 100);
  require_range("the angle that is near enough", options.angle, 0, kPi);
  require_range("the number of tries", options.tries, 1, 1e6);
  for (const CharacterFrame& frame : {start, goal.frame}) {
    for (const double value : {frame.position.x(), frame.position.y(), frame.heading})
      require_range("a place or a heading", value, -kFarthestPlace, kFarthestPlace);
  }
}

}  // namespace

Pin find_pin(const std::shared_ptr<const Character>& character, const PlayerOptions& player,
             const CharacterFrame& start, const Trace& trace, const PinGoal& goal, const PinOptions& options,
             const Progress& progress) {
  check(start, trace, goal, options);
  return PinSearch(character, player, start, trace, goal, options).run(progress);
}

}  // namespace fragmotion
