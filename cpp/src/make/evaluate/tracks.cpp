// SPDX-License-Identifier: MIT
#include "evaluate/tracks.hpp"

#include "motion/packed_clip.hpp"

namespace fragmotion {
namespace {

Clip sampled(const PackedClip& packed, int bones) {
  Clip clip;
  clip.name = packed.name;
  clip.rate = kTrackRate;
  std::vector<double> rotations(std::size_t{4} * bones);
  for (; clip.frames * packed.rate / kTrackRate <= packed.frames - 1; ++clip.frames) {
    const Vector3 root = sample_pose(packed, clip.frames * packed.rate / kTrackRate, rotations.data());
    clip.root_positions.insert(clip.root_positions.end(), root.data(), root.data() + 3);
    clip.rotations.insert(clip.rotations.end(), rotations.begin(), rotations.end());
  }
  return clip;
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

TakeTracks tracks_of_takes(const Character& character) {
  const Kinematics kinematics(character.pool.skeleton);
  TakeTracks takes;
  for (const Clip& take : captured_takes(character.pool)) takes.tracks.push_back(body_track(kinematics, take));
  takes.floors = floors_of(takes.tracks);
  for (BodyTrack& track : takes.tracks) stand_on(track, takes.floors);
  return takes;
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
