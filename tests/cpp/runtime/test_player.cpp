// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "control/simulated_players.hpp"
#include "evaluate/performance.hpp"
#include "fragments/successors.hpp"
#include "mocap_files.hpp"
#include "motion/pose.hpp"
#include "runtime/player.hpp"
#include "skeleton/roles.hpp"
#include "small_character.hpp"
#include "steering.hpp"

namespace fragmotion {
namespace {

std::vector<Vector3> joints(const Kinematics& kinematics, const Vector3& root, const std::vector<double>& rotations) {
  std::vector<Vector3> heads(kinematics.bones());
  std::vector<Quaternion> orientations(kinematics.bones());
  kinematics.world(root, rotations.data(), heads.data(), orientations.data());
  for (int b = 0; b < kinematics.bones(); ++b)
    heads.push_back(heads[b] + orientations[b] * kinematics.skeleton().tips[b]);
  return heads;
}

double largest_distance(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

// The speed of the fastest joint of all takes, m/s.
double top_speed(const Character& c, const Kinematics& kinematics) {
  double top = 0;
  for (const PackedClip& packed : c.pool.clips) {
    const Clip clip = unpack(packed);
    std::vector<Vector3> before;
    for (int f = 0; f < clip.frames; ++f) {
      const std::size_t width = std::size_t{4} * kinematics.bones();
      const std::vector<double> pose(clip.rotations.begin() + f * width, clip.rotations.begin() + (f + 1) * width);
      const std::vector<Vector3> now = joints(kinematics, load_vector(&clip.root_positions[3 * f]), pose);
      if (f > 0) top = std::max(top, clip.rate * largest_distance(before, now));
      before = now;
    }
  }
  return top;
}

// Takes, however different, are stitched over at least a tenth of a second, with a slope of at most 1.5.
double allowed_step(const Character& c, const Kinematics& kinematics, double seconds) {
  const double reach = 2 * stature(c.pool.skeleton);
  return (1.2 * top_speed(c, kinematics) + 1.5 * reach / 0.1) * seconds;
}

TEST(Player, ShowsTheSameAfterAStepOfNoTime) {
  for (const Stitching stitching : {Stitching::inertialize, Stitching::crossfade}) {
    PlayerOptions options;
    options.stitching = stitching;
    Player player(gait_character(), options);
    for (int i = 0; i < 120; ++i) {
      player.step(kForward, 1.0 / 60);
      const Vector3 root = player.root_position();
      const std::vector<double> rotations = player.rotations();
      player.step(kForward, 0);
      EXPECT_LT((player.root_position() - root).norm(), 1e-9) << i;
      for (std::size_t r = 0; r < rotations.size(); ++r) EXPECT_NEAR(player.rotations()[r], rotations[r], 1e-9) << i;
    }
  }
}

TEST(Player, MadeLikeAnotherPlaysAsOneMadeAnew) {
  const auto character = gait_character();
  PlayerOptions options;
  options.seed = 7;
  options.responsiveness = 0.8;
  Player like(character);
  const Control wanted{0.4, 1.1, 0.5, 0};
  for (int i = 0; i < 100; ++i) like.step(wanted, 1.0 / 60);
  Player made = like.another(options), anew(character, options);
  for (int i = 0; i < 600; ++i) {
    like.step(wanted, 1.0 / 60);  // room of its own
    const Control control{std::sin(0.03 * i), 1 + std::cos(0.02 * i), 0.1, i % 100 < 5 ? 1.0 : 0.0};
    for (Player* player : {&made, &anew}) player->step(control, 1.0 / 60);
    ASSERT_EQ(made.root_position(), anew.root_position()) << i;
    ASSERT_EQ(made.rotations(), anew.rotations()) << i;
  }
}

TEST(Player, NeverJumps) {
  const auto c = gait_character();
  const Kinematics kinematics(c->pool.skeleton);
  for (const double dt : {1.0 / 60, 1.0 / 5000}) {
    const double allowed = allowed_step(*c, kinematics, dt);
    Player player(c, {3});
    Random random(4);
    Control control;
    std::vector<Vector3> before = joints(kinematics, player.root_position(), player.rotations());
    double heading = player.frame().heading, largest = 0;
    for (int i = 0; i < static_cast<int>(8 / dt); ++i) {
      if (i % static_cast<int>(0.3 / dt) == 0) control = c->space.point(random.below(kPaperPoints));
      if (i % static_cast<int>(0.7 / dt) == 0) player.force(random.below(c->classes.count));
      player.step(control, dt);
      const std::vector<Vector3> now = joints(kinematics, player.root_position(), player.rotations());
      largest = std::max(largest, largest_distance(before, now));
      EXPECT_LT(std::abs(player.frame().heading - heading), 40 * dt);
      heading = player.frame().heading;
      before = now;
    }
    EXPECT_LT(largest, 1.5 * allowed) << dt;  // a locked foot straightens its knee faster than a stitch moves joints
  }
}

TEST(Player, ShowsFinitePosesOfUnitRotations) {
  Player player(gait_character(), {5});
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const Control wild{40 * random.uniform() - 20, 40 * random.uniform() - 20, 4 * random.uniform() - 2,
                       random.uniform()};
    player.step(wild, 0.3 * random.uniform() * random.uniform());
    ASSERT_TRUE(player.root_position().allFinite());
    for (std::size_t b = 0; b < player.rotations().size(); b += 4)
      ASSERT_NEAR(load_quaternion(&player.rotations()[b]).norm(), 1, 1e-6);
  }
}

// Without what is done once a step.
PlayerOptions unadjusted(std::uint64_t seed) {
  PlayerOptions options;
  options.seed = seed;
  options.lock_feet = false;
  options.root_adjustment = 0;
  return options;
}

// What plays, asked between the ends of fragments, which all lie on whole thirtieths of a second.
std::vector<int> what_plays(double rate, const Control& control, double seconds) {
  Player player(gait_character(), unadjusted(9));
  player.step(control, 1.0 / 240);
  std::vector<int> played;
  const int steps = static_cast<int>(rate / 30);
  for (int i = 0; i < static_cast<int>(seconds * 30); ++i) {
    for (int k = 0; k < steps; ++k) player.step(control, 1 / rate);
    played.push_back(player.playing_fragment());
  }
  return played;
}

TEST(Player, JumpsWheneverItIsAskedTo) {
  const Character& c = *gait_character();
  for (const int point : {2, 8, 56}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      Player player(gait_character(), unadjusted(seed));
      Control control = c.space.point(point);
      for (int i = 0; i < 60 + static_cast<int>(seed); ++i) player.step(control, 1.0 / 60);
      control.jump = 1;
      player.step(control, 0.1);
      control.jump = 0;
      bool jumps = false;
      for (int i = 0; i < 60; ++i) {
        jumps = jumps || c.pool.fragments[player.playing_fragment()].evident.jump > 0.5;
        player.step(control, 1.0 / 60);
      }
      EXPECT_TRUE(jumps) << point << " seed " << seed;
    }
  }
}

// A walk that is held is mostly the actor's own.
TEST(Player, MostlyGoesOnInTheTakeThatItPlays) {
  const auto character = gait_character();
  const std::vector<int> next = successors(character->pool.fragments);
  Player player(character);
  int stitches = 0, stays = 0, fragment = player.playing_fragment();
  for (int i = 0, entered = player.entered(); i < 1200; ++i) {
    player.step(kForward, 1.0 / 60);
    if (std::exchange(entered, player.entered()) == entered) continue;
    ++stitches;
    stays += next[std::exchange(fragment, player.playing_fragment())] == fragment ? 1 : 0;
  }
  EXPECT_GT(stitches, 20);
  EXPECT_GT(stays, stitches / 2);
}

TEST(Player, NeverHopsUnasked) {
  const Character& c = *gait_character();
  for (int point = 0; point < kPaperPoints; point += 2) {
    Player player(gait_character(), unadjusted(3));
    for (int i = 0; i < 180; ++i) {
      player.step(c.space.point(point), 1.0 / 60);
      const int shown = c.classes.representatives[player.playing_class()];
      ASSERT_LT(c.pool.fragments[shown].evident.jump, 0.9) << point << " at " << i;
    }
  }
}

// The distance between the poses that are joined where a change of the control ends a fragment early, and the time that
// it took, each summed.
std::pair<double, double> joined(double responsiveness) {
  PlayerOptions options = unadjusted(5);
  options.responsiveness = responsiveness;
  options.stitch = 0;
  Player player(gait_character(), options);
  Random random(7);
  double apart = 0, waited = 0;
  for (int n = 0; n < 200; ++n) {
    const Control control = gait_character()->space.point(2 + 6 * random.below(17));
    const int before = player.playing_fragment();
    for (int i = 0; i < 60 && player.playing_fragment() == before; ++i) {
      const std::vector<double> rotations = player.rotations();
      player.step(control, 1.0 / 60);
      waited += 1.0 / 60;
      if (player.playing_fragment() == before) continue;
      for (std::size_t k = 0; k < rotations.size(); k += 4) {
        apart += load_quaternion(&rotations[k]).angularDistance(load_quaternion(&player.rotations()[k]));
      }
    }
  }
  return {apart, waited};
}

TEST(Player, TakesAStitchOfNoTimeForNone) {
  for (const Stitching stitching : {Stitching::inertialize, Stitching::crossfade}) {
    PlayerOptions options;
    options.stitching = stitching;
    options.stitch = 0;
    Player none(gait_character(), options);
    options.stitch = 1e-300;
    Player shortest(gait_character(), options);
    for (int i = 0; i < 300; ++i) {
      const Control control{0, i % 100 < 50 ? 1.5 : -1.5, 0, 0};
      none.step(control, 1.0 / 60);
      shortest.step(control, 1.0 / 60);
      ASSERT_EQ(shortest.rotations(), none.rotations()) << i;
    }
  }
}

TEST(Player, ResponsivenessIsPaidForWithWorseStitches) {
  const auto [rough, soon] = joined(1);
  const auto [smooth, late] = joined(0);
  EXPECT_LT(soon, late);
  EXPECT_LT(smooth, rough);
}

// Where a fragment is left early, on the boundary of a thirtieth but for rounding, it plays for one more or less.
TEST(Player, PlaysTheSameFragmentsWhateverTheStep) {
  for (const int point : {2, 8, 56, 14, 1, 33}) {
    const Control control = gait_character()->space.point(point);
    const std::vector<int> expected = what_plays(30, control, 10);
    for (const double rate : {60.0, 120.0, 240.0}) {
      const std::vector<int> played = what_plays(rate, control, 10);
      for (std::size_t i = 1; i + 1 < played.size(); ++i) {
        EXPECT_GT(std::count(&expected[i - 1], &expected[i + 1] + 1, played[i]), 0) << point << ' ' << i;
      }
    }
  }
}

TEST(Player, GoesTheSameWayWhateverTheStep) {
  const auto position = [](int steps) {
    Player player(gait_character(), unadjusted(2));
    for (int i = 0; i < steps; ++i) player.step(kForward, 7.003 / steps);
    return player.root_position();
  };
  const Vector3 expected = position(101);
  for (const int steps : {1, 7, 1000}) EXPECT_LT((position(steps) - expected).norm(), 0.05) << steps;
}

TEST(Player, ForcesAtTheSameTimeWhateverTheStep) {
  const auto place = [](int steps) {
    Player player(gait_character(), unadjusted(2));
    player.step(kForward, 1.03);
    player.force(3);
    for (int i = 0; i < steps; ++i) player.step(kForward, 1.003 / steps);
    return player.root_position();
  };
  const Vector3 expected = place(101);
  for (const int steps : {1, 2, 7, 1000}) EXPECT_LT((place(steps) - expected).norm(), 0.05) << steps;
}

TEST(Player, ShowsTheSameAfterAReset) {
  const Trace trace = simulate_trace("jumper", 10, 4, gait_character()->space);
  Player player(gait_character(), {3});
  const Performance first = perform(player, trace, 30);
  player.reset();
  const Performance again = perform(player, trace, 30);
  EXPECT_EQ(again.fragments, first.fragments);
  EXPECT_EQ(again.rotations, first.rotations);
  EXPECT_EQ(again.root_positions, first.root_positions);
}

Performance performed(std::uint64_t seed, double rate) {
  Player player(gait_character(), {seed});
  return perform(player, simulate_trace("explorer", 20, 4, gait_character()->space), rate);
}

TEST(Player, RepeatsItselfForASeed) {
  const Performance a = performed(1, 30), b = performed(1, 30), other = performed(2, 30);
  EXPECT_EQ(a.rotations, b.rotations);
  EXPECT_EQ(a.root_positions, b.root_positions);
  EXPECT_EQ(a.fragments, b.fragments);
  EXPECT_NE(a.fragments, other.fragments);
}

TEST(Player, StandsWhereItIsPut) {
  const auto c = gait_character();
  Player player(c);
  for (const double heading : {0.0, 2.0, -3.0}) {
    player.step(kForward, 1.3);
    player.reset({{3, -4}, heading});
    EXPECT_LT((player.frame().position - Vector2(3, -4)).norm(), 1e-9);
    EXPECT_NEAR(player.frame().heading, heading, 1e-9);
    EXPECT_LT((player.root_position().head<2>() - Vector2(3, -4)).norm(), 1e-9);
    const Fragment& f = c->pool.fragments[player.playing_fragment()];
    EXPECT_EQ(c->space.nearest(f.evident), c->space.nearest({}));
    const Kinematics kinematics(c->pool.skeleton);
    const CharacterFrame hips = kinematics.frame(player.root_position(), load_quaternion(player.rotations().data()));
    EXPECT_NEAR(std::remainder(hips.heading - heading, 2 * kPi), 0, 0.5);
  }
}

TEST(Player, StaysWhereItStandsWithoutACommand) {
  Player player(gait_character());
  player.reset({{1, 2}, 0.7});
  for (int i = 0; i < 300; ++i) player.step({}, 1.0 / 30);
  EXPECT_LT((player.frame().position - Vector2(1, 2)).norm(), 0.5);
}

TEST(Player, GoesForwardFromWhereItIsPut) {
  for (const double heading : {0.0, 1.5, -2.0}) {
    Player player(gait_character());
    player.reset({{0, 0}, heading});
    player.step(kForward, 1);
    Vector3 mean = Vector3::Zero();  // velocity in the character's own frame
    for (int i = 0; i < 80; ++i) {
      const CharacterFrame before = player.frame();
      player.step(kForward, 0.1);
      mean += before.to_local({player.frame().position.x(), player.frame().position.y(), 0}) / 8;
    }
    EXPECT_NEAR(mean.y(), 1.2, 0.3);
    EXPECT_NEAR(mean.x(), 0, 0.3);
  }
}

TEST(Player, GoesByStepsWithRestsOnBothFeetWhereItIsToGoSlowly) {
  constexpr double kRate = 60, kSlow = 0.25;  // frames a second, m/s
  Player player(gait_character());
  for (int i = 0; i < 2 * kRate; ++i) player.step({0, kSlow, 0, 0}, 1 / kRate);
  const double from = player.frame().position.y();
  int rests = 0;
  std::array<int, 2> swings{}, longest{};
  for (int i = 0; i < 10 * kRate; ++i) {
    player.step({0, kSlow, 0, 0}, 1 / kRate);
    const auto feet = player.standing_feet();
    rests += feet[0] && feet[1] ? 1 : 0;
    for (int side = 0; side < 2; ++side) {
      swings[side] = feet[side] ? 0 : swings[side] + 1;
      longest[side] = std::max(longest[side], swings[side]);
    }
  }
  EXPECT_NEAR(player.frame().position.y() - from, 10 * kSlow, 0.1);
  EXPECT_GT(rests, 0.4 * 10 * kRate);  // in the takes a fifth of the time
  for (const int swing : longest) {
    EXPECT_GT(swing, 0.3 * kRate);
    EXPECT_LT(swing, 0.7 * kRate);  // in the takes 0.4 s
  }
}

TEST(Player, MovesAndTurnsWithThePlaceWhereItStarts) {
  PlayerOptions at_once;  // for the command that is followed is rounded otherwise there
  at_once.responsiveness = 1;
  Player here(gait_character(), at_once), there(gait_character(), at_once);
  const CharacterFrame place{{10, -7}, 2.5};
  here.reset();
  there.reset(place);
  Random random(3);
  Control control;
  for (int i = 0; i < 300; ++i) {
    if (i % 30 == 0) control = gait_character()->space.point(random.below(kPaperPoints));
    here.step(control, 1.0 / 30);
    there.step(control, 1.0 / 30);
    ASSERT_LT((there.root_position() - place.to_world(here.root_position())).norm(), 1e-6) << i;
    ASSERT_EQ(there.playing_fragment(), here.playing_fragment());
  }
}

TEST(Player, GivesAFrameForEveryTickOfAnyRate) {
  const double rates[] = {24, 25, 29.97, 30, 60, 120, 7.3, 1};
  for (const double rate : rates) {
    for (const std::size_t controls : {1U, 13U, 50U}) {
      Player player(gait_character());
      const Performance p = perform(player, Trace(controls, kForward), rate);
      EXPECT_EQ(p.frames, static_cast<int>(std::lround(controls / 10.0 * rate)) + 1) << rate;
      EXPECT_EQ(p.rate, rate);
      EXPECT_EQ(p.root_positions.size(), std::size_t(3) * p.frames);
      EXPECT_EQ(p.rotations.size(), std::size_t(4) * p.frames * gait_character()->pool.skeleton.size());
      EXPECT_EQ(p.path.size(), std::size_t(3) * p.frames);
      EXPECT_EQ(p.classes.size(), std::size_t(p.frames));
      EXPECT_EQ(p.fragments.size(), std::size_t(p.frames));
    }
  }
}

TEST(Player, RefusesBadTimesRatesAndTraces) {
  const auto c = gait_character();
  const double nan = std::nan("");
  for (const double stitch : {-0.1, 1.5, nan})
    EXPECT_NE(error_of([&] { Player(c, {1, stitch}); }), "no error") << stitch;
  for (const double stitch : {0.0, 1.0}) EXPECT_EQ(error_of([&] { Player(c, {1, stitch}); }), "no error") << stitch;
  Player player(c);
  EXPECT_NE(error_of([&] { perform(player, {}, 30); }).find("no controls"), std::string::npos);
  for (const double rate : {0.0, -30.0, nan, 1e9})
    EXPECT_NE(error_of([&] { perform(player, Trace(5), rate); }).find("rate"), std::string::npos) << rate;
}

TEST(Player, RefusesStepsThatAreNoNumbers) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  Player player(gait_character());
  for (const double bad : {nan, infinity, -infinity}) {
    for (const Control& control : {Control{bad, 0, 0, 0}, {0, bad, 0, 0}, {0, 0, bad, 0}, {0, 0, 0, bad}})
      EXPECT_NE(error_of([&] { player.step(control, 0.1); }).find("not a number"), std::string::npos) << bad;
  }
  for (const double seconds : {-0.1, nan, infinity, -infinity, 1e9})
    EXPECT_NE(error_of([&] { player.step({}, seconds); }).find("step"), std::string::npos) << seconds;
  EXPECT_EQ(error_of([&] { player.step({}, 0); }), "no error");
}

