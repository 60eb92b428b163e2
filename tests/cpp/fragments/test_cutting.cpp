// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mocap_files.hpp"
#include "motion/discontinuities.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

const double kRates[] = {24, 25, 29.97, 30, 60, 120};

FragmentPool cut_at(double rate, double seconds, const CutOptions& options) {
  Gait gait;
  gait.rate = rate;
  gait.seconds = seconds;
  return gait_pool({gait_clip(gait)}, 1, options);
}

void expect_whole_fragments(const FragmentPool& pool, const CutOptions& options) {
  for (const Fragment& f : pool.fragments) {
    EXPECT_GE(f.begin, 0);
    EXPECT_LT(f.end, pool.clips[f.clip].frames);
    EXPECT_GE(pool.seconds(f), options.shortest - 1e-9);
    EXPECT_LE(pool.seconds(f), options.longest + 1e-9);
  }
}

TEST(CutFragments, KeepsDurationsWithinTheLimitsAtAnyRate) {
  for (const double rate : kRates) {
    for (const double seconds : {0.2, 0.73, 3.01}) {
      for (const bool gait : {true, false}) {
        CutOptions options;
        options.at_gait_events = gait;
        SCOPED_TRACE(testing::Message() << rate << " frames/s, " << seconds << " s, gait " << gait);
        const FragmentPool pool = cut_at(rate, seconds, options);
        EXPECT_FALSE(pool.fragments.empty());
        expect_whole_fragments(pool, options);
      }
    }
  }
}

TEST(CutFragments, KeepsRandomLimitsOrSaysThatTheyHoldNoFrame) {
  Random random(11);
  int refused = 0;
  for (int n = 0; n < 200; ++n) {
    CutOptions options;
    options.shortest = 0.02 + 0.3 * random.uniform();
    options.longest = std::max(0.1, options.shortest + 0.4 * random.uniform() * random.uniform());
    options.at_gait_events = n % 2 == 0;
    const double rate = kRates[random.below(6)];
    FragmentPool pool;
    const std::string error = error_of([&] { pool = cut_at(rate, 0.5 + random.uniform(), options); });
    if (error != "no error") {
      ++refused;
      EXPECT_LT(std::floor(options.longest * rate + 1e-6), std::ceil(options.shortest * rate - 1e-6)) << error;
      EXPECT_NE(error.find("\"gait\""), std::string::npos) << error;
      continue;
    }
    SCOPED_TRACE(testing::Message() << rate << ": " << options.shortest << " .. " << options.longest);
    expect_whole_fragments(pool, options);
  }
  EXPECT_GT(refused, 3);
  EXPECT_LT(refused, 120);
}

TEST(CutFragments, RefusesLimitsOutOfTheirRanges) {
  for (const double bad : {-1.0, 0.0, 0.019, 10.1, 1e8, 1e308, std::nan(""), double(INFINITY), -double(INFINITY)}) {
    CutOptions options;
    options.shortest = bad;
    EXPECT_NE(error_of([&] { cut_at(30, 1, options); }).find("shortest fragment (s) must be 0.02 to 10"),
              std::string::npos)
        << bad;
    options = {};
    options.longest = bad;
    EXPECT_NE(error_of([&] { cut_at(30, 1, options); }).find("longest fragment (s) must be 0.1 to 10"),
              std::string::npos)
        << bad;
  }
}

TEST(CutFragments, FollowOneAnotherWithoutGapsOrOverlap) {
  for (const double rate : kRates) {
    for (const bool gait : {true, false}) {
      CutOptions options;
      options.at_gait_events = gait;
      const FragmentPool pool = cut_at(rate, 3, options);
      EXPECT_EQ(pool.fragments.front().begin, 0);
      EXPECT_EQ(pool.fragments.back().end, pool.clips[0].frames - 1);
      for (std::size_t i = 1; i < pool.fragments.size(); ++i)
        EXPECT_EQ(pool.fragments[i].begin, pool.fragments[i - 1].end);
    }
  }
}

TEST(CutFragments, CutsAtTheStrikesOfTheFeet) {
  Gait gait;
  gait.rate = 60;
  gait.cycle = 0.9;
  const FragmentPool pool = gait_pool({gait_clip(gait)});
  std::vector<int> strikes;  // as the walker is made: the left foot at whole cycles, the right one half a cycle later
  for (int half = 1; half * 0.45 < 3 - 0.1; ++half) strikes.push_back(static_cast<int>(std::lround(half * 0.45 * 60)));
  for (const int strike : strikes) {
    int nearest = 1000;
    for (const Fragment& f : pool.fragments) nearest = std::min(nearest, std::abs(f.begin - strike));
    EXPECT_LE(nearest, 5) << "no cut near the strike at frame " << strike;
  }
}

