// SPDX-License-Identifier: MIT
#include <algorithm>

#include "api/handles.hpp"
#include "api/player_state.hpp"

namespace fragmotion {
namespace {

constexpr double kFarthestGame = 1e9;  // m of a place, and rad of a heading
constexpr double kMostForeseen = 60;   // s
constexpr int kMostPlaces = 100000;

FragmotionPlayer& alive(FragmotionPlayer* player) {
  demand_alive(player, Kind::player);
  return *player;
}
const FragmotionPlayer& alive(const FragmotionPlayer* player) {
  demand_alive(player, Kind::player);
  return *player;
}

void check_place(const FragmotionPlayer& player, const FragmotionPlace& place) {
  const Vector3 at = player.hero->axes.place(place.position);
  demand(at.cwiseAbs().maxCoeff() <= kFarthestGame && std::abs(static_cast<double>(place.heading)) <= kFarthestGame,
         FRAGMOTION_ERROR_ARGUMENT, "the place holds what is not a number, or is farther away than a million km");
}

void check_space(FragmotionSpace space, FragmotionSpace first) {
  demand(space >= first && space <= FRAGMOTION_SPACE_WORLD, FRAGMOTION_ERROR_ARGUMENT, "there is no space %d for this",
         static_cast<int>(space));
}

void check_rig(const FragmotionPlayer& player, const FragmotionRig* rig, const void* out, int count) {
  if (rig != nullptr) {
    demand_alive(rig, Kind::rig);
    demand(rig->hero == player.hero, FRAGMOTION_ERROR_ARGUMENT, "the rig is of another character");
  }
  demand_given(out, "the place for the pose");
  const int bones = rig != nullptr ? static_cast<int>(rig->bones.size()) : player.hero->bones();
  demand(count == bones, FRAGMOTION_ERROR_CAPACITY, "there is room for %d bones, and %d are to be written", count,
         bones);
}

// The ground of a host's, as the player inside asks for it.
Ground ground_of(const FragmotionPlayer* player) {
  return [player](const Vector3& from) -> std::optional<GroundPoint> {
    const Axes& axes = player->hero->axes;
    float asked[3];
    axes.write_place(player->shift.place(from), asked);
    FragmotionGroundHit hit{0, {0, 0, 0}};
    if (player->ground(player->ground_user, asked, &hit) == 0) return std::nullopt;
    return GroundPoint{axes.metres(static_cast<double>(hit.height)) - player->shift.lift,
                       player->shift.direction_inside(axes.ours(hit.normal))};
  };
}

std::uint64_t fingerprint_of(const FragmotionPath& path) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  const auto add = [&](const void* data, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      hash = (hash ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3ULL;
  };
  add(path.positions, sizeof(float) * 3 * static_cast<std::size_t>(path.points));
  if (path.speeds != nullptr) add(path.speeds, sizeof(float) * static_cast<std::size_t>(path.points));
  for (const int number : {path.closed, static_cast<int>(path.end)}) add(&number, sizeof number);
  for (const float number : {path.speed, path.arrive, path.facing[0], path.facing[1], path.facing[2]})
    add(&number, sizeof number);
  return hash | 1;
}

Route make_route(const FragmotionPlayer& player, const FragmotionPath& wanted) {
  const Axes& axes = player.hero->axes;
  demand_range("the number of the path's points", wanted.points, 2, kMostPathPoints);
  demand_given(wanted.positions, "the path's positions");
  demand(wanted.end >= FRAGMOTION_PATH_STAND && wanted.end <= FRAGMOTION_PATH_GO_ON, FRAGMOTION_ERROR_ARGUMENT,
         "there is no end %d of a path", static_cast<int>(wanted.end));
  std::vector<Vector2> points;
  std::vector<double> speeds;
  for (int i = 0; i < wanted.points; ++i) {
    points.emplace_back(axes.place(wanted.positions + std::ptrdiff_t{3} * i).head<2>());
    if (wanted.speeds != nullptr) speeds.push_back(axes.metres(static_cast<double>(wanted.speeds[i])));
  }
  FollowOptions options;
  options.speed = axes.metres(static_cast<double>(wanted.speed));
  options.arrive = static_cast<double>(wanted.arrive);
  options.end = static_cast<PathEnd>(wanted.end);
  const Vector3 facing = axes.ours(wanted.facing);
  demand(facing.allFinite(), FRAGMOTION_ERROR_ARGUMENT, "the path's facing holds what is not a number");
  if (facing.head<2>().norm() > 0) {
    options.facing = PathFacing::heading;
    options.heading = std::atan2(-facing.x(), facing.y());
  }
  return {PathFollower(player.space(), Path(points, wanted.closed != 0, speeds), options), fingerprint_of(wanted)};
}

template <typename T>
void write3(const Vector3& values, T* out) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<T>(values[i]);
}

void tell_state(const FragmotionPlayer& p, FragmotionState& state) {
  const Player& player = p.player;
  const auto [whole, upper] = player.playing_moves();
  const auto [next_whole, next_upper] = player.waiting_moves();
  const std::array<bool, 2> stands = PlayerState::standing_feet(player);
  state.style = p.style();
  state.waiting_style = player.waiting_style();
  state.playing_class = player.playing_class();
  state.whole_body_move = whole;
  state.upper_body_move = upper;
  state.waiting_whole_body_move = next_whole;
  state.waiting_upper_body_move = next_upper;
  for (std::size_t side = 0; side < 2; ++side) state.foot_stands[side] = stands[side] ? 1 : 0;
  state.in_the_air = player.playback().is_in_the_air() ? 1 : 0;
  state.path_arrived = p.arrived ? 1 : 0;
  state.place = p.theirs(p.place(), p.heading());
  const Axes& axes = p.hero->axes;
  axes.write_heading(std::remainder(p.heading(), 2 * kPi), state.rotation);
  axes.write_place(p.report.velocity, state.velocity);
  axes.write_place(p.report.motion, state.motion);
  state.motion_heading = static_cast<float>(axes.yaw(p.report.turned));
  state.ground_missed = static_cast<float>(player.ground_missed());
  state.path_way = p.route ? static_cast<float>(axes.length(p.route->follower.way())) : 0;
  state.path_seconds_left = p.route ? static_cast<float>(p.route->follower.seconds_left()) : 0;
}

std::unique_ptr<FragmotionPlayer> make_player(const std::shared_ptr<const Hero>& hero,
                                              const FragmotionPlayerOptions& options) {
  return std::make_unique<FragmotionPlayer>(hero, Player(hero->character, to_options(options)),
                                            std::make_shared<Scratch>(hero->bones()), options);
}

FragmotionPlayerOptions checked(const FragmotionPlayerOptions* options) {
  if (options == nullptr) return fragmotion_player_options();
  demand_struct(options, "the options");
  check_options(*options);
  return *options;
}

void make_crowd(const std::shared_ptr<const Hero>& hero, const FragmotionPlayerOptions& options, int count,
                FragmotionCrowd& crowd) {
  crowd.players.reserve(static_cast<std::size_t>(count));
  const std::int64_t players = count;
  for (int part = 0; part < crowd.parts; ++part) {
    const FragmotionPlayer* first = nullptr;
    while (static_cast<std::int64_t>(crowd.players.size()) < players * (part + 1) / crowd.parts) {
      FragmotionPlayerOptions own = options;
      own.seed += crowd.players.size();
      auto made = first == nullptr
                      ? make_player(hero, own)
                      : std::make_unique<FragmotionPlayer>(hero, first->player.branch(), first->scratch, own);
      if (first == nullptr) first = made.get();
      made->in_crowd = true;
      made->left_out = static_cast<std::uint32_t>(crowd.players.size()) % own.step_interval;
      list_alive(made.get(), Kind::player);
      crowd.players.push_back(std::move(made));
    }
  }
}

void step_part_of(FragmotionCrowd& crowd, int part, const FragmotionInput* inputs, double seconds) {
  const auto players = static_cast<std::int64_t>(crowd.players.size());
  for (std::int64_t i = players * part / crowd.parts; i < players * (part + 1) / crowd.parts; ++i) {
    crowd.players[static_cast<std::size_t>(i)]->step(inputs[i], seconds);
  }
}

void check_inputs(const FragmotionCrowd& crowd, const FragmotionInput* inputs, double seconds) {
  check_step_seconds(seconds);
  if (!crowd.players.empty()) demand_given(inputs, "the inputs");
  for (std::size_t i = 0; i < crowd.players.size(); ++i) check_input(inputs + i);
}

}  // namespace
}  // namespace fragmotion

