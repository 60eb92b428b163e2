// SPDX-License-Identifier: MIT
#include "retarget/posture.hpp"

#include <algorithm>
#include <cmath>

#include "base/quantile.hpp"
#include "base/rates.hpp"
#include "motion/foot_paths.hpp"
#include "motion/pose.hpp"
#include "motion/soles.hpp"

namespace fragmotion {
namespace {

constexpr double kSlow = 0.25;  // of the moments in which the trunk is upright: the slowest
constexpr double kStill = 0.4;  // m/s of a 1.8 m character: a foot that is slower does not roll
constexpr int kEnough = 5;      // frames that tell how a foot stands

struct Moment {
  int clip = 0, frame = 0;
  double speed = 0;
};

double speed_at(const Clip& clip, int f) {
  const int a = std::max(0, f - 1), b = std::min(clip.frames - 1, f + 1);
  return (load_vector(&clip.root_positions[std::size_t{3} * b]) - load_vector(&clip.root_positions[std::size_t{3} * a]))
             .norm() *
         clip.rate / std::max(1, b - a);
}

bool upright(const PosedBones& posed, int hips, int top) {
  const Vector3 trunk = posed.heads[top] - posed.heads[hips];
  return trunk.z() > kSameWay * trunk.norm();
}

CharacterFrame frame_of(const Kinematics& kinematics, const PosedBones& posed) {
  const int hips = kinematics.skeleton().roles.hips;
  return kinematics.frame(posed.heads[hips], posed.rotations[hips]);
}

int frames_apart(const Clip& clip) { return std::max(1, static_cast<int>(std::lround(clip.rate / kPostureRate))); }

std::vector<Moment> upright_moments(const Kinematics& kinematics, const RoleMap& map, const std::vector<Clip>& clips) {
  const int hips = kinematics.skeleton().roles.hips, top = top_of(map);
  const std::vector<int> trunk = kinematics.chains({top});
  PosedBones posed(kinematics.bones());
  std::vector<Moment> moments;
  for (int c = 0; c < static_cast<int>(clips.size()); ++c) {
    for (int f = 0; f < clips[c].frames; f += frames_apart(clips[c])) {
      world(kinematics, clips[c], f, trunk, posed.heads.data(), posed.rotations.data());
      if (top == hips || upright(posed, hips, top)) moments.push_back({c, f, speed_at(clips[c], f)});
    }
  }
  return moments;
}

void keep_slowest(std::vector<Moment>& moments) {
  std::stable_sort(moments.begin(), moments.end(), [](const Moment& a, const Moment& b) { return a.speed < b.speed; });
  moments.resize(static_cast<std::size_t>(std::ceil(kSlow * static_cast<double>(moments.size()))));
}

// An elbow or a knee.
struct Hinge {
  int upper = -1, lower = -1, end = -1;

  // Adds what bends it, as both of its bones see it.
  void add(const PosedBones& posed, std::vector<Vector3>& sums) const {
    const Vector3 above = (posed.heads[lower] - posed.heads[upper]).normalized(),
                  below = (posed.heads[end] - posed.heads[lower]).normalized(), axis = above.cross(below);
    for (const int bone : {upper, lower}) sums[bone] += posed.rotations[bone].conjugate() * axis;
  }
};

std::vector<Hinge> hinges_of(const RoleMap& map) {
  std::vector<Hinge> hinges;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    hinges.push_back({map.bone(Role::kUpperArm, side), map.bone(Role::kLowerArm, side), map.bone(Role::kHand, side)});
    hinges.push_back({map.bone(Role::kThigh, side), map.bone(Role::kShin, side), map.bone(Role::kFoot, side)});
  }
  const auto incomplete = [](const Hinge& hinge) { return hinge.upper < 0 || hinge.lower < 0 || hinge.end < 0; };
  hinges.erase(std::remove_if(hinges.begin(), hinges.end(), incomplete), hinges.end());
  return hinges;
}

// The mean of rotations that are added one after the other.
class MeanRotation {
 public:
  void add(const Quaternion& rotation) {
    double stored[4];
    store_quaternion(rotation, stored);
    add_rotation(stored, sum_.data());
  }
  Quaternion mean() const { return load_quaternion(sum_.data()).normalized(); }

