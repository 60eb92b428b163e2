// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "runtime/root_governor.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

constexpr double kAcceleration = 50;  // m/s^2

// The fragment that goes forward fastest.
int forward_fragment(const Character& c) {
  int best = 0;
  for (std::size_t i = 0; i < c.pool.fragments.size(); ++i) {
    const Control &ev = c.pool.fragments[i].evident, &most = c.pool.fragments[best].evident;
    if (ev.jump < 0.1 && ev.y - std::abs(ev.x) > most.y - std::abs(most.x)) best = static_cast<int>(i);
  }
  return best;
}

// One that lets a body be accelerated so much, m/s^2.
RootGovernor governor_of(const Character& character, double adjustment, double acceleration) {
  static const RootLimits limits;
  static Filter settles(limits.settles);
  return {character, limits, settles, adjustment, 1 - limits.acceleration / 2 / character.space.scale() / acceleration};
}

// How far the character gets in half a second in which only the root adjustment moves it, m in its own frame, and the
// angle that it turns by, rad.
std::pair<Vector2, double> adjusted(double adjustment, const Control& beyond) {
  const auto character = gait_character();
  Workspace workspace(*character);
  Playback playback(*character, workspace, Stitching::inertialize, 0.2);
  RootGovernor governor = governor_of(*character, adjustment, kAcceleration);
  playback.reset(forward_fragment(*character), {});
  governor.reset(0);
  const Control& ev = playback.evident_of_hips();
  const double turn = playback.mean_travel().turn_rate / character->space.turn_rate();
  const Control control{ev.x + beyond.x, ev.y + beyond.y, turn + beyond.turn, 0};
  governor.resume(0, {control.x, control.y});
  for (int i = 0; i < 30; ++i) {
    governor.steer(control, 1.0 / 60, playback);
    playback.show();
  }
  return {playback.frame().position, playback.frame().heading};
}

TEST(RootGovernor, MovesTheRootByWhatIsMissingUpToALimit) {
  const auto [still, straight] = adjusted(0, {0, 0.2, 1, 0});
  EXPECT_LT(still.norm(), 1e-9);
  EXPECT_NEAR(straight, 0, 1e-9);
  // Aside, so that its steps follow each other hardly faster.
  const double little = adjusted(1, {0.2, 0, 0, 0}).first.x(), half = adjusted(0.5, {0.2, 0, 0, 0}).first.x(),
               most = adjusted(1, {100, 0, 0, 0}).first.x(), speed = [] {
                 const Character& c = *gait_character();
                 return c.pool.fragments[forward_fragment(c)].evident.speed();
               }();
  EXPECT_GT(little, 0.06);
  EXPECT_LT(little, 0.1);  // 0.2 m/s for half a second, eased in
  EXPECT_NEAR(half, little / 2, 0.002);
  EXPECT_GT(most, little);
  EXPECT_LT(most, 0.6 * speed * 0.5);
}

TEST(RootGovernor, LetsGoOfAVelocityNoFasterThanABodyCan) {
  const auto character = gait_character();
  Workspace workspace(*character);
  Playback playback(*character, workspace, Stitching::inertialize, 0.2);
  RootGovernor governor = governor_of(*character, 1, 5);
  playback.reset(character->classes.representatives[0], {});
  governor.reset(0);
  governor.keep({0, 2}, playback);
  const Control& ev = playback.evident_of_hips();
  governor.resume(0, {ev.x, ev.y});
  double before = 2;
  for (int i = 0; i < 60; ++i) {
    const double from = playback.frame().position.y();
    governor.steer(ev, 0.01, playback);
    playback.show();
    const double speed = (playback.frame().position.y() - from) / 0.01;
    EXPECT_LE(std::abs(speed - before), 0.05 + 1e-6) << i;
    before = speed;
  }
  EXPECT_NEAR(before, 0, 0.01);
}

// However much faster each ends than the next begins, and were it the same one again.
TEST(RootGovernor, GetsNoFasterByStitchesThanWhatTheyKeepFades) {
  constexpr double kMost = 5, kEnds = 2, kTime = 0.1;  // m/s^2, m/s, s
  const auto character = gait_character();
  Workspace workspace(*character);
  Playback playback(*character, workspace, Stitching::inertialize, 0.2);
  RootGovernor governor = governor_of(*character, 1, kMost);
  const int fragment = forward_fragment(*character);
  playback.reset(fragment, {});
  governor.reset(0);
  const Control ev = playback.evident_of_hips();
  governor.resume(0, {ev.x, ev.y});
  double fastest = 0;
  for (int stitch = 0; stitch < 100; ++stitch) {
    for (int i = 0; i < 10; ++i) {
      playback.advance(kTime / 10);
      governor.steer(ev, kTime / 10, playback);
      playback.show();
    }
    playback.start(fragment);
    governor.keep({0, kEnds}, playback);
    fastest = std::max(fastest, (governor.velocity() + governor.pace() * playback.mean_travel().velocity).norm());
  }
  EXPECT_GT(fastest, ev.speed() + 1);  // of one stitch it is kept, so that no hips are jerked,
  EXPECT_LE(fastest, ev.speed() + kEnds + 0.5);
}

