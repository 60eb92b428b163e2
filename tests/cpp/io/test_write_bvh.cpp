// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "io/asf_amc.hpp"
#include "io/bvh.hpp"
#include "mocap_files.hpp"
#include "small_skeleton.hpp"

namespace fragmotion {
namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The take after it was written and read again.
Take read_back(const Take& take, double unit = 0.01) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / (take.name + ".bvh");
  write_bvh(take, path, unit);
  return read_bvh(path, unit);
}

/// How far a joint is at most from where it was, m.
double apart(const Take& take, const Take& other) {
  std::vector<double> before, after, rotations;
  world_transforms(take, before, rotations);
  world_transforms(other, after, rotations);
  double most = 0;
  for (int f = 0; f < take.frames; ++f) {
    for (int b = 0; b < take.skeleton.size(); ++b) {
      const int at = other.skeleton.find(take.skeleton.names[b]);
      const Vector3 from = load_vector(&before[3 * (std::size_t(f) * take.skeleton.size() + b)]);
      most = std::max(most, (from - load_vector(&after[3 * (std::size_t(f) * take.skeleton.size() + at)])).norm());
    }
  }
  return most;
}

/// Rest frames that are not the world's, as an armature's.
Skeleton turned_skeleton() {
  Skeleton skeleton = small_skeleton();
  Random random(5);
  for (Quaternion& rest : skeleton.rest_rotations) rest = random_rotation(random);
  return skeleton;
}

TEST(WriteBvh, IsReadBackJointForJoint) {
  for (const double unit : {0.01, 1.0, 0.0254}) {
    const Take take = random_take(small_skeleton(), 20, 3);
    const Take back = read_back(take, unit);
    EXPECT_LT(apart(take, back), 1e-5) << unit;
    EXPECT_EQ(back.rate, take.rate);
    EXPECT_EQ(back.frames, take.frames);
    EXPECT_EQ(back.name, take.name);
  }
}

TEST(WriteBvh, AnyRestFramesBecomeTheWorlds) {
  const Take take = random_take(turned_skeleton(), 20, 3);
  const Take back = read_back(take);
  EXPECT_LT(apart(take, back), 1e-5);
  std::vector<Vector3> heads, heads_back;
  std::vector<Quaternion> rests, ignored;
  rest_pose(take.skeleton, heads, rests);
  rest_pose(back.skeleton, heads_back, ignored);
  std::vector<double> places, before, after;
  world_transforms(take, places, before);
  world_transforms(back, places, after);
  for (int b = 0; b < take.skeleton.size(); ++b) {
    const std::size_t at = back.skeleton.find(take.skeleton.names[b]);
    EXPECT_LT((heads[b] - heads_back[at]).norm(), 1e-7);
    // Away from rest, in the world, bones turn alike.
    const Quaternion was = load_quaternion(&before[4 * std::size_t(b)]) * rests[b].conjugate();
    EXPECT_LT(was.angularDistance(load_quaternion(&after[4 * at])), 1e-6);
  }
}

TEST(WriteBvh, OnlyJointsThatLeaveTheirPlaceHavePositions) {
  const Take take = random_take(small_skeleton(), 4, 3, 0);
  const TemporaryFolder folder;
  write_bvh(take, folder.path() / "still.bvh");
  const std::string text = bytes_of(folder.path() / "still.bvh");
  const std::string positions = "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n";
  EXPECT_NE(text.find(positions), std::string::npos);
  EXPECT_EQ(text.find(positions, text.find(positions) + 1), std::string::npos);
  EXPECT_NE(text.find("CHANNELS 3 Zrotation Xrotation Yrotation\n"), std::string::npos);
}

TEST(WriteBvh, TheSameTakeIsTheSameBytesAndReplacesTheFile) {
  const Take take = random_take(small_skeleton(), 4, 3);
  const TemporaryFolder folder;
  for (const char* name : {"one.bvh", "two.bvh", "one.bvh"}) write_bvh(take, folder.path() / name);
  EXPECT_EQ(bytes_of(folder.path() / "one.bvh"), bytes_of(folder.path() / "two.bvh"));
  EXPECT_EQ(bytes_of(folder.path() / "one.bvh").find("-0.000000"), std::string::npos);
  const auto entries = std::filesystem::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 2) << "a temporary file is left";
}

