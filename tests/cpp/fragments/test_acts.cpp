// SPDX-License-Identifier: MIT
// What a game's character does on the spot is no stand, where an Idle is.
#include <gtest/gtest.h>

#include "fragments/acts.hpp"
#include "fragments/standing.hpp"
#include "measured_clips.hpp"

namespace fragmotion {
namespace {

const ControlSpace kUsualSpace(1.2, 3.3, ControlSpace().turn_rate(), 1);

Clip clip_of(const std::string& name, double speed, double turn = 0, double jump = 0) {
  Gait gait;
  gait.y = speed;
  gait.turn = turn;
  gait.jump = jump;
  return gait_clip(gait, name);
}

std::vector<int> left_of(std::vector<Clip> clips) {
  FragmentPool pool = gait_pool(clips);
  drop_acts(pool, kUsualSpace);
  return fragments_by_clip(pool);
}

TEST(Acts, AreLeftOutWhereAnIdleStands) {
  const std::vector<Clip> clips = {clip_of("Hero|Idle", 0),     clip_of("Hero|Wave", 0),    clip_of("Walk", 1.2),
                                   clip_of("TurnLeft", 0, 1.2), clip_of("Jump", 0, 0, 0.3), clip_of("Death", 0)};
  std::vector<int> left = fragments_by_clip(gait_pool(clips));
  for (const int act : {1, 5}) {
    ASSERT_GT(left[act], 0);
    left[act] = 0;
  }
  EXPECT_EQ(left_of(clips), left);
}

TEST(Acts, AreHowABodyStandsThatHasNoIdle) {
  for (const double speed : {1.2, 3.0}) {  // what goes is no stand, whatever its name
    const std::vector<Clip> clips = {clip_of("Wave", 0), clip_of("Idle", speed), clip_of("Walk", 1.2)};
    EXPECT_EQ(left_of(clips), fragments_by_clip(gait_pool(clips)));
  }
}

TEST(Acts, NoPlainIdleIsOne) {
  const std::vector<Clip> clips = {clip_of("Idle", 0), clip_of("Sit_Idle", 0), clip_of("Idle_2", 0),
                                   clip_of("Walk", 1.2)};
  std::vector<int> left = fragments_by_clip(gait_pool(clips));
  left[1] = 0;
  EXPECT_EQ(left_of(clips), left);
  const std::vector<Clip> armed = {clip_of("Sword_Idle", 0), clip_of("IdleGun", 0), clip_of("Walk", 1.2)};
  EXPECT_EQ(left_of(armed), fragments_by_clip(gait_pool(armed)));
}

// A walk that rests for so long, s, and takes on the spot, one of which moves slowly.
FragmentPool resting_pool(double seconds) {
  Gait walk;
  walk.seconds = 12;
  FragmentPool pool = gait_pool({gait_clip(walk, "Walk"), clip_of("Wave", 0), clip_of("Turn", 0, 1.2),
                                 clip_of("Jump", 0, 0, 0.3), clip_of("Box", 0)});
  double rests = 0;
  int boxed = 0;
  for (Fragment& f : pool.fragments) {
    if (f.clip == 0 && rests + pool.seconds(f) < seconds) rests += pool.seconds(f), f.evident = {};
    if (f.clip == 4) f.evident = ++boxed % 3 == 0 ? Control{0, 1.2, 0, 0} : Control{0, 0.5, 0, 0};
  }
  EXPECT_GE(rests, seconds - 0.5);
  return pool;
}

TEST(Acts, AreWhatRestsMoreThanItMovesWhereWhatMovesRestsForLong) {
  for (const double seconds : {0.5, 4.0}) {
    FragmentPool pool = resting_pool(seconds);
    std::vector<int> left = fragments_by_clip(pool);
    if (seconds > kStandsLong) left[1] = 0, left[4] /= 3;
    drop_acts(pool, kUsualSpace);
    EXPECT_EQ(fragments_by_clip(pool), left) << seconds;
    for (const Fragment& f : pool.fragments) EXPECT_TRUE(seconds < kStandsLong || f.clip != 4 || f.evident.y == 1.2);
  }
}

// As all clips of a file may end in the armature's name; an image's name ends in another word.
TEST(Acts, AreToldByMirrorImagesAmongThese) {
  const std::vector<Clip> clips = {clip_of("Idle_Rig", 0), clip_of("Wave_Rig", 0), clip_of("Idle_Rig mirrored", 0),
                                   clip_of("Wave_Rig mirrored", 0), clip_of("Walk_Rig", 1.2)};
  FragmentPool pool = gait_pool(clips);
  for (Fragment& f : pool.fragments) f.origin = f.clip == 2 || f.clip == 3 ? Origin::mirrored : Origin::captured;
  std::vector<int> left = fragments_by_clip(pool);
  left[1] = left[3] = 0;
  drop_acts(pool, kUsualSpace);
  EXPECT_EQ(fragments_by_clip(pool), left);
}

TEST(Acts, ANameSaysIdleByAWordOfItsOwn) {
  for (const char* name :
       {"Idle", "idle", "IDLE", "Hero|Idle", "Armature|Idle|BaseLayer", "Idle_9", "idle1", "rig:idle-2"})
    EXPECT_EQ(words_beside_idle(name), 0) << name;
  for (const char* name : {"SwordIdle", "IdleBreathing", "stand idle", "Idle mirrored", "Idle_Armature"})
    EXPECT_EQ(words_beside_idle(name), 1) << name;
  for (const char* name : {"", "|", ":", "Walk", "Bridle", "idler", "sidle_left", "Armature|mixamo.com|Layer0"})
    EXPECT_EQ(words_beside_idle(name), -1) << name;
}

}  // namespace
}  // namespace fragmotion
