// SPDX-License-Identifier: MIT
#include "character/move.hpp"

#include <sstream>
#include <stdexcept>

#include "base/rounding.hpp"

namespace fragmotion {
namespace {

Fragment part(const Move& move, int begin, int end) {
  Fragment fragment;
  fragment.clip = move.clip;
  fragment.begin = begin;
  fragment.end = end;
  return fragment;
}

template <typename... Text>
void require(bool holds, const std::string& name, const Text&... text) {
  if (holds) return;
  std::ostringstream message;
  message << "the move \"" << name << '"';
  (message << ... << text);
  throw std::invalid_argument(message.str());
}

}  // namespace

std::vector<Fragment> move_parts(const PackedPool& pool, const std::vector<Move>& moves) {
  std::vector<Fragment> parts;
  for (const Move& move : moves) {
    const int last = pool.clips[move.clip].frames - 1, turn = move.loops() ? move.loop_end : last;
    parts.push_back(part(move, 0, turn));
    parts.push_back(part(move, move.loop_begin, move.loop_end));
    parts.push_back(part(move, turn, last));
  }
  return parts;
}

void check_move_times(const std::string& name, double seconds, double wait, const std::array<double, 2>& loop) {
  const auto [begin, end] = loop;
  require(seconds >= kShortestMove - kFloatRounding && seconds <= kLongestMove + kFloatRounding, name, " lasts ",
          seconds, " s: a move lasts ", kShortestMove, " s to ", kLongestMove, " s");
  require(wait >= 0 && wait <= kLongestWait, name, " is to wait ", wait, " s for its moment, which is 0 s to ",
          kLongestWait, " s");
  require(
      begin == end || (begin >= 0 && end <= seconds + kFloatRounding && end - begin >= kShortestLoop - kFloatRounding),
      name, " is to loop from ", begin, " s to ", end, " s: a loop lasts ", kShortestLoop,
      " s at least and is within the move, which lasts ", seconds, " s");
}

}  // namespace fragmotion
