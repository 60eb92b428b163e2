// SPDX-License-Identifier: MIT
#include <algorithm>

#include "api/handles.hpp"
#include "api/player_state_of.hpp"
#include "base/rounding.hpp"
#include "motion/pose.hpp"

namespace fragmotion {
namespace {

double heading_of_way(const Vector3& way) { return std::atan2(-way.x(), way.y()); }

}  // namespace

PlayerOptions to_options(const FragmotionPlayerOptions& options) {
  PlayerOptions wanted;
  wanted.seed = options.seed;
  wanted.stitch = options.stitch;
  wanted.lock_feet = options.hold_feet != 0;
  wanted.stitching = options.cross_fades != 0 ? Stitching::crossfade : Stitching::inertialize;
  wanted.root_adjustment = options.root_adjustment;
  wanted.responsiveness = options.responsiveness;
  wanted.far_away = options.step_interval > 1 && options.hold_feet == 0;
  return wanted;
}

void check_options(const FragmotionPlayerOptions& options) {
  demand_range("step_interval", options.step_interval, 1, kMostSteps);
  demand_range("responsiveness", options.responsiveness, 0, 1);
  demand_range("root_adjustment", options.root_adjustment, 0, 1);
  if (options.stitch != 0) demand_range("stitch", options.stitch, kShortestStitch, 1);
  demand_range("time_scale", options.time_scale, 0, 100);
  demand_range("hold_feet", options.hold_feet, 0, 1);
  demand_range("cross_fades", options.cross_fades, 0, 1);
  if (options.fixed_step != 0) demand_range("fixed_step", options.fixed_step, 0.001, 1);
}

void check_input(const FragmotionInput* input) {
  demand_struct(input, "the input");
  demand(input->steer >= FRAGMOTION_STEER_CHARACTER && input->steer <= FRAGMOTION_STEER_PATH, FRAGMOTION_ERROR_ARGUMENT,
         "there is no way %d to steer", static_cast<int>(input->steer));
  for (int i = 0; i < 3; ++i) {
    demand(std::abs(input->move[i]) <= kMostControl && std::abs(input->facing[i]) <= kMostControl,
           FRAGMOTION_ERROR_ARGUMENT, "the input's move or facing holds what is not a number, or beyond a million");
  }
  demand_range("the input's turn", static_cast<double>(input->turn), -kMostTurn, kMostTurn);
}

void check_step_seconds(double seconds) { demand_range("the seconds of a step", seconds, 0, kLongestCall); }

}  // namespace fragmotion

using namespace fragmotion;

FragmotionPlayer::FragmotionPlayer(std::shared_ptr<const Hero> of, Player&& made, std::shared_ptr<Scratch> room,
                                   const FragmotionPlayerOptions& wanted)
    : hero(std::move(of)),
      player(std::move(made)),
      scratch(std::move(room)),
      steering(player.styled_character().space, hero->turns_well[0]),
      options(fragmotion_player_options()) {
  set_options(wanted);
  reset(nullptr, 0);
  make_room();
}

// For the state, as large as it is now.
void FragmotionPlayer::make_room() {
  if (scratch->state.size() < save(nullptr)) scratch->state.resize(save(nullptr));
}

void FragmotionPlayer::set_options(const FragmotionPlayerOptions& wanted) {
  player.set_options(to_options(wanted));
  player.reseed(wanted.seed);
  const bool begins_fixed = wanted.fixed_step > 0 && !has_fixed_step();
  if (begins_fixed) before = between = now;
  options = wanted;
  if (!has_fixed_step() && wanted.step_interval == 1) banked = 0;
  make_room();
}

void FragmotionPlayer::reset(const FragmotionPlace* place, int style) {
  CharacterFrame at;
  double height = 0;
  if (place != nullptr) {
    const Vector3 ours = hero->axes.place(place->position);
    at = {ours.head<2>(), hero->axes.yaw(static_cast<double>(place->heading))};
    height = ours.z();
  }
  shift = {};
  if (ground == nullptr && height != 0) {
    shift.none = false;
    shift.lift = height;
  }
  player.reset(at, style);
  steering = Steering(space(), hero->turns_well[style]);
  steers_style = style;
  route.reset();
  arrived = false;
  banked = 0;
  left_out = 0;
  way_round = {};
  report = {};
  take_pose(now);
  if (has_fixed_step()) before = between = now;
}

