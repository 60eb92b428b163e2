// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "random_armature.hpp"

namespace fragmotion {
namespace {

TEST(RigClip, PosesAsBlenderDoes) {
  for (const bool special : {false, true}) {
    const Armature armature = random_armature(6, special);
    const Rig rig(armature);
    const Channels channels = random_channels(12, 6, 7);
    std::vector<double> matrices;
    for (int f = 0; f < channels.frames; ++f) {
      for (const Matrix4& bone : blender_pose(armature, &channels.locations[36 * f], &channels.rotations[48 * f]))
        append(bone, matrices);
    }
    expect_same_motion(clip_of(rig, channels), rig.clip_from_matrices("walk", 30, 6, matrices.data()), 1e-12);
  }
}

TEST(RigClip, PutsTheHipsWhereTheObjectMovesThem) {
  const Armature armature = random_armature(8);
  const Rig rig(armature);
  const Channels channels = random_channels(12, 4, 9);
  const double scale = matrix_at(armature.world, 0).topLeftCorner<3, 1>().norm();
  Random random(10);
  std::vector<double> worlds;
  for (int f = 0; f < 4; ++f) append(compose(random_vector(random, 3), random_rotation(random), scale), worlds);
  const Clip clip = clip_of(rig, channels, worlds.data());
  for (int f = 0; f < 4; ++f) {
    const Matrix4 hips =
        matrix_at(worlds, f) * blender_pose(armature, &channels.locations[36 * f], &channels.rotations[48 * f])[5];
    EXPECT_LT((load_vector(&clip.root_positions[3 * f]) - hips.topRightCorner<3, 1>()).norm(), 1e-12);
    EXPECT_LT(load_quaternion(&clip.rotations[4 * (10 * f + 3)]).angularDistance(rotation_of(hips)), 1e-12);
  }
}

// As exporters leave it; the mean is what its bones are scaled by.
TEST(RigClip, PutsTheHipsWhereAnObjectMovesThemThatIsScaledALittleUnevenly) {
  Armature armature = random_armature(8);
  const Eigen::Vector4d uneven(1.001, 1.001, 0.998, 1);
  const Matrix4 world = matrix_at(armature.world, 0) * uneven.asDiagonal();
  armature.world.clear();
  append(world, armature.world);
  const Rig rig(armature);
  const Channels channels = random_channels(12, 4, 9);
  const Clip clip = clip_of(rig, channels);
  for (int f = 0; f < 4; ++f) {
    const Matrix4 hips = world * blender_pose(armature, &channels.locations[36 * f], &channels.rotations[48 * f])[5];
    EXPECT_LT((load_vector(&clip.root_positions[3 * f]) - hips.topRightCorner<3, 1>()).norm(), 1e-12);
  }
  const Channels back = rig.channels(clip.frames, clip.root_positions.data(), clip.rotations.data());
  expect_same_motion(clip_of(rig, back), clip, 1e-9);
}

// What turns about the vertical stays as it is, whatever stretches it upwards; as bones' lengths do in clips.
TEST(RigClip, LeavesOutWhatStretchesTheObjectUpwards) {
  const Eigen::Vector4d upwards(1, 1, 1.206, 1);
  Armature armature = random_armature(8);
  const Matrix4 plain = matrix_at(armature.world, 0), world = upwards.asDiagonal() * plain;
  const Rig rig(armature);
  armature.world.clear();
  append(world, armature.world);
  const Rig stretched(armature);
  EXPECT_NEAR(stretched.rise(), 1.206, 1e-12);
  EXPECT_EQ(rig.rise(), 1);
  for (int b = 0; b < rig.skeleton().size(); ++b)
    EXPECT_LT((stretched.skeleton().offsets[b] - rig.skeleton().offsets[b]).norm(), 1e-12);
  const Channels channels = random_channels(12, 4, 9);
  const Clip clip = clip_of(stretched, channels);
  expect_same_motion(clip, clip_of(rig, channels), 1e-12);
  for (int f = 0; f < 4; ++f) {
    const Matrix4 hips = world * blender_pose(armature, &channels.locations[36 * f], &channels.rotations[48 * f])[5];
    const Vector3 shown = load_vector(&clip.root_positions[3 * f]).cwiseProduct(upwards.head<3>());
    EXPECT_LT((shown - hips.topRightCorner<3, 1>()).norm(), 1e-12);
  }
  const Channels back = stretched.channels(clip.frames, clip.root_positions.data(), clip.rotations.data());
  expect_same_motion(clip_of(stretched, back), clip, 1e-9);
}

TEST(RigClip, DropsTheScaleOfMatrices) {
  const Armature armature = random_armature(11);
  const Rig rig(armature);
  const Channels channels = random_channels(12, 2, 12);
  std::vector<double> plain, scaled;
  for (int f = 0; f < 2; ++f) {
    for (const Matrix4& bone : blender_pose(armature, &channels.locations[36 * f], &channels.rotations[48 * f])) {
      append(bone, plain);
      append(bone * Eigen::Vector4d(1.5, 0.8, 1.1, 1).asDiagonal(), scaled);
    }
  }
  expect_same_motion(rig.clip_from_matrices("a", 30, 2, plain.data()),
                     rig.clip_from_matrices("a", 30, 2, scaled.data()), 1e-12);
}

TEST(RigClip, NamesTheFrameAndBoneOfBadChannels) {
  const Armature armature = random_armature(13);
  const Rig rig(armature);
  const struct {
    const char* label;
    std::function<void(Channels&)> spoil;
    std::vector<std::string> named;
  } cases[] = {
      {"rotation not finite",
       [](Channels& c) { c.rotations[4 * (12 * 2 + 10)] = kNan; },
       {"'walk'", "frame 2", "'spine'", "rotation is not finite"}},
      {"zero rotation",
       [](Channels& c) { std::fill_n(&c.rotations[4 * (12 * 2 + 10)], 4, 0.0); },
       {"'walk'", "frame 2", "'spine'", "zero quaternion"}},
      {"location",
       [](Channels& c) { c.locations[3 * (12 * 1 + 4)] = INFINITY; },
       {"'walk'", "frame 1", "'body'", "location is not finite"}},
      {"one frame", [](Channels& c) { c.frames = 1; }, {"'walk'", "1 frames"}},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.label);
    Channels channels = random_channels(12, 3, 14);
    c.spoil(channels);
    expect_parts(error_of([&] { clip_of(rig, channels); }), c.named);
  }
}

TEST(RigClip, NamesTheFrameOfABadObject) {
  Armature armature = random_armature(15);
  armature.world.clear();
  append(Matrix4::Identity(), armature.world);
  const Rig rig(armature);
  const Channels channels = random_channels(12, 2, 16);
  std::vector<double> worlds = armature.world;
  append(compose({0, 0, 0}, Quaternion::Identity(), 2), worlds);
  expect_parts(error_of([&] { clip_of(rig, channels, worlds.data()); }), {"'walk'", "frame 1", "scale is 2", "keys"});
  worlds[16] = 1;
  expect_parts(error_of([&] { clip_of(rig, channels, worlds.data()); }), {"'walk'", "frame 1", "(1, 2, 2): apply"});
}

TEST(RigClip, NamesTheFrameAndBoneOfBadMatrices) {
  const Rig rig(random_armature(17));
  std::vector<double> matrices;
  for (int i = 0; i < 24; ++i) append(Matrix4::Identity(), matrices);
  const std::size_t spine = 16 * (12 + 10);
  const auto error = [&] { return error_of([&] { rig.clip_from_matrices("walk", 30, 2, matrices.data()); }); };
  for (const auto& [value, what] : {std::pair(-1.0, "mirrored"), {0.0, "flat"}, {kNan, "finite"}}) {
    matrices[spine] = value;
    expect_parts(error(), {"'walk'", "frame 1", "'spine'", what});
  }
}

// Quaternius' robots blink by an eye that is scaled to nothing, and a little beyond.
TEST(RigClip, LeavesABoneThatCarriesNoOtherAsItWasTurnedWhereItIsSquashed) {
  const Armature armature = random_armature(18);
  const Rig rig(armature);
  const Channels channels = random_channels(12, 4, 19);
  const auto matrices_of = [&](int frames, int squashed, double scale) {
    std::vector<double> matrices;
    for (int f = 0; f < frames; ++f) {
      std::vector<Matrix4> pose = blender_pose(armature, &channels.locations[36 * f], &channels.rotations[48 * f]);
      if (f == squashed) pose[11].col(1) *= scale;
      for (const Matrix4& matrix : pose) append(matrix, matrices);
    }
    return matrices;
  };
  const auto clip = [&](const std::vector<double>& matrices) {
    return rig.clip_from_matrices("blink", 30, 4, matrices.data());
  };
  const Clip seen = clip(matrices_of(4, -1, 1));
  const auto head_at = [&](const Clip& c, int f) { return load_quaternion(&c.rotations[4 * (10 * f + 9)]); };
  for (const double scale : {0.0, -0.1}) {
    const Clip blinks = clip(matrices_of(4, 2, scale));
    for (const int f : {0, 1, 3}) EXPECT_LT(head_at(blinks, f).angularDistance(head_at(seen, f)), 1e-9);
    EXPECT_LT(head_at(blinks, 2).angularDistance(head_at(seen, 1)), 1e-9);
  }
}

}  // namespace
}  // namespace fragmotion
