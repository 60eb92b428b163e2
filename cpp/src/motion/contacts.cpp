// SPDX-License-Identifier: MIT
#include "fragmotion/motion/contacts.hpp"

#include <algorithm>
#include <cmath>

#include "fragmotion/skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

constexpr double kHeight = 0.045, kSpeed = 0.5, kSpeedShare = 0.2, kShortest = 0.06;
constexpr double kDeeper = 0.02;  // of a path's points, that may be under its floor

// The path of a foot's ball, its lower end, and of its heel, the foot's head.
struct FootPath {
  std::vector<Vector3> ball, heel;
};

std::array<FootPath, 2> foot_paths(const Kinematics& kinematics, const Clip& clip) {
  const Skeleton& skeleton = kinematics.skeleton();
  const Roles& roles = skeleton.roles;
  const int feet[] = {roles.left_foot, roles.right_foot}, toes[] = {roles.left_toe, roles.right_toe};
  const std::vector<int> bones = kinematics.chains({feet[0], feet[1], toes[0], toes[1]});
  PosedBones posed(kinematics.bones());
  std::array<FootPath, 2> paths;
  for (int f = 0; f < clip.frames; ++f) {
    world(kinematics, clip, f, bones, posed.heads.data(), posed.rotations.data());
    for (int side = 0; side < 2; ++side) {
      paths[side].ball.push_back(ball(skeleton, feet[side], toes[side], posed));
      paths[side].heel.push_back(posed.heads[feet[side]]);
    }
  }
  return paths;
}

double speed_at(const std::vector<Vector3>& path, int f, double rate) {
  const int last = static_cast<int>(path.size()) - 1, a = std::max(0, f - 1), b = std::min(last, f + 1);
  return (path[b] - path[a]).norm() * rate / (b - a);
}

// Flips runs of `value` shorter than `frames`, those at the ends of the clip excepted.
void close_short_runs(std::vector<bool>& flags, bool value, int frames) {
  const int count = static_cast<int>(flags.size());
  for (int begin = 0; begin < count;) {
    int end = begin;
    while (end < count && flags[end] == flags[begin]) ++end;
    if (flags[begin] == value && end - begin < frames && begin > 0 && end < count) {
      std::fill(flags.begin() + begin, flags.begin() + end, !value);
    }
    begin = end;
  }
}

std::vector<bool> foot_contacts(const FootPath& path, const FootHeights& floor, const std::vector<Vector3>& hips,
                                double rate, double scale) {
  std::vector<bool> flags(path.ball.size());
  for (int f = 0; f < static_cast<int>(flags.size()); ++f) {
    const double limit = kSpeed + kSpeedShare * speed_at(hips, f, rate) * scale;
    const auto stands = [&](const std::vector<Vector3>& point, double lowest) {
      return (point[f].z() - lowest) * scale < kHeight && speed_at(point, f, rate) * scale < limit;
    };
    flags[f] = stands(path.ball, floor.ball) || stands(path.heel, floor.heel);
  }
  const int frames = static_cast<int>(std::ceil(kShortest * rate));
  close_short_runs(flags, false, frames);
  close_short_runs(flags, true, frames);
  return flags;
}

// The frames from which on a foot stands, or does not.
std::vector<int> changes(const Contacts& contacts, bool stands) {
  std::vector<int> frames;
  for (int f = 1; f < static_cast<int>(contacts.feet[0].size()); ++f) {
    for (const std::vector<bool>& foot : contacts.feet) {
      const bool changes = foot[f] == stands && foot[f - 1] != stands;
      if (changes && (frames.empty() || frames.back() != f)) frames.push_back(f);
    }
  }
  return frames;
}

}  // namespace

double floor_of(const std::vector<Vector3>& path) {
  std::vector<double> heights;
  for (const Vector3& p : path) heights.push_back(p.z());
  const auto floor = heights.begin() + static_cast<std::ptrdiff_t>(kDeeper * static_cast<double>(heights.size() - 1));
  std::nth_element(heights.begin(), floor, heights.end());
  return *floor;
}

Contacts find_contacts(const Kinematics& kinematics, const Clip& clip, const Floors* floors) {
  const Roles& roles = kinematics.skeleton().roles;
  if (roles.left_foot < 0 || roles.right_foot < 0) return {};
  std::vector<Vector3> hips;
  for (int f = 0; f < clip.frames; ++f) hips.push_back(load_vector(&clip.root_positions[3 * f]));
  const double scale = standard_scale(kinematics.skeleton());
  const std::array<FootPath, 2> paths = foot_paths(kinematics, clip);
  Contacts contacts;
  for (int side = 0; side < 2; ++side) {
    contacts.floors[side] =
        floors ? (*floors)[side] : FootHeights{floor_of(paths[side].ball), floor_of(paths[side].heel)};
    contacts.feet[side] = foot_contacts(paths[side], contacts.floors[side], hips, clip.rate, scale);
  }
  return contacts;
}

std::vector<int> foot_strikes(const Contacts& contacts) { return changes(contacts, true); }

std::vector<int> foot_lifts(const Contacts& contacts) { return changes(contacts, false); }

}  // namespace fragmotion
