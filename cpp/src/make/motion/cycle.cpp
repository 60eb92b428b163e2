// SPDX-License-Identifier: MIT
#include "motion/cycle.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/rates.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

constexpr double kHeld = 0.01;  // of what a clip changes in a frame on the mean: less is nothing

// The poses of a clip, each seen from the character frame of its hips.
class Poses {
 public:
  Poses(const Kinematics& kinematics, const Clip& clip)
      : kinematics_(kinematics), clip_(clip), bones_(measured_bones(kinematics.skeleton())) {}

  CharacterFrame frame(int f) const {
    const std::size_t hips =
        std::size_t{4} * (static_cast<std::size_t>(f) * kinematics_.bones() + kinematics_.skeleton().roles.hips);
    return kinematics_.frame(load_vector(&clip_.root_positions[std::size_t{3} * f]),
                             load_quaternion(&clip_.rotations[hips]));
  }

  // The sum over bone tips of their distances, m.
  double distance(int a, int b) const {
    const std::vector<Vector3> from = tips(a), to = tips(b);
    double sum = 0;
    for (std::size_t i = 0; i < from.size(); ++i) sum += (from[i] - to[i]).norm();
    return sum;
  }

 private:
  std::vector<Vector3> tips(int f) const {
    PosedBones posed(kinematics_.bones());
    world(kinematics_, clip_, f, posed.heads.data(), posed.rotations.data());
    const CharacterFrame frame = this->frame(f);
    std::vector<Vector3> tips;
    for (const int b : bones_)
      tips.push_back(frame.to_local(posed.heads[b] + posed.rotations[b] * kinematics_.skeleton().tips[b]));
    return tips;
  }

  const Kinematics& kinematics_;
  const Clip& clip_;
  std::vector<int> bones_;
};

// From one character frame to another, as the first sees it.
CharacterFrame between(const CharacterFrame& a, const CharacterFrame& b) {
  return {Eigen::Rotation2Dd(-a.heading) * (b.position - a.position), wrapped(b.heading - a.heading)};
}

CharacterFrame after(const CharacterFrame& a, const CharacterFrame& step) {
  return {a.position + Eigen::Rotation2Dd(a.heading) * step.position, a.heading + step.heading};
}

// Where frame `period` is: in the clip, or as far after the last as the mean of the steps beside the seam.
CharacterFrame next_round(const Poses& poses, const Clip& clip, int period) {
  if (period < clip.frames) return poses.frame(period);
  const CharacterFrame last = poses.frame(clip.frames - 1);
  const CharacterFrame before = between(poses.frame(clip.frames - 2), last),
                       behind = between(poses.frame(0), poses.frame(1));
  return after(last, {0.5 * (before.position + behind.position), 0.5 * (before.heading + behind.heading)});
}

void append(const Kinematics& kinematics, const Clip& from, int f, const CharacterFrame& round, Clip& to) {
  const std::size_t bones = kinematics.bones(), hips = kinematics.skeleton().roles.hips;
  const Vector3 root = load_vector(&from.root_positions[std::size_t{3} * f]);
  const Vector2 place = round.position + Eigen::Rotation2Dd(round.heading) * root.head<2>();
  to.root_positions.insert(to.root_positions.end(), {place.x(), place.y(), root.z()});
  const auto pose = from.rotations.begin() + static_cast<std::ptrdiff_t>(4 * bones * f);
  to.rotations.insert(to.rotations.end(), pose, pose + static_cast<std::ptrdiff_t>(4 * bones));
  double* turned = &to.rotations[4 * (bones * to.frames + hips)];
  store_quaternion(round.rotation() * load_quaternion(turned), turned);
  ++to.frames;
}

// How much a channel of so many values a frame changes from each frame to the next.
std::vector<double> steps_of(const std::vector<double>& channel, std::size_t values) {
  std::vector<double> steps;
  for (std::size_t begin = values; begin < channel.size(); begin += values) {
    double sum = 0;
    for (std::size_t i = begin; i < begin + values; ++i) sum += std::abs(channel[i] - channel[i - values]);
    steps.push_back(sum);
  }
  return steps;
}

double mean_of(const std::vector<double>& steps) {
  return steps.empty() ? 0 : std::accumulate(steps.begin(), steps.end(), 0.0) / static_cast<double>(steps.size());
}

}  // namespace

int cycle_of(const Kinematics& kinematics, const Clip& clip) {
  const int last = clip.frames - 1, span = std::max(1, static_cast<int>(std::lround(clip.rate / kPoseRate)));
  if (last < 2 * span) return 0;
  const Poses poses(kinematics, clip);
  const double gap = poses.distance(last, 0);
  const double most = std::max(poses.distance(0, span), poses.distance(last - span, last));
  if (gap > most || most == 0) return 0;
  return 2 * gap <= std::min(poses.distance(0, 1), poses.distance(last - 1, last)) ? last : clip.frames;
}

Clip unrolled(const Kinematics& kinematics, const Clip& clip, int period, int count) {
  const Poses poses(kinematics, clip);
  const CharacterFrame first = poses.frame(0), step = between(first, next_round(poses, clip, period));
  Clip result{clip.name, clip.rate, 0, {}, {}, {}};
  CharacterFrame begins = first;  // where the round does
  for (int g = 0; g < count; ++g) {
    if (g > 0 && g % period == 0) begins = after(begins, step);
    const double turn = begins.heading - first.heading;
    append(kinematics, clip, g % period, {begins.position - Eigen::Rotation2Dd(turn) * first.position, turn}, result);
  }
  result.markers = markers_in_rounds(clip.markers, 0, period, count);
  return make_clip(kinematics.skeleton(), std::move(result));
}

Clip without_held_end(Clip clip) {
  const std::size_t values = clip.rotations.size() / clip.frames;
  const std::vector<double> turns = steps_of(clip.rotations, values), ways = steps_of(clip.root_positions, 3);
  const double turn = kHeld * mean_of(turns), way = kHeld * mean_of(ways);
  int frames = clip.frames;
  while (frames > 1 && turns[frames - 2] < turn && ways[frames - 2] <= way) --frames;
  clip.frames = frames;
  clip.rotations.resize(values * frames);
  clip.root_positions.resize(std::size_t{3} * frames);
  clip.headings.resize(frames);
  return clip;
}

}  // namespace fragmotion
