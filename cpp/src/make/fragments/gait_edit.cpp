// SPDX-License-Identifier: MIT
#include "fragments/gait_edit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include "control/control.hpp"
#include "feet/foot_lock.hpp"
#include "fragments/body_pose.hpp"
#include "motion/pose.hpp"
#include "motion/trunk.hpp"

namespace fragmotion {
namespace {

constexpr double kFlexion = 2;   // rad that the trunk bows forward for each m of a crouch, of a 1.8 m character
constexpr double kWidest = 0.2;  // m of a 1.8 m character that each foot is set out so as not to cross the other
constexpr double kLevel = 0.8;   // of the way to flat, where feet go straight to the side
constexpr double kTuck = 0.35;   // of the body's height: how much further the feet are lifted
// rad for each m/s of the take-off; they point level at a little more than 2.75 m/s, with which people who jump as high
// as they can take off when they swing them (M. Feltner et al., J. Sports Sciences 17, 1999)
constexpr double kArmsForward = 0.6, kArmsBack = 0.3;

// The frame of a clip that is number `f` of a motion that goes round and round frames begin .. end of it.
int frame_of(int f, int begin, int end) {
  const int length = std::abs(end - begin), at = (f % length + length) % length;
  return begin < end ? begin + at : begin - at;
}

// One cycle of a gait, each pose seen from its character frame, and the way from each to the next.
struct GaitCycle {
  std::vector<BodyPose> poses;
  CharacterFrame end;  // where the next cycle begins

  int frames() const { return static_cast<int>(poses.size()); }
  // In a frame, m.
  Vector2 mean_way() const {
    return Eigen::Rotation2Dd(-poses[0].frame.heading) * Vector2{end.position - poses[0].frame.position} / frames();
  }
};

// Frames begin .. end of a clip. Where the last is not as the first, the second half leads to that.
GaitCycle gait_cycle_of(const Kinematics& kinematics, const Clip& clip, int begin, int end) {
  GaitCycle cycle;
  for (int f = 0; f < std::abs(end - begin); ++f) {
    cycle.poses.push_back(body_pose(kinematics, clip, frame_of(f, begin, end)));
  }
  const BodyPose first = cycle.poses.front(), last = body_pose(kinematics, clip, end);
  cycle.end = last.frame;
  for (int f = 0; f < cycle.frames(); ++f) {
    const double weight = ease_in_ease_out(2.0 * f / cycle.frames() - 1);
    BodyPose& pose = cycle.poses[f];
    pose.height += weight * (first.height - last.height);
    for (std::size_t b = 0; b < pose.rotations.size(); b += 4) {
      const Quaternion missing = load_quaternion(&first.rotations[b]) * load_quaternion(&last.rotations[b]).conjugate();
      const Quaternion by = Quaternion::Identity().slerp(weight, missing);
      store_quaternion((by * load_quaternion(&pose.rotations[b])).normalized(), &pose.rotations[b]);
    }
  }
  return cycle;
}

// The strides of a gait as its path is changed: what the balls of the feet do about their middle is turned and scaled
// like the path, so that a foot that stood still on the old path does so on the new one. Where the feet would cross, as
// strides do that are turned sideways, their middles go apart; and sideways feet do not roll from heel to toe, but are
// lifted flat. Fore legs go as the path would of a body that begins with them: where hind ones turn, they sidestep.
class Strides {
 public:
  // `rate`: of the cycle as it is played, frames a second.
  Strides(const Kinematics& kinematics, const Legs& legs, const GaitCycle& cycle, const GaitEdit& edit, double rate)
      : kinematics_(kinematics), legs_(legs), edit_(edit), posed_(kinematics.bones()) {
    if (!exist()) return;
    for (const BodyPose& body : cycle.poses) {
      pose(body);
      for (int side = 0; side < count(); ++side) {
        middles_[side] += balls(side) / cycle.frames();
        find_flat(side, body);
      }
    }
    if (count() == kMostLegs) find_fore_change(cycle, rate);
    set_apart(cycle);
  }

  void change(BodyPose& body) {
    if (!exist()) return;
    pose(body);
    const double level = kLevel * std::abs(std::sin(edit_.direction));
    for (int side = 0; side < count(); ++side) {
      const Leg& leg = legs_[side];
      const Vector3 from = ball(kinematics_.skeleton(), leg, posed_);
      const Vector2 to = changed(side);
      Quaternion& foot = posed_.rotations[leg.foot];
      const Vector3 arm = foot.conjugate() * (from - posed_.heads[leg.foot]);
      foot = foot.slerp(level, flat_[side].foot);
      reach(kinematics_.skeleton(), leg, posed_, Vector3{to.x(), to.y(), from.z()} - foot * arm, body.rotations.data());
      if (leg.toe < 0) continue;
      double* toe = &body.rotations[std::size_t{4} * leg.toe];
      store_quaternion(load_quaternion(toe).slerp(level, flat_[side].toe), toe);
    }
  }

 private:
  int count() const { return legs_.count(); }
  bool exist() const { return count() > 0; }
  void pose(const BodyPose& body) {
    kinematics_.world({0, 0, body.height}, body.rotations.data(), posed_.heads.data(), posed_.rotations.data());
  }
  Vector2 balls(int side) const { return ball(kinematics_.skeleton(), legs_[side], posed_).head<2>(); }
  Vector2 changed(int side) const {
    const double apart = apart_[side / 2];
    const Vector2 outward{side % 2 == 0 ? -apart : apart, 0};
    const Vector2 stride = balls(side) - middles_[side];
    if (side >= 2) return middles_[side] + outward + fore_ * stride;
    return middles_[side] + outward + edit_.speed * turned(stride, edit_.direction);
  }

