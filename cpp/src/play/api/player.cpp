// SPDX-License-Identifier: MIT
#include <algorithm>

#include "api/handles.hpp"
#include "api/player_state_of.hpp"
#include "api/transforms.hpp"
#include "motion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kForeseen = 1.0 / 60;      // s of a step that is foreseen
constexpr double kAlmost = 1e-6;            // of a fixed step: less that it lacks is what sums of seconds are off
constexpr double kDirection = 1e-6;         // length of what says where to face, at least
constexpr std::uint32_t kStateVersion = 1;  // of what exchange() and PlayerState hold
constexpr char kStateMagic[9] = "FRAGSTAT";
constexpr std::size_t kStateHeader = 16, kStateEnd = 8;  // bytes: magic, version and size; hash
constexpr double kLongestCall = 3600;                    // s that a step may last, and plays
constexpr double kMostSteps = 64;                        // that a level of detail puts together

Eigen::Rotation2Dd turn_by(double heading) { return Eigen::Rotation2Dd(heading); }

double heading_of_way(const Vector3& way) { return std::atan2(-way.x(), way.y()); }

}  // namespace

Vector3 Shift::place(const Vector3& inside) const {
  if (none) return inside;
  const Vector2 turned = turn_by(heading) * Vector2{inside.head<2>()} + offset;
  return {turned.x(), turned.y(), inside.z() + lift};
}

Vector3 Shift::direction(const Vector3& inside) const {
  if (none) return inside;
  const Vector2 turned = turn_by(heading) * Vector2{inside.head<2>()};
  return {turned.x(), turned.y(), inside.z()};
}

Vector3 Shift::place_inside(const Vector3& outside) const {
  if (none) return outside;
  const Vector2 turned = turn_by(-heading) * Vector2{outside.head<2>() - offset};
  return {turned.x(), turned.y(), outside.z() - lift};
}

Vector3 Shift::direction_inside(const Vector3& outside) const {
  if (none) return outside;
  const Vector2 turned = turn_by(-heading) * Vector2{outside.head<2>()};
  return {turned.x(), turned.y(), outside.z()};
}

CharacterFrame Shift::frame(const CharacterFrame& inside) const {
  if (none) return inside;
  return {turn_by(heading) * inside.position + offset, inside.heading + heading};
}

