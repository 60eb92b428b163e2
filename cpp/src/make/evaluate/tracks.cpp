// SPDX-License-Identifier: MIT
#include "evaluate/tracks.hpp"

#include "base/rates.hpp"
#include "motion/packed_clip.hpp"

namespace fragmotion {
namespace {

Clip sampled(const PackedClip& packed, int bones) {
  Clip clip;
  clip.name = packed.name;
  clip.rate = kGameRate;
  std::vector<double> rotations(std::size_t{4} * bones);
  for (; clip.frames * packed.rate / kGameRate <= packed.frames - 1; ++clip.frames) {
    const Vector3 root = sample_pose(packed, clip.frames * packed.rate / kGameRate, rotations.data());
    clip.root_positions.insert(clip.root_positions.end(), root.data(), root.data() + 3);
    clip.rotations.insert(clip.rotations.end(), rotations.begin(), rotations.end());
  }
  return clip;
}

Floors floors_of(const std::vector<BodyTrack>& takes) {
  std::vector<Contacts> contacts(takes.size());
  for (std::size_t i = 0; i < takes.size(); ++i) {
    for (int side = 0; side < takes[i].feet.count(); ++side) {
      const FootPath& foot = takes[i].feet[side];
      contacts[i].floors[side] = {floor_of(foot.ball), floor_of(foot.heel)};
    }
  }
  return usual_floors(contacts);
}

}  // namespace

std::vector<Clip> captured_takes(const PackedPool& pool) {
  std::vector<bool> captured(pool.clips.size(), false);
  for (const Fragment& f : pool.fragments) captured[f.clip] = captured[f.clip] || f.origin == Origin::captured;
  std::vector<Clip> takes;
  for (std::size_t c = 0; c < pool.clips.size(); ++c) {
    if (captured[c]) takes.push_back(sampled(pool.clips[c], pool.skeleton.size()));
  }
  return takes;
}

TakeTracks tracks_of(const Skeleton& skeleton, const std::vector<Clip>& takes) {
  const Kinematics kinematics(skeleton);
  TakeTracks found;
  for (const Clip& take : takes) found.tracks.push_back(body_track(kinematics, take));
  found.floors = floors_of(found.tracks);
  for (BodyTrack& track : found.tracks) stand_on(track, found.floors);
  return found;
}

Clip clip_of(const Performance& performance) {
  Clip clip;
  clip.rate = performance.rate;
  clip.frames = performance.frames;
  clip.root_positions = performance.root_positions;
  clip.rotations = performance.rotations;
  return clip;
}

}  // namespace fragmotion
