// SPDX-License-Identifier: MIT
#include "motion/contacts.hpp"

#include <utility>

#include "base/quantile.hpp"
#include "motion/foot_paths.hpp"

namespace fragmotion {
namespace {

// The frames from which on a foot of the pair that begins with `left` stands, or does not.
std::vector<int> changes(const Contacts& contacts, int left, bool stands) {
  std::vector<int> frames;
  for (int f = 1; f < static_cast<int>(contacts.feet[left].size()); ++f) {
    for (const int side : {left, left + 1}) {
      const std::vector<bool>& foot = contacts.feet[side];
      const bool changes = foot[f] == stands && foot[f - 1] != stands;
      if (changes && (frames.empty() || frames.back() != f)) frames.push_back(f);
    }
  }
  return frames;
}

}  // namespace

bool Contacts::any_stands(std::size_t frame) const {
  for (int foot = 0; foot < kMostLegs; ++foot) {
    if (stands(foot, frame)) return true;
  }
  return false;
}

bool Contacts::both_stand(std::size_t frame) const { return stands(0, frame) && stands(1, frame); }

double floor_of(const std::vector<Vector3>& path) {
  std::vector<double> heights;
  for (const Vector3& p : path) heights.push_back(p.z());
  return quantile(std::move(heights), kUnderFloor);
}

Floors usual_floors(const std::vector<Contacts>& contacts) {
  if (contacts.empty()) return {};
  const auto usual = [&](int side, double FootHeights::*point) {
    std::vector<double> heights;
    for (const Contacts& each : contacts) heights.push_back(each.floors[side].*point);
    return median(std::move(heights));
  };
  Floors floors;
  for (int side = 0; side < kMostLegs; ++side)
    floors[side] = {usual(side, &FootHeights::ball), usual(side, &FootHeights::heel)};
  return floors;
}

Contacts find_contacts(const Kinematics& kinematics, const Clip& clip, const Floors* floors) {
  return find_contacts(kinematics.skeleton(), foot_paths(kinematics, clip), hips_path(clip), clip.rate, floors);
}

Contacts find_contacts(const Skeleton& skeleton, const FootPaths& paths, const std::vector<Vector3>& hips, double rate,
                       const Floors* floors) {
  if (paths[0].ball.empty()) return {};
  const double scale = standard_scale(skeleton);
  Contacts contacts;
  for (int side = 0; side < kMostLegs && !paths[side].ball.empty(); ++side) {
    contacts.floors[side] =
        floors ? (*floors)[side] : FootHeights{floor_of(paths[side].ball), floor_of(paths[side].heel)};
    contacts.feet[side] = foot_contacts(paths[side], contacts.floors[side], hips, rate, scale);
  }
  return contacts;
}

Contacts find_plants(const Kinematics& kinematics, const Clip& clip, const Floors* floors) {
  const FootPaths paths = foot_paths(kinematics, clip);
  Contacts contacts = find_contacts(kinematics.skeleton(), paths, hips_path(clip), clip.rate, floors);
  const double scale = standard_scale(kinematics.skeleton());
  for (int side = 0; side < kMostLegs; ++side) end_where_ball_rises(paths[side], clip.rate, scale, contacts.feet[side]);
  return contacts;
}

std::vector<int> foot_strikes(const Contacts& contacts) { return changes(contacts, 0, true); }

std::vector<int> foot_lifts(const Contacts& contacts) { return changes(contacts, 0, false); }

std::vector<int> fore_foot_strikes(const Contacts& contacts) { return changes(contacts, 2, true); }

}  // namespace fragmotion