// Whatever is asked, and however the hips of the fragment sway.
TEST(RootGovernor, AcceleratesWithWhatPlaysNoFasterThanABodyCan) {
  constexpr double kLeast = 0.5;  // m/s^2
  const auto character = gait_character();
  Workspace workspace(*character);
  Playback playback(*character, workspace, Stitching::inertialize, 0.2);
  RootGovernor governor = governor_of(*character, 1, kLeast);
  double greatest = 0;
  for (const double asked : {0.3, 1.2, 3.0}) {
    playback.reset(forward_fragment(*character), {});
    governor.reset(0);
    governor.resume(0, {0, asked});
    governor.steer({0, asked, 0, 0}, 0.01, playback);
    Vector2 before = governor.velocity() + governor.tempo() * playback.mean_travel().velocity;
    while (playback.left() > 0.01) {
      playback.advance(0.01);
      governor.steer({0, asked, 0, 0}, 0.01, playback);
      const Vector2 now = governor.velocity() + governor.tempo() * playback.mean_travel().velocity;
      EXPECT_LE((now - before).norm(), 0.01 * kLeast + 1e-9);
      greatest = std::max(greatest, (now - before).norm());
      before = now;
    }
  }
  EXPECT_GT(greatest, 0.009 * kLeast);
}

TEST(RootGovernor, StepsSlowerWhereLessIsAskedForAndFasterWhereMoreIs) {
  const auto character = gait_character();
  Workspace workspace(*character);
  Playback playback(*character, workspace, Stitching::inertialize, 0.2);
  playback.reset(forward_fragment(*character), {});
  const Control& ev = playback.evident_of_hips();
  const auto tempo = [&](double adjustment, double share) {
    RootGovernor governor = governor_of(*character, adjustment, kAcceleration);
    governor.reset(0);
    governor.resume(0, {share * ev.x, share * ev.y});
    EXPECT_EQ(governor.tempo(), 1);
    for (int i = 0; i < 120; ++i) governor.steer({share * ev.x, share * ev.y, 0, 0}, 0.01, playback);
    return governor.tempo();
  };
  EXPECT_NEAR(tempo(1, 0.7), std::sqrt(0.7), 0.01);
  EXPECT_NEAR(tempo(0.5, 0.7), (1 + std::sqrt(0.7)) / 2, 0.01);
  EXPECT_NEAR(tempo(1, 0.2), std::sqrt(0.2), 0.01);
  EXPECT_NEAR(tempo(1, 1.3), std::sqrt(1.3), 0.01);
  EXPECT_NEAR(tempo(1, 2), 1.2, 0.01);
  EXPECT_EQ(tempo(0, 0.2), 1);
}

TEST(RootGovernor, BringsBackTheHeadingThatWasLost) {
  const auto character = gait_character();
  Workspace workspace(*character);
  Playback playback(*character, workspace, Stitching::inertialize, 0.2);
  RootGovernor governor = governor_of(*character, 1, 5);
  playback.reset(forward_fragment(*character), {});
  governor.reset(0);
  playback.move({0, 0}, 0.2, 1);  // turned by something else
  playback.show();
  for (int i = 0; i < 60; ++i) {
    governor.steer({0, 1, 0, 0}, 0.02, playback);
    playback.move({0, 0}, governor.tempo() * playback.mean_travel().turn_rate, 0.02);  // as if it played on
    playback.show();
  }
  EXPECT_NEAR(playback.frame().heading, 0, 0.01);
}

TEST(RootGovernor, TurnsTheWayThatIsAsked) {
  const auto left = adjusted(1, {0, 0, 0.3, 0}).second, right = adjusted(1, {0, 0, -0.3, 0}).second;
  EXPECT_GT(left, 0.05);
  EXPECT_NEAR(left, -right, 1e-9);
}

// However far the heading is behind.
TEST(RootGovernor, TurnsLittleFasterThanTheCharacterOrThanIsAsked) {
  const auto character = gait_character();
  const double unit = character->space.turn_rate();
  Workspace workspace(*character);
  for (const double asked : {0.0, 0.5, 1.0, 2.0}) {
    Playback playback(*character, workspace, Stitching::inertialize, 0.2);
    RootGovernor governor = governor_of(*character, 1, 5);
    playback.reset(forward_fragment(*character), {});
    governor.reset(0);
    playback.move({0, 0}, -1, 2);  // turned by something else
    playback.show();
    double fastest = 0;
    for (int i = 0; i < 120; ++i) {
      governor.steer({0, 1, asked, 0}, 0.01, playback);
      fastest = std::max(fastest, governor.turn_rate() + governor.tempo() * playback.mean_travel().turn_rate);
      playback.show();
    }
    const double most = kTurnsAtMost * std::max(1.0, asked) * unit;
    EXPECT_LT(fastest, most + 1e-6) << asked;
    EXPECT_GT(fastest, 0.5 * most) << asked;
  }
}

}  // namespace
}  // namespace fragmotion
