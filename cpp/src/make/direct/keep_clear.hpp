// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "base/progress.hpp"
#include "control/trace.hpp"
#include "direct/area_edge.hpp"
#include "direct/path_follower.hpp"
#include "runtime/player.hpp"

namespace fragmotion {

/// One of a crowd: what it would do alone, and how its world lies in the crowd's, larger by `scale`, turned and moved.
/// It does what `wanted` asks for, or goes along `path`, or to its `goals`, m, one after another, which it leaves out
/// where it cannot get there; to more than one of these it pays no heed.
struct CrowdMember {
  Player* player = nullptr;  ///< Who stands where it begins, of no other member.
  CharacterFrame origin;
  double scale = 1;
  Trace wanted;
  std::optional<Path> path;
  FollowOptions options;  ///< Of the path.
  std::vector<Vector2> goals;
};

struct CrowdOptions {
  double radius = 0.4;  ///< m in the crowd's world, which each has to itself; over 0 to 1e6.
  double seconds = 60;  ///< That paths and goals are gone for, 0.1 .. 3600.
  double rate = 60;     ///< Frames a second at which the traces are played.
  /// What nobody may touch: convex outlines, m in the crowd's world.
  std::vector<std::vector<Vector2>> obstacles;
  const AreaEdge* area = nullptr;  ///< Which nobody leaves and who stands beside it goes to, m in the crowd's world.
  /// Who makes way for nobody: each one's places, m in the crowd's world, one a control; it stays at the last.
  std::vector<std::vector<Vector2>> passers_by;
};

/// A trace for each member, by which it keeps clear of the others and of the obstacles (make_way.hpp) and does what it
/// would as far as that lets it: played at the same rate from the same start and seed, it shows the same motion. Who is
/// at the end of its trace stands there, and the others go around it. Deterministic. Throws std::invalid_argument on
/// options out of their range, a scale that is not over 0 and at most 1e6, a member without a player, and a passer-by
/// without a place.
std::vector<Trace> keep_clear(const std::vector<CrowdMember>& members, const CrowdOptions& options,
                              const Progress& progress = {});

}  // namespace fragmotion
