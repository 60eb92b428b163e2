// SPDX-License-Identifier: MIT
#include "api/handles.hpp"
#include "base/fnv.hpp"

namespace fragmotion {
namespace {

std::uint64_t fingerprint_of(const FragmotionPath& path) {
  std::uint64_t hash = kFnvSeed;
  const auto add = [&](const void* data, std::size_t size) { hash = fnv1a(data, size, hash); };
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

}  // namespace
}  // namespace fragmotion

using namespace fragmotion;

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
