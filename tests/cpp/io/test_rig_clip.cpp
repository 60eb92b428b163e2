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

// Hips, and legs with knees that stand on the ground.
Armature two_legs() {
  Armature armature;
  armature.names = {"hips", "thigh.L", "shin.L", "foot.L", "thigh.R", "shin.R", "foot.R"};
  armature.parents = {-1, 0, 1, 2, 0, 4, 5};
  const Quaternion up(Eigen::AngleAxisd(kPi / 2, Vector3::UnitX()));  // y along the bone
  append(compose({0, 0, 1}, up), armature.rest);
  for (const double x : {0.1, -0.1}) {
    for (const double z : {0.9, 0.5, 0.1}) append(compose({x, 0, z}, up), armature.rest);
  }
  armature.lengths.assign(7, 0.1);
  armature.inherit_rotation.assign(7, true);
  armature.local_location.assign(7, true);
  append(compose({1, 2, 0}, Quaternion(Eigen::AngleAxisd(1, Vector3::UnitZ())), 2), armature.world);
  return armature;
}

// Knees bent, of each thigh the one in front, and moved along the world's z so far.
Channels bent_legs(double moved, int frames, int front = 1) {
  Channels channels{frames, std::vector<double>(21 * frames, 0.0), {}};
  for (int f = 0; f < frames; ++f) {
    for (int b = 0; b < 7; ++b) {
      const bool thigh = b == 1 || b == 4, shin = b == 2 || b == 5;
      const double angle = front * ((thigh ? -0.6 : shin ? 0.9 : 0) + 0.1 * f);
      const Quaternion turn(Eigen::AngleAxisd(angle, Vector3::UnitX()));
      const double wxyz[] = {turn.w(), turn.x(), turn.y(), turn.z()};
      channels.rotations.insert(channels.rotations.end(), wxyz, wxyz + 4);
      if (thigh) channels.locations[3 * (7 * f + b) + 1] = moved;
    }
  }
  return channels;
}

std::vector<Matrix4> shown(const Armature& armature, const Channels& channels, int frame) {
  std::vector<Matrix4> pose = blender_pose(armature, &channels.locations[21 * frame], &channels.rotations[28 * frame]);
  for (Matrix4& bone : pose) bone = matrix_at(armature.world, 0) * bone;
  return pose;
}

// As where cartoons' legs come out of the hips.
TEST(RigClip, BringsFeetToWhereLegsAreShownThatMoveAway) {
  const Armature armature = two_legs();
  const Rig rig(armature);
  std::vector<Vector3> heads(7);
  std::vector<Quaternion> turns(7);
  for (const double moved : {0.06, -0.06}) {
    const Channels channels = bent_legs(moved, 3);
    std::vector<double> matrices;
    for (int f = 0; f < 3; ++f) {
      for (const Matrix4& bone : blender_pose(armature, &channels.locations[21 * f], &channels.rotations[28 * f]))
        append(bone, matrices);
    }
    for (const Clip& clip : {clip_of(rig, channels), rig.clip_from_matrices("walk", 30, 3, matrices.data())}) {
      for (int f = 0; f < 3; ++f) {
        const std::vector<Matrix4> pose = shown(armature, channels, f);
        world(Kinematics(rig.skeleton()), clip, f, heads.data(), turns.data());
        EXPECT_LT((heads[0] - pose[0].topRightCorner<3, 1>()).norm(), 1e-12);
        for (const int foot : {3, 6}) {
          EXPECT_LT((heads[foot] - pose[foot].topRightCorner<3, 1>()).norm(), 1e-9) << moved;
          EXPECT_LT(turns[foot].angularDistance(rotation_of(pose[foot])), 1e-9);
        }
      }
    }
  }
}

// As an animal's, which may be bent to the back.
TEST(RigClip, BendsKneesToWhereTheyAreShownToBend) {
  const Armature armature = two_legs();
  const Rig rig(armature);
  std::vector<Vector3> heads(7);
  std::vector<Quaternion> turns(7);
  for (const int front : {1, -1}) {
    const Channels channels = bent_legs(0.02, 3, front);
    const Clip clip = clip_of(rig, channels);
    for (int f = 0; f < 3; ++f) {
      world(Kinematics(rig.skeleton()), clip, f, heads.data(), turns.data());
      const std::vector<Matrix4> pose = shown(armature, channels, f);
      for (const int knee : {2, 5}) EXPECT_LT((heads[knee] - pose[knee].topRightCorner<3, 1>()).norm(), 0.1) << front;
    }
  }
}

TEST(RigClip, StretchesLegsTowardsFeetThatTheyDoNotReach) {
  const Armature armature = two_legs();
  const Rig rig(armature);
  const Channels channels = bent_legs(-0.5, 2);
  const Clip clip = clip_of(rig, channels);
  std::vector<Vector3> heads(7);
  std::vector<Quaternion> turns(7);
  world(Kinematics(rig.skeleton()), clip, 0, heads.data(), turns.data());
  const Vector3 leg = heads[3] - heads[1], asked = shown(armature, channels, 0)[3].topRightCorner<3, 1>() - heads[1];
  EXPECT_NEAR(leg.norm(), 1.6, 1e-9) << "twice as large as the armature";
  EXPECT_GT(leg.normalized().dot(asked.normalized()), 1 - 1e-9);
}

TEST(RigClip, LeavesLegsAsTheyAreTurnedWhereNothingMovesAway) {
  const Rig rig(two_legs());
  const Channels channels = bent_legs(0, 3);
  const Clip clip = clip_of(rig, channels);
  for (int f = 0; f < 3; ++f) {
    for (int b = 1; b < 7; ++b) {
      const std::size_t at = 4 * (7 * static_cast<std::size_t>(f) + b);
      EXPECT_LT(load_quaternion(&clip.rotations[at]).angularDistance(load_quaternion(&channels.rotations[at])), 1e-12);
    }
  }
}

}  // namespace
}  // namespace fragmotion
