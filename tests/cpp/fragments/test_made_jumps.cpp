// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "build/build.hpp"
#include "fragments/coverage.hpp"
#include "fragments/leap.hpp"
#include "fragments/synthesis.hpp"
#include "motion/legs.hpp"
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

TEST(NextFootDown, IsOfTheFootThatOnlyTouchesTheGroundBefore) {
  const Contacts contacts = in_turn(30);
  EXPECT_EQ(next_foot_down(contacts, 0, 30, 5, 8), 11) << "the right one has come down";
  EXPECT_EQ(next_foot_down(contacts, 0, 30, 5, 8, 2), 6);
  EXPECT_EQ(next_foot_down(contacts, 0, 30, 6, 8, 2), 6) << "it stands alone already";
  EXPECT_EQ(next_foot_down(contacts, 0, 30, 7, 8, 2), 11) << "it has stood for long enough";
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

// A walk that goes by turns faster and slower than it says, as drawn ones do.
Clip surging_walk() {
  const Gait gait{0, 1.2, 0, 6};
  Clip clip = gait_clip(gait);
  for (int f = 0; f < clip.frames; ++f)
    clip.root_positions[std::size_t{3} * f + 1] += 0.04 * std::sin(4 * kPi * f / gait.rate / gait.cycle);
  return make_clip(humanoid(), std::move(clip));
}

TEST(Leap, FliesAsFastAsItIsAskedToWithItsFeetWhereTheyWereUntilItTakesOff) {
  const Kinematics kinematics(humanoid());
  const ControlSpace space(1.2, 3, 1.2, standard_scale(kinematics.skeleton()));
  Clip clip = surging_walk();
  const Hop hop(0.22, 0.15, 0.25);
  add_hop(kinematics, find_legs(kinematics, {clip}), clip, hop);
  const double usual = usual_height({body_motion(kinematics, surging_walk())});
  Leap leap = leap_of(kinematics, clip, hop, usual, space);
  const Control asked{0.3, 0.9, 0, 1};
  ASSERT_GT(std::abs(leap.evident.y - asked.y), 0.1);
  fly_as_fast(asked, leap);
  for (std::size_t i = 0; i < std::size_t{3} * leap.begin + 3; ++i)
    EXPECT_EQ(leap.clip.root_positions[i], clip.root_positions[i]);
  const Control is = evident_control(leap.motion, clip.rate, leap.begin, leap.end, usual, space);
  EXPECT_NEAR(is.x, asked.x, 1e-9);
  EXPECT_NEAR(is.y, asked.y, 1e-9);
  EXPECT_NEAR(leap.evident.y, asked.y, 1e-9);
}

TEST(MadeJumps, AreAsFastAndHighAsTheyAreAskedForWhereNoTakeJumps) {
  const Kinematics kinematics(humanoid());
  const ControlSpace space(1.2, 3, 1.2, standard_scale(kinematics.skeleton()));
  const std::vector<Clip> clips{surging_walk(), make_clip(humanoid(), gait_clip({0, 0, 0}))};
  FragmentPool pool = gait_pool(clips, 1, {}, &space);
  synthesize(pool, space, usual_height({body_motion(kinematics, clips[0]), body_motion(kinematics, clips[1])}));
  const Coverage is = coverage(pool.fragments, space);
  for (int c = 0; c < space.size(); ++c) {
    const Control& asked = space.point(c);
    if (asked.jumps() && std::abs(asked.speed() - space.walk()) < 0.01)
      EXPECT_LE(is.distances[c], kPerformed) << asked.x << " " << asked.y << " " << asked.turn;
  }
}

}  // namespace
}  // namespace fragmotion
