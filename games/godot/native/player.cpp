// SPDX-License-Identifier: MIT
#include "player.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace fragmotion::godot {

namespace {

constexpr float kHighest = 4096,
                kDeep = 100;  // m: where rays begin at most, and how far below the ground is looked for

/// Names that are asked for each frame; they stay until the program ends.
struct Names {
  Name bone_count{"get_bone_count"}, bone_name{"get_bone_name"}, set_rotation{"set_bone_pose_rotation"},
      set_position{"set_bone_pose_position"}, set_from{"set_from"}, set_to{"set_to"}, intersect{"intersect_ray"};
  String position{"position"}, normal{"normal"};
};
const Names& names() {
  static const Names& made = *new Names;
  return made;
}

std::string text_of(const Variant& variant) {
  const String string = variant.as<String>();
  std::string text(static_cast<std::size_t>(engine.string_to_utf8(&string, nullptr, 0)), '\0');
  engine.string_to_utf8(&string, text.data(), static_cast<GDExtensionInt>(text.size()));
  return text;
}

game::Place place_of(const Transform& transform) {
  const auto& rows = transform.rows;
  return {{transform.origin.x, transform.origin.y, transform.origin.z}, std::atan2(rows[0][2], rows[2][2])};
}

game::Input input_of(std::int64_t steer, const Vector3& move, const Vector3& facing, double turn, bool jump) {
  game::Input input = fragmotion_input();
  input.steer = static_cast<FragmotionSteer>(steer);
  std::memcpy(input.move, &move, sizeof input.move);
  std::memcpy(input.facing, &facing, sizeof input.facing);
  input.turn = static_cast<float>(turn);
  input.jump = jump ? 1 : 0;
  return input;
}

Vector3 placed(const Transform& transform, const float point[3]) {
  const auto row = [&](int i, float origin) {
    return transform.rows[i][0] * point[0] + transform.rows[i][1] * point[1] + transform.rows[i][2] * point[2] + origin;
  };
  return {row(0, transform.origin.x), row(1, transform.origin.y), row(2, transform.origin.z)};
}

Quaternion times(const Quaternion& a, const float b[4]) {
  return {a.w * b[0] + a.x * b[3] + a.y * b[2] - a.z * b[1], a.w * b[1] - a.x * b[2] + a.y * b[3] + a.z * b[0],
          a.w * b[2] + a.x * b[1] - a.y * b[0] + a.z * b[3], a.w * b[3] - a.x * b[0] - a.y * b[1] - a.z * b[2]};
}

float scale_of(const Transform& transform) {
  const auto& rows = transform.rows;
  return std::sqrt(rows[0][0] * rows[0][0] + rows[1][0] * rows[1][0] + rows[2][0] * rows[2][0]);
}

}  // namespace

bool Player::held(bool done, const char* function) const {
  if (!done) complain(player_ ? game::last_error() : "there is no policy: play() one first", function);
  return done;
}

bool Player::play(Object policy, std::int64_t seed) {
  const Policy* given = Policy::given(policy, __func__);
  if (given == nullptr) return false;
  FragmotionPlayerOptions options = fragmotion_player_options();
  options.seed = static_cast<std::uint64_t>(seed);
  game::Player made(given->character(), options);
  if (!held(static_cast<bool>(made), __func__)) return false;
  own_ = std::move(made);
  player_ = own_;
  crowd_.reset();
  driven_.clear();
  return true;
}

bool Player::play_one_of(Object players, std::int64_t index) {
  auto* given = ours<Players>(players);
  if (given == nullptr || given->crowd() == nullptr) {
    complain("there are no players: make() them first", __func__);
    return false;
  }
  const game::PlayerRef one =
      (*given->crowd())[static_cast<std::int32_t>(std::clamp<std::int64_t>(index, -1, INT32_MAX))];
  if (!held(static_cast<bool>(one), __func__)) return false;
  player_ = one;
  crowd_ = given->crowd();
  own_ = game::Player();
  driven_.clear();
  return true;
}