using namespace fragmotion;

FragmotionResult fragmotion_player_create(const FragmotionCharacter* character, const FragmotionPlayerOptions* options,
                                          FragmotionPlayer** player) noexcept {
  return call("fragmotion_player_create", [&] {
    demand_given(player, "the place for the player");
    *player = nullptr;
    demand_alive(character, Kind::character);
    auto made = make_player(character->hero, checked(options));
    list_alive(made.get(), Kind::player);
    *player = made.release();
  });
}

void fragmotion_player_release(FragmotionPlayer* player) noexcept {
  if (player == nullptr) return;
  const FragmotionResult result = call("fragmotion_player_release", [&] {
    demand(!alive(player).in_crowd, FRAGMOTION_ERROR_ARGUMENT, "the player is a crowd's, and goes with it");
  });
  if (result != FRAGMOTION_OK) return;
  unlist_alive(player);
  delete player;
}

FragmotionResult fragmotion_player_set_options(FragmotionPlayer* player,
                                               const FragmotionPlayerOptions* options) noexcept {
  return call("fragmotion_player_set_options", [&] {
    demand_given(options, "the options");
    FragmotionPlayer& changed = alive(player);
    const FragmotionPlayerOptions wanted = checked(options);
    demand(wanted.cross_fades == changed.options.cross_fades, FRAGMOTION_ERROR_ARGUMENT,
           "cross_fades is chosen as a player is made: make another");
    changed.set_options(wanted);
  });
}

