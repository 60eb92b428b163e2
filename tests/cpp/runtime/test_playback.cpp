// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "motion/pose.hpp"
#include "runtime/playback.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

constexpr double kNear = 1e-9;

// A workspace and what plays in it.
struct Stage {
  std::shared_ptr<const Character> character = gait_character();
  Workspace workspace{*character};
  Playback playback;

  explicit Stage(Stitching stitching = Stitching::inertialize, double stitch = 0.2)
      : playback(*character, workspace, stitching, stitch) {}

  // The frames of a fragment's first pose and of one so much later, in its clip.
  std::pair<CharacterFrame, CharacterFrame> in_clip(int fragment, double seconds) const {
    const Fragment& f = character->pool.fragments[fragment];
    const PackedClip& clip = character->pool.clips[f.clip];
    return {frame_at(clip, f.first_played()), frame_at(clip, f.first_played() + seconds * clip.rate)};
  }
};

double apart(const WorldPose& a, const WorldPose& b) {
  double most = (a.root - b.root).norm();
  for (std::size_t i = 0; i < a.rotations.size(); i += 4)
    most = std::max(most, load_quaternion(&a.rotations[i]).angularDistance(load_quaternion(&b.rotations[i])));
  return most;
}

TEST(Playback, GoesTheWayOfTheClipFromWhereItIsPlaced) {
  Stage stage;
  for (int fragment = 0; fragment < static_cast<int>(stage.character->pool.fragments.size()); fragment += 37) {
    stage.playback.reset(fragment, {{3, -2}, 1.1});
    EXPECT_LT((stage.playback.frame().position - Vector2{3, -2}).norm(), kNear);
    EXPECT_NEAR(stage.playback.frame().heading, 1.1, kNear);
    const double seconds = stage.playback.left() / 2;
    const auto [first, later] = stage.in_clip(fragment, seconds);
    stage.playback.advance(seconds);
    stage.playback.show();
    const Vector2 way = Eigen::Rotation2Dd(1.1 - first.heading) * (later.position - first.position);
    EXPECT_LT((stage.playback.frame().position - Vector2{3, -2} - way).norm(), kNear);
    EXPECT_NEAR(stage.playback.frame().heading, 1.1 + later.heading - first.heading, kNear);
    EXPECT_NEAR(stage.playback.left(), seconds, kNear);
  }
}

TEST(Playback, ShowsTheSameAtTheBeginningOfAStitchOfEitherKind) {
  for (const Stitching stitching : {Stitching::inertialize, Stitching::crossfade}) {
    Stage stage(stitching);
    const int last = static_cast<int>(stage.character->pool.fragments.size()) - 1;
    stage.playback.reset(last, {});
    stage.playback.advance(0.07);
    stage.playback.show();
    const WorldPose before = stage.workspace.shown;
    stage.playback.start(0);
    EXPECT_EQ(&stage.playback.fragment(), &stage.character->played(0));
    EXPECT_EQ(stage.playback.seconds(), 0);
    EXPECT_LT(apart(before, stage.workspace.shown), 1e-3);  // offsets are kept in single precision
  }
}

TEST(Playback, FindsTheFrameInWhichItIsShown) {
  for (const Stitching stitching : {Stitching::inertialize, Stitching::crossfade}) {
    Stage stage(stitching);
    stage.playback.reset(static_cast<int>(stage.character->pool.fragments.size()) - 1, {{3, -2}, 1.1});
    stage.playback.advance(0.07);
    stage.playback.show();
    stage.playback.start(0);
    for (int i = 0; i < 20; ++i) {  // beyond the stitch
      stage.playback.advance(0.02);
      stage.playback.move({0.3, 0.1}, 0.5, 0.02);
      stage.playback.find_frame();
      const CharacterFrame found = stage.playback.frame();
      stage.playback.show();
      EXPECT_EQ(found.position, stage.playback.frame().position);
      EXPECT_EQ(found.heading, stage.playback.frame().heading);
    }
  }
}

TEST(Playback, ShowsOnlyTheNewFragmentOnceACrossfadeIsOver) {
  Stage fading(Stitching::crossfade, 0.1), alone(Stitching::crossfade, 0.1);
  fading.playback.reset(static_cast<int>(fading.character->pool.fragments.size()) - 1, {});
  fading.playback.start(0);
  alone.playback.reset(0, {});
  EXPECT_LE(fading.playback.faded(), 0.1);
  for (Stage* stage : {&fading, &alone}) {
    stage->playback.advance(0.1);
    stage->playback.show();
  }
  EXPECT_LT(apart(fading.workspace.shown, alone.workspace.shown), 1e-6);
}

TEST(Playback, IsMovedAndTurnedAboutWhereTheCharacterStands) {
  Stage stage;
  stage.playback.reset(0, {{1, 2}, kPi / 2});  // facing -x
  stage.playback.move({0, 2}, 0.5, 0.1);
  stage.playback.show();
  EXPECT_LT((stage.playback.frame().position - Vector2{0.8, 2}).norm(), kNear);
  EXPECT_NEAR(stage.playback.frame().heading, kPi / 2 + 0.05, kNear);
}

TEST(Playback, HasLandedFromAJumpAfterItsFlightAndBeforeItIsHalfUp) {
  Stage stage;
  int jumps = 0, sooner = 0;
  for (int fragment = 0; fragment < static_cast<int>(stage.character->pool.fragments.size()); ++fragment) {
    stage.playback.reset(fragment, {});
    const bool jump = stage.playback.evident().jumps();
    jumps += jump;
    EXPECT_EQ(stage.playback.has_landed(), !jump);
    for (; stage.playback.left() > kNear; stage.playback.advance(0.01)) {
      const bool landed = stage.playback.has_landed();
      EXPECT_TRUE(landed || jump);
      EXPECT_FALSE(landed && stage.playback.is_in_the_air());
      sooner += landed && stage.playback.is_jumping();
    }
  }
  EXPECT_GT(jumps, 0);
  EXPECT_GT(sooner, 0);
}

}  // namespace
}  // namespace fragmotion
