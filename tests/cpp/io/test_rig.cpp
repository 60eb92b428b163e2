// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "io/rig.hpp"
#include "small_skeleton.hpp"

namespace fragmotion {
namespace {

using Matrix4 = Eigen::Matrix4d;
using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Matrix4 compose(const Vector3& head, const Quaternion& rotation, double scale = 1) {
  Matrix4 matrix = Matrix4::Identity();
  matrix.topLeftCorner<3, 3>() = scale * rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = head;
  return matrix;
}

void append(const Matrix4& matrix, std::vector<double>& values) {
  const RowMajor4 rows = matrix;
  values.insert(values.end(), rows.data(), rows.data() + 16);
}

Matrix4 matrix_at(const std::vector<double>& values, std::size_t index) {
  return Eigen::Map<const RowMajor4>(&values[16 * index]);
}

Quaternion rotation_of(const Matrix4& matrix) {
  return Quaternion{Eigen::Matrix3d(matrix.topLeftCorner<3, 3>().colwise().normalized())};
}

/// Two trees: lamp > shade (no character), and root > {prop, body > hips > ...}, in mixed order and random rest poses.
Armature random_armature(std::uint64_t seed, bool special = false) {
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
std::vector<Matrix4> blender_pose(const Armature& armature, const double* locations, const double* rotations) {
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
    pose[b] = compose(moved.topRightCorner<3, 1>() + shift,
                      rotation_of(base) * load_quaternion(rotations + 4 * b).normalized());
  }
  return pose;
}

Channels random_channels(int bones, int frames, std::uint64_t seed) {
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

Clip clip_of(const Rig& rig, const Channels& channels, const double* worlds = nullptr) {
  return rig.clip("walk", 30, channels.frames, channels.locations.data(), channels.rotations.data(), worlds);
}

void expect_same_motion(const Clip& a, const Clip& b, double tolerance) {
  ASSERT_EQ(a.root_positions.size(), b.root_positions.size());
  ASSERT_EQ(a.rotations.size(), b.rotations.size());
  for (std::size_t i = 0; i < a.root_positions.size(); ++i)
    EXPECT_NEAR(a.root_positions[i], b.root_positions[i], tolerance);
  for (std::size_t i = 0; i < a.rotations.size(); i += 4) {
    const Quaternion p = load_quaternion(&a.rotations[i]), q = load_quaternion(&b.rotations[i]);
    EXPECT_LT(p.angularDistance(q), tolerance) << "rotation " << i / 4;
  }
}

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

void expect_parts(const std::string& error, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(error.find(part), std::string::npos) << part << " in: " << error;
}

TEST(Rig, MakesTheSkeletonOfTheTreeWithTheHips) {
  const Rig rig(random_armature(1));
  EXPECT_EQ(rig.bones(), 12);
  EXPECT_EQ(rig.skeleton().names, (std::vector<std::string>{"root", "prop", "body", "hips", "thigh.L", "thigh.R",
                                                            "foot.L", "foot.R", "spine", "head"}));
  EXPECT_EQ(rig.skeleton().parents, (std::vector<int>{-1, 0, 0, 2, 3, 3, 4, 5, 3, 8}));
  EXPECT_EQ(rig.skeleton_bones(), (std::vector<int>{1, 2, 4, 5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(rig.skeleton().roles.hips, 3);
  EXPECT_EQ(rig.skeleton().roles.left_foot, 6);
}

TEST(Rig, RestsWhereTheArmatureDoesInMetres) {
  const Armature armature = random_armature(2);
  const Rig rig(armature);
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(rig.skeleton(), heads, rotations);
  for (int b = 0; b < rig.skeleton().size(); ++b) {
    const int bone = rig.skeleton_bones()[b];
    const Matrix4 world = matrix_at(armature.world, 0) * matrix_at(armature.rest, bone);
    EXPECT_LT((heads[b] - world.topRightCorner<3, 1>()).norm(), 1e-12);
    EXPECT_LT(rotations[b].angularDistance(rotation_of(world)), 1e-12);
    const Eigen::Vector4d tail = world * Eigen::Vector4d(0, armature.lengths[bone], 0, 1);
    EXPECT_LT((heads[b] + rotations[b] * rig.skeleton().tips[b] - tail.head<3>()).norm(), 1e-12);
  }
}

TEST(Rig, ShortensBonesThatAnImporterMadeFarTooLong) {
  Armature armature = random_armature(2);
  const Rig rig(armature);
  for (double& length : armature.lengths) length *= 1000;
  const Rig overlong(armature);
  for (int b = 0; b < rig.skeleton().size(); ++b) {
    EXPECT_LT(overlong.skeleton().tips[b].norm(), 30 * rig.skeleton().tips[b].norm());
    EXPECT_EQ(overlong.skeleton().offsets[b], rig.skeleton().offsets[b]);
  }
}

// Importers of glTF have them point anywhere, as long as another bone.
TEST(Rig, LegsOfASingleBoneReachTheGround) {
  Armature armature;
  armature.names = {"root", "leg-left", "leg-right", "torso", "head"};
  armature.parents = {-1, 0, 0, 0, 3};
  const Quaternion up(Eigen::AngleAxisd(kPi / 2, Vector3::UnitX()));  // y along the bone
  for (const Vector3& head :
       {Vector3{0, 0, 0.1}, Vector3{0.1, 0, 0.3}, Vector3{-0.1, 0, 0.3}, Vector3{0, 0, 0.3}, Vector3{0, 0, 0.6}})
    append(compose(head, up), armature.rest);
  armature.lengths.assign(5, 0.2);
  append(compose({1, 2, 5}, Quaternion(Eigen::AngleAxisd(1, Vector3::UnitZ())), 2), armature.world);
  const Skeleton skeleton = Rig(armature).skeleton();
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  for (const int foot : {skeleton.roles.left_foot, skeleton.roles.right_foot}) {
    const Vector3 tip = heads[foot] + rotations[foot] * skeleton.tips[foot];
    EXPECT_LT((tip - Vector3(heads[foot].x(), heads[foot].y(), 5)).norm(), 1e-9);
  }
  EXPECT_EQ(skeleton.tips[4], Vector3(0, 0.4, 0)) << "the head is no leg";
}

TEST(Rig, TakesGivenRolesBeforeNames) {
  Armature armature = random_armature(3);
  armature.roles = {{"hips", "body"}, {"head", "spine"}};
  const Rig rig(armature);
  EXPECT_EQ(rig.skeleton().names[rig.skeleton().roles.hips], "body");
  EXPECT_EQ(rig.skeleton().names[rig.skeleton().roles.head], "spine");
  EXPECT_EQ(rig.skeleton().names[rig.skeleton().roles.left_foot], "foot.L");
  armature.roles = {{"hips", "shade"}};
  EXPECT_EQ(Rig(armature).skeleton().names, (std::vector<std::string>{"lamp", "shade"}));
}

TEST(Rig, RefusesBadArmaturesNamingTheCause) {
  const struct {
    const char* label;
    std::function<void(Armature&)> spoil;
    std::vector<std::string> named;
  } cases[] = {
      {"no bones", [](Armature& a) { a = {}; }, {"no bones"}},
      {"too few parents", [](Armature& a) { a.parents.pop_back(); }, {"11 parents", "expected 12"}},
      {"too few rest values", [](Armature& a) { a.rest.pop_back(); }, {"191 values in rest matrices"}},
      {"too few lengths", [](Armature& a) { a.lengths.pop_back(); }, {"11 lengths"}},
      {"no world", [](Armature& a) { a.world.clear(); }, {"0 values in the world matrix"}},
      {"flags", [](Armature& a) { a.inherit_rotation.pop_back(); }, {"11 inherit_rotation"}},
      {"flags", [](Armature& a) { a.local_location.pop_back(); }, {"11 local_location"}},
      {"child first", [](Armature& a) { a.parents[2] = 4; }, {"'prop'", "parents must come before"}},
      {"parent below -1", [](Armature& a) { a.parents[2] = -2; }, {"'prop'", "-2"}},
      {"name twice", [](Armature& a) { a.names[0] = "head"; }, {"'head'", "twice"}},
      {"length", [](Armature& a) { a.lengths[0] = kNan; }, {"'lamp'", "length"}},
      {"rest not finite", [](Armature& a) { a.rest[16] = kNan; }, {"'root'", "finite"}},
      {"rest scales",
       [](Armature& a) {
         for (int i = 0; i < 11; ++i) a.rest[16 + i] *= 2;
       },
       {"'root'", "(2, 2, 2)"}},
      {"rest mirrors",
       [](Armature& a) {
         for (int i = 0; i < 3; ++i) a.rest[16 + 4 * i] *= -1;
       },
       {"'root'", "mirrored"}},
      {"unknown role",
       [](Armature& a) {
         a.roles = {{"tail", "spine"}};
       },
       {"'tail'", "hips, head"}},
      {"unknown bone",
       [](Armature& a) {
         a.roles = {{"head", "Skull"}};
       },
       {"'head'", "'Skull'"}},
      {"two trees",
       [](Armature& a) {
         a.roles = {{"head", "lamp"}, {"hips", "hips"}, {"left_foot", "foot.L"}};
       },
       {"'head'", "'lamp'", "'root'"}},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.label);
    Armature armature = random_armature(4);
    c.spoil(armature);
    expect_parts(error_of([&] { Rig rig(armature); }), c.named);
  }
}

TEST(Rig, RefusesObjectsItCannotScaleUniformly) {
  const struct {
    const char* label;
    std::vector<double> world;
    std::vector<std::string> named;
  } cases[] = {
      {"non-uniform", {1, 0, 0, 5, 0, 2, 0, 5, 0, 0, 1, 5, 0, 0, 0, 1}, {"(1, 2, 1): apply the scale (Ctrl+A)"}},
      {"negative", {-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1}, {"(-1, -1, -1): apply the scale"}},
      {"mirrored", {-3, 0, 0, 0, 0, 3, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1}, {"(-3, -3, -3): apply the scale"}},
      {"sheared", {1, 0.6, 0, 0, 0, 0.8, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {"sheared", "(1, 1, 1)"}},
      {"nothing", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, {"(0, 0, 0): apply the scale"}},
      {"flat", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, {"(1, 1, 0): apply the scale"}},
      {"not finite", {1, 0, 0, kNan, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {"world matrix is not finite"}},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.label);
    Armature armature = random_armature(5);
    armature.world = c.world;
    expect_parts(error_of([&] { Rig rig(armature); }), c.named);
  }
}

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

TEST_P(RigChannels, PoseAsKinematicsDoes) {
  const Armature armature = random_armature(31, GetParam());
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

TEST(TakeChannels, NameTheBonesThatTheRigLacks) {
  Skeleton skeleton = small_skeleton();
  const Rig rig(armature_of(skeleton, 44, false));
  skeleton.names[1] = "sword";
  skeleton.names[7] = "torso";
  expect_parts(error_of([&] { rig.take_channels(random_take(skeleton, 2, 45)); }), {"'take'", "'sword', 'torso'"});
}

}  // namespace
}  // namespace fragmotion
