// SPDX-License-Identifier: MIT
#include "fragmotion/evaluate/motion_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "fragmotion/motion/center_of_mass.hpp"
#include "fragmotion/motion/pose.hpp"
#include "fragmotion/skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

constexpr double kRate = 60, kHeight = 0.025, kSliding = 0.1, kStitched = 0.25;
constexpr double kPush = 0.2, kHard = 6;  // s, m/s^2
constexpr double kNeverLow = std::numeric_limits<double>::infinity();

using PointFloors = std::array<double, 4>;  // heights of left ball, left heel, right ball, right heel

// A motion as the places of its joints, for a character of 1.8 m.
struct Joints {
  double rate = 0;
  int bones = 0, frames = 0;
  std::vector<Vector3> places;                 // [frames, bones]
  std::vector<Vector3> centers, hips;          // [frames]
  std::array<std::vector<Vector3>, 4> points;  // of the feet, as PointFloors; empty without feet
  std::vector<bool> judged;                    // frames whose steps count

  const Vector3& place(int frame, int bone) const { return places[static_cast<std::size_t>(frame) * bones + bone]; }
};

class JointReader {
 public:
  explicit JointReader(const Skeleton& skeleton)
      : kinematics_(skeleton),
        scale_(standard_scale(skeleton)),
        measured_(measured_bones(skeleton)),
        masses_(segment_masses(skeleton)),
        posed_(kinematics_.bones()) {}

  void add(Joints& joints, const Vector3& root, const double* rotations) {
    kinematics_.world(root, rotations, posed_.heads.data(), posed_.rotations.data());
    joints.bones = static_cast<int>(measured_.size());
    for (const int b : measured_) joints.places.push_back(posed_.heads[b] * scale_);
    const Roles& roles = kinematics_.skeleton().roles;
    joints.hips.push_back(posed_.heads[roles.hips] * scale_);
    joints.centers.push_back(center_of_mass(kinematics_.skeleton(), masses_, posed_) * scale_);
    if (roles.left_foot >= 0 && roles.right_foot >= 0) {
      add_foot(joints, 0, roles.left_foot, roles.left_toe);
      add_foot(joints, 2, roles.right_foot, roles.right_toe);
    }
    ++joints.frames;
  }

 private:
  void add_foot(Joints& joints, int at, int foot, int toe) {
    joints.points[at].push_back(ball(kinematics_.skeleton(), foot, toe, posed_) * scale_);
    joints.points[at + 1].push_back(posed_.heads[foot] * scale_);
  }

  Kinematics kinematics_;
  double scale_;
  std::vector<int> measured_;
  std::vector<double> masses_;
  PosedBones posed_;
};

std::vector<Joints> takes_of(const Character& character) {
  const PackedPool& pool = character.pool;
  std::vector<bool> captured(pool.clips.size(), false);
  for (const Fragment& f : pool.fragments) captured[f.clip] = captured[f.clip] || f.origin == Origin::captured;
  JointReader reader(pool.skeleton);
  std::vector<double> rotations(std::size_t{4} * pool.skeleton.size());
  std::vector<Joints> takes;
  for (std::size_t c = 0; c < pool.clips.size(); ++c) {
    if (!captured[c]) continue;
    const PackedClip& clip = pool.clips[c];
    Joints joints;
    joints.rate = kRate;
    for (int f = 0; f * clip.rate / kRate <= clip.frames - 1; ++f) {
      const Vector3 root = sample_pose(clip, f * clip.rate / kRate, rotations.data());
      reader.add(joints, root, rotations.data());
    }
    joints.judged.assign(joints.frames, true);
    takes.push_back(std::move(joints));
  }
  return takes;
}

// The median over the takes of where each point stands.
PointFloors floors_of(const std::vector<Joints>& takes) {
  PointFloors floors;
  floors.fill(kNeverLow);
  for (std::size_t point = 0; point < floors.size(); ++point) {
    std::vector<double> heights;
    for (const Joints& take : takes) {
      heights.push_back(take.points[point].empty() ? kNeverLow : floor_of(take.points[point]));
    }
    std::nth_element(heights.begin(), heights.begin() + heights.size() / 2, heights.end());
    floors[point] = heights[heights.size() / 2];
  }
  return floors;
}

class Measurement {
 public:
  explicit Measurement(const PointFloors& floors) : floors_(floors) {}

  void add(const Joints& joints) {
    for (std::size_t point = 0; point < floors_.size(); ++point) add_point(joints, point);
    for (int f = 3; f < joints.frames; ++f) {
      if (joints.judged[f]) add_steps(joints, f);
    }
    add_pushes(joints.centers, joints.rate, center_pushes_);
    add_pushes(joints.hips, joints.rate, hips_pushes_);
  }

