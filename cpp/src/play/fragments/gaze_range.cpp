// SPDX-License-Identifier: MIT
#include "fragments/gaze_range.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/quantile.hpp"
#include "fragments/look.hpp"
#include "motion/trunk.hpp"

namespace fragmotion {
namespace {

constexpr double kPosesASecond = 10;  // times a second at which poses are looked at
constexpr double kUsualShare = 0.99;  // of the time: within it are angles that a body has without acrobatics

// rad that a head looks aside, down and up without effort: half of what necks turn actively (J. Youdas et al., Physical
// Therapy 72, 1992: 70, 55 and 75 degrees at 20 to 30 years). Takes in which nobody looks about tell no more.
constexpr double kAside = 35 * kPi / 180, kDown = 27.5 * kPi / 180, kUp = 37.5 * kPi / 180;

// How a bone is turned in takes, seen from where the character faces.
class Turned {
 public:
  void add(const Quaternion& seen) { all_.emplace_back(seen.cast<float>()); }

  // Where it looks on the mean, as it sees it itself.
  Vector3 forward() const {
    Vector3 sum = Vector3::Zero();
    for (const Eigen::Quaternionf& seen : all_) sum += seen.cast<double>().conjugate() * Vector3::UnitY();
    return sum.norm() > 0 ? sum.normalized() : Vector3::UnitY();
  }

  // By how much a direction of its own is turned to a side, and how high it points, of all takes.
  std::pair<std::vector<double>, std::vector<double>> angles(const Vector3& direction) const {
    std::pair<std::vector<double>, std::vector<double>> angles;
    for (const Eigen::Quaternionf& seen : all_) {
      const Vector3 looks = seen.cast<double>() * direction;
      angles.first.push_back(std::abs(std::atan2(-looks.x(), looks.y())));
      angles.second.push_back(std::atan2(looks.z(), looks.head<2>().norm()));
    }
    return angles;
  }

  bool empty() const { return all_.empty(); }

 private:
  std::vector<Eigen::Quaternionf> all_;
};

// Adds how two bones, of which the first may be none, are turned in a clip.
class Reader {
 public:
  Reader(const Skeleton& skeleton, int chest, int head)
      : kinematics_(skeleton),
        chest_(chest),
        head_(head),
        chain_(kinematics_.chains({head})),
        rotations_(std::size_t{4} * skeleton.size()),
        heads_(skeleton.size()),
        worlds_(skeleton.size()) {}

  void read(const PackedClip& clip, Turned& chest, Turned& head) {
    const double apart = std::max(1.0, std::round(clip.rate / kPosesASecond));
    for (double frame = 0; frame < clip.frames; frame += apart) {
      const Vector3 root = sample_pose(clip, frame, rotations_.data());
      kinematics_.world(root, rotations_.data(), chain_, heads_.data(), worlds_.data());
      const Quaternion back = CharacterFrame{{}, -frame_at(clip, frame).heading}.rotation();
      if (chest_ >= 0) chest.add(back * worlds_[chest_]);
      head.add(back * worlds_[head_]);
    }
  }

 private:
  Kinematics kinematics_;
  int chest_, head_;
  std::vector<int> chain_;
  std::vector<double> rotations_;
  std::vector<Vector3> heads_;
  std::vector<Quaternion> worlds_;
};

}  // namespace

GazeRange gaze_range(const std::vector<const PackedPool*>& pools) {
  const Skeleton& skeleton = pools.front()->skeleton;
  GazeRange range;
  if (look_bones(skeleton).empty()) return range;
  const Trunk trunk(skeleton);
  Reader reader(skeleton, trunk.head >= 0 ? trunk.chest : -1, skeleton.roles.head);
  Turned chest, head;
  for (const PackedPool* pool : pools) {
    int last = -1;
    for (const Fragment& f : pool->fragments) {
      if (f.origin == Origin::captured && std::exchange(last, f.clip) != f.clip) {
        reader.read(pool->clips[f.clip], chest, head);
      }
    }
  }
  if (head.empty()) return range;
  range.forward = head.forward();
  const auto [turns, pitches] = head.angles(range.forward);
  range.turn = std::max(kAside, quantile(turns, kUsualShare));
  range.down = std::min(-kDown, quantile(pitches, 1 - kUsualShare));
  range.up = std::max(kUp, quantile(pitches, kUsualShare));
  if (!chest.empty()) range.chest = std::min(range.turn, quantile(chest.angles(chest.forward()).first, kUsualShare));
  return range;
}

}  // namespace fragmotion