TEST(CutFragments, CutsLongStepsWhereAFootLeavesTheGroundAndNotInMidSwing) {
  Gait gait;
  gait.rate = 60;
  gait.cycle = 1.2;  // steps of 0.6 s
  const Clip clip = gait_clip(gait);
  const Contacts contacts = find_contacts(Kinematics(humanoid()), clip);
  std::vector<int> events = foot_strikes(contacts), lifts = foot_lifts(contacts);
  events.insert(events.end(), lifts.begin(), lifts.end());
  const FragmentPool pool = gait_pool({clip});
  ASSERT_GT(pool.fragments.size(), 6U);
  for (std::size_t i = 1; i < pool.fragments.size(); ++i) {
    EXPECT_EQ(std::count(events.begin(), events.end(), pool.fragments[i].begin), 1) << pool.fragments[i].begin;
  }
}

// A walk whose first frame is a pose with raised arms, and that goes on two metres aside at frame 50.
Clip torn_clip() {
  Clip clip = gait_clip({});
  const Skeleton skeleton = humanoid();
  for (int b = 0; b < skeleton.size(); ++b) {
    if (skeleton.names[b].find("upper_arm") == std::string::npos) continue;
    const Quaternion raised = Quaternion(Eigen::AngleAxisd(kPi / 2, Vector3::UnitX()));
    store_quaternion((load_quaternion(&clip.rotations[std::size_t{4} * b]) * raised).normalized(),
                     &clip.rotations[std::size_t{4} * b]);
  }
  for (int f = 50; f < clip.frames; ++f) clip.root_positions[std::size_t{3} * f] += 2;
  return make_clip(skeleton, clip);
}

TEST(Discontinuities, AreWhereNoBodyGetsFromOneFrameToTheNext) {
  EXPECT_EQ(discontinuities(humanoid(), torn_clip()), (std::vector<int>{1, 50}));
  EXPECT_TRUE(discontinuities(humanoid(), gait_clip({})).empty());
  EXPECT_EQ(discontinuities(humanoid(10), moved(humanoid(10), torn_clip(), {})),
            (std::vector<int>{1}));  // a giant's step
}

// A stand in which one thigh turns by these angles, degrees, from frame to frame.
Clip turned_clip(const std::vector<double>& steps) {
  const Skeleton skeleton = humanoid();
  Clip clip{"turned", 24, static_cast<int>(steps.size()) + 1, {}, {}, {}};
  const int thigh = skeleton.roles.left_thigh;
  double angle = 0;
  for (int f = 0; f < clip.frames; ++f) {
    angle += f > 0 ? steps[f - 1] * kPi / 180 : 0;
    clip.root_positions.insert(clip.root_positions.end(), {0, 0, 1});
    for (int b = 0; b < skeleton.size(); ++b) {
      const double half = b == thigh ? angle / 2 : 0;
      clip.rotations.insert(clip.rotations.end(), {std::cos(half), std::sin(half), 0, 0});
    }
  }
  return make_clip(skeleton, clip);
}

TEST(Discontinuities, AreNoFastSwings) {
  const auto torn = [](const std::vector<double>& steps) { return discontinuities(humanoid(), turned_clip(steps)); };
  EXPECT_TRUE(torn({0, 10, 42, 81, 45, 5, -30, -81, -40, 0}).empty()) << "a fox' fore leg in a gallop";
  EXPECT_TRUE(torn({5, 20, 70, 115, 60, 5}).empty());
  EXPECT_EQ(torn({0, 3, 81, 5, 0}), (std::vector<int>{3})) << "a cut";
  EXPECT_EQ(torn({81, 3, 2, 0}), (std::vector<int>{1})) << "a calibration pose";
  EXPECT_EQ(torn({0, 70, -70, 3}), (std::vector<int>{2, 3})) << "markers that are mixed up for a frame";
  EXPECT_EQ(torn({0, 2, 70}), (std::vector<int>{3}));
  EXPECT_TRUE(torn({5, 10, -81, 30, 31, 5}).empty()) << "a drawn cycle, which ends where it begins";
  EXPECT_EQ(torn({5, 10, -81, 30, 31, 9}), (std::vector<int>{3}));
}

TEST(CutFragments, NeverGoOverATear) {
  for (const bool gait : {true, false}) {
    CutOptions options;
    options.at_gait_events = gait;
    const FragmentPool pool = gait_pool({torn_clip()}, 1, options);
    EXPECT_GT(pool.fragments.size(), 4U);
    expect_whole_fragments(pool, options);
    for (const Fragment& f : pool.fragments) {
      for (const int found : {1, 50}) EXPECT_TRUE(f.end < found || f.begin >= found) << f.begin << " " << f.end;
    }
  }
}

