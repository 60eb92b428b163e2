// SPDX-License-Identifier: MIT
#include "players.hpp"

#include <algorithm>
#include <vector>

namespace fragmotion::godot {

bool Players::make(Object policy, std::int64_t count, std::int64_t seed) {
  const Policy* given = Policy::given(policy, __func__);
  if (given == nullptr) return false;
  FragmotionPlayerOptions options = fragmotion_player_options();
  options.seed = static_cast<std::uint64_t>(seed);
  const auto many = static_cast<std::int32_t>(std::clamp<std::int64_t>(count, -1, INT32_MAX));
  auto made = std::make_shared<game::Crowd>(given->character(), many, 1, options);
  if (!*made) {
    complain(game::last_error(), __func__);
    return false;
  }
  crowd_ = std::move(made);
  return true;
}

bool Players::make_way(double radius, double seconds, VectorArray others) {
  if (crowd_ == nullptr) {
    complain("there are no players: make() them first", __func__);
    return false;
  }
  const std::int64_t count = size_of(others) / 2;
  const auto* vectors = count == 0 ? nullptr : static_cast<const Vector3*>(engine.vectors_at(&others, 0));
  std::vector<FragmotionBody> bodies;
  for (std::int64_t i = 0; i < count; ++i) {
    const Vector3 &place = vectors[2 * i], &velocity = vectors[2 * i + 1];
    bodies.push_back({{place.x, place.y, place.z}, {velocity.x, velocity.y, velocity.z}, static_cast<float>(radius)});
  }
  const bool done =
      crowd_->make_way(static_cast<float>(radius), seconds, bodies.data(), static_cast<std::int32_t>(count));
  if (!done) complain(game::last_error(), __func__);
  return done;
}

void Players::add() {
  add_class<Players>();
  Bound<&Players::make>::add(kName, "make", "policy", "count", "seed");
  Bound<&Players::make_way>::add(kName, "make_way", "radius", "seconds", "others");
}

}  // namespace fragmotion::godot
