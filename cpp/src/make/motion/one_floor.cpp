// SPDX-License-Identifier: MIT
#include "motion/one_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fragmotion {
namespace {

// How far feet stand over the usual floors, m; not finite where a clip has no feet.
double height_over(const Floors& usual, const Contacts& contacts) {
  const bool on_toes = !contacts.feet[2].empty();  // an animal's heels are on the ground where it sits alone
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t foot = 0; foot < usual.size(); ++foot) {
    if (contacts.feet[foot].empty()) continue;
    const FootHeights& floor = contacts.floors[foot];
    least = std::min(least, floor.ball - usual[foot].ball);
    if (!on_toes) least = std::min(least, floor.heel - usual[foot].heel);
  }
  return least;
}

void lower(double by, Clip& clip, Contacts& contacts) {
  for (std::size_t z = 2; z < clip.root_positions.size(); z += 3) clip.root_positions[z] -= by;
  for (FootHeights& floor : contacts.floors) floor.ball -= by, floor.heel -= by;
}

}  // namespace

void put_on_one_floor(std::vector<Clip>& clips, std::vector<Contacts>& contacts) {
  const Floors usual = usual_floors(contacts);
  for (std::size_t c = 0; c < clips.size(); ++c) {
    const double over = height_over(usual, contacts[c]);
    if (std::isfinite(over)) lower(over, clips[c], contacts[c]);
  }
}

}  // namespace fragmotion