 private:
  std::array<double, 4> sum_{};
};

// Heads from world rotations, the first bone's at the origin.
void hang_up(const Skeleton& skeleton, PosedBones& posed) {
  posed.heads[0].setZero();
  for (int b = 1; b < skeleton.size(); ++b) {
    const int parent = skeleton.parents[b];
    posed.heads[b] = posed.heads[parent] + posed.rotations[parent] * skeleton.offsets[b];
  }
}

// The frames in which a foot stands flat and still: its ball and its heel do.
std::vector<int> flat_frames(const FootPath& path, const FootHeights& floor, double rate, double scale) {
  const auto rests = [&](const std::vector<Vector3>& points, int f, double lowest) {
    const double speed = (points[f + 1] - points[f - 1]).norm() * rate / 2;
    return speed * scale < kStill && (points[f].z() - lowest) * scale < kFlatSole;
  };
  std::vector<int> frames;
  for (int f = 1; f + 1 < static_cast<int>(path.ball.size()); ++f) {
    if (rests(path.ball, f, floor.ball) && rests(path.heel, f, floor.heel)) frames.push_back(f);
  }
  return frames;
}

// A moment in which a foot stands flat.
struct FlatMoment {
  Quaternion foot, toe;
  double ball = 0, heel = 0;
};

// The frames in which a foot stands flat.
class FlatFrames {
 public:
  explicit FlatFrames(const Leg& leg) : leg_(leg) {}

  void add(const Quaternion& to_frame, const PosedBones& posed, const FootPath& path, int frame) {
    moments_.push_back({to_frame * posed.rotations[leg_.foot],
                        leg_.toe >= 0 ? to_frame * posed.rotations[leg_.toe] : Quaternion::Identity(),
                        path.ball[frame].z(), path.heel[frame].z()});
  }

  // The mean of those on the ground on which most of them are, nearer to it than `near`: somebody who sits lets feet
  // hang still somewhere else.
  FlatFoot result(double near) const {
    const double ball = middle(&FlatMoment::ball), heel = middle(&FlatMoment::heel);
    MeanRotation foot, toe;
    FootHeights sums;
    int count = 0;
    for (const FlatMoment& moment : moments_) {
      if (std::abs(moment.ball - ball) >= near || std::abs(moment.heel - heel) >= near) continue;
      foot.add(moment.foot);
      toe.add(moment.toe);
      sums.ball += moment.ball;
      sums.heel += moment.heel;
      ++count;
    }
    if (count < kEnough) return {};
    return {true, foot.mean(), toe.mean(), {sums.ball / count, sums.heel / count}};
  }

 private:
  double middle(double FlatMoment::*height) const {
    std::vector<double> heights;
    for (const FlatMoment& moment : moments_) heights.push_back(moment.*height);
    return heights.empty() ? 0 : median(heights);
  }

  Leg leg_;
  std::vector<FlatMoment> moments_;
};

Vector3 between(const RoleMap& map, const PosedBones& posture, Role role) {
  const int left = map.bone(role, Side::kLeft), right = map.bone(role, Side::kRight);
  return left < 0 || right < 0 ? Vector3::Zero() : Vector3{posture.heads[right] - posture.heads[left]};
}

}  // namespace

int top_of(const RoleMap& map) {
  int top = map.bone(Role::kHips);
  for (const Role role : {Role::kSpine, Role::kNeck, Role::kHead}) {
    const std::vector<int> chain = map.chain(role);
    if (!chain.empty()) top = chain.back();
  }
  return top;
}

PosedBones rest_posture(const Skeleton& skeleton) {
  PosedBones posture(skeleton.size());
  rest_pose(skeleton, posture.heads, posture.rotations);
  return posture;
}

std::optional<PosedBones> mean_posture(const Kinematics& kinematics, const RoleMap& map,
                                       const std::vector<Clip>& clips) {
  std::vector<Moment> moments = upright_moments(kinematics, map, clips);
  if (moments.empty()) return {};
  keep_slowest(moments);
  PosedBones posed(kinematics.bones());
  std::vector<MeanRotation> means(kinematics.bones());
  for (const Moment& moment : moments) {
    world(kinematics, clips[moment.clip], moment.frame, posed.heads.data(), posed.rotations.data());
    const Quaternion to_frame = frame_of(kinematics, posed).rotation().conjugate();
    for (int b = 0; b < kinematics.bones(); ++b) means[b].add(to_frame * posed.rotations[b]);
  }
  for (int b = 0; b < kinematics.bones(); ++b) posed.rotations[b] = means[b].mean();
  hang_up(kinematics.skeleton(), posed);
  return posed;
}

