// SPDX-License-Identifier: MIT
#include "fragments/lying.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "base/quantile.hpp"
#include "skeleton/kinematics.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

constexpr double kStandingShare = 0.9;  // of the frames; in the others it may rear and leap

// How high the hips and the shoulders are, m.
using Heights = std::array<double, 2>;

std::vector<Heights> heights_of(const Kinematics& kinematics, const Legs& legs, const Clip& clip) {
  PosedBones posed(kinematics.bones());
  std::vector<Heights> heights;
  for (int f = 0; f < clip.frames; ++f) {
    world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
    const auto height = [&](int leg) { return posed.heads[legs[leg].thigh].z(); };
    heights.push_back({(height(0) + height(1)) / 2, (height(2) + height(3)) / 2});
  }
  return heights;
}

// Where the feet are lowest in most clips: an armature's origin may be anywhere.
double ground_of(const Kinematics& kinematics, const Legs& legs, const std::vector<Clip>& clips) {
  PosedBones posed(kinematics.bones());
  std::vector<double> lowest;
  for (const Clip& clip : clips) {
    lowest.push_back(std::numeric_limits<double>::infinity());
    for (int f = 0; f < clip.frames; ++f) {
      world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
      for (const Leg& leg : legs) lowest.back() = std::min(lowest.back(), ankle_of(leg, posed).z());
    }
  }
  return median(std::move(lowest));
}

double standing_height(const std::vector<std::vector<Heights>>& clips, int pair) {
  std::vector<double> all;
  for (const std::vector<Heights>& clip : clips) {
    for (const Heights& heights : clip) all.push_back(heights[pair]);
  }
  return quantile(std::move(all), kStandingShare);
}

}  // namespace

void drop_lying(FragmentPool& pool, std::size_t first) {
  const Kinematics kinematics(pool.skeleton);
  const Legs legs = resting_legs(pool.skeleton);
  if (legs.count() != kMostLegs || pool.fragments.size() == first) return;
  std::vector<std::vector<Heights>> clips;
  for (const Clip& clip : pool.clips) clips.push_back(heights_of(kinematics, legs, clip));
  const Heights standing = {standing_height(clips, 0), standing_height(clips, 1)};
  const double ground = ground_of(kinematics, legs, pool.clips);
  // A dog that goes is over 0.67 of its height in 99 % of frames, one that sits under 0.3.
  const auto is_down = [&](const Heights& heights) {
    const auto sank = [&](int pair) { return heights[pair] - ground < (standing[pair] - ground) / 2; };
    return sank(0) || sank(1);
  };
  const auto lies = [&](const Fragment& fragment) {
    const auto begin = clips[fragment.clip].begin();
    return std::any_of(begin + fragment.begin, begin + fragment.end + 1, is_down);
  };
  pool.fragments.erase(
      std::remove_if(pool.fragments.begin() + static_cast<std::ptrdiff_t>(first), pool.fragments.end(), lies),
      pool.fragments.end());
}

}  // namespace fragmotion
