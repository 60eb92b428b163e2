// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/axes.hpp"
#include "api/calls.hpp"
#include "api/shift.hpp"
#include "base/ranges.hpp"
#include "direct/make_way.hpp"
#include "direct/path_follower.hpp"
#include "direct/steering.hpp"
#include "runtime/player.hpp"

namespace fragmotion {

constexpr double kMostSteps = 64;  // that a level of detail puts together

/// What is made of a policy file's bytes, and shared by all handles that need it.
struct Hero {
  Hero(Character&& loaded, std::uint64_t which, FragmotionAxes engine, double unit);

  std::shared_ptr<const Character> character;
  Player player;              ///< Whom all others are made like.
  std::uint64_t fingerprint;  ///< Of the file.
  Axes axes;
  Kinematics kinematics;
  std::array<std::vector<int>, 2> leg_bones;          ///< From the hips to each foot's toe.
  std::vector<std::vector<std::string>> class_names;  ///< Of each style.
  std::vector<TurnsWell> turns_well;                  ///< Likewise.
  std::vector<std::string> plain_names;               ///< Of bones: plain_name().
  std::vector<std::string> marker_names;              ///< Of the takes' markers, each once.
  std::vector<FragmotionTransform> rest;              ///< Of each bone, as seen from where the character stands.
  std::vector<bool> carried;                          ///< The hips and bones that are not below them.

  const Skeleton& skeleton() const { return character->pool.skeleton; }
  int bones() const { return skeleton().size(); }
  /// The bone of that name (fragmotion_character_find_bone), or -1.
  int find_bone(const char* name) const;
  /// The number of a marker, or -1.
  int find_marker(const std::string& name) const;
};

/// A body in the world, as it is shown.
struct Shown {
  Vector3 root = Vector3::Zero();
  CharacterFrame frame;
  double level = 0;  ///< Of the ground under it.
  std::vector<double> rotations;
};

/// Room for what players that are called in turn work out.
struct Scratch {
  explicit Scratch(int bones) : posed(bones), bones(bones) {}

  PosedBones posed;
  std::vector<FragmotionTransform> bones;
  std::vector<unsigned char> state;
};

/// What a step leaves to be asked for.
struct StepReport {
  int count = 0;
  double turned = 0;
  Vector3 motion = Vector3::Zero(), velocity = Vector3::Zero();
  std::array<FragmotionEvent, FRAGMOTION_MOST_EVENTS> events{};
};

/// What a path is followed with, and what it is known by.
struct Route {
  PathFollower follower;
  std::uint64_t fingerprint;
};

}  // namespace fragmotion

struct FragmotionCharacter {
  std::shared_ptr<const fragmotion::Hero> hero;
};

struct FragmotionRig {
  std::shared_ptr<const fragmotion::Hero> hero;
  std::vector<int> bones;                      // of the character, or -1
  std::vector<int> parents;                    // empty: not told
  std::vector<FragmotionTransform> rest;       // likewise
  std::vector<std::array<float, 16>> inverse;  // inverse binds
  bool same_parents = true;                    // bones' parents are the character's, as far as they are told
};

struct FragmotionPlayer {
  FragmotionPlayer(std::shared_ptr<const fragmotion::Hero> of, fragmotion::Player&& made,
                   std::shared_ptr<fragmotion::Scratch> room, const FragmotionPlayerOptions& wanted);

  // What each step needs lies together, from here to the report's events.
  std::shared_ptr<const fragmotion::Hero> hero;
  fragmotion::Player player;
  std::shared_ptr<fragmotion::Scratch> scratch;
  bool in_crowd = false, arrived = false;
  fragmotion::WayRound way_round;
  FragmotionGround ground = nullptr;
  void* ground_user = nullptr;
  fragmotion::Shift shift;
  fragmotion::Steering steering;
  int steers_style = 0;
  fragmotion::Shown now;  // played last
  FragmotionPlayerOptions options;
  double banked = 0;  // s that are still to be played: of a fixed step, or of steps that were left out
  std::uint32_t left_out = 0;
  fragmotion::StepReport report;

  std::optional<fragmotion::Clearance> clearance;  // of the next step
  std::optional<fragmotion::Route> route;
  fragmotion::Shown before, between;  // of a fixed step: before what was played last, and shown

  bool has_fixed_step() const { return options.fixed_step > 0; }
  const fragmotion::Shown& shown() const { return has_fixed_step() ? between : now; }
  int style() const { return player.playing_style(); }
  const fragmotion::ControlSpace& space() const { return player.styled_character().space; }
  fragmotion::CharacterFrame frame() const { return shift.frame(player.frame()); }
  fragmotion::Vector3 place() const;
  double heading() const { return shift.frame(shown().frame).heading; }

  void prefetch_turn() const;
  void prefetch() const;
  void reset(const FragmotionPlace* place, int style);
  void make_room();
  void move_to(const FragmotionPlace& place);
  void set_options(const FragmotionPlayerOptions& wanted);
  void step(const FragmotionInput& input, double seconds);
  void foresee(const FragmotionInput& input, double seconds, int count, FragmotionPlace* places);
  FragmotionPlace theirs(const fragmotion::Vector3& place, double heading) const;
  void pose(const FragmotionRig* rig, FragmotionSpace space, FragmotionTransform* bones) const;
  void skinning(const FragmotionRig& rig, FragmotionSpace space, float* matrices) const;

  template <typename Archive>
  void exchange(Archive& a);
  std::size_t save(unsigned char* bytes) const;
  std::uint64_t checksum() const;
  void restore(const unsigned char* bytes, std::size_t size);

 private:
  fragmotion::Control control(const FragmotionInput& input, double seconds);
  fragmotion::Control towards(const fragmotion::Vector3& velocity, double turn, bool jump) const;
  void keep_clear(fragmotion::Control& control, double seconds);
  fragmotion::Steering& steers();
  void advance(const FragmotionInput& input, double seconds);
  void play(const FragmotionInput& input, double seconds);
  void take_pose(fragmotion::Shown& pose) const;
  void interpolate();
  void tell(FragmotionEventType type, int index, const fragmotion::Vector3& inside, double ago);
  fragmotion::Vector3 sole(int side) const;
  void world(const fragmotion::Shown& pose) const;
  const std::vector<FragmotionTransform>& bones(FragmotionSpace space) const;
};

struct FragmotionCrowd {
  std::vector<std::unique_ptr<FragmotionPlayer>> players;
  int parts = 1;
  fragmotion::MakeWay make_way;
  std::vector<fragmotion::Walker> walkers;  // its players, and those who do not make way
};

namespace fragmotion {

/// Throws CallError where an input or options are wrong.
void check_input(const FragmotionInput* input);
void check_step_seconds(double seconds);
void check_options(const FragmotionPlayerOptions& options);
PlayerOptions to_options(const FragmotionPlayerOptions& options);
/// What is given, checked; or what there is without.
FragmotionPlayerOptions checked(const FragmotionPlayerOptions* options);

std::unique_ptr<FragmotionPlayer> make_player(const std::shared_ptr<const Hero>& hero,
                                              const FragmotionPlayerOptions& options);

/// The player of a handle; throws CallError where there is none.
inline FragmotionPlayer& alive(FragmotionPlayer* player) {
  demand_alive(player, Kind::player);
  return *player;
}
inline const FragmotionPlayer& alive(const FragmotionPlayer* player) {
  demand_alive(player, Kind::player);
  return *player;
}

/// What importers leave of a bone's name: in small letters, without what is before the last ':' or '|', signs and
/// blanks, and "mixamorig".
std::string plain_name(const std::string& name);

}  // namespace fragmotion
