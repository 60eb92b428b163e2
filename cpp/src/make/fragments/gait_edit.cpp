// SPDX-License-Identifier: MIT
#include "fragments/gait_edit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "feet/foot_lock.hpp"
#include "fragments/strides.hpp"
#include "motion/pose.hpp"
#include "motion/trunk.hpp"

namespace fragmotion {
namespace {

constexpr double kFlexion = 2;  // rad that the trunk bows forward for each m of a crouch, of a 1.8 m character
constexpr double kTuck = 0.35;  // of the body's height: how much further the feet are lifted
// rad for each m/s of the take-off; they point level at a little more than 2.75 m/s, with which people who jump as high
// as they can take off when they swing them (M. Feltner et al., J. Sports Sciences 17, 1999)
constexpr double kArmsForward = 0.6, kArmsBack = 0.3;

// Keeps planted feet of a clip where they are. Its frames go round and round frames begin .. end of another clip, whose
// contacts these are.
void plant_feet(const Kinematics& kinematics, const Legs& legs, Clip& clip, const Contacts& contacts, int begin,
                int end, double turn) {
  if (contacts.feet[0].empty()) return;
  FootLock lock(kinematics, legs);
  Footwork work;
  work.turn = turn;
  WorldPose pose;
  pose.rotations.resize(std::size_t{4} * kinematics.bones());
  for (int f = 0; f < clip.frames; ++f) {
    double *root = &clip.root_positions[std::size_t{3} * f], *rotations = &clip.rotations[pose.rotations.size() * f];
    pose.root = load_vector(root);
    pose.heading = clip.headings[f];
    std::copy_n(rotations, pose.rotations.size(), pose.rotations.begin());
    const std::size_t frame = frame_of(f, begin, end);
    lock.apply(pose, contacts, {frame, frame, frame}, f > 0 ? 1 / clip.rate : 0, {}, work);
    store_vector(pose.root, root);
    std::copy(pose.rotations.begin(), pose.rotations.end(), rotations);
  }
}

// From the take-off to the landing a gait goes from one moment to another, as fast at both as always.
double eased(double along, double way, double apart) {
  const double slope = std::min(apart, 3 * way), rest = 1 - along;  // no steeper: it would turn back between
  return way * along * along * (3 - 2 * along) + slope * along * rest * (rest - along);
}

}  // namespace

Clip transformed(const Kinematics& kinematics, const Legs& legs, const Clip& clip, const Contacts& contacts, int begin,
                 int end, int frames, const GaitEdit& edit) {
  const bool other_path = edit.direction != 0 || edit.speed != 1, plants = other_path || edit.turn != 0;
  GaitCycle cycle = gait_cycle_of(kinematics, clip, begin, end);
  turn_hips(kinematics.skeleton(), cycle, edit.hips);
  std::optional<Strides> strides;
  if (other_path || (edit.turn != 0 && legs.count() == kMostLegs))
    strides.emplace(kinematics, legs, cycle, edit, clip.rate * edit.tempo);
  Clip result;
  result.name = clip.name + " transformed";
  result.rate = clip.rate * edit.tempo;
  const int length = cycle.frames(), before = plants ? length : 0;  // a cycle more, in which the feet find their places
  const CharacterFrame start = cycle.poses[0].frame;
  const double bend = cycle.end.heading - start.heading;  // of the path, each cycle
  Vector2 position = Vector2::Zero(), origin = Vector2::Zero();
  for (int f = -before; f <= frames; ++f) {
    const int at = (f + before) % length, cycles = (f + before) / length - (before > 0 ? 1 : 0);
    BodyPose pose = cycle.poses[at];
    if (strides) strides->change(pose);
    if (f == 0) origin = position;
    const double seconds = f / result.rate, heading = pose.frame.heading + cycles * bend;
    append(kinematics, result, {position, heading + edit.turn * seconds}, pose);
    const Vector2 next = at + 1 < length ? cycle.poses[at + 1].frame.position : cycle.end.position;
    const double middle = edit.turn * (seconds + 0.5 / result.rate);
    position += edit.speed * turned(next - pose.frame.position, edit.direction + middle + cycles * bend);
  }
  for (int f = 0; f < result.frames; ++f) {
    Eigen::Map<Vector2>(&result.root_positions[std::size_t{3} * f]) += start.position - origin;
  }
  result.markers = markers_in_rounds(clip.markers, begin, length, result.frames);
  if (!plants) return result;
  plant_feet(kinematics, legs, result, contacts, begin, end, edit.turn);
  return part(result, before, result.frames - 1);
}

int next_foot_down(const Contacts& contacts, int begin, int end, int after, int within, int touch) {
  if (contacts.feet[0].empty()) return -1;
  const auto stands = [&](int side, int f) { return contacts.feet[side][frame_of(f, begin, end)]; };
  const auto strikes = [&](int side, int f) { return stands(side, f) && !stands(side, f - 1); };
  const int length = std::abs(end - begin);
  int last = -1, found = -1;
  const int came = after - touch;
  for (int f = came - length + 1; f <= came; ++f) {
    for (int side = 0; side < 2; ++side) last = strikes(side, f) ? side : last;
  }
  for (int f = came + 1; last >= 0 && f <= after + within; ++f) {
    if (!strikes(1 - last, f)) continue;
    int alone = f;
    while (alone < f + length && stands(last, alone)) ++alone;
    if (alone <= after + within) found = alone;
  }
  return found;
}

Clip gait_in_flight(const Kinematics& kinematics, const Clip& clip, double take_off, double landing, double down) {
  Clip result;
  result.name = clip.name;
  result.rate = clip.rate;
  result.markers = clip.markers;
  const double apart = landing - take_off, way = down - take_off, last = clip.frames - 1;
  for (int f = 0; f < clip.frames; ++f) {
    const double along = (f - take_off) / apart;
    const double at = along <= 0 ? f : along < 1 ? take_off + eased(along, way, apart) : f - landing + down;
    if (at > last) break;
    append(kinematics, result, frame_at(clip, f), body_pose(kinematics, clip, at));
  }
  return result;
}

Hop::Hop(double height, double dip, double sinking, double running)
    : dip_(dip),
      sinking_(sinking),
      speed_(std::sqrt(2 * kGravity * height)),
      pushing_(2 * dip / speed_),
      swing_((1 - running) * speed_) {}

double Hop::flight() const { return 2 * speed_ / kGravity; }

double Hop::at(double seconds) const {
  const double air = seconds - crouch();
  if (air > flight()) return at(2 * crouch() + flight() - seconds);
  if (air >= 0) return air * (speed_ - kGravity * air / 2);
  if (seconds < sinking_) return -dip_ * ease_in_ease_out(seconds / sinking_);
  const double pushed = (seconds - sinking_) / pushing_;
  return dip_ * (pushed * pushed - 1);
}

double Hop::arms(double seconds) const {
  const double forward = kArmsForward * swing_, back = -kArmsBack * swing_;
  const double turn = sinking_ / 2, top = crouch() + flight() / 4, landing = crouch() + flight();
  if (seconds < turn) return back * ease_in_ease_out(seconds / turn);
  if (seconds < top) return back + (forward - back) * ease_in_ease_out((seconds - turn) / (top - turn));
  return forward * (1 - ease_in_ease_out((seconds - top) / (landing - top)));
}

void add_hop(const Kinematics& kinematics, const Legs& legs, Clip& clip, const Hop& hop) {
  const Skeleton& skeleton = kinematics.skeleton();
  const Trunk trunk(skeleton);
  const std::array<Arm, 2> arms = resting_arms(skeleton);
  PosedBones posed(kinematics.bones());
  for (int f = 0; f < clip.frames && f < hop.seconds() * clip.rate; ++f) {
    const double height = hop.at(f / clip.rate), rise = height / standard_scale(skeleton);
    const double tuck = std::max(0.0, rise) * (1 + kTuck) - rise;  // of the feet, towards the hips
    double* root = &clip.root_positions[std::size_t{3} * f];
    double* rotations = &clip.rotations[std::size_t{4} * kinematics.bones() * f];
    world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
    root[2] += rise;
    for (const Leg& leg : legs) {
      if (!leg.exists()) continue;
      reach(skeleton, leg, posed, ankle_of(leg, posed) + tuck * Vector3::UnitZ(), rotations);
    }
    const Vector3 left{-std::cos(clip.headings[f]), -std::sin(clip.headings[f]), 0};
    turn_spine(skeleton, trunk, left, kFlexion * std::max(0.0, -height), rotations);
    for (const Arm& arm : arms) {
      if (arm.exists()) turn_bone(skeleton, arm.upper, left, -hop.arms(f / clip.rate), rotations);
    }
  }
}

}  // namespace fragmotion
