// SPDX-License-Identifier: MIT
#include "policy.hpp"

#include <algorithm>

namespace fragmotion::godot {

namespace {

constexpr std::uint32_t kStored = 2;  // of a property: in the file, and not in the inspector

template <typename Name_>
StringArray names(std::int32_t count, const Name_& name) {
  static const Name& append = *new Name("append");
  Variant made{StringArray()}, result;
  for (std::int32_t i = 0; i < count; ++i) made.call(append, result, Variant(String(name(i))));
  return made.as<StringArray>();
}

}  // namespace

Policy* Policy::given(Object policy, const char* function) {
  auto* given = ours<Policy>(policy);
  if (given != nullptr && given->is_valid()) return given;
  complain("there is no policy: import a .policy file and set it", function);
  return nullptr;
}

void Policy::set_data(ByteArray data) {
  data_ = std::move(data);
  const std::int64_t size = size_of(data_);
  character_ = game::Character();
  if (size == 0) return;
  character_ = game::Character::load(engine.bytes_at(&data_, 0), static_cast<std::size_t>(size));
  if (!character_) complain(game::last_error(), __func__);
}

StringArray Policy::get_bones() {
  return names(character_.info().bones, [this](std::int32_t i) { return character_.bone(i).name; });
}
StringArray Policy::get_moves() {
  return names(character_.info().moves, [this](std::int32_t i) { return character_.move(i).name; });
}
StringArray Policy::get_styles() {
  return names(character_.info().styles, [this](std::int32_t i) { return character_.style(i).name; });
}

StringArray Policy::get_markers() {
  return names(character_.info().markers, [this](std::int32_t i) { return character_.marker_name(i); });
}

FloatArray Policy::get_speeds(std::int64_t style) {
  const FragmotionStyle told = character_.style(static_cast<std::int32_t>(style));
  FloatArray speeds = sized<FloatArray>(told.speeds);
  for (std::int32_t i = 0; i < told.speeds; ++i) *engine.floats_at(&speeds, i) = told.speed[i];
  return speeds;
}

String Policy::get_class_name(std::int64_t style, std::int64_t index) {
  const char* name = fragmotion_character_class_name(character_.get(), static_cast<std::int32_t>(style),
                                                     static_cast<std::int32_t>(index));
  return String(name != nullptr ? name : "");
}

void Policy::add() {
  add_class<Policy>();
  Bound<&Policy::set_data>::add(kName, "set_data", "data");
  Bound<&Policy::get_data>::add(kName, "get_data");
  Bound<&Policy::is_valid>::add(kName, "is_valid");
  Bound<&Policy::get_bones>::add(kName, "get_bones");
  Bound<&Policy::get_moves>::add(kName, "get_moves");
  Bound<&Policy::get_styles>::add(kName, "get_styles");
  Bound<&Policy::get_markers>::add(kName, "get_markers");
  Bound<&Policy::get_speeds>::add(kName, "get_speeds", "style");
  Bound<&Policy::get_class_name>::add(kName, "get_class_name", "style", "index");
  const Name owner(kName), name("data"), none(""), set("set_data"), get("get_data");
  const String hint;
  const GDExtensionPropertyInfo info{Kind<ByteArray>::type,      const_cast<Name*>(&name),
                                     const_cast<Name*>(&none),   0,
                                     const_cast<String*>(&hint), kStored};
  engine.register_property(engine.library, &owner, &info, &set, &get);
}

}  // namespace fragmotion::godot
