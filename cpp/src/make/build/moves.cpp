// SPDX-License-Identifier: MIT
#include "build/moves.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "build/stages.hpp"
#include "motion/pack_clip.hpp"
#include "motion/trunk.hpp"

namespace fragmotion {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw std::invalid_argument("the move \"" + name + "\" " + why);
}

void check_names(const std::vector<MoveClip>& moves) {
  if (moves.size() > kMostMoves) {
    throw std::invalid_argument(std::to_string(moves.size()) + " moves are too many: a character has at most " +
                                std::to_string(kMostMoves));
  }
  std::set<std::string> names;
  for (const MoveClip& move : moves) {
    if (move.name.empty()) throw std::invalid_argument("a move has no name");
    if (!names.insert(move.name).second) refuse(move.name, "is there twice: give one of them another name");
  }
}

// Its clip, as the character plays it.
Clip checked_clip(const Skeleton& skeleton, const MoveClip& move) {
  const Clip& clip = move.clip;
  const std::size_t bones = clip.frames > 0 ? clip.rotations.size() / 4 / clip.frames : 0;
  if (clip.frames < 2) refuse(move.name, "is of one frame: choose a range of frames");
  if (bones != static_cast<std::size_t>(skeleton.size())) {
    refuse(move.name, "is of another rig, of " + std::to_string(bones) + " bones; the character's has " +
                          std::to_string(skeleton.size()));
  }
  check_move_times(move.name, (clip.frames - 1) / clip.rate, move.wait, move.loop);
  if (move.upper_body && Trunk(skeleton).base < 0) {
    refuse(move.name, "is of the upper body, and this skeleton has no spine that carries two hands");
  }
  Clip made = make_clip(skeleton, clip);
  made.name = move.name;
  return made;
}

}  // namespace

Character without_moves(Character character) {
  character.pool.clips.resize(character.takes());
  character.contacts.resize(character.pool.clips.size());
  character.moves.clear();
  character.move_parts.clear();
  return character;
}

Character with_moves(const Character& character, const std::vector<MoveClip>& moves) {
  check_names(moves);
  Character result = without_moves(character);
  const Skeleton& skeleton = result.pool.skeleton;
  const Kinematics kinematics(skeleton);
  const Floors floors = usual_floors(result.contacts);
  const auto grid = result.pool.clips.front().grid;
  std::vector<Move> added;
  for (const MoveClip& move : moves) {
    const Clip clip = checked_clip(skeleton, move);
    const auto frame = [&](double seconds) {
      return std::min(static_cast<int>(std::lround(seconds * clip.rate)), clip.frames - 1);
    };
    added.push_back({move.name, static_cast<int>(result.pool.clips.size()), move.upper_body, move.wait,
                     frame(move.loop[0]), frame(move.loop[1])});
    result.contacts.push_back(find_plants(kinematics, clip, &floors));
    result.pool.clips.push_back(pack(skeleton, grid, clip));
  }
  result.moves = std::move(added);
  result.move_parts = move_parts(result.pool, result.moves);
  return result;
}

std::vector<MoveClip> moves_of(const Character& character) {
  std::vector<MoveClip> moves;
  for (const Move& move : character.moves) {
    const PackedClip& clip = character.pool.clips[move.clip];
    moves.push_back({move.name,
                     unpack(clip),
                     move.upper_body,
                     move.wait,
                     {move.loop_begin / clip.rate, move.loop_end / clip.rate}});
  }
  return moves;
}

}  // namespace fragmotion
