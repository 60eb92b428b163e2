// SPDX-License-Identifier: MIT
#include "evaluate/change_pushes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "evaluate/body_track.hpp"
#include "evaluate/runner.hpp"
#include "motion/center_of_mass.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

constexpr double kReversed = 100 * kPi / 180, kSameWay = 20 * kPi / 180;  // rad
constexpr double kAfter = 1.5, kBefore = 0.2;                             // s

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

// Plays, and keeps where the centre of mass is.
class CenterPath {
 public:
  explicit CenterPath(const Character& character)
      : kinematics_(character.pool.skeleton),
        masses_(segment_masses(character.pool.skeleton)),
        posed_(kinematics_.bones()),
        scale_(character.space.scale()) {}

  void add(const Player& player) {
    kinematics_.world(player.root_position(), player.rotations().data(), posed_.heads.data(), posed_.rotations.data());
    path_.emplace_back(scale_ * center_of_mass(kinematics_.skeleton(), masses_, posed_));
  }
  std::vector<Vector3> take() { return std::exchange(path_, {}); }

 private:
  Kinematics kinematics_;
  std::vector<double> masses_;
  PosedBones posed_;
  double scale_;
  std::vector<Vector3> path_;
};

// Of the frames from the change until kAfter later; a push is of the 0.2 s to each side of a frame.
std::vector<double> pushes_after(Runner& runner, CenterPath& path, const Step& step) {
  const int before = static_cast<int>(kBefore * kTrackRate), after = static_cast<int>((kAfter + kBefore) * kTrackRate);
  for (int f = 0; f < before; ++f) {
    runner.frame(step.from);
    path.add(runner.player());
  }
  for (int f = 0; f <= after; ++f) {
    runner.frame(step.to);
    path.add(runner.player());
  }
  return ground_accelerations(path.take(), kTrackRate);
}

}  // namespace

Change kind_of(const Control& from, const Control& to) {
  const Vector2 before{from.x, from.y}, after{to.x, to.y};
  if (from.speed() == 0) return to.speed() == 0 ? Change::turn : Change::start;
  if (to.speed() == 0) return Change::stop;
  const double angle = std::acos(std::clamp(before.dot(after) / (from.speed() * to.speed()), -1.0, 1.0));
  if (angle > kReversed) return Change::reverse;
  return angle > kSameWay || from.turn != to.turn ? Change::turn : Change::gait;
}

std::array<Pushes, kChanges> change_pushes(const std::shared_ptr<const Character>& character,
                                           const PlayerOptions& options) {
  Player player(character, options);
  Runner runner(player);
  CenterPath path(*character);
  Random random(options.seed);
  std::array<std::vector<double>, kChanges> found;
  for (const Step& step : all_steps(character->space)) {
    runner.hold(step.from, random);
    const std::vector<double> after = pushes_after(runner, path, step);
    std::vector<double>& some = found[static_cast<std::size_t>(kind_of(step.from, step.to))];
    some.insert(some.end(), after.begin(), after.end());
  }
  std::array<Pushes, kChanges> result;
  for (std::size_t kind = 0; kind < result.size(); ++kind) result[kind] = pushes(std::move(found[kind]));
  return result;
}

}  // namespace fragmotion
