// SPDX-License-Identifier: MIT
//
// fragmotion.h for C++17 and later: handles that release themselves, names by string, spans as pointer and size.
// Nothing here throws, allocates (but for the vectors that you ask for) or needs exceptions or run-time types. What
// fails returns false or an empty handle; fragmotion::game::last_error() says why.
//
//     namespace fm = fragmotion::game;
//     fm::Character hero = fm::Character::load(bytes.data(), bytes.size());
//     if (!hero) return complain(fm::last_error());
//     fm::Player player(hero);
//     player.step(fm::by_camera(stick_x, stick_y, camera_forward), seconds);
#ifndef FRAGMOTION_FRAGMOTION_HPP
#define FRAGMOTION_FRAGMOTION_HPP

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "fragmotion/fragmotion.h"

namespace fragmotion::game {

using Transform = FragmotionTransform;
using Place = FragmotionPlace;
using Input = FragmotionInput;
using Event = FragmotionEvent;

inline const char* last_error() noexcept { return fragmotion_last_error(); }

/// Inputs, in the engine's axes and unit (FragmotionSteer). `velocity`, `facing`, `camera_forward`: 3 numbers.
inline Input by_character(float right, float forward, float turn = 0, bool jump = false) noexcept {
  Input input = fragmotion_input();
  input.move[0] = right;
  input.move[1] = forward;
  input.turn = turn;
  input.jump = jump ? 1 : 0;
  return input;
}
inline Input by_world(const float* velocity, const float* facing = nullptr, bool jump = false) noexcept {
  Input input = fragmotion_input();
  input.steer = FRAGMOTION_STEER_WORLD;
  for (int i = 0; i < 3; ++i) {
    input.move[i] = velocity[i];
    input.facing[i] = facing != nullptr ? facing[i] : 0;
  }
  input.jump = jump ? 1 : 0;
  return input;
}
inline Input by_camera(float right, float up, const float* camera_forward, bool jump = false) noexcept {
  Input input = by_character(right, up, 0, jump);
  input.steer = FRAGMOTION_STEER_CAMERA;
  for (int i = 0; i < 3; ++i) input.facing[i] = camera_forward[i];
  return input;
}
inline Input by_path() noexcept {
  Input input = fragmotion_input();
  input.steer = FRAGMOTION_STEER_PATH;
  return input;
}

/// A handle of the C API, released with this; empty where it could not be made.
template <typename T, void (*Release)(T*) noexcept>
class Handle {
 public:
  Handle() noexcept = default;
  explicit Handle(T* made) noexcept : handle_(made) {}
  Handle(Handle&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { Release(handle_); }

  explicit operator bool() const noexcept { return handle_ != nullptr; }
  T* get() const noexcept { return handle_; }

 protected:
  T* handle_ = nullptr;
};

class Character : public Handle<FragmotionCharacter, &fragmotion_character_release> {
 public:
  using Handle::Handle;

  static Character load(const void* bytes, std::size_t size,
                        const FragmotionLoadOptions& options = fragmotion_load_options()) noexcept {
    FragmotionCharacter* made = nullptr;
    fragmotion_character_load(bytes, size, &options, &made);
    return Character(made);
  }