FragmotionResult fragmotion_player_options_of(const FragmotionPlayer* player,
                                              FragmotionPlayerOptions* options) noexcept {
  return call("fragmotion_player_options_of", [&] {
    demand_struct(options, "the options");
    *options = alive(player).options;
  });
}

FragmotionResult fragmotion_player_reset(FragmotionPlayer* player, const FragmotionPlace* place,
                                         std::int32_t style) noexcept {
  return call("fragmotion_player_reset", [&] {
    FragmotionPlayer& p = alive(player);
    if (place != nullptr) check_place(p, *place);
    demand_index("style", style, p.hero->character->style_count());
    p.reset(place, style);
  });
}

FragmotionResult fragmotion_player_move_to(FragmotionPlayer* player, const FragmotionPlace* place) noexcept {
  return call("fragmotion_player_move_to", [&] {
    FragmotionPlayer& p = alive(player);
    demand_given(place, "the place");
    check_place(p, *place);
    p.move_to(*place);
  });
}

FragmotionResult fragmotion_player_set_ground(FragmotionPlayer* player, FragmotionGround ground, void* user) noexcept {
  return call("fragmotion_player_set_ground", [&] {
    FragmotionPlayer& p = alive(player);
    p.ground = ground;
    p.ground_user = user;
    p.player.stand_on(ground != nullptr ? ground_of(&p) : Ground());
    p.make_room();
  });
}

FragmotionResult fragmotion_player_step(FragmotionPlayer* player, const FragmotionInput* input,
                                        double seconds) noexcept {
  return call("fragmotion_player_step", [&] {
    FragmotionPlayer& p = alive(player);
    check_input(input);
    check_step_seconds(seconds);
    p.step(*input, seconds);
  });
}

FragmotionResult fragmotion_player_start_move(FragmotionPlayer* player, std::int32_t move) noexcept {
  return call("fragmotion_player_start_move", [&] {
    FragmotionPlayer& p = alive(player);
    demand_index("move", move, static_cast<int>(p.hero->character->moves.size()));
    p.player.start_move(move);
  });
}

FragmotionResult fragmotion_player_release_move(FragmotionPlayer* player, std::int32_t move) noexcept {
  return call("fragmotion_player_release_move", [&] {
    FragmotionPlayer& p = alive(player);
    demand_index("move", move, static_cast<int>(p.hero->character->moves.size()));
    p.player.release_move(move);
  });
}

FragmotionResult fragmotion_player_change_style(FragmotionPlayer* player, std::int32_t style) noexcept {
  return call("fragmotion_player_change_style", [&] {
    FragmotionPlayer& p = alive(player);
    demand_index("style", style, p.hero->character->style_count());
    p.player.change_style(style);
  });
}

