// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "dog.hpp"
#include "motion/one_floor.hpp"
#include "walker.hpp"

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
