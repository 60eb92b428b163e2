// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

#include "add_bone.hpp"
#include "base/random.hpp"
#include "base/turn_between.hpp"
#include "fragments/cutting.hpp"
#include "fragments/evident.hpp"
#include "motion/discontinuities.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion {

/// A humanoid 1.76 m tall whose rest frames are the world's axes; it faces -y as Blender's do, its left is at +x.
/// `size` scales it.
inline Skeleton humanoid(double size = 1) {
  Skeleton s;
  const auto add = [&](const char* name, int parent, const Vector3& offset, const Vector3& tip) {
    add_bone(s, name, parent, size * offset, size * tip);
  };
  add("hips", -1, {0, 0, 0.96}, {0, 0, 0.15});
  add("spine", 0, {0, 0, 0.15}, {0, 0, 0.4});
  add("head", 1, {0, 0, 0.45}, {0, 0, 0.2});
  for (const double side : {1.0, -1.0}) {
    const std::string end = side > 0 ? ".L" : ".R";
    const int arm = s.size();
    add(("upper_arm" + end).c_str(), 1, {0.18 * side, 0, 0.38}, {0, 0, -0.28});
    add(("forearm" + end).c_str(), arm, {0, 0, -0.28}, {0, 0, -0.25});
    add(("hand" + end).c_str(), arm + 1, {0, 0, -0.25}, {0, 0, -0.15});
    const int leg = s.size();
    add(("thigh" + end).c_str(), 0, {0.1 * side, 0, -0.02}, {0, 0, -0.44});
    add(("shin" + end).c_str(), leg, {0, 0, -0.44}, {0, 0, -0.42});
    add(("foot" + end).c_str(), leg + 1, {0, 0, -0.42}, {0, -0.18, -0.08});
  }
  return make_skeleton(std::move(s));
}

/// A humanoid() that ends in its shins: they are its feet.
inline Skeleton on_shins() {
  Skeleton s = humanoid();
  s.roles.left_foot = s.find("shin.L"), s.roles.right_foot = s.find("shin.R");
  s.roles.left_toe = s.roles.right_toe = -1;
  return s;
}

/// How the walker goes: velocity to the right and forward in m/s and turn rate in rad/s, constant in its own frame.
struct Gait {
  double x = 0, y = 1.2, turn = 0;
  double seconds = 3, rate = 30;
  double cycle = 1;    ///< s for two steps
  double jump = 0;     ///< m: height of a hop in the middle of the take, half a second long
  double size = 1;     ///< of humanoid()
  double heading = 0;  ///< rad, at the start

  bool steps() const { return std::hypot(x, y) > 0.05 || std::abs(turn) > 0.1; }

  CharacterFrame at(double t) const {
    const double a = turn * t;
    const Vector2 v(x, y);
    const Vector2 left(-y, x);
    const Vector2 path =
        std::abs(a) < 1e-9 ? Vector2(v * t) : Vector2((std::sin(a) * v + (1 - std::cos(a)) * left) / turn);
    return {Eigen::Rotation2Dd(heading) * path, heading + a};
  }
};

/// Where a foot (side 1: left) is at a time: planted for 60 % of the cycle, else on its way to where it stands next.
inline Vector3 foot_target(const Gait& gait, double side, double t) {
  const auto planted = [&](double middle) {
    const CharacterFrame frame = gait.at(middle);
    return frame.to_world({-0.1 * side, 0.0, 0.08});
  };
  if (!gait.steps()) return planted(t);
  const double phase = t / gait.cycle + (side > 0 ? 0 : 0.5), stand = 0.6;
  const double number = std::floor(phase), part = phase - number;
  const double middle = t - (part - 0.5 * stand) * gait.cycle;
  if (part <= stand) return planted(middle);
  const double u = (part - stand) / (1 - stand), w = u * u * (3 - 2 * u);
  return (1 - w) * planted(middle) + w * planted(middle + gait.cycle) + Vector3(0, 0, 0.12 * std::sin(kPi * u));
}

/// Writes the rotations of one leg of a humanoid whose hips stand in `frame` at `height`, so that its ankle is at
/// `ankle`. Lengths are those of humanoid(1).
inline void bend_leg(const CharacterFrame& frame, double height, double side, const Vector3& ankle, double* thigh) {
  const Vector3 local = frame.to_local(ankle);
  const Vector3 joint(0.1 * side, 0, height - 0.02);
  Vector3 reach = Vector3(-local.x(), -local.y(), local.z()) - joint;  // the hips face -y in their own frame
  const double a = 0.44, b = 0.42, length = std::min(reach.norm(), a + b - 1e-3);
  reach = reach.normalized() * length;
  const double hip = std::acos((a * a + length * length - b * b) / (2 * a * length));
  const double knee = kPi - std::acos((a * a + b * b - length * length) / (2 * a * b));
  const auto about_x = [](double angle) { return Quaternion(Eigen::AngleAxisd(angle, Vector3::UnitX())); };
  const Quaternion thigh_rotation = turn_between(-Vector3::UnitZ(), reach) * about_x(-hip);
  const Quaternion shin_rotation = about_x(knee);
  store_quaternion(thigh_rotation, thigh);
  store_quaternion(shin_rotation, thigh + 4);
  store_quaternion((thigh_rotation * shin_rotation).conjugate(), thigh + 8);
}

