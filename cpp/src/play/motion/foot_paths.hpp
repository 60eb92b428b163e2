// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "motion/contacts.hpp"

namespace fragmotion {

/// m over its floor, of a 1.8 m character, under which a ball or a heel may stand on it.
constexpr double kContactHeight = 0.045;

/// s of a contact: a foot that is on the ground for less only touches it.
constexpr double kShortestContact = 0.06;

/// The path of a foot's ball, its lower end, and of its heel, the foot's head: [frames] m. Both are the end of a leg
/// without a foot.
struct FootPath {
  std::vector<Vector3> ball, heel;
};

/// Of a body's feet, by the numbers of their legs; those that it has, none, two or four, are the first ones.
struct FootPaths {
  std::array<FootPath, kMostLegs> all;

  FootPath& operator[](std::size_t foot) { return all[foot]; }
  const FootPath& operator[](std::size_t foot) const { return all[foot]; }
  int count() const { return !all[2].ball.empty() ? 4 : !all[0].ball.empty() ? 2 : 0; }
  FootPath* begin() { return all.data(); }
  FootPath* end() { return all.data() + count(); }
};

/// Of each foot in a clip; those of a pair are empty where the skeleton has not both.
FootPaths foot_paths(const Kinematics& kinematics, const Clip& clip);

/// That of the hips in a clip: [frames] m.
std::vector<Vector3> hips_path(const Clip& clip);

/// When a foot of this path stands on this floor, as find_contacts() tells it: [frames]. `hips`: their path; times
/// `scale`, lengths are those of a character of 1.8 m.
std::vector<bool> foot_contacts(const FootPath& path, const FootHeights& floor, const std::vector<Vector3>& hips,
                                double rate, double scale);

/// Ends each contact as soon as the ball rises and goes away, faster than kLeaves.
void end_where_ball_rises(const FootPath& path, double rate, double scale, std::vector<bool>& contacts);

/// find_contacts() of feet and hips that went so.
Contacts find_contacts(const Skeleton& skeleton, const FootPaths& paths, const std::vector<Vector3>& hips, double rate,
                       const Floors* floors = nullptr);

}  // namespace fragmotion