  FragmotionCharacterInfo info() const noexcept {
    FragmotionCharacterInfo info = fragmotion_info();
    fragmotion_character_info(handle_, &info);
    return info;
  }
  FragmotionBone bone(std::int32_t index) const noexcept {
    FragmotionBone bone = fragmotion_bone();
    fragmotion_character_bone(handle_, index, &bone);
    return bone;
  }
  FragmotionMove move(std::int32_t index) const noexcept {
    FragmotionMove move = fragmotion_move();
    fragmotion_character_move(handle_, index, &move);
    return move;
  }
  FragmotionStyle style(std::int32_t index) const noexcept {
    FragmotionStyle style = fragmotion_style();
    fragmotion_character_style(handle_, index, &style);
    return style;
  }
  const char* marker_name(std::int32_t index) const noexcept {
    return fragmotion_character_marker_name(handle_, index);
  }
  std::int32_t find_bone(const char* name) const noexcept { return fragmotion_character_find_bone(handle_, name); }
  std::int32_t find_move(const char* name) const noexcept { return fragmotion_character_find_move(handle_, name); }
  std::int32_t find_style(const char* name) const noexcept { return fragmotion_character_find_style(handle_, name); }
  std::int32_t find_marker(const char* name) const noexcept { return fragmotion_character_find_marker(handle_, name); }
};

class Rig : public Handle<FragmotionRig, &fragmotion_rig_release> {
 public:
  using Handle::Handle;

  Rig(const Character& character, const FragmotionRigOptions& options) noexcept {
    fragmotion_rig_create(character.get(), &options, &handle_);
  }
  /// The character's bone that one of the rig's is, or -1.
  std::int32_t bone(std::int32_t index) const noexcept { return fragmotion_rig_bone(handle_, index); }
};

/// A player that somebody has: a Player, or a crowd's.
class PlayerRef {
 public:
  PlayerRef() noexcept = default;
  explicit PlayerRef(FragmotionPlayer* player) noexcept : player_(player) {}

  explicit operator bool() const noexcept { return player_ != nullptr; }
  FragmotionPlayer* get() const noexcept { return player_; }

  bool step(const Input& input, double seconds) noexcept {
    return fragmotion_player_step(player_, &input, seconds) == FRAGMOTION_OK;
  }
  FragmotionState state() const noexcept {
    FragmotionState state = fragmotion_state();
    fragmotion_player_state(player_, &state);
    return state;
  }
  /// Writes what happened in the last step to FRAGMOTION_MOST_EVENTS events, and returns how many it was.
  std::int32_t events(Event* events) const noexcept {
    std::int32_t count = 0;
    fragmotion_player_events(player_, events, FRAGMOTION_MOST_EVENTS, &count);
    return count;
  }
  bool pose(FragmotionSpace space, Transform* bones, std::int32_t count, const Rig* rig = nullptr) const noexcept {
    return fragmotion_player_pose(player_, rig != nullptr ? rig->get() : nullptr, space, bones, count) == FRAGMOTION_OK;
  }
  bool skinning(const Rig& rig, FragmotionSpace space, float* matrices, std::int32_t count) const noexcept {
    return fragmotion_player_skinning(player_, rig.get(), space, matrices, count) == FRAGMOTION_OK;
  }

  bool reset(const Place& place = {}, std::int32_t style = 0) noexcept {
    return fragmotion_player_reset(player_, &place, style) == FRAGMOTION_OK;
  }
  bool move_to(const Place& place) noexcept { return fragmotion_player_move_to(player_, &place) == FRAGMOTION_OK; }
  bool set_ground(FragmotionGround ground, void* user) noexcept {
    return fragmotion_player_set_ground(player_, ground, user) == FRAGMOTION_OK;
  }
  bool set_options(const FragmotionPlayerOptions& options) noexcept {
    return fragmotion_player_set_options(player_, &options) == FRAGMOTION_OK;
  }
  FragmotionPlayerOptions options() const noexcept {
    FragmotionPlayerOptions options = fragmotion_player_options();
    fragmotion_player_options_of(player_, &options);
    return options;
  }
  bool set_path(const FragmotionPath& path) noexcept {
    return fragmotion_player_set_path(player_, &path) == FRAGMOTION_OK;
  }
  bool forget_path() noexcept { return fragmotion_player_set_path(player_, nullptr) == FRAGMOTION_OK; }
  bool start_move(std::int32_t move) noexcept { return fragmotion_player_start_move(player_, move) == FRAGMOTION_OK; }
  bool release_move(std::int32_t move) noexcept {
    return fragmotion_player_release_move(player_, move) == FRAGMOTION_OK;
  }
  bool change_style(std::int32_t style) noexcept {
    return fragmotion_player_change_style(player_, style) == FRAGMOTION_OK;
  }
  bool look_at(const float* place) noexcept {
    return fragmotion_player_look(player_, FRAGMOTION_LOOK_AT, place) == FRAGMOTION_OK;
  }
  bool look(FragmotionLook look) noexcept { return fragmotion_player_look(player_, look, nullptr) == FRAGMOTION_OK; }
  bool reach(FragmotionHand hand, const FragmotionReach& reach) noexcept {
    return fragmotion_player_reach(player_, hand, &reach) == FRAGMOTION_OK;
  }
  bool let_go(FragmotionHand hand) noexcept { return fragmotion_player_reach(player_, hand, nullptr) == FRAGMOTION_OK; }
  bool force_class(std::int32_t index) noexcept {
    return fragmotion_player_force_class(player_, index) == FRAGMOTION_OK;
  }
  bool foresee(const Input& input, double seconds, std::int32_t count, Place* places) noexcept {
    return fragmotion_player_foresee(player_, &input, seconds, count, places) == FRAGMOTION_OK;
  }

