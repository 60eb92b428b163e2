// SPDX-License-Identifier: MIT
#include "evaluate/motion_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "evaluate/tracks.hpp"
#include "motion/skate.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

constexpr double kSliding = 0.1, kStitched = 0.25;

// The places of a motion's joints, of a character of 1.8 m.
struct Joints {
  int bones = 0;
  std::vector<Vector3> places;  // [frames, bones]
  std::vector<bool> judged;     // frames whose steps count

  const Vector3& place(int frame, int bone) const { return places[static_cast<std::size_t>(frame) * bones + bone]; }
};

Joints joints_of(const Kinematics& kinematics, const Clip& clip) {
  const double scale = standard_scale(kinematics.skeleton());
  const std::vector<int> measured = measured_bones(kinematics.skeleton());
  PosedBones posed(kinematics.bones());
  Joints joints;
  joints.bones = static_cast<int>(measured.size());
  for (int f = 0; f < clip.frames; ++f) {
    world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
    for (const int b : measured) joints.places.emplace_back(posed.heads[b] * scale);
  }
  joints.judged.assign(clip.frames, true);
  return joints;
}

class Measurement {
 public:
  Measurement(const UsualHeights& usual, const FootClearance& clearance) : usual_(usual), clearance_(clearance) {}

  void add(const BodyTrack& track, const Joints& joints) {
    for (int side = 0; side < track.feet.count(); ++side) {
      add_point(track.feet[side].ball, track.floors[side].ball, track.rate);
      add_point(track.feet[side].heel, track.floors[side].heel, track.rate);
      add_turns(track.feet[side], track.floors[side], track.rate);
    }
    for (int f = 3; f < track.frames(); ++f) {
      if (joints.judged[f]) add_steps(joints, f, track.rate);
    }
    append(center_pushes_, ground_accelerations(track.center, track.rate));
    append(hips_pushes_, ground_accelerations(track.hips, track.rate));
    append(yaw_, angular_accelerations(track.heading, track.rate));
    append(jumps_, find_jumps(track, usual_));
    footfalls_.add(count_footfalls(track));
    dragging_.add(dragging(track, clearance_));
  }

  MotionMeasures result() {
    MotionMeasures m;
    m.foot_skate = count_ > 0 ? skate_ / count_ : 0;
    m.sliding_share = low_ > 0 ? sliding_ / low_ : 0;
    m.foot_turn = stood_ > 0 ? turned_ / stood_ : 0;
    m.penetration = depth_;
    m.positions = steps(positions_);
    m.velocities = steps(velocities_);
    m.accelerations = steps(accelerations_);
    m.center_of_mass = pushes(std::move(center_pushes_));
    m.hips = pushes(std::move(hips_pushes_));
    m.yaw = spread(std::move(yaw_));
    m.jumps = jumps();
    m.footfalls = footfalls_;
    m.dragged_share = dragging_.share();
    return m;
  }

 private:
  template <typename T>
  static void append(std::vector<T>& all, const std::vector<T>& some) {
    all.insert(all.end(), some.begin(), some.end());
  }

  void add_point(const std::vector<Vector3>& path, double floor, double rate) {
    for (std::size_t f = 1; f < path.size(); ++f) {
      const double height = path[f].z() - floor;
      const double speed = (path[f] - path[f - 1]).head<2>().norm() * rate;
      skate_ += speed * skate_weight(height);
      ++count_;
      depth_ = std::max(depth_, -height);
      if (height < kSkateHeight) ++low_;
      if (height < kSkateHeight && speed > kSliding) ++sliding_;
    }
  }

  // Of a foot whose ball and heel both stand.
  void add_turns(const FootPath& foot, const FootHeights& floor, double rate) {
    const auto faces = [&](std::size_t f) {
      const Vector3 way = foot.ball[f] - foot.heel[f];
      return std::atan2(way.y(), way.x());
    };
    for (std::size_t f = 1; f < foot.ball.size(); ++f) {
      const double weight = skate_weight(foot.ball[f].z() - floor.ball) * skate_weight(foot.heel[f].z() - floor.heel);
      turned_ += weight * rate * std::abs(wrapped(faces(f) - faces(f - 1)));
      stood_ += weight;
    }
  }

