// SPDX-License-Identifier: MIT
// Bodies on four legs: which feet stand, the way that they tell, and that each is held.
#include <gtest/gtest.h>

#include <algorithm>

#include "dog.hpp"
#include "feet/foot_lock.hpp"
#include "motion/in_place.hpp"
#include "motion/legs.hpp"

namespace fragmotion {
namespace {

TEST(FourLegs, EachFootStandsWhenItDoes) {
  const Clip clip = dog_clip({}, false, "walk");
  const Contacts contacts = find_contacts(Kinematics(dog()), clip);
  for (int leg = 0; leg < 4; ++leg) {
    ASSERT_EQ(contacts.feet[leg].size(), static_cast<std::size_t>(clip.frames));
    int wrong = 0, frames = 0;
    for (int f = 0; f < clip.frames; ++f) {
      const double phase = f / clip.rate + dog_phase(leg, false), part = phase - std::floor(phase);
      if (std::min({part, std::abs(part - 0.6), 1 - part}) < 0.09) continue;  // striking or leaving
      ++frames;
      wrong += contacts.feet[leg][f] != (part < 0.6) ? 1 : 0;
    }
    EXPECT_GT(frames, 40);
    EXPECT_EQ(wrong, 0) << leg;
  }
}

TEST(FourLegs, GaitsAreCutByHindFeetAndLongPiecesByTheOthers) {
  const Skeleton skeleton = dog();
  const Clip clip = dog_clip({}, false, "walk");
  const Contacts contacts = find_contacts(Kinematics(skeleton), clip);
  const auto cuts = [&](double longest) {
    FragmentPool pool{skeleton, {clip}, {}};
    CutOptions options;
    options.longest = longest;
    cut_fragments(pool, 0, contacts, {}, options);
    std::vector<int> begins;
    for (const Fragment& f : pool.fragments) begins.push_back(f.begin);
    return begins;
  };
  const std::vector<int> strikes = foot_strikes(contacts), fore = fore_foot_strikes(contacts), whole = cuts(1);
  EXPECT_GE(strikes.size(), 5U);
  for (const int strike : strikes) {
    const bool ends = strike + 1 == clip.frames;
    EXPECT_TRUE(ends || std::count(whole.begin(), whole.end(), strike)) << strike;
  }
  const std::vector<int> parts = cuts(0.3);
  EXPECT_GT(parts.size(), whole.size());
  EXPECT_TRUE(std::any_of(fore.begin(), fore.end(), [&](int f) { return std::count(parts.begin(), parts.end(), f); }));
}

TEST(FourLegs, TellTheWayOfAClipOnTheSpot) {
  const Kinematics kinematics{dog()};
  for (const double speed : {1.2, 3.0}) {
    Gait gait;
    gait.y = speed;
    gait.cycle = speed > 2 ? 0.6 : 1;
    gait.rate = 60;
    Clip clip = dog_clip(gait, speed > 2, "spot");
    for (int f = 0; f < clip.frames; ++f) clip.root_positions[3 * f + 1] = 0;
    const std::optional<FeetWay> way = find_feet_way(kinematics, clip);
    ASSERT_TRUE(way) << speed;
    EXPECT_NEAR(way->mean.y(), speed, 0.05 * speed);
    EXPECT_NEAR(way->mean.x(), 0, 0.05 * speed);
  }
}

// How far balls go at most while they are planted for good, m, of a walk whose root goes so much too slowly.
std::array<double, 4> slides(bool holds) {
  const Skeleton skeleton = dog();
  const Kinematics kinematics(skeleton);
  const Clip clip = dog_clip({}, false, "walk");
  const Contacts contacts = find_plants(kinematics, clip);
  const Legs legs = find_legs(kinematics, {clip});
  FootLock lock(kinematics, legs);
  PosedBones posed(skeleton.size());
  std::array<double, 4> most{};
  std::array<Vector3, 4> last;
  std::array<int, 4> planted{};
  for (int f = 0; f < clip.frames; ++f) {
    WorldPose pose{load_vector(&clip.root_positions[std::size_t{3} * f]), clip.headings[f], {}};
    pose.root.y() *= 0.9;
    const auto first = clip.rotations.begin() + std::ptrdiff_t{4} * skeleton.size() * f;
    pose.rotations.assign(first, first + std::ptrdiff_t{4} * skeleton.size());
    const auto frame = static_cast<std::size_t>(f);
    if (holds) lock.apply(pose, contacts, {frame, frame, frame}, f > 0 ? 1 / clip.rate : 0);
    kinematics.world(pose.root, pose.rotations.data(), posed.heads.data(), posed.rotations.data());
    for (int leg = 0; leg < 4; ++leg) {
      const Vector3 place = ball(skeleton, legs[leg], posed);
      planted[leg] = contacts.stands(leg, f) ? planted[leg] + 1 : 0;
      if (planted[leg] > 6) most[leg] = std::max(most[leg], (place - last[leg]).head<2>().norm() * clip.rate);
      last[leg] = place;
    }
  }
  return most;
}

TEST(FourLegs, AreAllHeldWhereTheyStand) {
  const std::array<double, 4> free = slides(false), held = slides(true);
  for (int leg = 0; leg < 4; ++leg) {
    EXPECT_GT(free[leg], 0.1) << leg;  // m/s
    EXPECT_LT(held[leg], 0.02) << leg;
  }
}

}  // namespace
}  // namespace fragmotion