FragmotionResult fragmotion_player_look(FragmotionPlayer* player, FragmotionLook look, const float place[3]) noexcept {
  return call("fragmotion_player_look", [&] {
    FragmotionPlayer& p = alive(player);
    demand(look >= FRAGMOTION_LOOK_AS_CAPTURED && look <= FRAGMOTION_LOOK_AT, FRAGMOTION_ERROR_ARGUMENT,
           "there is no look %d", static_cast<int>(look));
    if (look != FRAGMOTION_LOOK_AT) return p.player.look(static_cast<Look>(look));
    demand_given(place, "the place to look at");
    const Vector3 there = p.hero->axes.place(place);
    demand(there.cwiseAbs().maxCoeff() <= kFarthestGame, FRAGMOTION_ERROR_ARGUMENT,
           "the place to look at holds what is not a number, or is farther away than a million km");
    p.player.look(Look::at, p.shift.place_inside(there));
  });
}

FragmotionResult fragmotion_player_force_class(FragmotionPlayer* player, std::int32_t index) noexcept {
  return call("fragmotion_player_force_class", [&] {
    FragmotionPlayer& p = alive(player);
    demand_index("class", index, p.player.styled_character().classes.count);
    p.player.force(index);
  });
}

FragmotionResult fragmotion_player_state(const FragmotionPlayer* player, FragmotionState* state) noexcept {
  return call("fragmotion_player_state", [&] {
    const FragmotionPlayer& p = alive(player);
    demand_struct(state, "the state");
    tell_state(p, *state);
  });
}

FragmotionResult fragmotion_player_events(const FragmotionPlayer* player, FragmotionEvent* events,
                                          std::int32_t capacity, std::int32_t* count) noexcept {
  return call("fragmotion_player_events", [&] {
    const FragmotionPlayer& p = alive(player);
    demand_given(count, "the place for the count");
    demand(capacity >= 0, FRAGMOTION_ERROR_ARGUMENT, "the capacity is %d", static_cast<int>(capacity));
    if (capacity > 0) demand_given(events, "the place for the events");
    *count = std::min(capacity, p.report.count);
    std::copy_n(p.report.events.begin(), *count, events);
  });
}

FragmotionResult fragmotion_player_pose(const FragmotionPlayer* player, const FragmotionRig* rig, FragmotionSpace space,
                                        FragmotionTransform* bones, std::int32_t count) noexcept {
  return call("fragmotion_player_pose", [&] {
    const FragmotionPlayer& p = alive(player);
    check_space(space, FRAGMOTION_SPACE_LOCAL);
    check_rig(p, rig, bones, count);
    p.pose(rig, space, bones);
  });
}

FragmotionResult fragmotion_player_skinning(const FragmotionPlayer* player, const FragmotionRig* rig,
                                            FragmotionSpace space, float* matrices, std::int32_t count) noexcept {
  return call("fragmotion_player_skinning", [&] {
    const FragmotionPlayer& p = alive(player);
    check_space(space, FRAGMOTION_SPACE_MODEL);
    demand_given(rig, "the rig");
    check_rig(p, rig, matrices, count);
    p.skinning(*rig, space, matrices);
  });
}

FragmotionResult fragmotion_player_foresee(FragmotionPlayer* player, const FragmotionInput* input, double seconds,
                                           std::int32_t count, FragmotionPlace* places) noexcept {
  return call("fragmotion_player_foresee", [&] {
    FragmotionPlayer& p = alive(player);
    check_input(input);
    demand_range("the seconds to foresee", seconds, 0, kMostForeseen);
    demand_range("the number of places", count, 1, kMostPlaces);
    demand_given(places, "the room for the places");
    p.foresee(*input, seconds, count, places);
  });
}

FragmotionResult fragmotion_player_set_path(FragmotionPlayer* player, const FragmotionPath* path) noexcept {
  return call("fragmotion_player_set_path", [&] {
    FragmotionPlayer& p = alive(player);
    if (path == nullptr) {
      p.route.reset();
    } else {
      demand_struct(path, "the path");
      p.route.emplace(make_route(p, *path));
    }
    p.arrived = false;
    p.make_room();
  });
}

std::size_t fragmotion_player_save_size(const FragmotionPlayer* player) noexcept {
  std::size_t size = 0;
  call("fragmotion_player_save_size", [&] { size = alive(player).save(nullptr); });
  return size;
}