std::int64_t Player::bind(Object policy, Object skeleton, Transform from_model, Quaternion rotation) {
  driven_.clear();
  auto* given = ours<Policy>(policy);
  if (given == nullptr || !given->is_valid() || skeleton == nullptr) return 0;
  skeleton_ = engine.id_of_object(skeleton);
  from_model_ = from_model;
  rotation_ = rotation;
  Variant object(skeleton);
  find_bones(given->character(), object);
  return static_cast<std::int64_t>(driven_.size());
}

void Player::find_bones(const game::Character& character, Variant& skeleton) {
  const std::int32_t hips = character.info().hips;
  Variant result;
  skeleton.call(names().bone_count, result);
  const auto count = result.as<std::int64_t>();
  std::vector<std::string> texts;
  for (std::int64_t i = 0; i < count; ++i) {
    skeleton.call(names().bone_name, result, Variant(i));
    const std::string text = text_of(result);
    const std::int32_t bone = character.find_bone(text.c_str());
    if (bone < 0) continue;
    driven_.push_back({i, bone == hips, character.bone(bone).parent < 0});
    texts.push_back(text);
  }
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  FragmotionRigOptions options = fragmotion_rig_options();
  options.bones = static_cast<std::int32_t>(pointers.size());
  options.names = pointers.data();
  pose_.resize(pointers.size());
  rig_ = pointers.empty() ? game::Rig() : game::Rig(character, options);
}

std::int32_t Player::hit_ground(void* user, const float from[3], FragmotionGroundHit* hit) {
  const auto& player = *static_cast<const Player*>(user);
  const Object space_object = engine.object_of_id(player.space_), query_object = engine.object_of_id(player.query_);
  if (space_object == nullptr || query_object == nullptr) return 0;
  Variant space(space_object), query(query_object), result, found;
  const Vector3 begin{from[0], std::min(from[1], kHighest), from[2]};
  const float deep = from[1] > kHighest ? 2 * kHighest : kDeep;
  query.call(names().set_from, result, Variant(begin));
  query.call(names().set_to, result, Variant(Vector3{begin.x, begin.y - deep, begin.z}));
  space.call(names().intersect, result, query);
  if (!result.find(Variant(names().position), found)) return 0;
  hit->height = found.as<Vector3>().y;
  result.find(Variant(names().normal), found);
  const auto normal = found.as<Vector3>();
  std::memcpy(hit->normal, &normal, sizeof hit->normal);
  return 1;
}

bool Player::set_ground(Object space, Object query) {
  const bool any = space != nullptr && query != nullptr;
  space_ = any ? engine.id_of_object(space) : 0;
  query_ = any ? engine.id_of_object(query) : 0;
  return held(player_.set_ground(any ? &hit_ground : nullptr, this), __func__);
}

bool Player::set_option(String name, double value) {
  const std::string text = text_of(Variant(name));
  FragmotionPlayerOptions options = player_.options();
  const auto whole = static_cast<std::uint32_t>(std::clamp(value, 0.0, 1e6));
  if (text == "responsiveness") options.responsiveness = value;
  if (text == "root_adjustment") options.root_adjustment = value;
  if (text == "stitch") options.stitch = value;
  if (text == "time_scale") options.time_scale = value;
  if (text == "fixed_step") options.fixed_step = value;
  if (text == "step_interval") options.step_interval = whole;
  if (text == "hold_feet") options.hold_feet = whole != 0 ? 1 : 0;
  return held(player_.set_options(options), __func__);
}

bool Player::step(std::int64_t steer, Vector3 move, Vector3 facing, double turn, bool jump, double seconds) {
  return held(player_.step(input_of(steer, move, facing, turn, jump), seconds), __func__);
}

void Player::show() {
  const Object object = engine.object_of_id(skeleton_);
  if (object == nullptr || driven_.empty()) return;
  const auto count = static_cast<std::int32_t>(pose_.size());
  if (!held(player_.pose(FRAGMOTION_SPACE_LOCAL, pose_.data(), count, &rig_), __func__)) return;
  Variant skeleton(object), result;
  for (std::size_t i = 0; i < driven_.size(); ++i) {
    const Driven& driven = driven_[i];
    const game::Transform& local = pose_[i];
    Quaternion rotation{local.rotation[0], local.rotation[1], local.rotation[2], local.rotation[3]};
    Vector3 position{local.position[0], local.position[1], local.position[2]};
    if (driven.has_no_parent) {
      rotation = times(rotation_, local.rotation);
      position = placed(from_model_, local.position);
    } else if (driven.is_hips) {
      const float scale = scale_of(from_model_);
      position = {scale * position.x, scale * position.y, scale * position.z};
    }
    skeleton.call(names().set_rotation, result, Variant(driven.bone), Variant(rotation));
    if (driven.has_no_parent || driven.is_hips) {
      skeleton.call(names().set_position, result, Variant(driven.bone), Variant(position));
    }
  }
}

