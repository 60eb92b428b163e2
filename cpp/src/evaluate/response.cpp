// SPDX-License-Identifier: MIT
#include "fragmotion/evaluate/response.hpp"

namespace fragmotion {
namespace {

constexpr double kRate = 60;               // frames a second
constexpr int kWindow = 6;                 // frames over which a velocity is measured
constexpr double kShare = 0.9;             // of the step
constexpr double kLeast = 1.5, kMost = 2;  // s that a command is held before a step

// A player whose velocity over the last frames is known.
class Runner {
 public:
  explicit Runner(Player& player) : player_(player), track_(kWindow, player.frame()) {}

  void frame(const Control& control) {
    player_.step(control, 1 / kRate);
    for (int i = 1; i < kWindow; ++i) track_[i - 1] = track_[i];
    track_[kWindow - 1] = player_.frame();
  }

  // m/s, seen from the character frame of the window's middle
  Vector2 velocity() const {
    const Vector2 way = track_[kWindow - 1].position - track_[0].position;
    return Eigen::Rotation2Dd(-track_[kWindow / 2].heading) * way * (kRate / (kWindow - 1));
  }

 private:
  Player& player_;
  std::vector<CharacterFrame> track_;
};

double response(Runner& runner, const Control& from, const Control& to) {
  const Vector2 before{from.x, from.y}, step = Vector2{to.x, to.y} - before;
  for (int f = 1; f <= kNoResponse * kRate; ++f) {
    runner.frame(to);
    if ((runner.velocity() - before).dot(step) >= kShare * step.squaredNorm()) return f / kRate;
  }
  return kNoResponse;
}

}  // namespace

std::vector<double> response_times(const std::shared_ptr<const Character>& character, const PlayerOptions& options) {
  Player player(character, options);
  Runner runner(player);
  Random random(options.seed);
  const auto point = [&](int velocity) { return character->space.point(ControlSpace::index(velocity, 0, false)); };
  std::vector<double> times;
  for (int from = 0; from < ControlSpace::kVelocities; ++from) {
    for (int to = 0; to < ControlSpace::kVelocities; ++to) {
      if (to == from) continue;
      const double held = kLeast + (kMost - kLeast) * random.uniform();
      for (int f = 0; f < held * kRate; ++f) runner.frame(point(from));
      times.push_back(response(runner, point(from), point(to)));
    }
  }
  return times;
}

}  // namespace fragmotion
