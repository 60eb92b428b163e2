// SPDX-License-Identifier: MIT
#include "bake/loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace fragmotion {
namespace {

std::size_t at(int frame, int width) { return static_cast<std::size_t>(frame) * width; }

Vector3 turned(const Vector3& place, double angle) {
  Vector3 result = place;
  result.head<2>() = Eigen::Rotation2Dd(angle) * Vector2{place.head<2>()};
  return result;
}

// A rotation as axis times angle, by the shorter way.
Vector3 to_vector(const Quaternion& q) {
  const double sine = q.vec().norm(), side = q.w() < 0 ? -1 : 1;
  if (sine == 0) return Vector3::Zero();
  return side * 2 * std::atan2(sine, side * q.w()) / sine * q.vec();
}

Quaternion from_vector(const Vector3& vector) {
  const double angle = vector.norm();
  return angle > 0 ? Quaternion(Eigen::AngleAxisd(angle, vector / angle)) : Quaternion::Identity();
}

// An offset that leaves 0 without velocity and is as told in the last frame of `count` and in the one before.
class Offset {
 public:
  Offset(const Vector3& at_end, const Vector3& before_end, int count) : at_end_(at_end) {
    const double before = 1 - 1.0 / count;
    slope_ = (before_end - rise(before) * at_end) / swing(before);
  }

  Vector3 at(double share) const { return rise(share) * at_end_ + swing(share) * slope_; }

 private:
  static double rise(double share) { return ease_in_ease_out(share); }
  static double swing(double share) { return share * share * (share - 1); }

  Vector3 at_end_, slope_;
};

// Poses of a character frame that rests, the last `count` steps of them eased to the first.
void ease_poses(Motion& still, int count) {
  const int last = still.frames() - 1, bones = still.bones();
  const auto root = [&](int f) { return load_vector(&still.root_positions[at(f, 3)]); };
  const auto bone = [&](int f, int b) { return &still.rotations[at(f, 4 * bones) + at(b, 4)]; };
  const Vector3 first = root(0), before = 2 * first - root(1);
  const Offset moves(first - root(last), before - root(last - 1), count);
  std::vector<Offset> turns;
  for (int b = 0; b < bones; ++b) {
    const Quaternion begin = load_quaternion(bone(0, b)),
                     lead_in = begin * load_quaternion(bone(1, b)).conjugate() * begin;
    turns.emplace_back(to_vector(begin * load_quaternion(bone(last, b)).conjugate()),
                       to_vector(lead_in * load_quaternion(bone(last - 1, b)).conjugate()), count);
  }
  for (int i = 0; i <= count; ++i) {
    const int f = last - count + i;
    const double share = static_cast<double>(i) / count;
    store_vector(root(f) + moves.at(share), &still.root_positions[at(f, 3)]);
    for (int b = 0; b < bones; ++b)
      store_quaternion(from_vector(turns[b].at(share)) * load_quaternion(bone(f, b)), bone(f, b));
  }
}

// Places whose last steps are eased to the first one, each step seen from the place where it begins.
std::vector<double> ease_path(const std::vector<double>& places, int count) {
  const int steps = static_cast<int>(places.size() / 3) - 1;
  const auto place = [&](int f) { return load_vector(&places[at(f, 3)]); };
  const auto step = [&](int f) { return turned(place(f + 1) - place(f), -place(f).z()); };
  std::vector<double> eased = places;
  Vector3 here = place(0);
  for (int f = 0; f < steps; ++f) {
    const int i = f - (steps - count) + 1;
    const Vector3 own = step(f),
                  going = own + ease_in_ease_out(std::max(i, 0) / static_cast<double>(count)) * (step(0) - own);
    here += turned(going, here.z());
    store_vector(here, &eased[at(f + 1, 3)]);
  }
  return eased;
}

}  // namespace

Motion looped(const Motion& motion, int hips, int count) {
  const int steps = motion.frames() - 1;
  if (steps < 2) return motion;
  const int eased = std::min(std::max(count, 2), steps);
  Motion still = carried(motion, hips, std::vector<double>(motion.path.size(), 0));
  ease_poses(still, eased);
  return carried(still, hips, ease_path(motion.path, eased));
}

}  // namespace fragmotion