  /// The state, in a vector that is used again; and back.
  bool save(std::vector<unsigned char>& bytes) const {
    bytes.resize(fragmotion_player_save_size(player_));
    std::size_t written = 0;
    return fragmotion_player_save(player_, bytes.data(), bytes.size(), &written) == FRAGMOTION_OK;
  }
  bool restore(const std::vector<unsigned char>& bytes) noexcept {
    return fragmotion_player_restore(player_, bytes.data(), bytes.size()) == FRAGMOTION_OK;
  }
  std::uint64_t checksum() const noexcept {
    std::uint64_t checksum = 0;
    fragmotion_player_checksum(player_, &checksum);
    return checksum;
  }

 protected:
  FragmotionPlayer* player_ = nullptr;
};

class Player : public PlayerRef {
 public:
  Player() noexcept = default;
  explicit Player(const Character& character,
                  const FragmotionPlayerOptions& options = fragmotion_player_options()) noexcept {
    fragmotion_player_create(character.get(), &options, &player_);
  }
  Player(Player&& other) noexcept : PlayerRef(std::exchange(other.player_, nullptr)) {}
  Player& operator=(Player&& other) noexcept {
    std::swap(player_, other.player_);
    return *this;
  }
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;
  ~Player() { fragmotion_player_release(player_); }
};

class Crowd : public Handle<FragmotionCrowd, &fragmotion_crowd_release> {
 public:
  using Handle::Handle;

  Crowd(const Character& character, std::int32_t count, std::int32_t parts = 1,
        const FragmotionPlayerOptions& options = fragmotion_player_options()) noexcept {
    fragmotion_crowd_create(character.get(), &options, count, parts, &handle_);
  }
  std::int32_t count() const noexcept { return fragmotion_crowd_count(handle_); }
  std::int32_t parts() const noexcept { return fragmotion_crowd_parts(handle_); }
  PlayerRef operator[](std::int32_t index) const noexcept { return PlayerRef(fragmotion_crowd_player(handle_, index)); }
  /// Before a step.
  bool make_way(float radius, double seconds, const FragmotionBody* others = nullptr, std::int32_t count = 0) noexcept {
    return fragmotion_crowd_make_way(handle_, radius, seconds, others, count) == FRAGMOTION_OK;
  }
  bool step(const Input* inputs, double seconds) noexcept {
    return fragmotion_crowd_step(handle_, inputs, seconds) == FRAGMOTION_OK;
  }
  bool step_part(std::int32_t part, const Input* inputs, double seconds) noexcept {
    return fragmotion_crowd_step_part(handle_, part, inputs, seconds) == FRAGMOTION_OK;
  }
};

}  // namespace fragmotion::game

#endif
