// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "dog.hpp"
#include "motion/one_floor.hpp"
#include "on_slope.hpp"

namespace fragmotion {
namespace {

constexpr double kSame = 1e-9;  // m

std::vector<Contacts> contacts_of(const std::vector<Clip>& clips) {
  const Kinematics kinematics(humanoid());
  std::vector<Contacts> contacts;
  for (const Clip& clip : clips) contacts.push_back(find_contacts(kinematics, clip));
  return contacts;
}

void raise(double by, Clip& clip) {
  for (std::size_t z = 2; z < clip.root_positions.size(); z += 3) clip.root_positions[z] += by;
}

double lowest(const Floors& floors) {
  return std::min({floors[0].ball, floors[0].heel, floors[1].ball, floors[1].heel});
}

double farthest_apart(const Clip& a, const Clip& b) {
  double apart = 0;
  for (std::size_t i = 0; i < a.root_positions.size(); ++i)
    apart = std::max(apart, std::abs(a.root_positions[i] - b.root_positions[i]));
  return apart;
}

const Clip& take_named(const std::string& name) {
  static const std::vector<Clip> takes = gait_takes();
  return *std::find_if(takes.begin(), takes.end(), [&](const Clip& take) { return take.name == name; });
}

// Walks of CMU's subject 2 rise so.
TEST(OneFloor, PutsWalksLevelThatRise) {
  const Kinematics kinematics(humanoid());
  for (const double degrees : {0.5, 1.0, 2.5}) {
    const double slope = std::tan(degrees * kPi / 180);
    for (const Vector2& rises : {Vector2(0, slope), Vector2(0, -slope)}) {
      const Clip level = take_named("walk");
      Clip clip = on_slope(rises, level);
      const Contacts contacts = put_level(kinematics, clip);
      EXPECT_LT(farthest_apart(clip, level), 0.01) << degrees;
      EXPECT_EQ(contacts.feet, find_contacts(kinematics, level).feet) << degrees;
    }
  }
}

// A walk in a curve tells both slopes; one that is straight nothing of how the floor is aside of it.
TEST(OneFloor, TellsOnlySlopesAlongTheWay) {
  const Kinematics kinematics(humanoid());
  const Vector2 slope(0.02, 0.03);
  const auto told = [&](const Clip& level) {
    const Clip clip = on_slope(slope, level);
    return floor_slope(kinematics.skeleton(), foot_paths(kinematics, clip), hips_path(clip), clip.rate);
  };
  EXPECT_LT((told(take_named("curve")) - slope).norm(), 0.003);
  EXPECT_LT((told(take_named("walk")) - Vector2(0, slope.y())).norm(), 0.003);
}

TEST(OneFloor, TurnsNoTakeThatIsLevelOrClimbsOrStays) {
  const Kinematics kinematics(humanoid());
  std::vector<Clip> clips = gait_takes();
  clips.push_back(on_slope({0, 0.1}, take_named("walk")));
  clips.push_back(on_slope({0, 0.6}, take_named("walk")));
  for (const char* stays : {"stand", "turn"}) clips.push_back(on_slope({0, 0.02}, take_named(stays)));
  for (Clip& clip : clips) {
    const Clip before = clip;
    put_level(kinematics, clip);
    EXPECT_EQ(clip.root_positions, before.root_positions) << clip.name;
    EXPECT_EQ(clip.rotations, before.rotations) << clip.name;
  }
}

// A leg that is held up for a second is as still as one that stands.
TEST(OneFloor, IsToldByTheFootBelow) {
  const Kinematics kinematics(humanoid());
  Clip level = take_named("walk");
  const int bones = humanoid().size(), thigh = humanoid().find("thigh.L");
  const int from = level.frames - 30;
  for (int f = from; f < level.frames; ++f) {
    std::copy_n(&level.root_positions[std::size_t{3} * from], 3, &level.root_positions[std::size_t{3} * f]);
    double* pose = &level.rotations[std::size_t{4} * bones * f];
    std::copy_n(&level.rotations[std::size_t{4} * bones * from], 4 * bones, pose);
    store_quaternion(Quaternion(Eigen::AngleAxisd(-kPi / 2, Vector3::UnitX())), pose + std::size_t{4} * thigh);
  }
  Clip clip = on_slope({0, 0.02}, level);
  put_level(kinematics, clip);
  EXPECT_LT(farthest_apart(clip, level), 0.01);
}

TEST(OneFloor, BringsTakesToWhereMostStand) {
  const std::vector<Clip> level = {gait_takes()[0], gait_takes()[1], gait_takes()[2]};
  std::vector<Clip> clips = level;
  raise(0.03, clips[1]);
  std::vector<Contacts> contacts = contacts_of(clips), as_is = contacts_of(level);
  put_on_one_floor(clips, contacts);
  const Floors usual = usual_floors(as_is);
  for (std::size_t c = 0; c < clips.size(); ++c) {
    EXPECT_NEAR(clips[c].root_positions[2], level[c].root_positions[2], 0.005) << c;
    EXPECT_EQ(contacts[c].feet, as_is[c].feet) << c;
    const Contacts told = contacts_of({clips[c]})[0];
    for (int foot = 0; foot < 2; ++foot) {
      EXPECT_NEAR(contacts[c].floors[foot].ball, told.floors[foot].ball, kSame);
      EXPECT_NEAR(contacts[c].floors[foot].heel, told.floors[foot].heel, kSame);
    }
    EXPECT_NEAR(lowest(contacts[c].floors), lowest(usual), 0.005) << c;
  }
}

TEST(OneFloor, LeavesTakesThatShareItsFloor) {
  std::vector<Clip> clips(3, gait_takes()[0]);
  std::vector<Contacts> contacts = contacts_of(clips);
  put_on_one_floor(clips, contacts);
  for (const Clip& clip : clips) EXPECT_EQ(clip.root_positions, gait_takes()[0].root_positions);
}

// Where a dog sits its hocks are down.
TEST(OneFloor, LiftsNoAnimalByItsHeels) {
  const Clip walk = dog_clip({}, false, "walk");
  std::vector<Clip> clips(3, walk);
  std::vector<Contacts> contacts(3, find_contacts(Kinematics(dog()), walk));
  for (FootHeights& floor : contacts[2].floors) floor.heel -= 0.1;
  put_on_one_floor(clips, contacts);
  EXPECT_EQ(clips[2].root_positions, walk.root_positions);
  for (FootHeights& floor : contacts[2].floors) floor.ball -= 0.1;
  put_on_one_floor(clips, contacts);
  EXPECT_NEAR(clips[2].root_positions[2], walk.root_positions[2] + 0.1, kSame);
}

TEST(OneFloor, PushesNobodyDownWhoStandsOnTheBalls) {
  const Clip walk = gait_takes()[0];
  std::vector<Clip> clips(3, walk);
  std::vector<Contacts> contacts = contacts_of(clips);
  for (FootHeights& floor : contacts[2].floors) floor.heel += 0.08;
  put_on_one_floor(clips, contacts);
  EXPECT_EQ(clips[2].root_positions, walk.root_positions);
}

TEST(OneFloor, LeavesABodyWithoutFeet) {
  std::vector<Clip> clips = {gait_takes()[0]};
  std::vector<Contacts> contacts(1);
  put_on_one_floor(clips, contacts);
  EXPECT_EQ(clips[0].root_positions, gait_takes()[0].root_positions);
}

}  // namespace
}  // namespace fragmotion