  // What takes the velocity of the shoulders to the one that they get by the change of the path and by its turn.
  void find_fore_change(const GaitCycle& cycle, double rate) {
    const Vector2 velocity = rate * cycle.mean_way(), hips = edit_.speed * turned(velocity, edit_.direction);
    if (velocity.norm() * standard_scale(kinematics_.skeleton()) < kMoving) {
      fore_ = edit_.speed * Eigen::Rotation2Dd(edit_.direction).toRotationMatrix();
      return;
    }
    Vector2 shoulders = Vector2::Zero();
    for (const BodyPose& body : cycle.poses) {
      pose(body);
      shoulders += (posed_.heads[legs_[2].thigh] + posed_.heads[legs_[3].thigh]).head<2>() / (2 * cycle.frames());
    }
    const Vector2 wanted = hips + edit_.turn * Vector2{-shoulders.y(), shoulders.x()};
    const double along = velocity.dot(wanted) / velocity.squaredNorm(),
                 across = (velocity.x() * wanted.y() - velocity.y() * wanted.x()) / velocity.squaredNorm();
    fore_ << along, -across, across, along;
  }

  // A foot as it stands flat: the lowest that it gets, and its toe relative to it.
  struct Flat {
    double height = std::numeric_limits<double>::infinity();  // m, of ankle and ball together
    Quaternion foot = Quaternion::Identity(), toe = Quaternion::Identity();
  };

  void find_flat(int side, const BodyPose& body) {
    const Leg& leg = legs_[side];
    const double height = posed_.heads[leg.foot].z() + ball(kinematics_.skeleton(), leg, posed_).z();
    if (height >= flat_[side].height) return;
    flat_[side] = {height, posed_.rotations[leg.foot], Quaternion::Identity()};
    if (leg.toe >= 0) flat_[side].toe = load_quaternion(&body.rotations[std::size_t{4} * leg.toe]);
  }

  // Finds how far each foot is to go outward for them to come no nearer to crossing than they did, or at most may.
  void set_apart(const GaitCycle& cycle) {
    for (int left = 0; left < count(); left += 2) {
      const int right = left + 1;
      double least = std::numeric_limits<double>::infinity(), least_changed = least;
      for (const BodyPose& body : cycle.poses) {
        pose(body);
        least = std::min(least, balls(right).x() - balls(left).x());
        least_changed = std::min(least_changed, changed(right).x() - changed(left).x());
      }
      apart_[left / 2] = std::clamp((least - least_changed) / 2, 0.0, kWidest / standard_scale(kinematics_.skeleton()));
    }
  }

  const Kinematics& kinematics_;
  const Legs& legs_;
  const GaitEdit& edit_;
  std::array<Vector2, kMostLegs> middles_{Vector2::Zero(), Vector2::Zero(), Vector2::Zero(), Vector2::Zero()};
  std::array<Flat, kMostLegs> flat_;
  Matrix2 fore_ = Matrix2::Identity();
  std::array<double, kMostLegs / 2> apart_{};  // m, of each pair
  PosedBones posed_;
};

// Keeps planted feet of a clip where they are. Its frames go round and round frames begin .. end of another clip, whose
// contacts these are.
void plant_feet(const Kinematics& kinematics, const Legs& legs, Clip& clip, const Contacts& contacts, int begin,
                int end) {
  if (contacts.feet[0].empty()) return;
  FootLock lock(kinematics, legs);
  WorldPose pose;
  pose.rotations.resize(std::size_t{4} * kinematics.bones());
  for (int f = 0; f < clip.frames; ++f) {
    double *root = &clip.root_positions[std::size_t{3} * f], *rotations = &clip.rotations[pose.rotations.size() * f];
    pose.root = load_vector(root);
    pose.heading = clip.headings[f];
    std::copy_n(rotations, pose.rotations.size(), pose.rotations.begin());
    lock.apply(pose, contacts, frame_of(f, begin, end), f > 0 ? 1 / clip.rate : 0);
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
  const GaitCycle cycle = gait_cycle_of(kinematics, clip, begin, end);
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
  plant_feet(kinematics, legs, result, contacts, begin, end);
  return part(result, before, result.frames - 1);
}

int next_foot_down(const Contacts& contacts, int begin, int end, int after, int within) {
  if (contacts.feet[0].empty()) return -1;
  const auto stands = [&](int side, int f) { return contacts.feet[side][frame_of(f, begin, end)]; };
  const auto strikes = [&](int side, int f) { return stands(side, f) && !stands(side, f - 1); };
  const int length = std::abs(end - begin);
  int last = -1, found = -1;
  for (int f = after - length + 1; f <= after; ++f) {
    for (int side = 0; side < 2; ++side) last = strikes(side, f) ? side : last;
  }
  for (int f = after + 1; last >= 0 && f <= after + within; ++f) {
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
      const Vector3 ankle = posed.heads[leg.foot] + tuck * Vector3::UnitZ();
      reach(skeleton, leg, posed, ankle, rotations);
    }
    const Vector3 left{-std::cos(clip.headings[f]), -std::sin(clip.headings[f]), 0};
    turn_spine(skeleton, trunk, left, kFlexion * std::max(0.0, -height), rotations);
    for (const Arm& arm : arms) {
      if (arm.exists()) turn_bone(skeleton, arm.upper, left, -hop.arms(f / clip.rate), rotations);
    }
  }
}

}  // namespace fragmotion
