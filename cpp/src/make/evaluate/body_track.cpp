// SPDX-License-Identifier: MIT
#include "evaluate/body_track.hpp"

#include <algorithm>
#include <cmath>

#include "motion/center_of_mass.hpp"
#include "motion/facing.hpp"

namespace fragmotion {
namespace {

constexpr double kPushSeconds = 0.2;  // s

template <typename T, typename Length>
std::vector<double> second_differences(const std::vector<T>& path, double rate, const Length& length) {
  const auto apart = static_cast<std::size_t>(std::max(1L, std::lround(kPushSeconds * rate)));
  std::vector<double> found;
  for (std::size_t f = 2 * apart; f < path.size(); ++f) {
    found.push_back(length(path[f] - 2 * path[f - apart] + path[f - 2 * apart]) / (kPushSeconds * kPushSeconds));
  }
  return found;
}

void scale_path(std::vector<Vector3>& path, double scale) {
  for (Vector3& place : path) place *= scale;
}

}  // namespace

int BodyTrack::frames_in(double seconds) const { return std::max(1, static_cast<int>(std::lround(seconds * rate))); }

BodyTrack body_track(const Kinematics& kinematics, const Clip& clip) {
  const double scale = standard_scale(kinematics.skeleton());
  BodyTrack track;
  track.rate = clip.rate;
  track.center = center_of_mass(kinematics, clip);
  track.hips = hips_path(clip);
  track.heading = facing(kinematics, clip);
  track.feet = foot_paths(kinematics, clip);
  for (std::vector<Vector3>* path : {&track.center, &track.hips}) scale_path(*path, scale);
  for (FootPath& foot : track.feet) {
    scale_path(foot.ball, scale);
    scale_path(foot.heel, scale);
  }
  return track;
}

void stand_on(BodyTrack& track, const Floors& floors) {
  track.floors = floors;
  if (!track.has_feet()) return;
  for (int side = 0; side < track.feet.count(); ++side) {
    track.stands[side] = foot_contacts(track.feet[side], floors[side], track.hips, track.rate, 1);
  }
}

std::vector<double> ground_accelerations(const std::vector<Vector3>& path, double rate) {
  return second_differences(path, rate, [](const Vector3& change) { return change.head<2>().norm(); });
}

std::vector<double> angular_accelerations(const std::vector<double>& angles, double rate) {
  return second_differences(angles, rate, [](double change) { return std::abs(change); });
}

}  // namespace fragmotion