std::vector<Vector3> mean_hinges(const Kinematics& kinematics, const RoleMap& map, const std::vector<Clip>& clips) {
  std::vector<Vector3> sums(kinematics.bones(), Vector3::Zero());
  PosedBones posed(kinematics.bones());
  const std::vector<Hinge> hinges = hinges_of(map);
  int poses = 0;
  for (const Clip& clip : clips) {
    for (int f = 0; f < clip.frames; f += frames_apart(clip), ++poses) {
      world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
      for (const Hinge& hinge : hinges) hinge.add(posed, sums);
    }
  }
  for (Vector3& sum : sums) sum = sum.norm() > kBends * poses ? sum.normalized() : Vector3::Zero();
  return sums;
}

bool bends_back(const RoleMap& map, const PosedBones& posture, const std::vector<Vector3>& hinges) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    for (const Role role : {Role::kThigh, Role::kShin}) {
      const int bone = map.bone(role, side);
      const Vector3 hinge = posture.rotations[bone] * hinges[bone];
      if (!hinge.isZero(0) && hinge.dot(-Vector3::UnitX()) < kSameWay) return false;
    }
  }
  return true;
}

std::array<FlatFoot, 2> flat_feet(const Kinematics& kinematics, const Legs& legs, const std::vector<Clip>& clips) {
  const std::vector<int> bones = kinematics.chains({legs[0].foot, legs[0].toe, legs[1].foot, legs[1].toe});
  const double scale = standard_scale(kinematics.skeleton());
  std::array<FlatFrames, 2> sums{FlatFrames(legs[0]), FlatFrames(legs[1])};
  PosedBones posed(kinematics.bones());
  for (const Clip& clip : clips) {
    const FootPaths paths = foot_paths(kinematics, clip);
    for (int side = 0; side < 2; ++side) {
      const FootHeights floor{floor_of(paths[side].ball), floor_of(paths[side].heel)};
      for (const int f : flat_frames(paths[side], floor, clip.rate, scale)) {
        world(kinematics, clip, f, bones, posed.heads.data(), posed.rotations.data());
        sums[side].add(frame_of(kinematics, posed).rotation().conjugate(), posed, paths[side], f);
      }
    }
  }
  const double near = kFlatSole / scale;
  return {sums[0].result(near), sums[1].result(near)};
}

void face_forward(const RoleMap& map, PosedBones& posture) {
  const int hips = map.bone(Role::kHips), top = top_of(map);
  Vector3 right = between(map, posture, Role::kThigh), up = Vector3::UnitZ();
  if (top != hips && !upright(posture, hips, top)) up = (posture.heads[top] - posture.heads[hips]).normalized();
  const double width = right.norm();
  right -= up.dot(right) * up;
  if (right.norm() < kSameWay * width) return;  // one hip above the other
  right.normalize();
  Eigen::Matrix3d axes;  // the body's, in the rows
  axes << right.transpose(), up.cross(right).transpose(), up.transpose();
  const Quaternion turn(axes);
  for (Vector3& head : posture.heads) head = turn * head;
  for (Quaternion& rotation : posture.rotations) rotation = turn * rotation;
}

bool stands(const RoleMap& map, const PosedBones& posture) {
  const int hips = map.bone(Role::kHips), top = top_of(map);
  if (top != hips && !upright(posture, hips, top)) return false;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Vector3 &thigh = posture.heads[map.bone(Role::kThigh, side)],
                  &shin = posture.heads[map.bone(Role::kShin, side)],
                  &foot = posture.heads[map.bone(Role::kFoot, side)];
    if (thigh.z() - shin.z() < kSameWay * (thigh - shin).norm()) return false;
    if (shin.z() - foot.z() < kSameWay * (shin - foot).norm()) return false;
  }
  return true;
}

}  // namespace fragmotion
