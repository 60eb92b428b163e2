// SPDX-License-Identifier: MIT
#include <algorithm>

#include "api/handles.hpp"
#include "api/player_state.hpp"
#include "base/ranges.hpp"

namespace fragmotion {
namespace {

constexpr double kMostForeseen = 60;  // s
constexpr int kMostPlaces = 100000;

// No farther away than is allowed, and numbers: which the greatest of coordinates would not tell.
bool is_place(const Vector3& at) { return (at.array().abs() <= kFarthestPlace).all(); }

void check_place(const FragmotionPlayer& player, const FragmotionPlace& place) {
  const Vector3 at = player.hero->axes.place(place.position);
  demand(is_place(at) && std::abs(static_cast<double>(place.heading)) <= kFarthestPlace, FRAGMOTION_ERROR_ARGUMENT,
         "the place holds what is not a number, or is farther away than a million km");
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
  axes.write_heading(wrapped(p.heading()), state.rotation);
  axes.write_place(p.report.velocity, state.velocity);
  axes.write_place(p.report.motion, state.motion);
  state.motion_heading = static_cast<float>(axes.yaw(p.report.turned));
  state.ground_missed = static_cast<float>(player.ground_missed());
  state.path_way = p.route ? static_cast<float>(axes.length(p.route->follower.way())) : 0;
  state.path_seconds_left = p.route ? static_cast<float>(p.route->follower.seconds_left()) : 0;
}

}  // namespace

std::unique_ptr<FragmotionPlayer> make_player(const std::shared_ptr<const Hero>& hero,
                                              const FragmotionPlayerOptions& options) {
  return std::make_unique<FragmotionPlayer>(hero, hero->player.another(to_options(options)),
                                            std::make_shared<Scratch>(hero->bones()), options);
}

FragmotionPlayerOptions checked(const FragmotionPlayerOptions* options) {
  if (options == nullptr) return fragmotion_player_options();
  demand_struct(options, "the options");
  check_options(*options);
  return *options;
}

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
    demand(is_place(there), FRAGMOTION_ERROR_ARGUMENT,
           "the place to look at holds what is not a number, or is farther away than a million km");
    p.player.look(Look::at, p.shift.place_inside(there));
  });
}

FragmotionResult fragmotion_player_reach(FragmotionPlayer* player, FragmotionHand hand,
                                         const FragmotionReach* reach) noexcept {
  return call("fragmotion_player_reach", [&] {
    FragmotionPlayer& p = alive(player);
    demand_index("hand", hand, 2);
    if (reach == nullptr) {
      HandAim aim = p.player.reaching().aim(hand);
      aim.weight = 0;
      return p.player.reach(hand, aim);
    }
    const bool carried = reach->carried == 1;
    const Vector3 seen = Eigen::Vector3f::Map(reach->place).cast<double>() / p.hero->axes.unit(),
                  there = carried ? seen : p.hero->axes.place(reach->place);
    demand(is_place(there), FRAGMOTION_ERROR_ARGUMENT,
           "the place to reach for holds what is not a number, or is farther away than a million km");
    demand(reach->weight >= 0 && reach->weight <= 1, FRAGMOTION_ERROR_ARGUMENT, "the weight of a hand must be 0 to 1");
    demand(reach->carried == 0 || reach->carried == 1, FRAGMOTION_ERROR_ARGUMENT, "carried must be 0 or 1");
    p.player.reach(hand, {carried ? there : p.shift.place_inside(there), static_cast<double>(reach->weight), carried});
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
