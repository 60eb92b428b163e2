// SPDX-License-Identifier: MIT
#include "character/naming.hpp"

#include "control/gaits.hpp"

namespace fragmotion {
namespace {

// The gait or jump with its direction, without a turn.
std::string moving(const ControlSpace& space, int velocity, bool jumps) {
  const ControlLayout& layout = space.layout();
  const int gait = space.gaits()[layout.speed_of(velocity)];
  const int direction = layout.direction_of(velocity) * (kMostDirections / layout.directions);
  const bool aside = direction % (kMostDirections / 2) == kMostDirections / 4;
  const char* verb = jumps ? kGaits[gait].jump : aside && gait == kWalk ? "sidestep" : kGaits[gait].name;
  return std::string(verb) + " " + kDirectionNames[direction];
}

}  // namespace

std::string control_name(const ControlSpace& space, const Control& control) {
  const ControlLayout& layout = space.layout();
  const int point = space.nearest(control), velocity = layout.velocity_of(point), turn = layout.turn_of(point);
  const bool jumps = layout.is_jump(point);
  const std::string side = turn > 0 ? "left" : "right";
  if (velocity == 0 && !jumps) return turn == 0 ? "stand" : "turn " + side + " in place";
  const std::string name = velocity == 0 ? "jump up" : moving(space, velocity, jumps);
  return turn == 0 ? name : name + " turning " + side;
}

std::vector<std::string> class_names(const Character& character) {
  std::map<std::string, int> used;
  std::vector<std::string> names;
  for (const int representative : character.classes.representatives) {
    const std::string name = control_name(character.space, character.pool.fragments[representative].evident);
    const int number = ++used[name];
    names.push_back(number == 1 ? name : name + " " + std::to_string(number));
  }
  return names;
}

}  // namespace fragmotion