  void add_steps(const Joints& joints, int f, double rate) {
    for (int b = 0; b < joints.bones; ++b) {
      const Vector3 now = (joints.place(f, b) - joints.place(f - 1, b)) * rate;
      const Vector3 before = (joints.place(f - 1, b) - joints.place(f - 2, b)) * rate;
      const Vector3 earlier = (joints.place(f - 2, b) - joints.place(f - 3, b)) * rate;
      positions_.push_back(now.norm() / rate);
      velocities_.push_back((now - before).norm());
      accelerations_.push_back((now - 2 * before + earlier).norm() * rate);
    }
  }

  static Steps steps(std::vector<double>& values) {
    const Spread found = spread(std::move(values));
    return {found.p99, found.p999, found.worst};
  }

  // Of those that are numbers.
  double mean(double Jump::*figure) const {
    double sum = 0, count = 0;
    for (const Jump& jump : jumps_) {
      if (std::isnan(jump.*figure)) continue;
      sum += jump.*figure;
      ++count;
    }
    return sum / count;
  }

  JumpMeans jumps() const {
    return {static_cast<int>(jumps_.size()), mean(&Jump::dip), mean(&Jump::landing_dip), mean(&Jump::flight_ratio)};
  }

  UsualHeights usual_;
  const FootClearance& clearance_;
  double skate_ = 0, count_ = 0, low_ = 0, sliding_ = 0, depth_ = 0, turned_ = 0, stood_ = 0;
  std::vector<double> positions_, velocities_, accelerations_, center_pushes_, hips_pushes_, yaw_;
  std::vector<Jump> jumps_;
  Footfalls footfalls_;
  Dragging dragging_;
};

void check(const Performance& p, std::size_t width) {
  const auto frames = static_cast<std::size_t>(p.frames);
  if (p.frames < 1 || !(p.rate > 0) || p.root_positions.size() != 3 * frames || p.entered.size() != frames ||
      p.rotations.size() % frames != 0) {
    throw std::invalid_argument("the performance's parts do not fit together");
  }
  if (p.rotations.size() == width * frames) return;
  throw std::invalid_argument("the performance is of a skeleton of " + std::to_string(p.rotations.size() / frames / 4) +
                              " bones, the character's has " + std::to_string(width / 4) +
                              ": measure it by its own character");
}

}  // namespace

MotionMetrics::MotionMetrics(const Character& character) : skeleton_(character.pool.skeleton), limits_(character.pool) {
  const Kinematics kinematics(skeleton_);
  const std::vector<Clip> takes = captured_takes(character.pool);
  if (takes.empty()) throw std::invalid_argument("the character holds no captured fragment to measure by");
  const auto [tracks, floors] = tracks_of(skeleton_, takes);
  floors_ = floors;
  usual_ = usual_heights(tracks);
  clearance_ = clearance_of(tracks);
  Measurement measurement(usual_, clearance_);
  for (std::size_t i = 0; i < takes.size(); ++i) measurement.add(tracks[i], joints_of(kinematics, takes[i]));
  takes_ = measurement.result();
  takes_.turns = limits_.takes();
}

MotionMeasures MotionMetrics::of(const Performance& p) const {
  check(p, std::size_t{4} * skeleton_.size());
  const Kinematics kinematics(skeleton_);
  const Clip clip = clip_of(p);
  BodyTrack track = body_track(kinematics, clip);
  stand_on(track, floors_);
  Joints joints = joints_of(kinematics, clip);
  double since = kStitched;
  for (int f = 0; f < p.frames; ++f) {
    since = f > 0 && p.entered[f] != p.entered[f - 1] ? 0 : since + 1 / p.rate;
    joints.judged[f] = since < kStitched;
  }
  Measurement measurement(usual_, clearance_);
  measurement.add(track, joints);
  MotionMeasures measures = measurement.result();
  measures.turns = limits_.of(p.rotations);
  return measures;
}

}  // namespace fragmotion