bool Player::reset(Transform place, std::int64_t style) {
  return held(player_.reset(place_of(place), static_cast<std::int32_t>(style)), __func__);
}
bool Player::move_to(Transform place) { return held(player_.move_to(place_of(place)), __func__); }

Transform Player::get_place() {
  const FragmotionPlace place = player_.state().place;
  const float sine = std::sin(place.heading), cosine = std::cos(place.heading);
  return {{{cosine, 0, sine}, {0, 1, 0}, {-sine, 0, cosine}},
          {place.position[0], place.position[1], place.position[2]}};
}
Vector3 Player::get_velocity() {
  const FragmotionState state = player_.state();
  return {state.velocity[0], state.velocity[1], state.velocity[2]};
}
std::int64_t Player::get_style() { return player_.state().style; }
std::int64_t Player::get_class_index() { return player_.state().playing_class; }
std::int64_t Player::get_whole_body_move() { return player_.state().whole_body_move; }
std::int64_t Player::get_upper_body_move() { return player_.state().upper_body_move; }
bool Player::foot_stands(std::int64_t side) { return player_.state().foot_stands[side != 0 ? 1 : 0] != 0; }
bool Player::is_in_the_air() { return player_.state().in_the_air != 0; }
bool Player::has_arrived() { return player_.state().path_arrived != 0; }
double Player::get_path_seconds_left() { return static_cast<double>(player_.state().path_seconds_left); }
double Player::get_ground_missed() { return static_cast<double>(player_.state().ground_missed); }

FloatArray Player::get_events() {
  game::Event events[FRAGMOTION_MOST_EVENTS];
  const std::int32_t count = player_ ? player_.events(events) : 0;
  FloatArray numbers = sized<FloatArray>(6 * static_cast<std::int64_t>(count));
  for (std::int32_t i = 0; i < count; ++i) {
    const game::Event& event = events[i];
    float* at = engine.floats_at(&numbers, 6 * static_cast<std::int64_t>(i));
    at[0] = static_cast<float>(event.type);
    at[1] = static_cast<float>(event.index);
    std::memcpy(at + 2, event.position, sizeof event.position);
    at[5] = event.seconds;
  }
  return numbers;
}

bool Player::start_move(std::int64_t move) {
  return held(player_.start_move(static_cast<std::int32_t>(move)), __func__);
}
bool Player::release_move(std::int64_t move) {
  return held(player_.release_move(static_cast<std::int32_t>(move)), __func__);
}
bool Player::change_style(std::int64_t style) {
  return held(player_.change_style(static_cast<std::int32_t>(style)), __func__);
}

bool Player::look(std::int64_t where, Vector3 place) {
  const float at[3] = {place.x, place.y, place.z};
  const auto look = static_cast<FragmotionLook>(std::clamp<std::int64_t>(where, -1, INT32_MAX));
  return held(fragmotion_player_look(player_.get(), look, at) == FRAGMOTION_OK, __func__);
}

bool Player::set_path(VectorArray points, bool closed, std::int64_t end, double speed) {
  const std::int64_t count = size_of(points);
  if (count == 0) return held(player_.forget_path(), __func__);
  FragmotionPath path = fragmotion_path();
  path.points = static_cast<std::int32_t>(count);
  path.positions = static_cast<const float*>(engine.vectors_at(&points, 0));
  path.closed = closed ? 1 : 0;
  path.end = static_cast<FragmotionPathEnd>(end);
  path.speed = static_cast<float>(speed);
  return held(player_.set_path(path), __func__);
}

