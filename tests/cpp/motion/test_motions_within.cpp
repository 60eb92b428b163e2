// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "motion/motions_within.hpp"
#include "walker.hpp"

namespace fragmotion {
namespace {

Clip on_the_spot(const Gait& gait) {
  Clip clip = gait_clip(gait);
  for (int f = 0; f < clip.frames; ++f)
    clip.root_positions[std::size_t{3} * f] = clip.root_positions[std::size_t{3} * f + 1] = 0;
  return clip;
}

const Gait kStand{0, 0, 0, 2}, kWalk{0, 1.2, 0, 1}, kRun{0, 3, 0, 0.6, 30, 0.6};

// A timeline of clips on the spot.
class Timeline {
 public:
  explicit Timeline(const Skeleton& skeleton = humanoid()) : skeleton_(skeleton) {}

  // The frames that it is in.
  Span add(const Clip& clip) {
    const int first = all_.frames;
    all_.rate = clip.rate, all_.frames += clip.frames;
    append(clip.root_positions, all_.root_positions), append(clip.rotations, all_.rotations);
    return {first, all_.frames - 1};
  }

  // An animator's curves lead in so many frames to the first pose of the next clip, with an ease at both ends.
  void lead_to(const Clip& next, int frames) {
    const std::size_t width = std::size_t{4} * skeleton_.size();
    const std::vector<double> root(all_.root_positions.end() - 3, all_.root_positions.end());
    const std::vector<double> pose(all_.rotations.end() - static_cast<std::ptrdiff_t>(width), all_.rotations.end());
    for (int f = 1; f <= frames; ++f) {
      const double x = f / (frames + 1.0), w = x * x * (3 - 2 * x);
      for (int i = 0; i < 3; ++i) all_.root_positions.push_back((1 - w) * root[i] + w * next.root_positions[i]);
      for (std::size_t b = 0; b < width; b += 4) {
        all_.rotations.resize(all_.rotations.size() + 4);
        store_quaternion(load_quaternion(&pose[b]).slerp(w, load_quaternion(&next.rotations[b])),
                         &*(all_.rotations.end() - 4));
      }
    }
    all_.frames += frames;
  }

  std::vector<Span> motions() const { return motions_within(Kinematics(skeleton_), make_clip(skeleton_, Clip(all_))); }

 private:
  static void append(const std::vector<double>& from, std::vector<double>& to) {
    to.insert(to.end(), from.begin(), from.end());
  }

  Skeleton skeleton_;
  Clip all_{"all", 30, 0, {}, {}, {}};
};

bool same(const Span& a, const Span& b) { return a.first == b.first && a.last == b.last; }

TEST(MotionsWithin, AreTheGaitsAndStandsOfATimeline) {
  for (const int between : {0, 5, 9, 20}) {
    Timeline timeline;
    std::vector<Span> expected;
    for (const Gait& gait : {kStand, kWalk, kRun}) {
      const Clip clip = on_the_spot(gait);
      if (!expected.empty()) timeline.lead_to(clip, between);
      expected.push_back(timeline.add(clip));
    }
    const std::vector<Span> found = timeline.motions();
    ASSERT_EQ(found.size(), 3) << between;
    for (const std::size_t i : {1, 2}) EXPECT_TRUE(same(found[i], expected[i])) << between;
    EXPECT_LE(found[0].first, 1);
    EXPECT_NEAR(found[0].last, expected[0].last, 2) << "an ease begins as a stand does";
  }
}

TEST(MotionsWithin, LeaveOutAFallThatLeadsAway) {
  Timeline timeline;
  const Clip stand = on_the_spot(kStand), walk = on_the_spot(kWalk);
  timeline.add(stand);
  timeline.lead_to(walk, 9);
  const Span gait = timeline.add(walk);
  Clip lies = part(stand, 0, 5);
  for (int f = 0; f < lies.frames; ++f) {
    lies.root_positions[std::size_t{3} * f + 1] = -1, lies.root_positions[std::size_t{3} * f + 2] = 0.1;
    double* hips = &lies.rotations[std::size_t{4} * humanoid().size() * f];
    store_quaternion(Quaternion(Eigen::AngleAxisd(kPi / 2, Vector3::UnitX())) * load_quaternion(hips), hips);
  }
  timeline.lead_to(lies, 12);
  timeline.add(lies);
  const std::vector<Span> found = timeline.motions();
  ASSERT_EQ(found.size(), 2);
  EXPECT_TRUE(same(found[1], gait));
}

TEST(MotionsWithin, AreNoneOfOneMotionAlone) {
  const auto alone = [](const Clip& clip) { return motions_within(Kinematics(humanoid()), clip); };
  EXPECT_TRUE(alone(on_the_spot(kStand)).empty());
  EXPECT_TRUE(alone(on_the_spot(kWalk)).empty());
  EXPECT_TRUE(alone(on_the_spot({0, 1.2, 0, 7.3})).empty()) << "rounds of a walk";
  EXPECT_TRUE(alone(gait_clip(kWalk)).empty()) << "it goes by itself";
}

TEST(MotionsWithin, AreNoneWithoutFeet) {
  Skeleton footless = humanoid();
  footless.roles.left_foot = footless.roles.right_foot = -1;
  Timeline timeline(footless);
  for (const Gait& gait : {kStand, kWalk}) timeline.add(on_the_spot(gait));
  EXPECT_TRUE(timeline.motions().empty());
}

}  // namespace
}  // namespace fragmotion