PlayerOptions to_options(const FragmotionPlayerOptions& options) {
  PlayerOptions wanted;
  wanted.seed = options.seed;
  wanted.stitch = options.stitch;
  wanted.lock_feet = options.hold_feet != 0;
  wanted.stitching = options.cross_fades != 0 ? Stitching::crossfade : Stitching::inertialize;
  wanted.root_adjustment = options.root_adjustment;
  wanted.responsiveness = options.responsiveness;
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
      options(fragmotion_player_options()),
      steering(player.styled_character().space, hero->turns_well[0]) {
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
  report = {};
  take_pose(now);
  if (has_fixed_step()) before = between = now;
}

// The world inside is put where the character is to be.
void FragmotionPlayer::move_to(const FragmotionPlace& place) {
  const Vector3 to = hero->axes.place(place.position);
  const CharacterFrame inside = shown().frame;
  shift.none = false;
  shift.heading = std::remainder(hero->axes.yaw(static_cast<double>(place.heading)) - inside.heading, 2 * kPi);
  shift.offset = to.head<2>() - turn_by(shift.heading) * inside.position;
  shift.lift = to.z() - shown().level;
  if (route) route->follower.moved(frame());
}

Vector3 FragmotionPlayer::place() const {
  const Shown& pose = shown();
  return shift.place({pose.frame.position.x(), pose.frame.position.y(), pose.level});
}

FragmotionPlace FragmotionPlayer::theirs(const Vector3& place, double heading) const {
  FragmotionPlace found;
  hero->axes.write_place(place, found.position);
  found.heading = static_cast<float>(hero->axes.yaw(std::remainder(heading, 2 * kPi)));
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
  const bool faces = facing.head<2>().norm() > kDirection;
  switch (input.steer) {
    case FRAGMOTION_STEER_CHARACTER:
      return {axes.metres(static_cast<double>(input.move[0])), axes.metres(static_cast<double>(input.move[1])), turn,
              jump ? 1.0 : 0.0};
    case FRAGMOTION_STEER_WORLD: {
      const double off = std::remainder(heading_of_way(facing) - frame().heading, 2 * kPi);
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

void FragmotionPlayer::take_pose(Shown& pose) const {
  pose.root = player.root_position();
  pose.frame = player.frame();
  pose.level = player.ground_level();
  pose.rotations = player.rotations();
}

Vector3 FragmotionPlayer::sole(int side) const {
  const Roles& roles = hero->skeleton().roles;
  const int foot = side == 0 ? roles.left_foot : roles.right_foot, toe = side == 0 ? roles.left_toe : roles.right_toe;
  if (foot < 0) return now.root;
  world(now);
  const PosedBones& posed = scratch->posed;
  const Vector3 heel = posed.heads[foot], front = ball(hero->skeleton(), foot, toe, posed);
  const Vector3 middle = (heel + front) / 2;
  return {middle.x(), middle.y(), std::min(heel.z(), front.z())};
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
  const Control asked = control(input, seconds);
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

void FragmotionPlayer::step(const FragmotionInput& input, double seconds) {
  report.count = 0;
  report.motion = report.velocity = Vector3::Zero();
  report.turned = 0;
  const double played = std::min(seconds * options.time_scale, kLongestCall);
  const Vector3 from = place();
  const double faced = heading();
  if (has_fixed_step()) {
    const double step = options.fixed_step;
    banked += played;
    while (banked > step * (1 - kAlmost)) {
      std::swap(before, now);
      banked = std::max(0.0, banked - step);
      play(input, step);
    }
    interpolate();
  } else if (++left_out < options.step_interval) {
    banked = std::min(banked + played, kLongestCall);
    return;
  } else {
    left_out = 0;
    play(input, std::min(banked + played, kLongestCall));
    banked = 0;
  }
  const Vector3 way = place() - from;
  const Vector2 seen = turn_by(-faced) * Vector2{way.head<2>()};
  report.motion = {seen.x(), seen.y(), way.z()};
  report.turned = std::remainder(heading() - faced, 2 * kPi);
  if (seconds > 0) report.velocity = way / seconds;
}

void FragmotionPlayer::foresee(const FragmotionInput& input, double seconds, int count, FragmotionPlace* places) {
  std::vector<unsigned char>& state = scratch->state;
  const std::size_t size = save(state.data());
  for (int i = 0; i < count; ++i) {
    for (double rest = seconds / count; rest > kInstant; rest -= kForeseen) advance(input, std::min(rest, kForeseen));
    const CharacterFrame at = shift.frame(now.frame);
    const double level = now.level + shift.lift;
    places[i] = theirs({at.position.x(), at.position.y(), level}, at.heading);
  }
  StateReader reader(state.data() + kStateHeader, size - kStateHeader - kStateEnd);
  exchange(reader);
}

void FragmotionPlayer::world(const Shown& pose) const {
  PosedBones& posed = scratch->posed;
  hero->kinematics.world(pose.root, pose.rotations.data(), posed.heads.data(), posed.rotations.data());
}

// Of all bones of the character.
const std::vector<FragmotionTransform>& FragmotionPlayer::bones(FragmotionSpace space) const {
  const Shown& pose = shown();
  const Skeleton& skeleton = hero->skeleton();
  const Axes& axes = hero->axes;
  const std::vector<Vector3>& heads = scratch->posed.heads;
  const std::vector<Quaternion>& rotations = scratch->posed.rotations;
  std::vector<FragmotionTransform>& all = scratch->bones;
  world(pose);
  const Quaternion back = pose.frame.rotation().conjugate(), turn = CharacterFrame{{0, 0}, shift.heading}.rotation();
  const auto model = [&](int b) {
    const Vector3 from = heads[b] - Vector3{pose.frame.position.x(), pose.frame.position.y(), pose.level};
    return axes.global(back * from, back * rotations[b]);
  };
  for (int b = 0; b < hero->bones(); ++b) {
    const int parent = skeleton.parents[b];
    if (space == FRAGMOTION_SPACE_WORLD) {
      all[b] = axes.global(shift.place(heads[b]), shift.none ? rotations[b] : turn * rotations[b]);
    } else if (space == FRAGMOTION_SPACE_MODEL || parent < 0) {
      all[b] = model(b);
    } else if (hero->carried[b]) {
      const Quaternion above = rotations[parent].conjugate();
      all[b] = axes.local(above * (heads[b] - heads[parent]), above * rotations[b]);
    } else {
      all[b] = axes.local(skeleton.offsets[b], load_quaternion(&pose.rotations[std::size_t{4} * b]));
    }
  }
  return all;
}

void FragmotionPlayer::pose(const FragmotionRig* rig, FragmotionSpace space, FragmotionTransform* out) const {
  const bool fills = rig != nullptr && !rig->rest.empty() && !rig->parents.empty(),
             relates = fills && space == FRAGMOTION_SPACE_LOCAL && !rig->same_parents;
  const std::vector<FragmotionTransform>& all = bones(relates ? FRAGMOTION_SPACE_MODEL : space);
  if (rig == nullptr) {
    std::copy(all.begin(), all.end(), out);
    return;
  }
  for (std::size_t i = 0; i < rig->bones.size(); ++i) {
    const int bone = rig->bones[i];
    if (bone >= 0) {
      out[i] = all[bone];
    } else if (fills) {
      const bool alone = rig->parents[i] < 0 || (space == FRAGMOTION_SPACE_LOCAL && !relates);
      out[i] = alone ? rig->rest[i] : compose(out[rig->parents[i]], rig->rest[i]);
    }
  }
  if (!relates) return;
  for (std::size_t i = rig->bones.size(); i-- > 0;) {
    if (rig->parents[i] >= 0) out[i] = compose(inverse(out[rig->parents[i]]), out[i]);
  }
}

void FragmotionPlayer::skinning(const FragmotionRig& rig, FragmotionSpace space, float* matrices) const {
  const std::vector<FragmotionTransform>& all = bones(space);
  const bool fills = !rig.rest.empty() && !rig.parents.empty();
  // What of the rig is posed is kept as matrices at first, so that nothing more is needed for bones that rest.
  for (std::size_t i = 0; i < rig.bones.size(); ++i) {
    float* out = matrices + 16 * i;
    if (rig.bones[i] >= 0) {
      const Matrix16 posed = matrix_of(all[rig.bones[i]]);
      std::copy(posed.begin(), posed.end(), out);
    } else if (fills) {
      Matrix16 above{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
      if (rig.parents[i] >= 0) std::copy_n(matrices + 16 * rig.parents[i], 16, above.begin());
      multiply(above, matrix_of(rig.rest[i]), out);
    }
  }
  for (std::size_t i = 0; i < rig.bones.size(); ++i) {
    if (rig.bones[i] < 0 && !fills) continue;
    Matrix16 posed;
    std::copy_n(matrices + 16 * i, 16, posed.begin());
    multiply(posed, rig.inverse[i], matrices + 16 * i);
  }
}

namespace {

template <typename Archive>
void exchange_pose(Archive& a, Shown& pose) {
  for (int i = 0; i < 3; ++i) a.number(pose.root[i], -kMostPlace, kMostPlace);
  for (int i = 0; i < 2; ++i) a.number(pose.frame.position[i], -kMostPlace, kMostPlace);
  a.number(pose.frame.heading, -kMostPlace, kMostPlace);
  a.number(pose.level, -kMostPlace, kMostPlace);
  for (double& value : pose.rotations) a.number(value, -2, 2);
}

template <typename Archive>
void exchange_options(Archive& a, FragmotionPlayerOptions& options) {
  a.number(options.step_interval, 1, kMostSteps);
  a.bits(options.seed);
  for (double* part : {&options.responsiveness, &options.root_adjustment}) a.number(*part, 0, 1);
  const double stitch = a.told(options.stitch, 0, 1);
  demand(stitch == 0 || stitch >= kShortestStitch, FRAGMOTION_ERROR_REFUSED, "the state's stitch is %g s", stitch);
  if constexpr (Archive::kKeeps) options.stitch = stitch;
  a.number(options.time_scale, 0, 100);
  a.number(options.hold_feet, 0, 1);
}

}  // namespace

template <typename Archive>
void FragmotionPlayer::exchange(Archive& a) {
  a.same(hero->fingerprint, "of another character");
  std::uint64_t step = 0;
  std::memcpy(&step, &options.fixed_step, sizeof step);
  a.same(step, "of a player with another fixed_step");
  a.same(static_cast<std::uint64_t>(options.cross_fades), "of a player with other cross_fades");
  exchange_options(a, options);
  if constexpr (Archive::kKeeps) player.set_options(to_options(options));
  PlayerState::exchange(a, player);
  a.number(shift.none, 0, 1);
  a.number(shift.heading, -kMostPlace, kMostPlace);
  a.number(shift.lift, -kMostPlace, kMostPlace);
  for (int i = 0; i < 2; ++i) a.number(shift.offset[i], -kMostPlace, kMostPlace);
  const int last_style = hero->character->style_count() - 1;
  const int of_steering = a.told(steers_style, 0, last_style);
  if constexpr (Archive::kKeeps) {
    if (of_steering != steers_style) {
      steering = Steering(hero->character->in_style(of_steering).space, hero->turns_well[of_steering]);
      steers_style = of_steering;
    }
  }
  PlayerState::exchange(a, steering);
  a.number(arrived, 0, 1);
  a.number(banked, 0, has_fixed_step() ? options.fixed_step : kLongestCall);
  a.number(left_out, 0, kMostSteps);
  a.same(route ? route->fingerprint : 0, "of a player on another path");
  if (route) PlayerState::exchange(a, route->follower);
  exchange_pose(a, now);
  if (has_fixed_step()) {
    exchange_pose(a, before);
    exchange_pose(a, between);
  }
}

std::size_t FragmotionPlayer::save(unsigned char* bytes) const {
  StateWriter writer(bytes != nullptr ? bytes + kStateHeader : nullptr);
  const_cast<FragmotionPlayer*>(this)->exchange(writer);
  const std::size_t size = kStateHeader + writer.size() + kStateEnd;
  if (bytes == nullptr) return size;
  const std::uint32_t numbers[2] = {kStateVersion, static_cast<std::uint32_t>(writer.size())};
  const std::uint64_t hash = writer.hash();
  std::copy_n(kStateMagic, 8, bytes);
  std::memcpy(bytes + 8, numbers, 8);
  std::memcpy(bytes + size - kStateEnd, &hash, 8);
  return size;
}

std::uint64_t FragmotionPlayer::checksum() const {
  StateWriter writer;
  const_cast<FragmotionPlayer*>(this)->exchange(writer);
  return writer.hash();
}

void FragmotionPlayer::restore(const unsigned char* bytes, std::size_t size) {
  std::uint32_t numbers[2] = {0, 0};
  demand(size >= kStateHeader + kStateEnd && std::memcmp(bytes, kStateMagic, 8) == 0, FRAGMOTION_ERROR_REFUSED,
         "the bytes are no state of a player");
  std::memcpy(numbers, bytes + 8, 8);
  demand(numbers[0] <= kStateVersion, FRAGMOTION_ERROR_NEWER_VERSION,
         "the state is of version %u, newer than the %u that this library knows", static_cast<unsigned>(numbers[0]),
         static_cast<unsigned>(kStateVersion));
  demand(numbers[0] == kStateVersion, FRAGMOTION_ERROR_OLDER_VERSION, "the state is of the older version %u",
         static_cast<unsigned>(numbers[0]));
  const std::size_t payload = size - kStateHeader - kStateEnd;
  demand(numbers[1] == payload && payload % 8 == 0, FRAGMOTION_ERROR_REFUSED,
         "the state is cut short or has bytes too many");
  std::uint64_t hash = 0;
  std::memcpy(&hash, bytes + size - kStateEnd, 8);
  StateWriter again;
  for (std::size_t at = 0; at < payload; at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + kStateHeader + at, 8);
    again.bits(word);
  }
  demand(again.hash() == hash, FRAGMOTION_ERROR_REFUSED, "the state is damaged (checksum)");
  StateChecker checker(bytes + kStateHeader, payload);
  exchange(checker);
  demand(checker.done(), FRAGMOTION_ERROR_REFUSED, "the state has bytes too many");
  StateReader reader(bytes + kStateHeader, payload);
  exchange(reader);
  report = {};
}