// The world inside is put where the character is to be.
void FragmotionPlayer::move_to(const FragmotionPlace& place) {
  const Vector3 to = hero->axes.place(place.position);
  const CharacterFrame inside = shown().frame;
  const Vector3 looked_at = shift.place(player.gaze().place());
  std::array<HandAim, 2> aims{player.reaching().aim(0), player.reaching().aim(1)};
  for (HandAim& aim : aims) {
    if (!aim.carried) aim.place = shift.place(aim.place);
  }
  shift.none = false;
  shift.heading = wrapped(hero->axes.yaw(static_cast<double>(place.heading)) - inside.heading);
  shift.offset = to.head<2>() - turn_by(shift.heading) * inside.position;
  shift.lift = to.z() - shown().level;
  player.look(player.gaze().looks(), shift.place_inside(looked_at));
  player.forget_ground();
  for (int hand = 0; hand < 2; ++hand) {
    if (!aims[hand].carried) aims[hand].place = shift.place_inside(aims[hand].place);
    player.reach(hand, aims[hand]);
  }
  if (route) route->follower.moved(frame());
}

Vector3 FragmotionPlayer::place() const {
  const Shown& pose = shown();
  return shift.place({pose.frame.position.x(), pose.frame.position.y(), pose.level});
}

FragmotionPlace FragmotionPlayer::theirs(const Vector3& place, double heading) const {
  FragmotionPlace found;
  hero->axes.write_place(place, found.position);
  found.heading = static_cast<float>(hero->axes.yaw(wrapped(heading)));
  return found;
}

Steering& FragmotionPlayer::steers() {
  if (steers_style != style()) {
    steers_style = style();
    steering = Steering(space(), hero->turns_well[steers_style]);
  }
  return steering;
}

// The control for a velocity in the world.
Control FragmotionPlayer::towards(const Vector3& velocity, double turn, bool jump) const {
  const Vector2 local = turn_by(-frame().heading) * Vector2{velocity.head<2>()};
  return {local.x(), local.y(), turn, jump ? 1.0 : 0.0};
}

Control FragmotionPlayer::control(const FragmotionInput& input, double seconds) {
  const Axes& axes = hero->axes;
  const auto turn = static_cast<double>(input.turn);
  const bool jump = input.jump != 0;
  const Vector3 facing = axes.ours(input.facing);
  const bool faces = facing.head<2>().norm() > kFloatRounding;
  switch (input.steer) {
    case FRAGMOTION_STEER_CHARACTER:
      return {axes.metres(static_cast<double>(input.move[0])), axes.metres(static_cast<double>(input.move[1])), turn,
              jump ? 1.0 : 0.0};
    case FRAGMOTION_STEER_WORLD: {
      const double off = wrapped(heading_of_way(facing) - frame().heading);
      const double asked = turn == 0 && faces ? space().turn_towards(off) : turn;
      return towards(axes.place(input.move), asked, jump);
    }
    case FRAGMOTION_STEER_CAMERA: {
      const StickIntent intent{static_cast<double>(input.move[0]), static_cast<double>(input.move[1]), turn, jump};
      const auto view = faces ? std::optional<double>(heading_of_way(facing)) : std::nullopt;
      return steers().control(intent, frame().heading, view);
    }
    default: {
      Control along = route ? route->follower.steer(frame(), seconds) : Control{0, 0, turn, 0};
      along.jump = jump ? 1 : 0;
      return along;
    }
  }
}

// Who stands may be asked to walk.
void FragmotionPlayer::keep_clear(Control& control, double seconds) {
  const Matrix2 turn = turn_by(frame().heading).matrix();
  const Vector2 wanted = turn * Vector2{control.x, control.y};
  const double most = std::max(wanted.norm(), space().walk());
  const Vector2 clear = turn.transpose() * way_round.choose(*clearance, wanted, most, seconds);
  control.x = clear.x();
  control.y = clear.y();
}

void FragmotionPlayer::take_pose(Shown& pose) const {
  pose.root = player.root_position();
  pose.frame = player.frame();
  pose.level = player.ground_level();
  pose.rotations = player.rotations();
}

Vector3 FragmotionPlayer::sole(int side) const {
  const LegRoles leg = leg_roles(hero->skeleton().roles)[side];
  if (leg.foot < 0) return now.root;
  PosedBones& posed = scratch->posed;
  hero->kinematics.world(now.root, now.rotations.data(), hero->leg_bones[side], posed.heads.data(),
                         posed.rotations.data());
  return fragmotion::sole(hero->skeleton(), leg, scratch->posed);
}

void FragmotionPlayer::tell(FragmotionEventType type, int index, const Vector3& inside, double ago) {
  if (report.count == FRAGMOTION_MOST_EVENTS) return;
  FragmotionEvent& event = report.events[report.count++];
  event.type = type;
  event.index = index;
  hero->axes.write_place(shift.place(inside), event.position);
  event.seconds = static_cast<float>(ago);
}

