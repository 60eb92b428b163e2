// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "players.hpp"

namespace fragmotion::godot {

/// One that plays a policy on a skeleton: what the node FragmotionCharacter is made of. Calls that fail return false
/// and say in Godot's debugger what was wrong.
class Player {
 public:
  static constexpr const char *kName = "FragmotionPlayer", *kParent = "RefCounted";
  static void add();

  bool play(Object policy, std::int64_t seed);
  /// Is one of many FragmotionPlayers.
  bool play_one_of(Object players, std::int64_t index);
  /// The skeleton whose bones it drives, by their names; `from_model`: the model's space as the skeleton sees it, and
  /// its rotation. Returns how many bones were found.
  std::int64_t bind(Object policy, Object skeleton, Transform from_model, Quaternion rotation);
  /// Where rays look for the ground: a PhysicsDirectSpaceState3D and a PhysicsRayQueryParameters3D; or two nulls.
  bool set_ground(Object space, Object query);
  /// "responsiveness", "root_adjustment", "stitch", "time_scale", "fixed_step", "step_interval", "hold_feet".
  bool set_option(String name, double value);

  bool step(std::int64_t steer, Vector3 move, Vector3 facing, double turn, bool jump, double seconds);
  /// Writes the pose to the skeleton.
  void show();

  bool reset(Transform place, std::int64_t style);
  bool move_to(Transform place);
  Transform get_place();
  Vector3 get_velocity();
  std::int64_t get_style();
  std::int64_t get_class_index();
  std::int64_t get_whole_body_move();
  std::int64_t get_upper_body_move();
  bool foot_stands(std::int64_t side);
  bool is_in_the_air();
  bool has_arrived();
  double get_path_seconds_left();
  double get_ground_missed();
  /// Of the last step, each as six numbers: type, index, position, seconds before its end.
  FloatArray get_events();

  bool start_move(std::int64_t move);
  bool release_move(std::int64_t move);
  bool change_style(std::int64_t style);
  /// Where head and chest look until a reset: 0 as captured, 1 ahead, 2 at a place in the world.
  bool look(std::int64_t where, Vector3 place);
  /// No points: no path. `end`: 0 stands there, 1 goes round, 2 goes straight on. `speed`: m/s, 0: as it walks.
  bool set_path(VectorArray points, bool closed, std::int64_t end, double speed);
  /// Where it would be under an input that is held, evenly over the seconds to come.
  VectorArray foresee(std::int64_t steer, Vector3 move, Vector3 facing, double seconds, std::int64_t count);

  ByteArray save_state();
  bool restore_state(ByteArray state);
  std::int64_t get_checksum();

 private:
  struct Driven {
    std::int64_t bone;
    bool is_hips, has_no_parent;
  };
  static std::int32_t hit_ground(void* user, const float from[3], FragmotionGroundHit* hit);
  bool held(bool done, const char* function) const;
  void find_bones(const game::Character& character, Variant& skeleton);

  game::Player own_;
  std::shared_ptr<game::Crowd> crowd_;  // or whose it is
  game::PlayerRef player_;              // what plays: its own, or one of the crowd's
  game::Rig rig_;
  std::uint64_t skeleton_ = 0;
  Transform from_model_{};
  Quaternion rotation_{0, 0, 0, 1};
  std::vector<Driven> driven_;
  std::vector<game::Transform> pose_;
  std::uint64_t space_ = 0, query_ = 0;
};

}  // namespace fragmotion::godot
