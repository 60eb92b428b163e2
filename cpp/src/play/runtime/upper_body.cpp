// SPDX-License-Identifier: MIT
#include "runtime/upper_body.hpp"

#include <algorithm>

#include "base/rounding.hpp"

namespace fragmotion {
namespace {

constexpr double kBlend = 0.3;  // s

void blend(const Quaternion& to, double weight, double* rotation) {
  double wanted[4];
  store_quaternion(to, wanted);
  blend_rotations(rotation, wanted, weight, 1, rotation);
}

}  // namespace

[[gnu::cold]] UpperBody::UpperBody(const Character& character, Workspace& workspace, Stitching stitching, double stitch)
    : track(character),
      character_(&character),
      workspace_(&workspace),
      base_(Trunk(character.pool.skeleton).base),
      playback_(character, workspace, stitching, stitch) {
  for (int b = base_ + 1; base_ >= 0 && b < character.pool.skeleton.size(); ++b) {
    if (character.pool.skeleton.is_below(b, base_)) bones_.push_back(b);
  }
}

void UpperBody::reset() {
  track.reset();
  weight_ = 0;
}

void UpperBody::begin() {
  const int part = track.begin();
  if (weight_ > 0) {
    playback_.show();
    playback_.start(part);
  } else {
    playback_.reset(part, {});
  }
}

bool UpperBody::is_ending() const {
  if (!track.plays()) return true;
  const Move& move = character_->moves[track.playing()];
  const Fragment& part = playback_.fragment();
  return part.end == character_->pool.clips[move.clip].frames - 1 && !track.repeats() && playback_.left() < kBlend;
}

void UpperBody::advance(double seconds) {
  if (!track.plays() && weight_ <= 0) return;
  for (double rest = seconds; track.plays() && rest > 0;) {
    const double part = std::min(rest, playback_.left());
    playback_.advance(part);
    rest -= part;
    if (playback_.left() > kRounding) continue;
    const int next = track.next_part();
    if (next < 0) break;
    playback_.show();
    playback_.start(next);
  }
  weight_ = std::clamp(weight_ + (is_ending() ? -seconds : seconds) / kBlend, 0.0, 1.0);
}

void UpperBody::lay(WorldPose& pose) const {
  if (weight_ <= 0) return;
  WorldPose& move = workspace_->poses[0];
  playback_.sample(playback_.seconds(), move);
  lay(move, ease_in_ease_out(weight_), pose);
}

void UpperBody::lay(const WorldPose& move, double weight, WorldPose& pose) const {
  const Skeleton& skeleton = workspace_->kinematics.skeleton();
  const Quaternion below = world_turn(skeleton, skeleton.parents[base_], pose.rotations.data()),
                   facing = CharacterFrame{{}, pose.heading - move.heading}.rotation(),
                   wanted = facing * world_turn(skeleton, base_, move.rotations.data());
  blend(below.conjugate() * wanted, weight, &pose.rotations[std::size_t{4} * base_]);
  for (const int b : bones_) {
    const std::size_t at = std::size_t{4} * b;
    blend(load_quaternion(&move.rotations[at]), weight, &pose.rotations[at]);
  }
}

double UpperBody::distance_to(int move) const {
  auto& [opening, laid, unused, unused_too] = workspace_->poses;
  const Fragment& part = character_->played(character_->number_of(move, MovePart::opening));
  const PackedClip& clip = character_->pool.clips[part.clip];
  opening.root = sample_pose(clip, 0, opening.rotations.data());
  opening.heading = frame_at(clip, 0).heading;
  laid = workspace_->shown;
  lay(opening, 1, laid);
  auto& [before, after, none] = workspace_->tips;
  const CharacterFrame frame{laid.root.head<2>(), laid.heading};
  std::vector<float>& rows = workspace_->onward;
  const int stride = static_cast<int>(rows.size()) / 3, points = before.points();
  before.pose(workspace_->shown.root, workspace_->shown.rotations.data());
  before.write(frame, rows.data(), stride, 0);
  after.pose(laid.root, laid.rotations.data());
  after.write(frame, rows.data(), stride, points);
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const float *x = &rows[i], *y = x + stride, *z = y + stride;
    sum += Vector3{x[0] - x[points], y[0] - y[points], z[0] - z[points]}.norm();
  }
  return sum * kTunedReach / before.reach();
}

}  // namespace fragmotion
