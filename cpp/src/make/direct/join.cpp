// SPDX-License-Identifier: MIT
#include "direct/join.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/filtered.hpp"
#include "base/ranges.hpp"
#include "base/rates.hpp"
#include "fragments/body_tips.hpp"
#include "runtime/player.hpp"

namespace fragmotion {
namespace {

constexpr double kCarried = 0.1;  // s: time constant of the velocity that goes on

void check_frames(const std::vector<int>& frames, const Motion& motion, const char* name) {
  if (frames.empty()) throw std::invalid_argument(std::string("there are no frames at which ") + name + " is joined");
  for (const int f : frames) {
    if (f < 0 || f >= motion.frames()) {
      throw std::invalid_argument(std::string(name) + " has no frame " + std::to_string(f));
    }
  }
}

void resize(Motion& motion, int frames) {
  motion.rotations.resize(std::size_t{4} * motion.bones() * frames);
  motion.root_positions.resize(std::size_t{3} * frames);
  motion.path.resize(std::size_t{3} * frames);
}

// How a pose goes on after one before it.
WorldPose onward(const WorldPose& before, const WorldPose& now) {
  WorldPose later;
  extrapolate(before, now, later);
  return later;
}

// The tips of poses and of those a little later, each seen from the frame of the first, in three rows.
class SeamPoses {
 public:
  explicit SeamPoses(const Skeleton& skeleton) : tips_(skeleton), stride_(padded(2 * tips_.points())) {}

  int stride() const { return stride_; }
  int points() const { return tips_.points(); }

  // How the motion would go on after a frame: `onward` its speed up to there.
  std::vector<float> of(const Motion& motion, int frame, bool onward) {
    std::vector<float> rows(std::size_t{3} * stride_, 0);
    const int later = std::max(1, static_cast<int>(std::lround(motion.rate / kPoseRate)));
    const int other = std::clamp(onward ? frame - later : frame + later, 0, motion.frames() - 1);
    write(motion, frame, motion.frame(frame), rows, 0);
    write(motion, other, motion.frame(frame), rows, points());
    if (onward) extrapolate(rows);
    return rows;
  }

 private:
  void write(const Motion& motion, int at, const CharacterFrame& seen, std::vector<float>& rows, int offset) {
    tips_.pose(load_vector(&motion.root_positions[std::size_t{3} * at]),
               &motion.rotations[motion.rotations.size() / motion.frames() * at]);
    tips_.write(seen, rows.data(), stride_, offset);
  }

  void extrapolate(std::vector<float>& rows) const {
    for (int axis = 0; axis < 3; ++axis) {
      float* now = &rows[static_cast<std::size_t>(axis) * stride_];
      for (int i = 0; i < points(); ++i) now[points() + i] = 2 * now[i] - now[points() + i];
    }
  }

  BodyTips tips_;
  int stride_;
};

}  // namespace

Motion join(const Skeleton& skeleton, const Motion& first, int end, const Motion& second, int beginning) {
  check_motion(skeleton, first, "the first motion");
  check_motion(skeleton, second, "the second motion");
  if (first.rate != second.rate) throw std::invalid_argument("the motions must have the same frame rate");
  check_frames({end}, first, "the first motion");
  check_frames({beginning}, second, "the second motion");
  const CharacterFrame from = second.frame(beginning), to = first.frame(end);
  const auto carried_pose = [&](int f) {
    WorldPose pose = pose_at(second, f);
    carry(skeleton.roles.hips, from, to, pose);
    return pose;
  };
  const double apart = 1 / first.rate;
  Inertialization stitch(skeleton.size());
  const WorldPose old = pose_at(first, end), fresh = carried_pose(beginning);
  const Vector2 faster = end > 0 ? stitch.begin(old, onward(pose_at(first, end - 1), old), fresh,
                                                beginning > 0 ? onward(carried_pose(beginning - 1), fresh)
                                                              : carried_pose(std::min(1, second.frames() - 1)),
                                                apart, kStitch)
                                 : stitch.begin(old, old, fresh, fresh, apart, kStitch);
  Motion joined = first;
  resize(joined, end + second.frames() - beginning);
  for (int f = 1; beginning + f < second.frames(); ++f) {
    WorldPose pose = carried_pose(beginning + f);
    const Vector2 before = pose.root.head<2>();
    stitch.apply(f * apart, pose);
    pose.root.head<2>() += kCarried * (1 - std::exp(-f * apart / kCarried)) * faster;
    const Vector2 place = carried(from, to, second.frame(beginning + f).position) + pose.root.head<2>() - before;
    set_pose(joined, end + f, pose, place);
  }
  return joined;
}

Seam find_seam(const Skeleton& skeleton, const Motion& first, const std::vector<int>& ends, const Motion& second,
               const std::vector<int>& beginnings) {
  check_motion(skeleton, first, "the first motion");
  check_motion(skeleton, second, "the second motion");
  check_frames(ends, first, "the first motion");
  check_frames(beginnings, second, "the second motion");
  SeamPoses poses(skeleton);
  std::vector<std::vector<float>> begun;
  for (const int beginning : beginnings) begun.push_back(poses.of(second, beginning, false));
  Seam best;
  float least = std::numeric_limits<float>::infinity();
  for (const int end : ends) {
    const std::vector<float> goes_on = poses.of(first, end, true);
    for (std::size_t i = 0; i < beginnings.size(); ++i) {
      const float distance = tip_distance(goes_on.data(), begun[i].data(), poses.stride());
      if (distance < least) {
        least = distance;
        best = {end, beginnings[i], distance / (2.0 * poses.points())};
      }
    }
  }
  return best;
}

Motion spread(const Skeleton& skeleton, const Motion& motion, int begin, int end, const CharacterFrame& target) {
  check_motion(skeleton, motion, "the motion");
  if (!(0 <= begin && begin < end && end < motion.frames())) {
    throw std::invalid_argument("the frames between which it is moved must be in order, and frames of the motion");
  }
  for (const double value : {target.position.x(), target.position.y(), target.heading})
    require_range("the place and the heading to be at", value, -kFarthestPlace, kFarthestPlace);
  const CharacterFrame reached = motion.frame(end);
  const Vector2 move = target.position - reached.position;
  const double turn = wrapped(target.heading - reached.heading);
  Motion moved = motion;
  for (int f = begin + 1; f < motion.frames(); ++f) {
    const double share = ease_in_ease_out(static_cast<double>(f - begin) / (end - begin));
    const CharacterFrame pivot = f <= end ? motion.frame(f) : reached;
    const CharacterFrame to{pivot.position + share * move, pivot.heading + share * turn};
    WorldPose pose = pose_at(motion, f);
    carry(skeleton.roles.hips, pivot, to, pose);
    set_pose(moved, f, pose, carried(pivot, to, motion.frame(f).position));
  }
  return moved;
}

}  // namespace fragmotion
