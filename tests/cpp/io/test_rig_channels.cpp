// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "random_armature.hpp"

namespace fragmotion {
namespace {

Armature held_armature(std::uint64_t seed, bool special) {
  Armature armature = random_armature(seed, special);
  for (const char* bone : {"root", "prop", "body", "spine", "lamp"}) {
    const Channels channels = random_channels(1, 1, ++seed);
    const Quaternion turn = load_quaternion(channels.rotations.data()).normalized();
    std::array<double, 7>& place = armature.held[bone];
    store_vector(load_vector(channels.locations.data()), place.data());
    store_quaternion(turn, place.data() + 3);
  }
  return armature;
}

/// The root, the hips and a foot are as large as they do not rest.
Armature sized_armature(std::uint64_t seed, bool special) {
  Armature armature = held_armature(seed, special);
  armature.sizes = {{"root", 7.26}, {"hips", 0.5}, {"foot.L", 3}};
  return armature;
}

class RigChannels : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(InheritAndLocal, RigChannels, testing::Bool());

TEST_P(RigChannels, RoundTripThroughChannels) {
  for (int seed = 20; seed < 30; ++seed) {
    const Rig rig(random_armature(seed, GetParam()));
    const Clip clip = make_clip(rig.skeleton(), random_clip(rig.skeleton(), 5, seed));
    const Channels channels = rig.channels(clip.frames, clip.root_positions.data(), clip.rotations.data());
    expect_same_motion(clip_of(rig, channels), clip, 1e-9);
  }
}

void expect_posed_as_kinematics_does(const Armature& armature) {
  const Rig rig(armature);
  const Kinematics kinematics(rig.skeleton());
  const Clip clip = make_clip(rig.skeleton(), random_clip(rig.skeleton(), 5, 32));
  const Channels channels = rig.channels(clip.frames, clip.root_positions.data(), clip.rotations.data());
  std::vector<Vector3> heads(10);
  std::vector<Quaternion> rotations(10);
  for (int f = 0; f < clip.frames; ++f) {
    kinematics.world(load_vector(&clip.root_positions[3 * f]), &clip.rotations[40 * f], heads.data(), rotations.data());
    const std::vector<Matrix4> pose = blender_pose(armature, &channels.locations[36 * f], &channels.rotations[48 * f]);
    for (int b = 0; b < 10; ++b) {
      const Matrix4 bone = matrix_at(armature.world, 0) * pose[rig.skeleton_bones()[b]];
      EXPECT_LT((heads[b] - bone.topRightCorner<3, 1>()).norm(), 1e-11) << rig.skeleton().names[b];
      EXPECT_LT(rotations[b].angularDistance(rotation_of(bone)), 1e-11) << rig.skeleton().names[b];
    }
  }
}

TEST_P(RigChannels, PoseAsKinematicsDoes) { expect_posed_as_kinematics_does(random_armature(31, GetParam())); }

TEST_P(RigChannels, PoseAsKinematicsDoesWhereBonesAreHeld) {
  expect_posed_as_kinematics_does(held_armature(31, GetParam()));
}

TEST_P(RigChannels, PoseAsKinematicsDoesWhereBonesAreLargerThanAtRest) {
  expect_posed_as_kinematics_does(sized_armature(31, GetParam()));
}

TEST_P(RigChannels, AreLearnedAsBlenderShowsThemWhereBonesAreLargerThanAtRest) {
  const Armature armature = sized_armature(41, GetParam());
  const Rig rig(armature);
  const Channels channels = random_channels(12, 3, 42);
  std::vector<double> matrices;
  for (int f = 0; f < 3; ++f) {
    const auto pose = blender_pose(armature, &channels.locations[36 * f], &channels.rotations[48 * f]);
    for (const Matrix4& bone : pose) append(bone, matrices);
  }
  expect_same_motion(clip_of(rig, channels), rig.clip_from_matrices("walk", 30, 3, matrices.data()), 1e-7);
}

TEST(RigSizes, MakeTheWholeSoManyTimesAsLarge) {
  Armature armature = random_armature(43);
  const Skeleton small = Rig(armature).skeleton();
  armature.sizes = {{"root", 100}};
  const Skeleton large = Rig(armature).skeleton();
  for (int b = 1; b < small.size(); ++b) {
    EXPECT_LT((large.offsets[b] - 100 * small.offsets[b]).norm(), 1e-9) << small.names[b];
    EXPECT_LT((large.tips[b] - 100 * small.tips[b]).norm(), 1e-9 * large.tips[b].norm() + 1e-9) << small.names[b];
  }
}

TEST(RigHeld, BonesKeepTheirPlacesAndWhatIsNotBelowTheHipsItsTurn) {
  const Armature armature = held_armature(37, false);
  const Rig rig(armature);
  const Clip clip = make_clip(rig.skeleton(), random_clip(rig.skeleton(), 5, 38));
  const Channels channels = rig.channels(clip.frames, clip.root_positions.data(), clip.rotations.data());
  for (int f = 0; f < clip.frames; ++f) {
    for (const int b : {0, 2, 4, 10}) {  // lamp, prop, body and spine; the root carries all
      const std::array<double, 7>& place = armature.held.at(armature.names[b]);
      const std::size_t at = 12 * static_cast<std::size_t>(f) + b;
      EXPECT_LT((load_vector(&channels.locations[3 * at]) - load_vector(place.data())).norm(), 1e-9) << b;
      const Quaternion turn = load_quaternion(&channels.rotations[4 * at]);
      EXPECT_EQ(turn.angularDistance(load_quaternion(&place[3])) < 1e-9, b != 10) << armature.names[b];
    }
  }
}

TEST(RigHeld, CarriesTheHipsToWhereTheSkeletonRests) {
  const Armature armature = sized_armature(39, true);
  const Rig rig(armature);
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(rig.skeleton(), heads, rotations);
  const std::array<double, 16> carried = rig.carried();
  const Matrix4 hips =
      matrix_at(armature.world, 0) * matrix_at({carried.begin(), carried.end()}, 0) * matrix_at(armature.rest, 5);
  EXPECT_LT((heads[3] - hips.topRightCorner<3, 1>()).norm(), 1e-9);
  EXPECT_LT(rotations[3].angularDistance(rotation_of(hips)), 1e-9);
  EXPECT_NEAR(std::cbrt(matrix_at({carried.begin(), carried.end()}, 0).topLeftCorner<3, 3>().determinant()), 3.63,
              1e-9);
}

TEST_P(RigChannels, MoveOnlyTheHipsAndTheFirstBone) {
  const Rig rig(random_armature(33, GetParam()));
  const Clip clip = make_clip(rig.skeleton(), random_clip(rig.skeleton(), 5, 34));
  const Channels channels = rig.channels(clip.frames, clip.root_positions.data(), clip.rotations.data());
  for (int f = 0; f < clip.frames; ++f) {
    for (const int b : {0, 2, 3, 4, 6, 7, 8, 9, 10, 11})
      EXPECT_EQ(load_vector(&channels.locations[3 * (12 * f + b)]), Vector3(0, 0, 0)) << b;
    for (const int b : {0, 3}) EXPECT_EQ(channels.rotations[4 * (12 * f + b)], 1);
  }
}

TEST_P(RigChannels, KeepSuccessiveQuaternionsOnTheSameSide) {
  const Rig rig(random_armature(35, GetParam()));
  const Clip clip = make_clip(rig.skeleton(), random_clip(rig.skeleton(), 30, 36));
  const Channels channels = rig.channels(clip.frames, clip.root_positions.data(), clip.rotations.data());
  for (std::size_t i = 4 * 12; i < channels.rotations.size(); i += 4) {
    EXPECT_GE(load_quaternion(&channels.rotations[i]).dot(load_quaternion(&channels.rotations[i - 48])), 0);
    EXPECT_NEAR(load_quaternion(&channels.rotations[i]).norm(), 1, 1e-12);
  }
}

TEST(RigChannelsErrors, NameThePoseAndBone) {
  const Rig rig(random_armature(37));
  const Clip good = make_clip(rig.skeleton(), random_clip(rig.skeleton(), 3, 38));
  const auto error = [&](const Clip& clip) {
    return error_of([&] { rig.channels(clip.frames, clip.root_positions.data(), clip.rotations.data()); });
  };
  Clip clip = good;
  clip.root_positions[4] = kNan;
  expect_parts(error(clip), {"pose 1", "root position"});
  for (const double value : {kNan, 3.0}) {
    clip = good;
    clip.rotations[4 * (20 + 8)] = value;
    expect_parts(error(clip), {"pose 2", "'spine'", "unit quaternion"});
  }
}

/// An armature of a take's bones: heads at rest in the world, random rolls, with one bone more than the take.
Armature armature_of(const Skeleton& skeleton, std::uint64_t seed, bool special) {
  Random random(seed);
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  Armature armature = random_armature(seed, special);
  const Matrix4 to_armature = matrix_at(armature.world, 0).inverse();
  const double scale = to_armature.topLeftCorner<3, 1>().norm();
  armature.names = skeleton.names;
  armature.parents = skeleton.parents;
  armature.names.push_back("hat");
  armature.parents.push_back(7);
  heads.push_back(random_vector(random));
  armature.rest.clear();
  for (const Vector3& head : heads)
    append(to_armature * compose(head, random_rotation(random)) *
               Eigen::Vector4d(1 / scale, 1 / scale, 1 / scale, 1).asDiagonal(),
           armature.rest);
  armature.lengths.assign(9, 1);
  armature.inherit_rotation.resize(9);
  armature.local_location.resize(9);
  return armature;
}

void expect_take_on_armature(const Take& take, const Armature& armature) {
  const Channels channels = Rig(armature).take_channels(take);
  const Matrix4 world = matrix_at(armature.world, 0);
  std::vector<Vector3> rest_heads;
  std::vector<Quaternion> take_rest;
  rest_pose(take.skeleton, rest_heads, take_rest);
  std::vector<double> positions, rotations;
  world_transforms(take, positions, rotations);
  for (int f = 0; f < take.frames; ++f) {
    const std::vector<Matrix4> pose = blender_pose(armature, &channels.locations[27 * f], &channels.rotations[36 * f]);
    for (int b = 0; b < 8; ++b) {
      const Matrix4 now = world * pose[b], rest = world * matrix_at(armature.rest, b);
      const Quaternion away = rotation_of(now) * rotation_of(rest).conjugate();
      const Quaternion expected = load_quaternion(&rotations[4 * (8 * f + b)]) * take_rest[b].conjugate();
      EXPECT_LT((load_vector(&positions[3 * (8 * f + b)]) - now.topRightCorner<3, 1>()).norm(), 1e-12);
      EXPECT_LT(away.angularDistance(expected), 1e-12);
    }
    EXPECT_EQ(load_vector(&channels.locations[3 * (9 * f + 8)]), Vector3(0, 0, 0));
    EXPECT_EQ(load_quaternion(&channels.rotations[4 * (9 * f + 8)]).coeffs(), Quaternion::Identity().coeffs());
  }
}

TEST(TakeChannels, PutEveryBoneWhereTheTakeDoes) {
  Skeleton skeleton = small_skeleton();
  for (const bool special : {false, true})
    expect_take_on_armature(random_take(skeleton, 5, 40), armature_of(skeleton, 41, special));
  Random random(46);
  for (Quaternion& rotation : skeleton.rest_rotations) rotation = random_rotation(random);
  expect_take_on_armature(random_take(skeleton, 5, 47), armature_of(skeleton, 48, true));
}

TEST(TakeChannels, GiveTheClipOfTheTake) {
  const Skeleton skeleton = small_skeleton();
  const Take take = random_take(skeleton, 5, 42);
  const Rig rig(armature_of(skeleton, 43, false));
  const Clip through_rig = clip_of(rig, rig.take_channels(take));
  const Clip direct = clip_from_take(skeleton, take);
  for (std::size_t i = 0; i < direct.root_positions.size(); ++i)
    EXPECT_NEAR(through_rig.root_positions[i], direct.root_positions[i], 1e-12);
}

TEST(TakeChannels, GiveTheClipOfATakeOfItsOwnWhereBonesAreHeld) {
  Armature armature = random_armature(49);
  armature.held["root"] = {1, 2, 3, 0.6, 0, 0.8, 0};
  armature.held["spine"] = {0, 0.5, 0, 0, 1, 0, 0};
  const Rig rig(armature);
  const Take take = random_take(rig.skeleton(), 5, 50);
  expect_same_motion(clip_of(rig, rig.take_channels(take)), clip_from_take(rig.skeleton(), take), 1e-7);
}

TEST(TakeChannels, NameTheBonesThatTheRigLacks) {
  Skeleton skeleton = small_skeleton();
  const Rig rig(armature_of(skeleton, 44, false));
  skeleton.names[1] = "sword";
  skeleton.names[7] = "torso";
  expect_parts(error_of([&] { rig.take_channels(random_take(skeleton, 2, 45)); }), {"'take'", "'sword', 'torso'"});
}

}  // namespace
}  // namespace fragmotion
