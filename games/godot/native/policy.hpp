// SPDX-License-Identifier: MIT
#pragma once

#include "engine.hpp"
#include "fragmotion/fragmotion.hpp"

namespace fragmotion::godot {

/// A policy file as a resource: its bytes, and the character that they hold, which all its players share.
class Policy {
 public:
  static constexpr const char *kName = "FragmotionPolicy", *kParent = "Resource";
  static void add();

  /// The one that a call was given; where that is none or holds no character it is complained of, and nullptr.
  static Policy* given(Object policy, const char* function);

  /// Bytes that are no policy are complained of, and leave no character.
  void set_data(ByteArray data);
  ByteArray get_data() { return data_; }
  bool is_valid() { return static_cast<bool>(character_); }
  StringArray get_bones();
  StringArray get_moves();
  StringArray get_styles();
  StringArray get_markers();
  /// Of a style: slowest first, m/s.
  FloatArray get_speeds(std::int64_t style);
  /// What a class of a style's motion does.
  String get_class_name(std::int64_t style, std::int64_t index);

  const game::Character& character() const { return character_; }

 private:
  ByteArray data_;
  game::Character character_;
};

/// An array's length, and another one; which the arrays that Godot hands over do not tell by themselves.
template <typename Array>
std::int64_t size_of(const Array& array) {
  static const Name& size = *new Name("size");
  Variant result;
  Variant(array).call(size, result);
  return result.as<std::int64_t>();
}
template <typename Array>
Array sized(std::int64_t count) {
  static const Name& resize = *new Name("resize");
  Variant made{Array()}, result;
  made.call(resize, result, Variant(count));
  return made.as<Array>();
}

}  // namespace fragmotion::godot