  MotionMeasures result() {
    MotionMeasures m;
    m.foot_skate = count_ > 0 ? skate_ / count_ : 0;
    m.sliding_share = low_ > 0 ? sliding_ / low_ : 0;
    m.penetration = depth_;
    m.positions = steps(positions_);
    m.velocities = steps(velocities_);
    m.accelerations = steps(accelerations_);
    m.center_of_mass = pushes(center_pushes_);
    m.hips = pushes(hips_pushes_);
    return m;
  }

 private:
  void add_point(const Joints& joints, std::size_t point) {
    const std::vector<Vector3>& path = joints.points[point];
    for (std::size_t f = 1; f < path.size(); ++f) {
      const double height = path[f].z() - floors_[point];
      const double speed = (path[f] - path[f - 1]).head<2>().norm() * joints.rate;
      skate_ += speed * std::clamp(2 - std::exp2(height / kHeight), 0.0, 1.0);
      ++count_;
      depth_ = std::max(depth_, -height);
      if (height < kHeight) ++low_;
      if (height < kHeight && speed > kSliding) ++sliding_;
    }
  }

  void add_steps(const Joints& joints, int f) {
    for (int b = 0; b < joints.bones; ++b) {
      const Vector3 now = (joints.place(f, b) - joints.place(f - 1, b)) * joints.rate;
      const Vector3 before = (joints.place(f - 1, b) - joints.place(f - 2, b)) * joints.rate;
      const Vector3 earlier = (joints.place(f - 2, b) - joints.place(f - 3, b)) * joints.rate;
      positions_.push_back(static_cast<float>(now.norm() / joints.rate));
      velocities_.push_back(static_cast<float>((now - before).norm()));
      accelerations_.push_back(static_cast<float>((now - 2 * before + earlier).norm() * joints.rate));
    }
  }

  static void add_pushes(const std::vector<Vector3>& path, double rate, std::vector<float>& pushes) {
    const auto apart = static_cast<std::size_t>(std::max(1L, std::lround(kPush * rate)));
    for (std::size_t f = 2 * apart; f < path.size(); ++f) {
      const Vector3 change = path[f] - 2 * path[f - apart] + path[f - 2 * apart];
      pushes.push_back(static_cast<float>(change.head<2>().norm() / (kPush * kPush)));
    }
  }

  static double percentile(std::vector<float>& values, double share) {
    const auto i = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), i, values.end());
    return static_cast<double>(*i);
  }

  static Steps steps(std::vector<float>& values) {
    if (values.empty()) return {};
    return {percentile(values, 0.99), percentile(values, 0.999), percentile(values, 1)};
  }

  static Pushes pushes(std::vector<float>& values) {
    if (values.empty()) return {};
    const auto hard = std::count_if(values.begin(), values.end(), [](float push) { return push > kHard; });
    return {percentile(values, 0.5), percentile(values, 0.99), percentile(values, 0.999), percentile(values, 1),
            static_cast<double>(hard) / static_cast<double>(values.size())};
  }

  PointFloors floors_;
  double skate_ = 0, count_ = 0, low_ = 0, sliding_ = 0, depth_ = 0;
  std::vector<float> positions_, velocities_, accelerations_, center_pushes_, hips_pushes_;
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
  const std::vector<Joints> takes = takes_of(character);
  if (takes.empty()) throw std::invalid_argument("the character holds no captured fragment to measure by");
  floors_ = floors_of(takes);
  Measurement measurement(floors_);
  for (const Joints& take : takes) measurement.add(take);
  takes_ = measurement.result();
  takes_.turns = limits_.takes();
}

MotionMeasures MotionMetrics::of(const Performance& p) const {
  const std::size_t width = std::size_t{4} * skeleton_.size();
  check(p, width);
  JointReader reader(skeleton_);
  Joints joints;
  joints.rate = p.rate;
  double since = kStitched;
  for (int f = 0; f < p.frames; ++f) {
    reader.add(joints, load_vector(&p.root_positions[std::size_t{3} * f]), &p.rotations[width * f]);
    since = f > 0 && p.entered[f] != p.entered[f - 1] ? 0 : since + 1 / p.rate;
    joints.judged.push_back(since < kStitched);
  }
  Measurement measurement(floors_);
  measurement.add(joints);
  MotionMeasures measures = measurement.result();
  measures.turns = limits_.of(p.rotations);
  return measures;
}

}  // namespace fragmotion
