// SPDX-License-Identifier: MIT
#include <cmath>

#include "allocations.hpp"
#include "api_players.hpp"
#include "direct/steering.hpp"
#include "looking.hpp"
#include "runtime/player.hpp"

namespace fragmotion {
namespace {

constexpr double kGameFrame = 1.0 / 60;

Control control_of(const FragmotionInput& input) {
  return {input.move[0], input.move[1], input.turn, input.jump != 0 ? 1.0 : 0.0};
}

void expect_rotation(const float* theirs, const Quaternion& ours, int bone) {
  const double expected[] = {ours.x(), ours.y(), ours.z(), ours.w()};
  for (int i = 0; i < 4; ++i) ASSERT_EQ(theirs[i], static_cast<float>(expected[i])) << bone;
}

TEST(ApiPlayer, ShowsToTheBitWhatThePlayerInsideShows) {
  Player inside(std::make_shared<const Character>(from_bytes(to_bytes(*styled_character()))));
  const auto player = playing(styled_api_character());
  const Kinematics kinematics(inside.character().pool.skeleton);
  const int bones = kinematics.bones(), hips = kinematics.skeleton().roles.hips;
  PosedBones posed(bones);
  for (int frame = 0; frame < 900; ++frame) {
    if (frame == 450) {
      inside.stand_on([](const Vector3& from) {
        const float at[3] = {static_cast<float>(from.x()), static_cast<float>(from.y()), 0};
        FragmotionGroundHit hit;
        hills(nullptr, at, &hit);
        return std::optional<GroundPoint>({hit.height, {hit.normal[0], hit.normal[1], hit.normal[2]}});
      });
      expect_ok(fragmotion_player_set_ground(player.get(), &hills, nullptr));
    }
    press_wildly(player.get(), frame);
    press_wildly(
        frame, [&](int move) { inside.start_move(move); }, [&](int move) { inside.release_move(move); },
        [&](int style) { inside.change_style(style); });
    const FragmotionInput input = wild_input(frame);
    inside.step(control_of(input), kGameFrame);
    expect_ok(fragmotion_player_step(player.get(), &input, kGameFrame));
    kinematics.world(inside.root_position(), inside.rotations().data(), posed.heads.data(), posed.rotations.data());
    const auto world = pose_of(player.get(), FRAGMOTION_SPACE_WORLD, bones),
               local = pose_of(player.get(), FRAGMOTION_SPACE_LOCAL, bones);
    for (int b = 0; b < bones; ++b) {
      expect_rotation(world[b].rotation, posed.rotations[b], b);
      for (int i = 0; i < 3; ++i) ASSERT_EQ(world[b].position[i], static_cast<float>(posed.heads[b][i]));
      if (kinematics.skeleton().is_below(b, hips) && b != hips)
        expect_rotation(local[b].rotation, load_quaternion(&inside.rotations()[4 * static_cast<std::size_t>(b)]), b);
    }
    const FragmotionState state = state_of(player.get());
    ASSERT_EQ(state.place.position[0], static_cast<float>(inside.frame().position.x()));
    ASSERT_EQ(state.place.position[2], static_cast<float>(inside.ground_level()));
    ASSERT_LE(std::abs(state.place.heading), static_cast<float>(kPi)) << "within a turn";
    ASSERT_EQ(state.style, inside.playing_style());
    ASSERT_EQ(state.whole_body_move, inside.playing_moves()[0]);
    ASSERT_EQ(state.waiting_upper_body_move, inside.waiting_moves()[1]);
  }
}

TEST(ApiPlayer, AllocatesNothingAsItPlays) {
  const auto player = playing(styled_api_character());
  expect_ok(fragmotion_player_set_ground(player.get(), &hills, nullptr));
  const int bones = bones_of(styled_api_character());
  std::vector<FragmotionTransform> pose(static_cast<std::size_t>(bones));
  std::vector<unsigned char> bytes(fragmotion_player_save_size(player.get()));
  std::vector<FragmotionPlace> places(10);
  std::size_t written = 0;
  const std::size_t before = allocations;
  for (int frame = 0; frame < 600; ++frame) {
    press_wildly(player.get(), frame);
    const FragmotionInput input = wild_input(frame);
    expect_ok(fragmotion_player_step(player.get(), &input, kGameFrame));
    expect_ok(fragmotion_player_pose(player.get(), nullptr, FRAGMOTION_SPACE_MODEL, pose.data(), bones));
    state_of(player.get());
    expect_ok(fragmotion_player_save(player.get(), bytes.data(), bytes.size(), &written));
    expect_ok(fragmotion_player_restore(player.get(), bytes.data(), written));
    if (frame % 50 == 0) expect_ok(fragmotion_player_foresee(player.get(), &input, 0.5F, 10, places.data()));
  }
  EXPECT_EQ(allocations, before);
}

TEST(ApiPlayer, CrossFadesAsThePaperDoes) {
  FragmotionPlayerOptions options = fragmotion_player_options();
  options.cross_fades = 1;
  options.hold_feet = 0;
  const auto player = playing(styled_api_character(), options);
  PlayerOptions same;
  same.stitching = Stitching::crossfade;
  same.lock_feet = false;
  Player inside(std::make_shared<const Character>(from_bytes(to_bytes(*styled_character()))), same);
  for (int frame = 0; frame < 300; ++frame) {
    FragmotionInput input = fragmotion_input();
    input.move[1] = frame / 60 % 2 == 0 ? 1.2F : 0.0F;
    expect_ok(fragmotion_player_step(player.get(), &input, kGameFrame));
    inside.step(control_of(input), kGameFrame);
    ASSERT_EQ(state_of(player.get()).place.position[1], static_cast<float>(inside.frame().position.y()));
  }
}

TEST(ApiPlayer, ForeseesWithoutAChange) {
  const auto player = playing(styled_api_character());
  expect_ok(fragmotion_player_set_ground(player.get(), &hills, nullptr));
  const FragmotionInput input = wild_input(30);
  for (int frame = 0; frame < 300; ++frame) {
    press_wildly(player.get(), frame);
    const FragmotionInput before = wild_input(frame);
    expect_ok(fragmotion_player_step(player.get(), &before, kGameFrame));
  }
  const std::uint64_t checksum = checksum_of(player.get());
  const std::size_t events = events_of(player.get()).size();
  std::vector<FragmotionPlace> places(30);
  expect_ok(fragmotion_player_foresee(player.get(), &input, 0.5F, 30, places.data()));
  EXPECT_EQ(checksum_of(player.get()), checksum);
  EXPECT_EQ(events_of(player.get()).size(), events);
  for (const FragmotionPlace& place : places) {
    expect_ok(fragmotion_player_step(player.get(), &input, 1.0 / 60));
    EXPECT_NEAR(state_of(player.get()).place.position[0], place.position[0], 1e-4);
    EXPECT_NEAR(state_of(player.get()).place.position[1], place.position[1], 1e-4);
  }
}

// As on a lift, or a ship: all that it does is done elsewhere.
TEST(ApiPlayer, IsMovedWithAllThatItDoes) {
  const auto still = playing(styled_api_character()), moved = playing(styled_api_character());
  const int bones = bones_of(styled_api_character());
  for (int frame = 0; frame < 500; ++frame) {
    const FragmotionInput input = wild_input(frame);
    for (FragmotionPlayer* player : {still.get(), moved.get()}) {
      press_wildly(player, frame);
      expect_ok(fragmotion_player_step(player, &input, kGameFrame));
    }
    const auto a = pose_of(still.get(), FRAGMOTION_SPACE_MODEL, bones),
               b = pose_of(moved.get(), FRAGMOTION_SPACE_MODEL, bones);
    ASSERT_TRUE(same(a, b)) << frame;
    const FragmotionState was = state_of(still.get()), is = state_of(moved.get());
    for (int i = 0; i < 3; ++i) ASSERT_NEAR(was.motion[i], is.motion[i], 1e-5) << frame;
    if (frame % 100 == 50) {
      const FragmotionPlace place{{static_cast<float>(frame), -3, 7}, 2};
      expect_ok(fragmotion_player_move_to(moved.get(), &place));
      const FragmotionState there = state_of(moved.get());
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(there.place.position[i], place.position[i], 1e-5);
      EXPECT_NEAR(there.place.heading, 2, 1e-6);
      const auto world = pose_of(moved.get(), FRAGMOTION_SPACE_WORLD, bones);
      EXPECT_NEAR(world[0].position[2], 7 + b[0].position[2], 1e-5);
    }
  }
}

TEST(ApiPlayer, TellsWhatHappensWhereItHappens) {
  const auto player = playing(styled_api_character());
  std::array<int, 8> seen{};
  std::array<bool, 2> stands{};
  int steps = 0, high = 0;
  bool known = false;
  for (int frame = 0; frame < 1500; ++frame) {
    press_wildly(player.get(), frame);
    const FragmotionInput input = wild_input(frame);
    expect_ok(fragmotion_player_step(player.get(), &input, kGameFrame));
    const FragmotionState state = state_of(player.get());
    for (const FragmotionEvent& event : events_of(player.get())) {
      ++seen[event.type];
      if (event.type <= FRAGMOTION_EVENT_FOOT_UP) {
        const bool down = event.type == FRAGMOTION_EVENT_FOOT_DOWN;
        if (known) {
          EXPECT_NE(stands[event.index], down);
        }
        stands[event.index] = down;
        EXPECT_LT(std::hypot(event.position[0] - state.place.position[0], event.position[1] - state.place.position[1]),
                  1.2);
        steps += down ? 1 : 0;
        high += down && std::abs(event.position[2]) > 0.05F ? 1 : 0;
      }
      if (event.type == FRAGMOTION_EVENT_STYLE_CHANGES) {
        EXPECT_EQ(event.index, state.style);
      }
      if (event.type == FRAGMOTION_EVENT_MOVE_BEGINS) {
        EXPECT_TRUE(event.index == state.whole_body_move || event.index == state.upper_body_move);
      }
    }
    for (std::size_t side = 0; side < 2; ++side) {
      if (known) {
        ASSERT_EQ(state.foot_stands[side] != 0, stands[side]) << frame;
      }
      stands[side] = state.foot_stands[side] != 0;
    }
    known = true;
  }
  EXPECT_GT(steps, 30);
  EXPECT_LT(high, 0.1 * steps) << "on the ground, but for a few in the middle of a stitch";
  for (int type = FRAGMOTION_EVENT_FOOT_DOWN; type <= FRAGMOTION_EVENT_STYLE_CHANGES; ++type)
    EXPECT_GT(seen[type], 0) << type;
  EXPECT_LE(std::abs(seen[FRAGMOTION_EVENT_MOVE_BEGINS] - seen[FRAGMOTION_EVENT_MOVE_ENDS]), 2);
  EXPECT_LE(std::abs(seen[FRAGMOTION_EVENT_TAKE_OFF] - seen[FRAGMOTION_EVENT_LANDING]), 1);
}

TEST(ApiPlayer, IsSteeredByTheCameraAsTheSteeringInside) {
  const auto player = playing(styled_api_character());
  const auto character = std::make_shared<const Character>(from_bytes(to_bytes(*styled_character())));
  Player inside(character);
  Steering steering(character->space, turns_well(character));
  FragmotionInput input = fragmotion_input();
  input.steer = FRAGMOTION_STEER_CAMERA;
  for (int frame = 0; frame < 600; ++frame) {
    const double view = 0.5 * std::floor(frame / 90.0);
    input.facing[0] = static_cast<float>(-std::sin(view));
    input.facing[1] = static_cast<float>(std::cos(view));
    input.move[1] = frame / 60 % 3 == 2 ? 0 : 0.8F;
    const double seen = std::atan2(-static_cast<double>(input.facing[0]), static_cast<double>(input.facing[1]));
    inside.step(steering.control({input.move[0], input.move[1], 0, false}, inside.frame().heading, seen), kGameFrame);
    expect_ok(fragmotion_player_step(player.get(), &input, kGameFrame));
    ASSERT_EQ(state_of(player.get()).place.position[0], static_cast<float>(inside.frame().position.x())) << frame;
  }
  EXPECT_GT(inside.frame().position.norm(), 3);
}

TEST(ApiPlayer, GoesInTheWorldWhereItIsToldAndFacesWhatItIsTold) {
  const auto player = playing(styled_api_character());
  FragmotionInput input = fragmotion_input();
  input.steer = FRAGMOTION_STEER_WORLD;
  input.move[0] = -1.2F;
  input.facing[1] = -3;
  for (int frame = 0; frame < 300; ++frame) expect_ok(fragmotion_player_step(player.get(), &input, kGameFrame));
  const FragmotionState before = state_of(player.get());
  EXPECT_NEAR(std::abs(before.place.heading), kPi, 0.3);
  for (int frame = 0; frame < 120; ++frame) expect_ok(fragmotion_player_step(player.get(), &input, kGameFrame));
  const FragmotionState after = state_of(player.get());
  EXPECT_LT(after.place.position[0] - before.place.position[0], -1.2);
  EXPECT_LT(std::abs(after.place.position[1] - before.place.position[1]), 1);
}

TEST(ApiPlayer, GoesAlongAPathAndArrives) {
  const auto player = playing(styled_api_character());
  const float points[] = {0, 0, 0, 0, 3, 0, 2, 5, 0};
  FragmotionPath path = fragmotion_path();
  path.points = 3;
  path.positions = points;
  expect_ok(fragmotion_player_set_path(player.get(), &path));
  FragmotionInput input = fragmotion_input();
  input.steer = FRAGMOTION_STEER_PATH;
  int arrivals = 0;
  for (int frame = 0; frame < 900; ++frame) {
    expect_ok(fragmotion_player_step(player.get(), &input, kGameFrame));
    for (const FragmotionEvent& event : events_of(player.get()))
      arrivals += event.type == FRAGMOTION_EVENT_PATH_ARRIVED ? 1 : 0;
  }
  const FragmotionState state = state_of(player.get());
  EXPECT_GE(arrivals, 1);
  EXPECT_EQ(state.path_arrived, 1);
  EXPECT_LT(std::hypot(state.place.position[0] - 2, state.place.position[1] - 5), 0.5);
  EXPECT_GT(state.path_way, 5);
  expect_ok(fragmotion_player_set_path(player.get(), nullptr));
  expect_ok(fragmotion_player_step(player.get(), &input, kGameFrame));
}

// The frame rate of the game changes nothing but how often it looks.
TEST(ApiPlayer, GoesTheSameWayAtAnyFrameRateByFixedSteps) {
  for (const double step : {1.0 / 60, 1.0 / 45}) {
    FragmotionPlayerOptions options = fragmotion_player_options();
    options.fixed_step = step;
    std::vector<std::vector<FragmotionPlace>> ways;
    for (const int rate : {30, 60, 120}) {
      const auto player = playing(styled_api_character(), options);
      std::vector<FragmotionPlace>& way = ways.emplace_back();
      for (int frame = 0; frame < 30 * rate; ++frame) {
        const FragmotionInput input = wild_input(60 * frame / rate / 2 * 2);
        expect_ok(fragmotion_player_step(player.get(), &input, 1.0 / rate));
        if ((frame + 1) % (rate / 30) == 0) way.push_back(state_of(player.get()).place);
      }
    }
    for (std::size_t i = 0; i < ways[0].size(); ++i) {
      for (const auto& way : ways) {
        for (int axis = 0; axis < 2; ++axis) ASSERT_NEAR(way[i].position[axis], ways[0][i].position[axis], 1e-4) << i;
      }
    }
  }
}

TEST(ApiPlayer, PausesAndIsSlowedDown) {
  FragmotionPlayerOptions options = fragmotion_player_options();
  const auto quick = playing(styled_api_character()), slow = playing(styled_api_character());
  options.time_scale = 0.5F;
  expect_ok(fragmotion_player_set_options(slow.get(), &options));
  for (int frame = 0; frame < 200; ++frame) {
    const FragmotionInput input = wild_input(frame);
    expect_ok(fragmotion_player_step(quick.get(), &input, kGameFrame));
    expect_ok(fragmotion_player_step(slow.get(), &input, 2 * kGameFrame));
  }
  const float way = state_of(quick.get()).place.position[1];
  EXPECT_EQ(state_of(slow.get()).place.position[1], way);
  options.time_scale = 0;
  expect_ok(fragmotion_player_set_options(slow.get(), &options));
  const FragmotionInput input = wild_input(9);
  for (int frame = 0; frame < 20; ++frame) expect_ok(fragmotion_player_step(slow.get(), &input, kGameFrame));
  EXPECT_EQ(state_of(slow.get()).place.position[1], way);
  EXPECT_EQ(state_of(slow.get()).velocity[1], 0);
}

TEST(ApiPlayer, TakesOptionsWhileItPlays) {
  const auto lazy = playing(styled_api_character()), quick = playing(styled_api_character());
  FragmotionPlayerOptions options = fragmotion_player_options();
  options.responsiveness = 0.1F;
  expect_ok(fragmotion_player_set_options(lazy.get(), &options));
  options.responsiveness = 1;
  expect_ok(fragmotion_player_set_options(quick.get(), &options));
  FragmotionPlayerOptions told = fragmotion_player_options();
  expect_ok(fragmotion_player_options_of(quick.get(), &told));
  EXPECT_EQ(told.responsiveness, 1);
  FragmotionInput input = fragmotion_input();
  input.move[1] = 3;
  for (int frame = 0; frame < 40; ++frame) {
    for (FragmotionPlayer* player : {lazy.get(), quick.get()})
      expect_ok(fragmotion_player_step(player, &input, kGameFrame));
  }
  EXPECT_GT(state_of(quick.get()).place.position[1], state_of(lazy.get()).place.position[1] + 0.2F);
}

TEST(ApiPlayer, OfACrowdShowsWhatItShowsAlone) {
  FragmotionPlayerOptions options = fragmotion_player_options();
  options.seed = 5;
  FragmotionCrowd* made = nullptr;
  expect_ok(fragmotion_crowd_create(&styled_api_character(), &options, 7, 3, &made));
  const Held<FragmotionCrowd> crowd(made);
  EXPECT_EQ(fragmotion_crowd_count(crowd.get()), 7);
  EXPECT_EQ(fragmotion_crowd_parts(crowd.get()), 3);
  std::vector<Held<FragmotionPlayer>> alone;
  for (int i = 0; i < 7; ++i, ++options.seed) alone.push_back(playing(styled_api_character(), options));
  const int bones = bones_of(styled_api_character());
  std::vector<FragmotionInput> inputs(7, fragmotion_input());
  for (int frame = 0; frame < 300; ++frame) {
    for (int i = 0; i < 7; ++i) {
      inputs[i] = wild_input(frame + 37 * i);
      press_wildly(alone[i].get(), frame + i);
      press_wildly(fragmotion_crowd_player(crowd.get(), i), frame + i);
      expect_ok(fragmotion_player_step(alone[i].get(), &inputs[i], kGameFrame));
    }
    for (const int part : {2, 0, 1})
      expect_ok(fragmotion_crowd_step_part(crowd.get(), part, inputs.data(), kGameFrame));
    for (int i = 0; i < 7; ++i) {
      const FragmotionPlayer* member = fragmotion_crowd_player(crowd.get(), i);
      ASSERT_TRUE(
          same(pose_of(member, FRAGMOTION_SPACE_WORLD, bones), pose_of(alone[i].get(), FRAGMOTION_SPACE_WORLD, bones)));
      ASSERT_EQ(checksum_of(member), checksum_of(alone[i].get()));
    }
  }
}

TEST(ApiPlayer, FarAwayIsPlayedAtFewerSteps) {
  FragmotionPlayerOptions options = fragmotion_player_options();
  options.step_interval = 4;
  const auto player = playing(styled_api_character(), options);
  FragmotionInput input = fragmotion_input();
  input.move[1] = 1.2F;
  int moved = 0;
  float before = 0;
  for (int frame = 0; frame < 240; ++frame) {
    expect_ok(fragmotion_player_step(player.get(), &input, kGameFrame));
    const float now = state_of(player.get()).place.position[1];
    moved += now != before ? 1 : 0;
    before = now;
  }
  EXPECT_NEAR(moved, 60, 3);
  EXPECT_GT(before, 2.5);
}

// In the engine's axes and unit, also of one that something has put elsewhere meanwhile.
TEST(ApiPlayer, LooksAtAPlaceOfTheWorld) {
  const auto character = loaded(*looking_character(), FRAGMOTION_AXES_GLTF, 100);
  const auto player = playing(*character);
  const int head = looking_character()->pool.skeleton.roles.head, bones = bones_of(*character);
  const FragmotionInput stands = fragmotion_input();
  const FragmotionPlace there{{500, 0, -700}, 0.4F};
  const float place[] = {450, 150, -1000};
  expect_ok(fragmotion_player_look(player.get(), FRAGMOTION_LOOK_AT, place));
  for (int frame = 0; frame < 240; ++frame) {
    if (frame == 60) expect_ok(fragmotion_player_move_to(player.get(), &there));
    expect_ok(fragmotion_player_step(player.get(), &stands, kGameFrame));
  }
  const FragmotionTransform seen = pose_of(player.get(), FRAGMOTION_SPACE_WORLD, bones)[head];
  const Eigen::Quaternionf rotation(seen.rotation[3], seen.rotation[0], seen.rotation[1], seen.rotation[2]);
  FragmotionBone bone = fragmotion_bone();
  expect_ok(fragmotion_character_bone(character.get(), head, &bone));
  const Eigen::Vector3f looks = rotation * looks_in({&looking_character()->pool}).gaze.forward.cast<float>(),
                        eyes = Eigen::Vector3f::Map(seen.position) +
                               rotation * (looking_character()->pool.skeleton.tips[head] * 50).cast<float>();
  EXPECT_GT(looks.dot((Eigen::Vector3f::Map(place) - eyes).normalized()), 0.9999F);
}

// Likewise, and of what is carried along.
TEST(ApiPlayer, ReachesForAPlaceOfTheWorld) {
  const auto character = loaded(*looking_character(), FRAGMOTION_AXES_GLTF, 100);
  const auto player = playing(*character);
  const Arm arm = resting_arms(looking_character()->pool.skeleton)[0];
  const FragmotionInput stands = fragmotion_input();
  const FragmotionPlace there{{500, 0, -700}, 0.4F};
  const auto hand = [&] {
    const FragmotionTransform seen = pose_of(player.get(), FRAGMOTION_SPACE_WORLD, bones_of(*character))[arm.hand];
    const Eigen::Quaternionf rotation(seen.rotation[3], seen.rotation[0], seen.rotation[1], seen.rotation[2]);
    const Vector3 tip = looking_character()->pool.skeleton.tips[arm.hand] * 50;
    return Eigen::Vector3f(Eigen::Vector3f::Map(seen.position) + rotation * tip.cast<float>());
  };
  FragmotionReach held{{-20, 40, 120}, 1, 1};  // to the right, forward, up
  expect_ok(fragmotion_player_reach(player.get(), FRAGMOTION_LEFT_HAND, &held));
  const auto play = [&](int frames) {
    for (int frame = 0; frame < frames; ++frame) expect_ok(fragmotion_player_step(player.get(), &stands, kGameFrame));
  };
  play(90);
  EXPECT_NEAR(hand().y(), 120, 0.1F);
  const Eigen::Vector3f place = hand() + Eigen::Vector3f{3, 5, 2};
  held.carried = 0;
  for (int i = 0; i < 3; ++i) held.place[i] = place[i];
  expect_ok(fragmotion_player_reach(player.get(), FRAGMOTION_LEFT_HAND, &held));
  play(90);
  EXPECT_LT((hand() - place).norm(), 0.1F);  // cm
  expect_ok(fragmotion_player_move_to(player.get(), &there));
  play(90);
  EXPECT_GT((hand() - place).norm(), 100);
  const FragmotionPlace back{{0, 0, 0}, 0};
  expect_ok(fragmotion_player_move_to(player.get(), &back));
  play(90);
  EXPECT_LT((hand() - place).norm(), 0.1F);
  expect_ok(fragmotion_player_reach(player.get(), FRAGMOTION_LEFT_HAND, nullptr));
  play(90);
  EXPECT_GT((hand() - place).norm(), 10);
}

}  // namespace
}  // namespace fragmotion
