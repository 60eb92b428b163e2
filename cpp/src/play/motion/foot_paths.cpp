// SPDX-License-Identifier: MIT
#include "motion/foot_paths.hpp"

#include <algorithm>
#include <cmath>

#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

constexpr double kSpeedShare = 0.2;

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

}  // namespace

FootPaths foot_paths(const Kinematics& kinematics, const Clip& clip) {
  const Skeleton& skeleton = kinematics.skeleton();
  const std::vector<LegRoles> feet = legs_with_feet(skeleton.roles);
  std::vector<int> ends;
  std::vector<bool> stilts;
  for (const LegRoles& leg : feet) {
    ends.insert(ends.end(), {leg.foot, leg.toe});
    stilts.push_back(ends_without_foot(skeleton, leg));
  }
  const std::vector<int> bones = kinematics.chains(ends);
  PosedBones posed(kinematics.bones());
  FootPaths paths;
  for (int f = 0; f < clip.frames && !feet.empty(); ++f) {
    world(kinematics, clip, f, bones, posed.heads.data(), posed.rotations.data());
    for (std::size_t i = 0; i < feet.size(); ++i) {
      paths[i].ball.push_back(ball(skeleton, feet[i].foot, feet[i].toe, posed));
      paths[i].heel.push_back(stilts[i] ? paths[i].ball.back() : posed.heads[feet[i].foot]);
    }
  }
  return paths;
}

std::vector<Vector3> hips_path(const Clip& clip) {
  std::vector<Vector3> hips;
  for (int f = 0; f < clip.frames; ++f) hips.push_back(load_vector(&clip.root_positions[3 * f]));
  return hips;
}

std::vector<bool> foot_contacts(const FootPath& path, const FootHeights& floor, const std::vector<Vector3>& hips,
                                double rate, double scale) {
  std::vector<bool> flags(path.ball.size());
  for (int f = 0; f < static_cast<int>(flags.size()); ++f) {
    const double limit = kStandingSpeed + kSpeedShare * speed_at(hips, f, rate) * scale;
    const auto stands = [&](const std::vector<Vector3>& point, double lowest) {
      return (point[f].z() - lowest) * scale < kContactHeight && speed_at(point, f, rate) * scale < limit;
    };
    flags[f] = stands(path.ball, floor.ball) || stands(path.heel, floor.heel);
  }
  const int frames = static_cast<int>(std::ceil(kShortestContact * rate));
  close_short_runs(flags, false, frames);
  const std::vector<bool> all = flags;
  close_short_runs(flags, true, frames);
  const bool stands = std::find(flags.begin(), flags.end(), true) != flags.end();
  return stands ? flags : all;
}

void end_where_ball_rises(const FootPath& path, double rate, double scale, std::vector<bool>& contacts) {
  const std::vector<Vector3>& ball = path.ball;
  for (int f = static_cast<int>(contacts.size()) - 2; f > 0; --f) {
    const bool ends = contacts[f] && !contacts[f + 1], rises = ball[f + 1].z() > ball[f].z();
    if (ends && rises && speed_at(ball, f, rate) * scale > kLeaves) contacts[f] = false;
  }
}

}  // namespace fragmotion
