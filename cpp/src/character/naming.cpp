// SPDX-License-Identifier: MIT
#include "fragmotion/character/naming.hpp"

namespace fragmotion {
namespace {

constexpr const char* kDirections[] = {"forward", "forward left", "left",  "back left",
                                       "back",    "back right",   "right", "forward right"};

// The gait or jump with its direction, without a turn.
std::string moving(int velocity, bool jumps) {
  const bool runs = ControlSpace::runs(velocity);
  const int direction = ControlSpace::direction_of(velocity);
  const bool aside = direction % 4 == 2;
  const char* verb = runs ? "run" : aside ? "sidestep" : "walk";
  if (jumps) verb = runs ? "running jump" : "jump";
  return std::string(verb) + " " + kDirections[direction];
}

}  // namespace

std::string control_name(const ControlSpace& space, const Control& control) {
  const int point = space.nearest(control);
  const int velocity = ControlSpace::velocity_of(point), turn = ControlSpace::turn_of(point);
  const bool jumps = ControlSpace::jumps(point);
  const std::string side = turn > 0 ? "left" : "right";
  if (velocity == 0 && !jumps) return turn == 0 ? "stand" : "turn " + side + " in place";
  const std::string name = velocity == 0 ? "jump up" : moving(velocity, jumps);
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