TEST(Player, RefusesToStandWhereNoPlaceIs) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  Player player(gait_character());
  const Vector3 before = player.root_position();
  for (const double bad : {nan, infinity, -infinity, 1e308, -1.1e9}) {
    for (const CharacterFrame& frame : {CharacterFrame{{bad, 0}, 0}, {{0, bad}, 0}, {{0, 0}, bad}})
      EXPECT_NE(error_of([&] { player.reset(frame); }).find("to stand at"), std::string::npos) << bad;
  }
  EXPECT_EQ(player.root_position(), before);
  player.reset({{1e9, -1e9}, 1e9});
  for (int i = 0; i < 60; ++i) player.step(kForward, 1.0 / 30);
  EXPECT_TRUE(player.root_position().allFinite());
}

TEST(Player, IsCancelledByItsProgress) {
  Player player(gait_character());
  EXPECT_THROW(perform(player, Trace(500, kForward), 60, [](double f, const std::string&) { return f < 0.3; }),
               Cancelled);
}

TEST(Player, PlaysWithoutStitching) {
  Player player(gait_character(), {1, 0});
  for (int i = 0; i < 300; ++i) player.step(kForward, 1.0 / 30);
  EXPECT_TRUE(player.root_position().allFinite());
}

TEST(Player, RefusesWhatIsNoStepAndNoControl) {
  Player player(gait_character());
  for (const double much : {1.7e308, -1.1e6, std::numeric_limits<double>::infinity()}) {
    EXPECT_NE(error_of([&] { player.step({0, much, 0, 0}, kStep); }), "no error");
    EXPECT_NE(error_of([&] { player.step({0, 0, much, 0}, kStep); }), "no error");
    EXPECT_NE(error_of([&] { player.step(kForward, much); }), "no error");
  }
  for (const int control : {-1, kPaperPoints}) {
    EXPECT_EQ(error_of([&] { player.quality(control); }), "control " + std::to_string(control) + " does not exist");
  }
}

// Feet are locked and the heel rises, by legs whose toe is said to be the body's first bone.
TEST(Player, WalksOnLegsWhoseToeIsNoneOfTheirs) {
  Skeleton skeleton = humanoid();
  skeleton.roles.left_toe = skeleton.roles.right_toe = 0;
  BuildOptions options;
  options.classes = 10;
  options.policies = {"greedy"};
  const auto character = std::make_shared<const Character>(
      build(make_skeleton(skeleton), gait_takes(), {simulate_trace("walker", 10, 1, ControlSpace())}, options));
  Player player(character);
  player.stand_on([](const Vector3& from) { return GroundPoint{0.2 * from.y(), {0, -0.2, 1}}; });
  for (int f = 0; f < 240; ++f) {
    player.step({0, f < 120 ? 3.3 : -1.2, 0, 0}, kStep);
    for (const double value : player.rotations()) ASSERT_TRUE(std::isfinite(value)) << f;
    for (const auto& foot : player.standing_feet()) ASSERT_TRUE(!foot || foot->allFinite());
  }
}

}  // namespace
}  // namespace fragmotion
