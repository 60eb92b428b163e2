// SPDX-License-Identifier: MIT
#include "synthetic_takes.hpp"

#include <cmath>
#include <string>

#include "base/random.hpp"
#include "base/rates.hpp"
#include "skeleton/kinematics.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion::benchmarks {
namespace {

constexpr int kFrames = 121;
constexpr double kHipHeight = 0.96;  // m
constexpr double kLegLength = 0.86;  // m, hip to ankle

// What a take does, and in which style.
struct Style {
  double speed = 0, direction = 0, turn = 0, jump = 0;  // m/s, rad from forward to the left, rad/s, m
  double cycle = 1, phase = 0;                          // s for two steps; of the cycle at the start
  double swing = 0, lift = 0, arms = 0, sway = 0;       // rad: amplitudes
};

double between(Random& random, double low, double high) { return low + (high - low) * random.uniform(); }

Style style_of(int take) {
  Random random(static_cast<std::uint64_t>(take) + 1);
  const int velocity = take % 17;
  const bool run = velocity > 8;
  Style style;
  style.speed = velocity == 0 ? 0 : (run ? 3.3 : 1.2) * between(random, 0.85, 1.15);
  style.direction = velocity == 0 ? 0 : (velocity - 1) % 8 * kPi / 4 + between(random, -0.1, 0.1);
  style.turn = (take / 17 % 3 - 1) * 70 * kPi / 180 * between(random, 0.8, 1.2);
  style.jump = take / 51 % 3 == 2 ? between(random, 0.25, 0.4) : 0;
  style.cycle = (run ? 0.62 : 1) * between(random, 0.9, 1.1);
  style.phase = random.uniform();
  // The foot that stands goes back as fast as the body goes ahead.
  style.swing = style.speed * style.cycle / (2 * kPi * kLegLength);
  style.lift = style.speed > 0 || style.turn != 0 ? between(random, 0.3, 0.6) : 0.02;
  style.arms = between(random, 0.1, 0.3) + 0.1 * style.speed;
  style.sway = between(random, 0.02, 0.08);
  return style;
}

Quaternion about(const Vector3& axis, double angle) { return Quaternion{Eigen::AngleAxisd(angle, axis)}; }

// Poses one leg; `phase` is where it is in the cycle, rad.
void pose_leg(const Style& style, double phase, double* thigh) {
  // The body faces -y in its own frame, so going in `direction` is turning the leg about this axis.
  const Vector3 axis(-std::cos(style.direction), -std::sin(style.direction), 0);
  const double bend = style.lift * std::max(0.0, std::cos(phase));
  store_quaternion(about(axis, style.swing * std::sin(phase)) * about(-Vector3::UnitX(), bend), thigh);
  store_quaternion(about(Vector3::UnitX(), 2 * bend), thigh + 4);
  store_quaternion(about(-Vector3::UnitX(), bend), thigh + 8);
}

void pose_arm(const Style& style, double phase, double* upper_arm) {
  store_quaternion(about(Vector3::UnitX(), style.arms * std::sin(phase)), upper_arm);
  store_quaternion(about(-Vector3::UnitX(), 0.3 + style.arms * (1 + std::sin(phase))), upper_arm + 4);
}

// Rotations of one pose; `phase` is the left leg's, rad.
std::vector<double> pose(const Style& style, const Skeleton& skeleton, double phase, double heading) {
  std::vector<double> rotations;
  for (int b = 0; b < skeleton.size(); ++b) rotations.insert(rotations.end(), {1, 0, 0, 0});
  const auto bone = [&](const char* name) { return &rotations[std::size_t{4} * skeleton.find(name)]; };
  store_quaternion(about(Vector3::UnitZ(), heading + kPi), bone("hips"));
  store_quaternion(about(Vector3::UnitZ(), style.sway * std::sin(phase)), bone("spine"));
  store_quaternion(about(Vector3::UnitY(), style.sway * std::cos(phase)), bone("chest"));
  pose_leg(style, phase, bone("thigh.L"));
  pose_leg(style, phase + kPi, bone("thigh.R"));
  pose_arm(style, phase, bone("upper_arm.L"));
  pose_arm(style, phase + kPi, bone("upper_arm.R"));
  return rotations;
}

// Height of a hop of half a second in every other second.
double hop(const Style& style, double t) {
  const double u = std::fmod(t, 2.0) - 1;
  return std::abs(u) < 0.25 ? style.jump * (1 - 16 * u * u) : 0;
}

Clip make_take(const Skeleton& skeleton, int take) {
  const Style style = style_of(take);
  Clip clip;
  clip.name = "take " + std::to_string(take);
  clip.rate = kPoseRate;
  clip.frames = kFrames;
  CharacterFrame frame;
  for (int f = 0; f < kFrames; ++f) {
    const double t = f / kPoseRate, phase = 2 * kPi * (t / style.cycle + style.phase);
    const double height = kHipHeight - 0.02 + 0.02 * std::cos(2 * phase) + hop(style, t);
    clip.root_positions.insert(clip.root_positions.end(), {frame.position.x(), frame.position.y(), height});
    const std::vector<double> rotations = pose(style, skeleton, phase, frame.heading);
    clip.rotations.insert(clip.rotations.end(), rotations.begin(), rotations.end());
    const double course = frame.heading + style.direction;
    frame.position += style.speed / kPoseRate * Vector2(-std::sin(course), std::cos(course));
    frame.heading += style.turn / kPoseRate;
  }
  return make_clip(skeleton, std::move(clip));
}

// Adds bones in parent-before-child order; all frames are the world's axes at rest.
class SkeletonMaker {
 public:
  int add(const std::string& name, int parent, const Vector3& offset, const Vector3& tip) {
    skeleton_.names.push_back(name);
    skeleton_.parents.push_back(parent);
    skeleton_.rest_rotations.push_back(Quaternion::Identity());
    skeleton_.offsets.push_back(offset);
    skeleton_.tips.push_back(tip);
    return skeleton_.size() - 1;
  }
  Skeleton skeleton() const { return make_skeleton(skeleton_); }