// Plays on by so much, and takes the pose.
void FragmotionPlayer::advance(const FragmotionInput& input, double seconds) {
  Control asked = control(input, seconds);
  if (clearance) keep_clear(asked, seconds);
  player.step(asked, seconds);
  take_pose(now);
}

// The same, and tells what happens.
void FragmotionPlayer::play(const FragmotionInput& input, double seconds) {
  const auto feet = [&] { return PlayerState::standing_feet(player); };
  const std::array<bool, 2> stood = feet();
  const std::array<int, 2> moved = player.playing_moves();
  const bool flew = player.playback().is_in_the_air(), was_there = arrived;
  const int style_before = style();
  advance(input, seconds);
  const Vector3 here{now.frame.position.x(), now.frame.position.y(), now.level};
  const double ago = has_fixed_step() ? banked : 0;
  const std::array<bool, 2> stands = feet();
  for (int side = 0; side < 2; ++side) {
    if (stands[side] != stood[side])
      tell(stands[side] ? FRAGMOTION_EVENT_FOOT_DOWN : FRAGMOTION_EVENT_FOOT_UP, side, sole(side), ago);
  }
  const bool flies = player.playback().is_in_the_air();
  if (flies != flew) tell(flies ? FRAGMOTION_EVENT_TAKE_OFF : FRAGMOTION_EVENT_LANDING, 0, here, ago);
  const std::array<int, 2> moves = player.playing_moves();
  for (int track = 0; track < 2; ++track) {
    if (moves[track] == moved[track]) continue;
    if (moved[track] >= 0) tell(FRAGMOTION_EVENT_MOVE_ENDS, moved[track], here, ago);
    if (moves[track] >= 0) tell(FRAGMOTION_EVENT_MOVE_BEGINS, moves[track], here, ago);
  }
  if (style() != style_before) tell(FRAGMOTION_EVENT_STYLE_CHANGES, style(), here, ago);
  for (const PassedMarkers& passed : player.passed_markers()) {
    for (const Marker* marker : passed) {
      tell(FRAGMOTION_EVENT_MARKER, hero->find_marker(marker->name), here, ago);
    }
  }
  arrived = route && route->follower.stands() && input.steer == FRAGMOTION_STEER_PATH;
  if (arrived && !was_there) tell(FRAGMOTION_EVENT_PATH_ARRIVED, 0, here, ago);
}

// Shows what lies between the last two poses of a fixed step.
void FragmotionPlayer::interpolate() {
  const double share = std::clamp(banked / options.fixed_step, 0.0, 1.0);
  between.root = before.root + share * (now.root - before.root);
  between.frame.position = before.frame.position + share * (now.frame.position - before.frame.position);
  between.frame.heading = before.frame.heading + share * (now.frame.heading - before.frame.heading);
  between.level = before.level + share * (now.level - before.level);
  blend_rotations(before.rotations.data(), now.rotations.data(), share, hero->bones(), between.rotations.data());
}

// What tells whether its next step is left out, which is all that such a step needs of it.
void FragmotionPlayer::prefetch_turn() const { prefetch_between(&options, &report.events); }

// What its next step needs of it, unless that is left out.
void FragmotionPlayer::prefetch() const {
  if (!has_fixed_step() && left_out + 1 < options.step_interval) return;
  player.prefetch();
  prefetch_between(&scratch, &options);
  fragmotion::prefetch(now.rotations.data(), now.rotations.size());
}

void FragmotionPlayer::step(const FragmotionInput& input, double seconds) {
  report.count = 0;
  report.motion = report.velocity = Vector3::Zero();
  report.turned = 0;
  const double played = std::min(seconds * options.time_scale, kLongestCall);
  if (!has_fixed_step() && ++left_out < options.step_interval) {
    banked = std::min(banked + played, kLongestCall);
    return;
  }
  const Vector3 from = place();
  const double faced = heading();
  if (has_fixed_step()) {
    const double step = options.fixed_step;
    banked += played;
    while (banked > step * (1 - kFloatRounding)) {
      std::swap(before, now);
      banked = std::max(0.0, banked - step);
      play(input, step);
    }
    interpolate();
  } else {
    left_out = 0;
    play(input, std::min(banked + played, kLongestCall));
    banked = 0;
  }
  clearance.reset();
  const Vector3 way = place() - from;
  const Vector2 seen = turn_by(-faced) * Vector2{way.head<2>()};
  report.motion = {seen.x(), seen.y(), way.z()};
  report.turned = wrapped(heading() - faced);
  if (seconds > 0) report.velocity = way / seconds;
}