TEST(CutFragments, WindowsHaveOneLength) {
  CutOptions options;
  options.at_gait_events = false;
  const FragmentPool pool = cut_at(30, 4, options);
  for (const Fragment& f : pool.fragments) EXPECT_NEAR(f.end - f.begin, 15, 1);
}

TEST(CutFragments, WithoutFeetCutsWindows) {
  Gait gait;
  const Clip clip = gait_clip(gait);
  Skeleton skeleton = humanoid();
  skeleton.roles.left_foot = skeleton.roles.right_foot = -1;
  const Contacts contacts = find_contacts(Kinematics(skeleton), clip);
  EXPECT_TRUE(contacts.feet[0].empty());
  EXPECT_TRUE(contacts.feet[1].empty());
  FragmentPool pool{skeleton, {clip}, {}}, windows = pool;
  cut_fragments(pool, 0, contacts, {}, {});
  CutOptions options;
  options.at_gait_events = false;
  cut_fragments(windows, 0, contacts, {}, options);
  ASSERT_EQ(pool.fragments.size(), windows.fragments.size());
  ASSERT_FALSE(pool.fragments.empty());
  for (std::size_t i = 0; i < pool.fragments.size(); ++i)
    EXPECT_EQ(pool.fragments[i].begin, windows.fragments[i].begin);
}

TEST(CutFragments, FindsNoneInAClipThatIsTooShort) {
  Gait gait;
  gait.rate = 60;
  gait.seconds = 0.09;
  EXPECT_TRUE(gait_pool({gait_clip(gait)}).fragments.empty());
}

TEST(CutFragments, SaysThatALimitHoldsNoFrame) {
  CutOptions options;
  options.shortest = 0.31;
  options.longest = 0.32;
  const std::string error = error_of([&] { cut_at(30, 3, options); });
  for (const char* part : {"0.31", "0.32", "\"gait\"", "30"}) EXPECT_NE(error.find(part), std::string::npos) << error;
}

TEST(FindContacts, FindsThePlantedFeet) {
  for (const double rate : {30.0, 60.0, 120.0}) {
    Gait gait;
    gait.rate = rate;
    const Contacts contacts = find_contacts(Kinematics(humanoid()), gait_clip(gait));
    int wrong = 0, frames = 0;
    for (int f = 0; f < static_cast<int>(contacts.feet[0].size()); ++f) {
      const double t = f / rate;
      for (int side = 0; side < 2; ++side) {
        const double phase = t / gait.cycle + (side == 0 ? 0 : 0.5), part = phase - std::floor(phase);
        const double edge = std::min({part, std::abs(part - 0.6), 1 - part}) * gait.cycle;
        if (edge < 0.09) continue;  // striking or leaving
        ++frames;
        wrong += contacts.feet[side][f] != (part < 0.6) ? 1 : 0;
      }
    }
    EXPECT_GT(frames, 100);
    EXPECT_EQ(wrong, 0) << rate << " frames/s, of " << frames;
  }
}

TEST(FindContacts, DoNotTakeABadFrameForTheFloor) {
  Clip clip = gait_clip({});
  const Contacts usual = find_contacts(Kinematics(humanoid()), clip);
  clip.root_positions[3 * 40 + 2] -= 0.2;
  const Contacts with_bad_frame = find_contacts(Kinematics(humanoid()), clip);
  int different = 0;
  for (int f = 0; f < clip.frames; ++f) {
    for (int side = 0; side < 2; ++side) different += usual.feet[side][f] != with_bad_frame.feet[side][f] ? 1 : 0;
  }
  EXPECT_LT(different, 12);  // near the frame, as the foot is fast there
  EXPECT_NEAR(usual.floors[0].ball, with_bad_frame.floors[0].ball, 5e-3);
}

TEST(FindContacts, AreTheSameForAGiant) {
  for (const double size : {0.1, 10.0}) {
    Gait gait;
    const Contacts usual = find_contacts(Kinematics(humanoid()), gait_clip(gait));
    gait.size = size;
    const Contacts scaled = find_contacts(Kinematics(humanoid(size)), gait_clip(gait));
    EXPECT_EQ(usual.feet, scaled.feet) << size;
  }
}

TEST(FootStrikes, AreTheFramesInWhichAFootComesDown) {
  Random random(4);
  for (int n = 0; n < 100; ++n) {
    Contacts contacts;
    for (std::vector<bool>& foot : contacts.feet) {
      for (int f = 0; f < 30; ++f) foot.push_back(random.below(2) == 1);
    }
    std::vector<int> expected;
    for (int f = 1; f < 30; ++f) {
      const bool left = contacts.feet[0][f] && !contacts.feet[0][f - 1];
      const bool right = contacts.feet[1][f] && !contacts.feet[1][f - 1];
      if (left || right) expected.push_back(f);
    }
    EXPECT_EQ(foot_strikes(contacts), expected);
  }
}

}  // namespace
}  // namespace fragmotion