VectorArray Player::foresee(std::int64_t steer, Vector3 move, Vector3 facing, double seconds, std::int64_t count) {
  std::vector<game::Place> places(static_cast<std::size_t>(std::clamp<std::int64_t>(count, 1, 3600)));
  const game::Input input = input_of(steer, move, facing, 0, false);
  const auto number = static_cast<std::int32_t>(places.size());
  if (!held(player_.foresee(input, seconds, number, places.data()), __func__)) return {};
  VectorArray points = sized<VectorArray>(number);
  for (std::int32_t i = 0; i < number; ++i) {
    auto* point = const_cast<void*>(static_cast<const void*>(engine.vectors_at(&points, i)));
    std::memcpy(point, places[static_cast<std::size_t>(i)].position, sizeof(Vector3));
  }
  return points;
}

ByteArray Player::save_state() {
  std::vector<unsigned char> bytes(fragmotion_player_save_size(player_.get()));
  std::size_t written = 0;
  if (!held(fragmotion_player_save(player_.get(), bytes.data(), bytes.size(), &written) == FRAGMOTION_OK, __func__)) {
    return {};
  }
  ByteArray state = sized<ByteArray>(static_cast<std::int64_t>(written));
  std::memcpy(engine.bytes_write_at(&state, 0), bytes.data(), written);
  return state;
}

bool Player::restore_state(ByteArray state) {
  const auto size = static_cast<std::size_t>(size_of(state));
  const void* bytes = size == 0 ? nullptr : engine.bytes_at(&state, 0);
  return held(fragmotion_player_restore(player_.get(), bytes, size) == FRAGMOTION_OK, __func__);
}

std::int64_t Player::get_checksum() { return static_cast<std::int64_t>(player_.checksum()); }

void Player::add() {
  add_class<Player>();
  Bound<&Player::play>::add(kName, "play", "policy", "seed");
  Bound<&Player::play_one_of>::add(kName, "play_one_of", "players", "index");
  Bound<&Player::bind>::add(kName, "bind", "policy", "skeleton", "from_model", "rotation");
  Bound<&Player::set_ground>::add(kName, "set_ground", "space", "query");
  Bound<&Player::set_option>::add(kName, "set_option", "name", "value");
  Bound<&Player::step>::add(kName, "step", "steer", "move", "facing", "turn", "jump", "seconds");
  Bound<&Player::show>::add(kName, "show");
  Bound<&Player::reset>::add(kName, "reset", "place", "style");
  Bound<&Player::move_to>::add(kName, "move_to", "place");
  Bound<&Player::get_place>::add(kName, "get_place");
  Bound<&Player::get_velocity>::add(kName, "get_velocity");
  Bound<&Player::get_style>::add(kName, "get_style");
  Bound<&Player::get_class_index>::add(kName, "get_class_index");
  Bound<&Player::get_whole_body_move>::add(kName, "get_whole_body_move");
  Bound<&Player::get_upper_body_move>::add(kName, "get_upper_body_move");
  Bound<&Player::foot_stands>::add(kName, "foot_stands", "side");
  Bound<&Player::is_in_the_air>::add(kName, "is_in_the_air");
  Bound<&Player::has_arrived>::add(kName, "has_arrived");
  Bound<&Player::get_path_seconds_left>::add(kName, "get_path_seconds_left");
  Bound<&Player::get_ground_missed>::add(kName, "get_ground_missed");
  Bound<&Player::get_events>::add(kName, "get_events");
  Bound<&Player::start_move>::add(kName, "start_move", "move");
  Bound<&Player::release_move>::add(kName, "release_move", "move");
  Bound<&Player::change_style>::add(kName, "change_style", "style");
  Bound<&Player::look>::add(kName, "look", "where", "place");
  Bound<&Player::set_path>::add(kName, "set_path", "points", "closed", "end", "speed");
  Bound<&Player::foresee>::add(kName, "foresee", "steer", "move", "facing", "seconds", "count");
  Bound<&Player::save_state>::add(kName, "save_state");
  Bound<&Player::restore_state>::add(kName, "restore_state", "state");
  Bound<&Player::get_checksum>::add(kName, "get_checksum");
}

}  // namespace fragmotion::godot
