// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string_view>

#include "api/handles.hpp"
#include "character/naming.hpp"
#include "character/policy_bytes.hpp"
#include "character/policy_file.hpp"
#include "skeleton/role_names.hpp"

namespace fragmotion {
namespace {

constexpr double kMostUnit = 1e6;

// A file of another version is no damaged one.
void check_version(std::string_view bytes) {
  std::uint32_t version = 0;
  if (bytes.size() < kPolicyMagic.size() + sizeof version || bytes.substr(0, kPolicyMagic.size()) != kPolicyMagic)
    return;
  std::memcpy(&version, bytes.data() + kPolicyMagic.size(), sizeof version);
  demand(version <= kPolicyVersion, FRAGMOTION_ERROR_NEWER_VERSION,
         "the policy is of version %u, newer than the %u that this library knows: get a newer Fragmotion",
         static_cast<unsigned>(version), static_cast<unsigned>(kPolicyVersion));
  demand(version >= kOldestPolicyVersion, FRAGMOTION_ERROR_OLDER_VERSION,
         "the policy is of version %u, older than the %u that this library knows: build it again in Blender",
         static_cast<unsigned>(version), static_cast<unsigned>(kOldestPolicyVersion));
}

Character read_character(std::string_view bytes) {
  check_version(bytes);
  try {
    return from_bytes(bytes, "the policy");
  } catch (const std::invalid_argument& error) {
    throw CallError{fail(FRAGMOTION_ERROR_REFUSED, "%s", error.what())};
  }
}

FragmotionRole role_of(const Skeleton& skeleton, int bone) {
  const Roles& r = skeleton.roles;
  const int by_role[] = {r.hips,       r.head,     r.left_hand, r.right_hand, r.left_foot,
                         r.right_foot, r.left_toe, r.right_toe, r.left_thigh, r.right_thigh};
  for (int i = 0; i < 10; ++i) {
    if (by_role[i] == bone) return static_cast<FragmotionRole>(i + 1);
  }
  return FRAGMOTION_ROLE_NONE;
}

const Hero& alive(const FragmotionCharacter* character) {
  demand_alive(character, Kind::character);
  return *character->hero;
}

template <typename Items, typename NameOf>
int find_named(const Items& items, const char* name, const NameOf& name_of) {
  demand_given(name, "the name");
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (name_of(items[i]) == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

std::string plain_name(const std::string& name) {
  const std::size_t prefix = name.find_last_of(":|");
  std::string plain;
  for (std::size_t i = prefix == std::string::npos ? 0 : prefix + 1; i < name.size(); ++i) {
    const char c = name[i];
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (c & 0x80) != 0;
    if (is_letter) plain += c;
    if (c >= 'A' && c <= 'Z') plain += static_cast<char>(c - 'A' + 'a');
  }
  constexpr std::string_view kMixamo = "mixamorig";
  if (plain.compare(0, kMixamo.size(), kMixamo) != 0) return plain;
  const std::size_t end = plain.find_first_not_of("0123456789", kMixamo.size());
  return end == std::string::npos ? plain : plain.substr(end);
}

Hero::Hero(Character&& loaded, std::uint64_t which, FragmotionAxes engine, double unit)
    : character(std::make_shared<const Character>(std::move(loaded))),
      player(character),
      fingerprint(which),
      axes(engine, unit),
      kinematics(character->pool.skeleton) {
  const std::array<LegRoles, kMostLegs> legs = leg_roles(skeleton().roles);
  for (int side = 0; side < 2; ++side) leg_bones[side] = kinematics.chains({legs[side].foot, legs[side].toe});
  for (int style = 0; style < character->style_count(); ++style) {
    class_names.push_back(fragmotion::class_names(character->in_style(style)));
    turns_well.push_back(fragmotion::turns_well(player, style));
    for (const PackedClip& clip : character->in_style(style).pool.clips) {
      for (const Marker& marker : clip.markers) {
        if (find_marker(marker.name) < 0) marker_names.push_back(marker.name);
      }
    }
  }
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton(), heads, rotations);
  const CharacterFrame& stands = kinematics.rest_frame();
  for (int b = 0; b < bones(); ++b) {
    plain_names.push_back(plain_name(skeleton().names[b]));
    carried.push_back(b == skeleton().roles.hips || !skeleton().is_below(b, skeleton().roles.hips));
    rest.push_back(axes.global(stands.to_local(heads[b]), stands.rotation().conjugate() * rotations[b]));
  }
}

int Hero::find_bone(const char* name) const {
  const int whole = skeleton().find(name);
  if (whole >= 0) return whole;
  const std::string plain = plain_name(name);
  const auto found = std::find(plain_names.begin(), plain_names.end(), plain);
  const bool is_one = !plain.empty() && found != plain_names.end() &&
                      std::find(found + 1, plain_names.end(), plain) == plain_names.end();
  return is_one ? static_cast<int>(found - plain_names.begin()) : -1;
}

int Hero::find_marker(const std::string& name) const {
  const auto found = std::find(marker_names.begin(), marker_names.end(), name);
  return found == marker_names.end() ? -1 : static_cast<int>(found - marker_names.begin());
}

}  // namespace fragmotion

using namespace fragmotion;

FragmotionResult fragmotion_character_load(const void* bytes, std::size_t size, const FragmotionLoadOptions* options,
                                           FragmotionCharacter** character) noexcept {
  return call("fragmotion_character_load", [&] {
    demand_given(character, "the place for the character");
    *character = nullptr;
    demand_given(bytes, "the policy's bytes");
    if (options != nullptr) demand_struct(options, "the options");
    const FragmotionLoadOptions wanted = options != nullptr ? *options : fragmotion_load_options();
    demand(Axes::exist(wanted.axes), FRAGMOTION_ERROR_ARGUMENT, "there are no axes %d", static_cast<int>(wanted.axes));
    demand(wanted.units_per_metre > 0 && wanted.units_per_metre <= kMostUnit, FRAGMOTION_ERROR_ARGUMENT,
           "units_per_metre must be over 0 to %g, not %g", kMostUnit, static_cast<double>(wanted.units_per_metre));
    const std::string_view text(static_cast<const char*>(bytes), size);
    auto made = std::make_unique<FragmotionCharacter>();
    made->hero = std::make_shared<const Hero>(read_character(text), policy_checksum(text), wanted.axes,
                                              static_cast<double>(wanted.units_per_metre));
    list_alive(made.get(), Kind::character);
    *character = made.release();
  });
}

void fragmotion_character_release(FragmotionCharacter* character) noexcept {
  if (character == nullptr) return;
  const FragmotionResult result =
      call("fragmotion_character_release", [&] { demand_alive(character, Kind::character); });
  if (result != FRAGMOTION_OK) return;
  unlist_alive(character);
  delete character;
}

FragmotionResult fragmotion_character_info(const FragmotionCharacter* character,
                                           FragmotionCharacterInfo* info) noexcept {
  return call("fragmotion_character_info", [&] {
    const Hero& hero = alive(character);
    demand_struct(info, "the info");
    const Character& c = *hero.character;
    std::vector<Vector3> heads;
    std::vector<Quaternion> rotations;
    rest_pose(hero.skeleton(), heads, rotations);
    info->bones = hero.bones();
    info->moves = static_cast<std::int32_t>(c.moves.size());
    info->styles = c.style_count();
    info->hips = hero.skeleton().roles.hips;
    info->jumps = c.space.layout().jump ? 1 : 0;
    info->turns = c.space.layout().turn ? 1 : 0;
    info->height = static_cast<float>(hero.axes.length(stature(hero.skeleton())));
    info->markers = static_cast<std::int32_t>(hero.marker_names.size());
    info->hips_height = static_cast<float>(hero.axes.length(heads[static_cast<std::size_t>(info->hips)].z()));
  });
}

FragmotionResult fragmotion_character_bone(const FragmotionCharacter* character, std::int32_t index,
                                           FragmotionBone* bone) noexcept {
  return call("fragmotion_character_bone", [&] {
    const Hero& hero = alive(character);
    demand_struct(bone, "the bone");
    const Skeleton& skeleton = hero.skeleton();
    demand_index("bone", index, hero.bones());
    bone->parent = skeleton.parents[index];
    bone->name = skeleton.names[index].c_str();
    bone->role = role_of(skeleton, index);
    bone->length = static_cast<float>(hero.axes.length(skeleton.tips[index].norm()));
    bone->model = hero.rest[index];
    bone->rest =
        bone->parent < 0 ? bone->model : hero.axes.local(skeleton.offsets[index], skeleton.rest_rotations[index]);
  });
}

FragmotionResult fragmotion_character_move(const FragmotionCharacter* character, std::int32_t index,
                                           FragmotionMove* move) noexcept {
  return call("fragmotion_character_move", [&] {
    const Hero& hero = alive(character);
    demand_struct(move, "the move");
    const std::vector<Move>& moves = hero.character->moves;
    demand_index("move", index, static_cast<int>(moves.size()));
    const Move& found = moves[index];
    const PackedClip& clip = hero.character->pool.clips[found.clip];
    move->upper_body = found.upper_body ? 1 : 0;
    move->loops = found.loops() ? 1 : 0;
    move->name = found.name.c_str();
    move->seconds = static_cast<float>((clip.frames - 1) / clip.rate);
    move->wait = static_cast<float>(found.wait);
  });
}

FragmotionResult fragmotion_character_style(const FragmotionCharacter* character, std::int32_t index,
                                            FragmotionStyle* style) noexcept {
  return call("fragmotion_character_style", [&] {
    const Hero& hero = alive(character);
    demand_struct(style, "the style");
    demand_index("style", index, hero.character->style_count());
    const Character& found = hero.character->in_style(index);
    const ControlSpace& space = found.space;
    const auto speed = [&](double value) { return static_cast<float>(hero.axes.length(value)); };
    style->classes = found.classes.count;
    style->speeds = static_cast<std::int32_t>(space.speeds().size());
    style->name = found.style.c_str();
    for (std::size_t i = 0; i < 4; ++i) style->speed[i] = i < space.speeds().size() ? speed(space.speeds()[i]) : 0;
    style->walk = speed(space.walk());
    style->run = speed(space.run());
    style->turn_rate = static_cast<float>(space.turn_rate());
  });
}

const char* fragmotion_character_class_name(const FragmotionCharacter* character, std::int32_t style,
                                            std::int32_t index) noexcept {
  const char* name = nullptr;
  call("fragmotion_character_class_name", [&] {
    const Hero& hero = alive(character);
    demand_index("style", style, hero.character->style_count());
    demand_index("class", index, static_cast<int>(hero.class_names[style].size()));
    name = hero.class_names[style][index].c_str();
  });
  return name;
}

const char* fragmotion_character_marker_name(const FragmotionCharacter* character, std::int32_t index) noexcept {
  const char* name = nullptr;
  call("fragmotion_character_marker_name", [&] {
    const Hero& hero = alive(character);
    demand_index("marker", index, static_cast<int>(hero.marker_names.size()));
    name = hero.marker_names[static_cast<std::size_t>(index)].c_str();
  });
  return name;
}

std::int32_t fragmotion_character_find_bone(const FragmotionCharacter* character, const char* name) noexcept {
  std::int32_t found = -1;
  call("fragmotion_character_find_bone", [&] {
    const Hero& hero = alive(character);
    demand_given(name, "the name");
    found = hero.find_bone(name);
  });
  return found;
}

std::int32_t fragmotion_character_find_move(const FragmotionCharacter* character, const char* name) noexcept {
  std::int32_t found = -1;
  call("fragmotion_character_find_move", [&] {
    found = find_named(alive(character).character->moves, name, [](const Move& move) { return move.name; });
  });
  return found;
}

std::int32_t fragmotion_character_find_style(const FragmotionCharacter* character, const char* name) noexcept {
  std::int32_t found = -1;
  call("fragmotion_character_find_style", [&] {
    const Character& c = *alive(character).character;
    std::vector<std::string> names;
    for (int style = 0; style < c.style_count(); ++style) names.push_back(c.in_style(style).style);
    found = find_named(names, name, [](const std::string& each) { return each; });
  });
  return found;
}

std::int32_t fragmotion_character_find_marker(const FragmotionCharacter* character, const char* name) noexcept {
  std::int32_t found = -1;
  call("fragmotion_character_find_marker", [&] {
    const Hero& hero = alive(character);
    demand_given(name, "the name");
    found = hero.find_marker(name);
  });
  return found;
}