/// A take of a humanoid() that goes as `gait` says, on planted feet.
inline Clip gait_clip(const Gait& gait, const std::string& name = "gait") {
  const Skeleton skeleton = humanoid(gait.size);
  Clip clip;
  clip.name = name;
  clip.rate = gait.rate;
  clip.frames = static_cast<int>(std::lround(gait.seconds * gait.rate)) + 1;
  for (int f = 0; f < clip.frames; ++f) {
    const double t = f / gait.rate;
    const CharacterFrame frame = gait.at(t);
    const double hop = std::abs(t - gait.seconds / 2) / 0.25;
    const double air = hop < 1 ? gait.jump * (1 - hop * hop) : 0;
    const double height = (gait.steps() ? 0.9 : 0.94) + air;
    std::vector<double> pose;
    for (int b = 0; b < skeleton.size(); ++b) pose.insert(pose.end(), {1, 0, 0, 0});
    store_quaternion(CharacterFrame{{0, 0}, frame.heading + kPi}.rotation(), pose.data());
    for (const double side : {1.0, -1.0}) {
      const int arm = skeleton.find(side > 0 ? "upper_arm.L" : "upper_arm.R");
      const double swing = gait.steps() ? 0.4 * side * std::sin(2 * kPi * t / gait.cycle) : 0;
      store_quaternion(Quaternion(Eigen::AngleAxisd(swing, Vector3::UnitX())), &pose[std::size_t{4} * arm]);
      const int thigh = skeleton.find(side > 0 ? "thigh.L" : "thigh.R");
      bend_leg(frame, height, side, foot_target(gait, side, t) + Vector3(0, 0, air), &pose[std::size_t{4} * thigh]);
    }
    for (const double value : {frame.position.x(), frame.position.y(), height}) {
      clip.root_positions.push_back(gait.size * value);
    }
    clip.rotations.insert(clip.rotations.end(), pose.begin(), pose.end());
  }
  return make_clip(skeleton, std::move(clip));
}

/// Takes that cover the gaits: standing, eight directions at a walk and a run forward, curves, turning in place, a
/// jump.
inline std::vector<Clip> gait_takes(double rate = 30, double size = 1) {
  std::vector<Clip> clips;
  const auto add = [&](Gait gait, const char* name) {
    gait.rate = rate;
    gait.size = size;
    clips.push_back(gait_clip(gait, name));
  };
  Gait stand;
  stand.y = 0;
  add(stand, "stand");
  for (int direction = 0; direction < 8; ++direction) {
    Gait gait;
    gait.x = -1.2 * std::sin(direction * kPi / 4);
    gait.y = 1.2 * std::cos(direction * kPi / 4);
    add(gait, "walk");
  }
  Gait run;
  run.y = 3;
  run.cycle = 0.6;
  add(run, "run");
  for (const double side : {1.0, -1.0}) {
    Gait turn;
    turn.turn = 1.2 * side;
    add(turn, "curve");
    turn.y = 0;
    add(turn, "turn");
  }
  Gait jump = stand;
  jump.jump = 0.3;
  add(jump, "jump");
  return clips;
}

/// Cuts every clip into fragments with their evident controls.
inline FragmentPool gait_pool(const std::vector<Clip>& clips, double size = 1, const CutOptions& options = {},
                              const ControlSpace* space = nullptr) {
  const Skeleton skeleton = humanoid(size);
  const Kinematics kinematics(skeleton);
  FragmentPool pool{skeleton, clips, {}};
  const ControlSpace standard(1.2 * size, 3.3 * size, ControlSpace().turn_rate(), 1.8 / stature(skeleton));
  std::vector<BodyMotion> motions;
  for (int c = 0; c < static_cast<int>(clips.size()); ++c) {
    cut_fragments(pool, c, find_contacts(kinematics, clips[c]), discontinuities(skeleton, clips[c]), options);
    motions.push_back(body_motion(kinematics, clips[c]));
  }
  const double usual = usual_height(motions);
  for (Fragment& f : pool.fragments) {
    f.evident = evident_control(motions[f.clip], clips[f.clip].rate, f.begin, f.end, usual, space ? *space : standard);
  }
  return pool;
}

/// How many fragments each clip of the pool has.
inline std::vector<int> fragments_by_clip(const FragmentPool& pool) {
  std::vector<int> counts(pool.clips.size(), 0);
  for (const Fragment& fragment : pool.fragments) ++counts[fragment.clip];
  return counts;
}

/// The clip turned by `heading` about z and then moved on the ground.
inline Clip moved(const Skeleton& skeleton, Clip clip, const CharacterFrame& move) {
  for (int f = 0; f < clip.frames; ++f) {
    store_vector(move.to_world(load_vector(&clip.root_positions[3 * f])), &clip.root_positions[3 * f]);
    double* hips = &clip.rotations[std::size_t{4} * (f * skeleton.size() + skeleton.roles.hips)];
    store_quaternion(move.rotation() * load_quaternion(hips), hips);
    clip.headings[f] += move.heading;
  }
  return clip;
}

}  // namespace fragmotion