FragmotionResult fragmotion_player_save(const FragmotionPlayer* player, void* bytes, std::size_t capacity,
                                        std::size_t* written) noexcept {
  return call("fragmotion_player_save", [&] {
    const FragmotionPlayer& p = alive(player);
    demand_given(bytes, "the room for the state");
    demand_given(written, "the place for the size");
    const std::size_t size = p.save(nullptr);
    demand(size <= capacity, FRAGMOTION_ERROR_CAPACITY, "there is room for %zu bytes, and %zu are to be written",
           capacity, size);
    *written = p.save(static_cast<unsigned char*>(bytes));
  });
}

FragmotionResult fragmotion_player_restore(FragmotionPlayer* player, const void* bytes, std::size_t size) noexcept {
  return call("fragmotion_player_restore", [&] {
    FragmotionPlayer& p = alive(player);
    demand_given(bytes, "the state");
    p.restore(static_cast<const unsigned char*>(bytes), size);
  });
}

FragmotionResult fragmotion_player_checksum(const FragmotionPlayer* player, std::uint64_t* checksum) noexcept {
  return call("fragmotion_player_checksum", [&] {
    const FragmotionPlayer& p = alive(player);
    demand_given(checksum, "the place for the checksum");
    *checksum = p.checksum();
  });
}

FragmotionResult fragmotion_crowd_create(const FragmotionCharacter* character, const FragmotionPlayerOptions* options,
                                         std::int32_t count, std::int32_t parts, FragmotionCrowd** crowd) noexcept {
  return call("fragmotion_crowd_create", [&] {
    demand_given(crowd, "the place for the crowd");
    *crowd = nullptr;
    demand_alive(character, Kind::character);
    demand_range("the number of a crowd's players", count, 0, 100000);
    demand(parts >= 1, FRAGMOTION_ERROR_ARGUMENT, "a crowd has 1 part or more, not %d", static_cast<int>(parts));
    auto made = std::make_unique<FragmotionCrowd>();
    made->parts = std::clamp(parts, 1, std::max(1, count));
    try {
      make_crowd(character->hero, checked(options), count, *made);
      list_alive(made.get(), Kind::crowd);
    } catch (...) {
      for (const auto& player : made->players) unlist_alive(player.get());
      throw;
    }
    *crowd = made.release();
  });
}

void fragmotion_crowd_release(FragmotionCrowd* crowd) noexcept {
  if (crowd == nullptr) return;
  if (call("fragmotion_crowd_release", [&] { demand_alive(crowd, Kind::crowd); }) != FRAGMOTION_OK) return;
  for (const auto& player : crowd->players) unlist_alive(player.get());
  unlist_alive(crowd);
  delete crowd;
}

std::int32_t fragmotion_crowd_count(const FragmotionCrowd* crowd) noexcept {
  std::int32_t count = 0;
  call("fragmotion_crowd_count", [&] {
    demand_alive(crowd, Kind::crowd);
    count = static_cast<std::int32_t>(crowd->players.size());
  });
  return count;
}

std::int32_t fragmotion_crowd_parts(const FragmotionCrowd* crowd) noexcept {
  std::int32_t parts = 0;
  call("fragmotion_crowd_parts", [&] {
    demand_alive(crowd, Kind::crowd);
    parts = crowd->parts;
  });
  return parts;
}

FragmotionPlayer* fragmotion_crowd_player(FragmotionCrowd* crowd, std::int32_t index) noexcept {
  FragmotionPlayer* player = nullptr;
  call("fragmotion_crowd_player", [&] {
    demand_alive(crowd, Kind::crowd);
    demand_index("player", index, static_cast<int>(crowd->players.size()));
    player = crowd->players[static_cast<std::size_t>(index)].get();
  });
  return player;
}

FragmotionResult fragmotion_crowd_step(FragmotionCrowd* crowd, const FragmotionInput* inputs, double seconds) noexcept {
  return call("fragmotion_crowd_step", [&] {
    demand_alive(crowd, Kind::crowd);
    check_inputs(*crowd, inputs, seconds);
    for (int part = 0; part < crowd->parts; ++part) step_part_of(*crowd, part, inputs, seconds);
  });
}

FragmotionResult fragmotion_crowd_step_part(FragmotionCrowd* crowd, std::int32_t part, const FragmotionInput* inputs,
                                            double seconds) noexcept {
  return call("fragmotion_crowd_step_part", [&] {
    demand_alive(crowd, Kind::crowd);
    demand_index("part", part, crowd->parts);
    check_inputs(*crowd, inputs, seconds);
    step_part_of(*crowd, part, inputs, seconds);
  });
}