 private:
  Skeleton skeleton_;
};

void add_arm(SkeletonMaker& maker, int chest, double side, const std::string& end) {
  const int clavicle = maker.add("clavicle" + end, chest, {0.03 * side, 0, 0.12}, {0.14 * side, 0, 0});
  const int upper = maker.add("upper_arm" + end, clavicle, {0.15 * side, 0, 0}, {0, 0, -0.28});
  const int fore = maker.add("forearm" + end, upper, {0, 0, -0.28}, {0, 0, -0.25});
  maker.add("hand" + end, fore, {0, 0, -0.25}, {0, 0, -0.18});
}

void add_leg(SkeletonMaker& maker, int hips, double side, const std::string& end) {
  const int thigh = maker.add("thigh" + end, hips, {0.1 * side, 0, -0.02}, {0, 0, -0.44});
  const int shin = maker.add("shin" + end, thigh, {0, 0, -0.44}, {0, 0, -0.42});
  const int foot = maker.add("foot" + end, shin, {0, 0, -0.42}, {0, -0.14, -0.07});
  maker.add("toe" + end, foot, {0, -0.14, -0.07}, {0, -0.06, 0});
}

}  // namespace

Skeleton mannequin() {
  SkeletonMaker maker;
  const int hips = maker.add("hips", -1, {0, 0, kHipHeight}, {0, 0, 0.1});
  const int spine = maker.add("spine", hips, {0, 0, 0.1}, {0, 0, 0.14});
  const int chest = maker.add("chest", spine, {0, 0, 0.14}, {0, 0, 0.14});
  const int upper_chest = maker.add("upper_chest", chest, {0, 0, 0.14}, {0, 0, 0.14});
  const int neck = maker.add("neck", upper_chest, {0, 0, 0.16}, {0, 0, 0.08});
  maker.add("head", neck, {0, 0, 0.08}, {0, 0, 0.2});
  for (const double side : {1.0, -1.0}) {
    add_arm(maker, upper_chest, side, side > 0 ? ".L" : ".R");
    add_leg(maker, hips, side, side > 0 ? ".L" : ".R");
  }
  return maker.skeleton();
}

std::vector<Clip> synthetic_takes(int count) {
  const Skeleton skeleton = mannequin();
  std::vector<Clip> clips;
  for (int take = 0; take < count; ++take) clips.push_back(make_take(skeleton, take));
  return clips;
}

}  // namespace fragmotion::benchmarks
