// SPDX-License-Identifier: MIT
#include "evaluate/change_pushes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rates.hpp"
#include "base/rounding.hpp"
#include "evaluate/about_face.hpp"
#include "evaluate/body_track.hpp"
#include "evaluate/dragging.hpp"
#include "evaluate/runner.hpp"
#include "evaluate/tracks.hpp"

namespace fragmotion {
namespace {

constexpr double kAfter = 1.5, kBefore = 0.2;  // s

struct Step {
  Control from, to;
};

std::vector<Step> all_steps(const ControlSpace& space) {
  const ControlLayout& layout = space.layout();
  const auto point = [&](int velocity, int turn) { return space.point(layout.index(velocity, turn, false)); };
  std::vector<Step> steps;
  for (int from = 0; from < layout.velocities(); ++from) {
    for (int to = 0; to < layout.velocities(); ++to) {
      if (to != from) steps.push_back({point(from, 0), point(to, 0)});
    }
  }
  for (int speed = 0; layout.turn && speed < layout.speeds; ++speed) {
    const int forward = 1 + speed * layout.directions;
    for (const int turn : {-1, 1}) {
      steps.push_back({point(forward, 0), point(forward, turn)});
      steps.push_back({point(forward, turn), point(forward, 0)});
    }
  }
  return steps;
}

constexpr int kFramesBefore = static_cast<int>(kBefore * kGameRate),
              kFramesAfter = static_cast<int>((kAfter + kBefore) * kGameRate);

void show(const Player& player, Clip& clip) {
  const Vector3& root = player.root_position();
  clip.root_positions.insert(clip.root_positions.end(), root.data(), root.data() + 3);
  clip.rotations.insert(clip.rotations.end(), player.rotations().begin(), player.rotations().end());
  ++clip.frames;
}

// From kBefore before the change until kAfter and as much later.
Clip shown_around(Runner& runner, const Step& step) {
  Clip clip;
  clip.rate = kGameRate;
  for (int f = -kFramesBefore; f <= kFramesAfter; ++f) {
    runner.frame(f < 0 ? step.from : step.to);
    show(runner.player(), clip);
  }
  return clip;
}

// What changes of one kind do; a push is of the 0.2 s to each side of a frame.
struct Changes {
  std::vector<double> pushes;
  double dragged = 0, count = 0;

  ChangePushes result() { return {fragmotion::pushes(std::move(pushes)), count > 0 ? dragged / count : 0}; }
};

}  // namespace

Change kind_of(const Control& from, const Control& to) {
  const Vector2 before{from.x, from.y}, after{to.x, to.y};
  if (from.speed() == 0) return to.speed() == 0 ? Change::turn : Change::start;
  if (to.speed() == 0) return Change::stop;
  const double angle = std::acos(std::clamp(before.dot(after) / (from.speed() * to.speed()), -1.0, 1.0));
  if (angle > kTurnsBack) return Change::reverse;
  return angle > kFloatRounding || from.turn != to.turn ? Change::turn : Change::gait;
}

std::array<ChangePushes, kChanges> change_pushes(const std::shared_ptr<const Character>& character,
                                                 const PlayerOptions& options) {
  Player player(character, options);
  Runner runner(player);
  const Kinematics kinematics(character->pool.skeleton);
  const auto [takes, floors] = tracks_of(kinematics.skeleton(), captured_takes(character->pool));
  const FootClearance clearance = clearance_of(takes);
  Random random(options.seed);
  std::array<Changes, kChanges> found;
  for (const Step& step : all_steps(character->space)) {
    runner.hold(step.from, random);
    BodyTrack track = body_track(kinematics, shown_around(runner, step));
    stand_on(track, floors);
    const std::vector<double> pushes = ground_accelerations(track.center, kGameRate);
    Changes& some = found[static_cast<std::size_t>(kind_of(step.from, step.to))];
    some.pushes.insert(some.pushes.end(), pushes.begin(), pushes.end());
    some.dragged += dragging(track, clearance, kFramesBefore).dragged;
    ++some.count;
  }
  std::array<ChangePushes, kChanges> result;
  for (std::size_t kind = 0; kind < result.size(); ++kind) result[kind] = found[kind].result();
  return result;
}

}  // namespace fragmotion