TEST(WriteBvh, ReadAndWrittenAgainItIsTheSameFile) {
  const TemporaryFolder folder;
  write_bvh(random_take(small_skeleton(), 6, 9), folder.path() / "one.bvh");
  write_bvh(read_bvh(folder.path() / "one.bvh"), folder.path() / "two.bvh");
  EXPECT_LT(apart(read_bvh(folder.path() / "one.bvh"), read_bvh(folder.path() / "two.bvh")), 1e-7);
}

TEST(WriteBvh, KeepsTheRate) {
  for (const double rate : {0.1, 24.0, 30 / 1.001, 37.7, 120.0, 1000.0, 9999.0}) {
    Take take = random_take(small_skeleton(), 2, 3);
    take.rate = rate;
    EXPECT_NEAR(read_back(take).rate, rate, 1e-6 * rate);
  }
}

TEST(WriteBvh, KeepsNamesOfSeveralWords) {
  Take take = random_take(small_skeleton(), 2, 3);
  take.skeleton.names[4] = "Bip01 L Thigh";
  EXPECT_GE(read_back(take).skeleton.find("Bip01 L Thigh"), 0);
}

TEST(WriteBvh, RefusesNamesThatEndEarly) {
  for (const char* name : {"", " before", "after ", "two  blanks", "tab\there", "brace{", "brace}", "line\nend"}) {
    Take take = random_take(small_skeleton(), 2, 3);
    take.skeleton.names[4] = name;
    const TemporaryFolder folder;
    const std::string error = error_of([&] { write_bvh(take, folder.path() / "out.bvh"); });
    EXPECT_NE(error.find(*name ? std::string("bone '") + name + "'" : "has no name"), std::string::npos) << error;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.bvh"));
  }
}

TEST(WriteBvh, RefusesMissingNumbersByFrameAndBone) {
  for (const bool is_rotation : {false, true}) {
    Take take = random_take(small_skeleton(), 3, 3);
    const std::size_t at = 2 * 8 + 4;
    (is_rotation ? take.rotations[4 * at] : take.translations[3 * at]) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(error_of([&] { read_back(take); }),
              "take 'take', frame 2, bone 'foot.L': a number is missing: mend the take first");
  }
}

TEST(WriteBvh, RefusesUnitsThatAreNoLengthAndPlacesTooFar) {
  Take take = random_take(small_skeleton(), 2, 3);
  for (const double unit : {0.0, -1.0, 1e308, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_NE(error_of([&] { read_back(take, unit); }).find("unit"), std::string::npos) << unit;
  }
  take.translations[0] = 1e200;
  EXPECT_NE(error_of([&] { read_back(take); }).find("choose a larger unit"), std::string::npos);
}

TEST(WriteBvh, NamesThePathThatCannotBeWritten) {
  const Take take = random_take(small_skeleton(), 2, 3);
  EXPECT_NE(error_of([&] { write_bvh(take, "/nowhere/at/all.bvh"); }).find("/nowhere/at/all.bvh"), std::string::npos);
}

TEST(WriteBvh, RealTakesAreReadBackWithinATenthOfAMillimetre) {
  const std::filesystem::path cmu = shared_mocap() / "cmu";
  const auto files = files_in(shared_mocap() / "bandai-namco", ".bvh");
  if (files.empty()) GTEST_SKIP() << "no motion capture beside the project";
  const Take acclaim = read_asf_amc(cmu / "02.asf", cmu / "02_01.amc");
  EXPECT_LT(apart(acclaim, read_back(acclaim)), 1e-4);
  for (std::size_t i = 0; i < files.size(); i += 40) {
    const Take take = read_bvh(files[i]);
    EXPECT_LT(apart(take, read_back(take)), 1e-4) << files[i];
  }
}

TEST(TakeFromClip, IsTheInverseOfClipFromTake) {
  for (const Skeleton& skeleton : {small_skeleton(), turned_skeleton()}) {
    const Clip clip = make_clip(skeleton, random_clip(skeleton, 10, 4));
    const Clip back = clip_from_take(skeleton, take_from_clip(skeleton, clip));
    ASSERT_EQ(back.frames, clip.frames);
    for (std::size_t i = 0; i < clip.root_positions.size(); ++i)
      EXPECT_NEAR(back.root_positions[i], clip.root_positions[i], 1e-12);
    for (std::size_t i = 0; i < clip.rotations.size(); i += 4)
      EXPECT_LT(load_quaternion(&clip.rotations[i]).angularDistance(load_quaternion(&back.rotations[i])), 1e-7);
  }
}

}  // namespace
}  // namespace fragmotion
