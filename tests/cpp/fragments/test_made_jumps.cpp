// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "build/build.hpp"
#include "fragments/gait_edit.hpp"
#include "motion/pose.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

// Feet that stand for six of ten frames each, in turn.
Contacts in_turn(int frames) {
  Contacts contacts;
  for (int f = 0; f <= frames; ++f) {
    contacts.feet[0].push_back(f % 10 < 6);
    contacts.feet[1].push_back((f + 5) % 10 < 6);
  }
  return contacts;
}

TEST(NextFootDown, IsTheLastTimeThatTheOneStandsAloneWhoseTurnItIs) {
  const Contacts contacts = in_turn(30);  // left strikes at 0, 10, 20, right at 5, 15, 25, and stands alone from 6 on
  EXPECT_EQ(next_foot_down(contacts, 0, 30, 2, 8), 6);
  EXPECT_EQ(next_foot_down(contacts, 0, 30, 2, 4), 6);
  EXPECT_EQ(next_foot_down(contacts, 0, 30, 2, 3), -1);
  EXPECT_EQ(next_foot_down(contacts, 0, 30, 2, 14), 16);
  EXPECT_EQ(next_foot_down(contacts, 0, 30, 7, 8), 11);
  EXPECT_EQ(next_foot_down(contacts, 0, 30, 28, 8), 31) << "round the cycle";
  EXPECT_EQ(next_foot_down(contacts, 30, 0, 2, 8), 6) << "backward, where feet strike that lift";
  EXPECT_EQ(next_foot_down({}, 0, 30, 2, 8), -1) << "without feet";
  const Contacts stands{{std::vector<bool>(31, true), std::vector<bool>(31, true)}, {}};
  EXPECT_EQ(next_foot_down(stands, 0, 30, 2, 8), -1) << "where none comes down";
}

TEST(GaitInFlight, GoesTheSameWayAndLandsInThePoseThatItIsTold) {
  const Skeleton skeleton = humanoid();
  const Kinematics kinematics(skeleton);
  const Clip clip = make_clip(skeleton, gait_clip({}));
  const double take_off = 6.5, landing = 20.25, down = 11;
  const Clip made = gait_in_flight(kinematics, clip, take_off, landing, down);
  ASSERT_GT(made.frames, 60);
  std::vector<double> one(std::size_t{4} * kinematics.bones()), other(one);
  const auto expect_pose = [&](double at, double of_clip) {
    sample_pose(made, at, one.data());
    sample_pose(clip, of_clip, other.data());
    for (std::size_t i = 4; i < one.size(); ++i) EXPECT_NEAR(one[i], other[i], 0.02) << at;
  };
  for (int f = 0; f < made.frames; ++f) {
    EXPECT_EQ(made.root_positions[3 * f], clip.root_positions[3 * f]) << f;
    EXPECT_EQ(made.root_positions[3 * f + 1], clip.root_positions[3 * f + 1]) << f;
    EXPECT_EQ(made.headings[f], clip.headings[f]) << f;
  }
  for (int f = 0; f < take_off; ++f) expect_pose(f, f);
  for (int f = 21; f < made.frames; ++f) expect_pose(f, f - landing + down);
  expect_pose((take_off + landing) / 2, (take_off + down) / 2);
}

// A frame in which one foot alone stands, from one on in a direction; -1 where there is none.
int one_stands(const Contacts& contacts, int from, int by) {
  const int frames = static_cast<int>(contacts.feet[0].size());
  for (int f = from; f >= 0 && f < frames; f += by) {
    if (contacts.feet[0][f] != contacts.feet[1][f]) return f;
  }
  return -1;
}

TEST(MadeJumps, OfARunLandOnTheOtherFoot) {
  const Character& c = *gait_character();
  int jumps = 0, hops = 0;
  for (const Fragment& f : c.pool.fragments) {
    const bool runs = f.evident.speed() > 0.75 * c.space.run();
    if (f.origin != Origin::transformed || !f.evident.jumps() || !runs) continue;
    const Contacts& contacts = c.contacts[f.clip];
    const int before = one_stands(contacts, f.begin, -1), after = one_stands(contacts, f.end, 1);
    if (before < 0 || after < 0) continue;
    ++jumps;
    hops += contacts.feet[0][before] == contacts.feet[0][after] ? 1 : 0;
  }
  EXPECT_GE(jumps, 3);
  EXPECT_EQ(hops, 0);
}

}  // namespace
}  // namespace fragmotion
