// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "fragmotion/skeleton/skeleton.hpp"

namespace fragmotion {
namespace {

enum class Side { kNone, kLeft, kRight };

/// What a bone's name says, in lower case: words without the namespace, the side's mark and trailing numbers.
struct BoneName {
  std::vector<std::string> words;
  Side side = Side::kNone;
  int counterpart = -1;  ///< The bone with the other side's mark, or -1.
};

/// A piece of a name: a word, or the mark of a side.
struct Piece {
  std::size_t begin = 0, length = 0;
};

struct SideMark {
  Piece piece;
  Side side = Side::kNone;
  bool is_word = false;  ///< A word of its own tells the side even where the counterpart is missing.
};

using BonesByName = std::unordered_map<std::string, int>;

// ASCII only: the locale must not change what a name means. Bytes of other alphabets count as lower-case letters.
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_lower(char c) { return (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80; }
bool is_word_character(char c) { return is_upper(c) || is_lower(c) || is_digit(c); }

std::string lower_case(std::string text) {
  for (char& c : text) {
    if (is_upper(c)) c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

/// Whether a new word begins at `at` inside a run of letters and digits: "Left|Up|Leg", "L|Hip|Joint", "Bip01|Head".
bool is_camel_boundary(std::string_view name, std::size_t at) {
  if (!is_upper(name[at])) return false;
  return !is_upper(name[at - 1]) || (at + 1 < name.size() && is_lower(name[at + 1]));
}

std::vector<Piece> split_words(std::string_view name) {
  std::vector<Piece> words;
  const std::size_t space_end = name.find_last_of(":|");
  const std::size_t start = space_end == std::string_view::npos ? 0 : space_end + 1;
  for (std::size_t at = start; at < name.size(); ++at) {
    if (!is_word_character(name[at])) continue;
    const bool first = at == start || !is_word_character(name[at - 1]);
    if (first || is_camel_boundary(name, at)) words.push_back({at, 0});
    ++words.back().length;
  }
  return words;
}

Side side_of_word(std::string_view word) {
  if (word == "l" || word == "left") return Side::kLeft;
  if (word == "r" || word == "right") return Side::kRight;
  return Side::kNone;
}

/// Every place where a name may tell its side: whole words first, then "lfoot" and "leftfoot".
std::vector<SideMark> side_marks(std::string_view lower, const std::vector<Piece>& words) {
  std::vector<SideMark> marks;
  for (const Piece& word : words) {
    const Side side = side_of_word(lower.substr(word.begin, word.length));
    if (side != Side::kNone) marks.push_back({word, side, true});
  }
  for (const Piece& word : words) {
    const std::string_view text = lower.substr(word.begin, word.length);
    for (const std::string_view mark : {"left", "right"}) {
      const std::size_t at = text.find(mark);
      if (at != std::string_view::npos) marks.push_back({{word.begin + at, mark.size()}, side_of_word(mark), false});
    }
  }
  if (!words.empty()) {
    const Piece letter{words[0].begin, 1};
    const Side side = side_of_word(lower.substr(letter.begin, 1));
    if (side != Side::kNone) marks.push_back({letter, side, false});
  }
  return marks;
}

int find_counterpart(const std::string& lower, const SideMark& mark, const BonesByName& bones) {
  const bool is_letter = mark.piece.length == 1;
  const char* other = mark.side == Side::kLeft ? (is_letter ? "r" : "right") : (is_letter ? "l" : "left");
  const auto found = bones.find(std::string(lower).replace(mark.piece.begin, mark.piece.length, other));
  return found == bones.end() ? -1 : found->second;
}

std::vector<std::string> plain_words(const std::string& lower, const std::vector<Piece>& pieces, const Piece& mark) {
  std::vector<std::string> words;
  for (const Piece& piece : pieces) {
    std::string word = lower.substr(piece.begin, piece.length);
    const bool marked = mark.begin >= piece.begin && mark.begin < piece.begin + piece.length;
    if (marked) word.erase(mark.begin - piece.begin, mark.length);
    while (!word.empty() && is_digit(word.back())) word.pop_back();
    if (!word.empty()) words.push_back(std::move(word));
  }
  return words;
}

BoneName read_name(const std::string& name, const BonesByName& bones) {
  const std::string lower = lower_case(name);
  const std::vector<Piece> pieces = split_words(name);
  BoneName result;
  Piece mark;
  for (const SideMark& candidate : side_marks(lower, pieces)) {
    const int counterpart = find_counterpart(lower, candidate, bones);
    if (counterpart < 0 && (!candidate.is_word || result.side != Side::kNone)) continue;
    result.side = candidate.side;
    result.counterpart = counterpart;
    mark = candidate.piece;
    if (counterpart >= 0) break;
  }
  result.words = plain_words(lower, pieces, mark);
  return result;
}

std::vector<BoneName> read_names(const Skeleton& skeleton) {
  BonesByName bones;
  for (int bone = 0; bone < skeleton.size(); ++bone) bones.emplace(lower_case(skeleton.names[bone]), bone);
  std::vector<BoneName> names;
  names.reserve(skeleton.names.size());
  for (const std::string& name : skeleton.names) names.push_back(read_name(name, bones));
  return names;
}

bool has_any_word(const BoneName& name, std::initializer_list<std::string_view> words) {
  return std::any_of(name.words.begin(), name.words.end(), [&](const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  });
}

bool is_finger(const BoneName& name) {
  return has_any_word(name, {"thumb", "finger", "fingers", "index", "middle", "ring", "pinky", "little"});
}

/// Markers, controls and helpers carry the name of the bone they serve.
bool is_helper(const BoneName& name) {
  return has_any_word(name, {"end", "nub", "top", "tip", "site", "ik", "pole", "target", "ctrl", "control", "twist",
                             "roll", "mch", "helper"});
}

/// How many words a name has beside `keyword`, which may be several of its words together ("up leg"), or -1 where it
/// does not hold the keyword.
int extra_words(const BoneName& name, std::string_view keyword) {
  for (std::size_t first = 0; first < name.words.size(); ++first) {
    std::string run;
    for (std::size_t last = first; last < name.words.size() && run.size() < keyword.size(); ++last) {
      run += name.words[last];
      if (run == keyword) return static_cast<int>(name.words.size() - (last - first + 1));
    }
  }
  return -1;
}

/// Finds roles in a skeleton whose names were read once.
class RoleFinder {
 public:
  explicit RoleFinder(const Skeleton& skeleton) : skeleton_(skeleton), names_(read_names(skeleton)) {}

  Roles find() const {
    Roles roles;
    roles.hips = find_hips();
    roles.head = find_head(roles.hips);
    roles.left_hand = find_hand(Side::kLeft);
    roles.right_hand = find_hand(Side::kRight);
    roles.left_foot = find_foot(Side::kLeft);
    roles.right_foot = find_foot(Side::kRight);
    roles.left_toe = find_toe(Side::kLeft, roles.left_foot);
    roles.right_toe = find_toe(Side::kRight, roles.right_foot);
    roles.left_thigh = find_thigh(Side::kLeft, roles.left_foot, roles.right_foot, roles.hips);
    roles.right_thigh = find_thigh(Side::kRight, roles.right_foot, roles.left_foot, roles.hips);
    return roles;
  }

 private:
  using Keywords = std::initializer_list<std::string_view>;

  /// The bone of this side, below `ancestor`, with a keyword and the fewest other words; the first of equals, or -1.
  int best_match(Side side, Keywords keywords, int ancestor = 0) const {
    int best = -1, best_extra = 0;
    for (int bone = 0; bone < skeleton_.size(); ++bone) {
      if (names_[bone].side != side || is_helper(names_[bone]) || is_finger(names_[bone])) continue;
      for (const std::string_view keyword : keywords) {
        const int extra = extra_words(names_[bone], keyword);
        if (extra >= 0 && (best < 0 || extra < best_extra) && skeleton_.is_below(bone, ancestor)) {
          best = bone;
          best_extra = extra;
        }
      }
    }
    return best;
  }

  int best_match_in_turn(Side side, Keywords first, Keywords second, int ancestor = 0) const {
    const int bone = best_match(side, first, ancestor);
    return bone >= 0 ? bone : best_match(side, second, ancestor);
  }

  int find_hips() const {
    // One group: where both stand in one rig (Daz, Reallusion), the hip is above the pelvis and carries the body.
    const int named = best_match(Side::kNone, {"hips", "hip", "pelvis"});
    if (named >= 0) return named;
    std::vector<int> children(skeleton_.names.size(), 0);
    for (int bone = 1; bone < skeleton_.size(); ++bone) ++children[skeleton_.parents[bone]];
    const auto branching = std::find_if(children.begin(), children.end(), [](int count) { return count >= 3; });
    return branching == children.end() ? 0 : static_cast<int>(branching - children.begin());
  }

  int find_head(int hips) const {
    const int named = best_match(Side::kNone, {"head"});
    return named >= 0 ? named : end_of_spine(hips);
  }

  /// Rigify calls the whole column "spine", from the hips to the head ("spine.006").
  int end_of_spine(int hips) const {
    const auto is_spine = [&](int bone) {
      return names_[bone].side == Side::kNone && names_[bone].words == std::vector<std::string>{"spine"};
    };
    if (!is_spine(hips)) return -1;
    int end = hips;
    for (int bone = hips + 1; bone < skeleton_.size(); ++bone) {
      if (skeleton_.parents[bone] == end && is_spine(bone)) end = bone;
    }
    return end == hips ? -1 : end;
  }

  int find_hand(Side side) const { return best_match_in_turn(side, {"hand"}, {"wrist"}); }

  int find_foot(Side side) const { return best_match_in_turn(side, {"foot"}, {"ankle"}); }

  int find_toe(Side side, int foot) const {
    // Below the foot, since an eyeball is a ball too.
    return best_match_in_turn(side, {"toe", "toes", "toebase"}, {"ball"}, std::max(foot, 0));
  }

  /// By its name, or two bones above the foot; one where the leg has no knee.
  int find_thigh(Side side, int foot, int other_foot, int hips) const {
    const int named = best_match(side, {"thigh", "upleg", "upperleg", "femur"});
    if (named >= 0 || foot < 0) return named;
    const auto carries_leg = [&](int bone) {
      return bone > hips && skeleton_.is_below(bone, hips) && !skeleton_.is_below(other_foot, bone);
    };
    const int above = skeleton_.parents[foot], thigh = above < 0 ? -1 : skeleton_.parents[above];
    if (carries_leg(thigh)) return thigh;
    return carries_leg(above) ? above : -1;
  }

  const Skeleton& skeleton_;
  std::vector<BoneName> names_;
};

}  // namespace

Roles find_roles(const Skeleton& skeleton) { return RoleFinder(skeleton).find(); }

std::vector<int> mirror_bones(const Skeleton& skeleton) {
  const std::vector<BoneName> names = read_names(skeleton);
  std::vector<int> mirror(names.size());
  for (int bone = 0; bone < skeleton.size(); ++bone) {
    const int other = names[bone].counterpart;
    // Both must name each other: names that differ only in case would pair three bones.
    mirror[bone] = other >= 0 && names[other].counterpart == bone ? other : bone;
  }
  return mirror;
}

std::vector<int> measured_bones(const Skeleton& skeleton) {
  const Roles& roles = skeleton.roles;
  const std::vector<BoneName> names = read_names(skeleton);
  const auto is_beyond = [&](int bone, int end) { return end >= 0 && bone != end && skeleton.is_below(bone, end); };
  const int hips = std::max(roles.hips, 0);
  std::vector<int> bones{hips};  // whatever the roles are, Dis sums over something
  for (int bone = hips + 1; bone < skeleton.size(); ++bone) {
    if (!skeleton.is_below(bone, hips)) continue;
    const bool is_face = is_beyond(bone, roles.head);
    const bool is_hand_part = is_beyond(bone, roles.left_hand) || is_beyond(bone, roles.right_hand);
    // CMU's thumbs hang on the wrist beside the hand, so the place alone does not tell fingers.
    const bool is_named_finger = names[bone].side != Side::kNone && is_finger(names[bone]);
    if (!is_face && !is_hand_part && !is_named_finger) bones.push_back(bone);
  }
  return bones;
}

}  // namespace fragmotion
