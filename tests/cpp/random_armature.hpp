// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "io/rig.hpp"
#include "mocap_files.hpp"
#include "small_skeleton.hpp"

namespace fragmotion {

using Matrix4 = Eigen::Matrix4d;
using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

inline Matrix4 compose(const Vector3& head, const Quaternion& rotation, double scale = 1) {
  Matrix4 matrix = Matrix4::Identity();
  matrix.topLeftCorner<3, 3>() = scale * rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = head;
  return matrix;
}

inline void append(const Matrix4& matrix, std::vector<double>& values) {
  const RowMajor4 rows = matrix;
  values.insert(values.end(), rows.data(), rows.data() + 16);
}

inline Matrix4 matrix_at(const std::vector<double>& values, std::size_t index) {
  return Eigen::Map<const RowMajor4>(&values[16 * index]);
}

inline Quaternion rotation_of(const Matrix4& matrix) {
  return Quaternion{Eigen::Matrix3d(matrix.topLeftCorner<3, 3>().colwise().normalized())};
}

/// Two trees: lamp > shade (no character), and root > {prop, body > hips > ...}, in mixed order and random rest poses.
inline Armature random_armature(std::uint64_t seed, bool special = false) {
  Random random(seed);
  Armature armature;
  armature.names = {"lamp",    "root",    "prop",   "shade",  "body",  "hips",
                    "thigh.L", "thigh.R", "foot.L", "foot.R", "spine", "head"};
  armature.parents = {-1, -1, 1, 0, 1, 4, 5, 5, 6, 7, 5, 10};
  for (std::size_t b = 0; b < armature.names.size(); ++b) {
    append(compose(random_vector(random, 2), random_rotation(random)), armature.rest);
    armature.lengths.push_back(0.1 + random.uniform());
    armature.inherit_rotation.push_back(!special || random.uniform() < 0.5);
    armature.local_location.push_back(!special || random.uniform() < 0.5);
  }
  append(compose(random_vector(random, 3), random_rotation(random), 0.2 + random.uniform()), armature.world);
  return armature;
}

/// Blender's pose of one frame in matrices, from the manual: the reference for the quaternions of Rig.
inline std::vector<Matrix4> blender_pose(const Armature& armature, const double* locations, const double* rotations) {
  std::vector<Matrix4> pose(armature.names.size());
  for (std::size_t b = 0; b < pose.size(); ++b) {
    const Matrix4 rest = matrix_at(armature.rest, b);
    const int parent = armature.parents[b];
    const Matrix4 above = parent < 0 ? Matrix4(Matrix4::Identity()) : pose[parent];
    const Matrix4 local = parent < 0 ? rest : Matrix4(matrix_at(armature.rest, parent).inverse() * rest);
    const Matrix4 moved = above * local;
    const Matrix4 axes = armature.local_location[b] ? moved : above;
    const Matrix4 base = armature.inherit_rotation[b] ? moved : rest;
    const Vector3 shift = axes.topLeftCorner<3, 3>() * load_vector(locations + 3 * b);
    const auto size = armature.sizes.find(armature.names[b]);
    const double own = size == armature.sizes.end() ? 1 : size->second;
    pose[b] = compose(moved.topRightCorner<3, 1>() + shift,
                      rotation_of(base) * load_quaternion(rotations + 4 * b).normalized(), own * above.col(0).norm());
  }
  return pose;
}

inline Channels random_channels(int bones, int frames, std::uint64_t seed) {
  Random random(seed);
  Channels channels{frames, {}, {}};
  for (int i = 0; i < frames * bones; ++i) {
    const Vector3 location = random_vector(random);
    const Eigen::Vector4d q = random_rotation(random).coeffs() * (0.5 + random.uniform());
    channels.locations.insert(channels.locations.end(), location.data(), location.data() + 3);
    channels.rotations.insert(channels.rotations.end(), q.data(), q.data() + 4);
  }
  return channels;
}

inline Clip clip_of(const Rig& rig, const Channels& channels, const double* worlds = nullptr) {
  return rig.clip("walk", 30, channels.frames, channels.locations.data(), channels.rotations.data(), worlds);
}

inline void expect_same_motion(const Clip& a, const Clip& b, double tolerance) {
  ASSERT_EQ(a.root_positions.size(), b.root_positions.size());
  ASSERT_EQ(a.rotations.size(), b.rotations.size());
  for (std::size_t i = 0; i < a.root_positions.size(); ++i)
    EXPECT_NEAR(a.root_positions[i], b.root_positions[i], tolerance);
  for (std::size_t i = 0; i < a.rotations.size(); i += 4) {
    const Quaternion p = load_quaternion(&a.rotations[i]), q = load_quaternion(&b.rotations[i]);
    EXPECT_LT(p.angularDistance(q), tolerance) << "rotation " << i / 4;
  }
}

inline void expect_parts(const std::string& error, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(error.find(part), std::string::npos) << part << " in: " << error;
}

}  // namespace fragmotion
