// SPDX-License-Identifier: MIT
#include "skeleton/bone_names.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <unordered_map>
#include <utility>

namespace fragmotion {
namespace {

/// A piece of a name: a word, or the mark of a side.
struct Piece {
  std::size_t begin = 0, length = 0;
};

struct SideMark {
  Piece piece;
  Side side = Side::kNone;
  std::string_view other;  ///< The mark of the other side.
  bool is_word = false;    ///< A word of its own tells the side even where the counterpart is missing.
};

struct SideWords {
  std::string_view left, right;
};

// A whole word of a name, or anywhere in one; the latter in other alphabets, whose words often stand unseparated.
constexpr SideWords kWholeWords[] = {{"l", "r"}, {"left", "right"}};
constexpr SideWords kShortWords[] = {{"lf", "rt"}, {"lf", "rg"}, {"lft", "rgt"}};  // where the counterpart is there
constexpr SideWords kParts[] = {{"left", "right"}};
constexpr SideWords kOtherAlphabets[] = {
    {"左", "右"}, {"왼", "오른"}, {"левый", "правый"}, {"левая", "правая"}, {"лев", "прав"}};

using BonesByName = std::unordered_map<std::string, int>;

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

std::size_t length_of_namespace(std::string_view name) { return name.find_last_of(":|") + 1; }

/// Whether what stands before a ":" tells bones apart, as in "Leg:Left:Upper" beside "Arm:Left:Upper": no namespace.
bool has_no_namespace(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const std::string_view plain = std::string_view(name).substr(length_of_namespace(name));
    for (const std::string_view other : names) {
      if (plain.size() == name.size() || other.data() == name.data() || other.size() < plain.size()) continue;
      const std::size_t at = other.size() - plain.size();
      if (other.substr(at) == plain && length_of_namespace(other) == at) return true;
    }
  }
  return false;
}

std::vector<Piece> split_words(std::string_view name, std::size_t start) {
  std::vector<Piece> words;
  for (std::size_t at = start; at < name.size(); ++at) {
    if (!is_word_character(name[at])) continue;
    const bool first = at == start || !is_word_character(name[at - 1]);
    if (first || is_camel_boundary(name, at)) words.push_back({at, 0});
    ++words.back().length;
  }
  return words;
}

template <std::size_t N>
void mark_whole_word(const Piece& word, std::string_view text, const SideWords (&sides)[N], bool is_word,
                     std::vector<SideMark>& marks) {
  for (const SideWords& words : sides) {
    if (text == words.left) marks.push_back({word, Side::kLeft, words.right, is_word});
    if (text == words.right) marks.push_back({word, Side::kRight, words.left, is_word});
  }
}

template <std::size_t N>
void mark_parts(const Piece& word, std::string_view text, const SideWords (&sides)[N], bool is_word,
                std::vector<SideMark>& marks) {
  const auto mark = [&](std::string_view here, Side side, std::string_view other) {
    const std::size_t at = text.find(here);
    if (at != std::string_view::npos) marks.push_back({{word.begin + at, here.size()}, side, other, is_word});
  };
  for (const SideWords& words : sides) {
    mark(words.left, Side::kLeft, words.right);
    mark(words.right, Side::kRight, words.left);
  }
}

/// Every place where a name may tell its side: whole words first, then "lfoot" and "leftfoot".
std::vector<SideMark> side_marks(std::string_view lower, const std::vector<Piece>& words) {
  std::vector<SideMark> marks;
  const auto text_of = [&](const Piece& word) { return lower.substr(word.begin, word.length); };
  for (const Piece& word : words) mark_whole_word(word, text_of(word), kWholeWords, true, marks);
  for (const Piece& word : words) mark_whole_word(word, text_of(word), kShortWords, false, marks);
  for (const Piece& word : words) mark_parts(word, text_of(word), kParts, false, marks);
  for (const Piece& word : words) mark_parts(word, text_of(word), kOtherAlphabets, true, marks);
  if (!words.empty()) {
    const char letter = lower[words[0].begin];
    if (letter == 'l') marks.push_back({{words[0].begin, 1}, Side::kLeft, "r", false});
    if (letter == 'r') marks.push_back({{words[0].begin, 1}, Side::kRight, "l", false});
  }
  return marks;
}

int find_counterpart(const std::string& lower, const SideMark& mark, const BonesByName& bones) {
  const auto found = bones.find(std::string(lower).replace(mark.piece.begin, mark.piece.length, mark.other));
  return found == bones.end() ? -1 : found->second;
}

/// The number that a text ends with; of no digits where it has none.
NameNumber number_at_end(std::string_view text) {
  constexpr int kMostDigits = 4;
  const auto last = static_cast<int>(text.find_last_not_of("0123456789"));
  const int digits = static_cast<int>(text.size()) - last - 1;
  if (digits == 0 || digits > kMostDigits) return {};
  return {std::stoi(std::string(text.substr(text.size() - digits))), digits};
}

/// Words without the side's mark, and the numbers that they end with or that stand between them: of "finger1-2" 1
/// and 2.
void read_pieces(const std::string& lower, const std::vector<Piece>& pieces, const Piece& mark, BoneName& name) {
  for (const Piece& piece : pieces) {
    std::string word = lower.substr(piece.begin, piece.length);
    NameNumber number = number_at_end(word);
    const bool marked = mark.begin >= piece.begin && mark.begin < piece.begin + piece.length;
    if (marked) word.erase(mark.begin - piece.begin, mark.length);
    while (!word.empty() && is_digit(word.back())) word.pop_back();
    if (!word.empty()) name.words.push_back(std::move(word));
    number.word = static_cast<int>(name.words.size()) - 1;
    if (number.digits > 0) name.numbers.push_back(number);
  }
}

BoneName read_name(const std::string& name, std::size_t start, const BonesByName& bones) {
  const std::string lower = lower_case(name);
  const std::vector<Piece> pieces = split_words(name, start);
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
  read_pieces(lower, pieces, mark, result);
  return result;
}

/// The first of some words in a name; as many as it has where there is none.
int first_word(const BoneName& name, std::initializer_list<std::string_view> words) {
  const auto is_one = [&](const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  return static_cast<int>(std::find_if(name.words.begin(), name.words.end(), is_one) - name.words.begin());
}

/// How many words of a name are not touched by `keyword` when words are written together.
int extra_unseparated(const BoneName& name, std::string_view keyword) {
  for (const std::string& word : name.words) {
    if (word.find(keyword) == std::string::npos) continue;
    const bool alone = word.size() == keyword.size();
    return static_cast<int>(name.words.size()) - (alone ? 1 : 0);
  }
  return -1;
}

}  // namespace

std::vector<BoneName> read_names(const std::vector<std::string>& bone_names) {
  BonesByName bones;
  for (std::size_t bone = 0; bone < bone_names.size(); ++bone) {
    bones.emplace(lower_case(bone_names[bone]), static_cast<int>(bone));
  }
  std::vector<BoneName> names;
  names.reserve(bone_names.size());
  const bool whole = has_no_namespace(bone_names);
  for (const std::string& name : bone_names) {
    names.push_back(read_name(name, whole ? 0 : length_of_namespace(name), bones));
  }
  return names;
}

bool has_any_word(const BoneName& name, std::initializer_list<std::string_view> words) {
  return first_word(name, words) < static_cast<int>(name.words.size());
}

std::vector<NameNumber> numbers_from(const BoneName& name, std::initializer_list<std::string_view> words) {
  const int first = first_word(name, words);
  std::vector<NameNumber> numbers;
  for (const NameNumber& number : name.numbers) {
    if (number.word >= first) numbers.push_back(number);
  }
  return numbers;
}

int extra_words(const BoneName& name, std::string_view keyword) {
  if (static_cast<unsigned char>(keyword[0]) >= 0x80) return extra_unseparated(name, keyword);
  for (std::size_t first = 0; first < name.words.size(); ++first) {
    if (name.words[first][0] != keyword[0]) continue;
    std::string run;
    for (std::size_t last = first; last < name.words.size() && run.size() < keyword.size(); ++last) {
      run += name.words[last];
      if (run == keyword) return static_cast<int>(name.words.size() - (last - first + 1));
    }
  }
  return -1;
}

bool is_finger(const BoneName& name) {
  return has_any_word(name, {"thumb", "finger", "fingers", "index", "middle", "ring", "pinky", "little"});
}

}  // namespace fragmotion
