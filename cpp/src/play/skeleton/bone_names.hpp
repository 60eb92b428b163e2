// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace fragmotion {

enum class Side { kNone, kLeft, kRight };
constexpr Side kSides[] = {Side::kLeft, Side::kRight};

/// A number in a bone's name.
struct NameNumber {
  int value = 0;
  int digits = 0;
  int word = -1;  ///< Which of the name's words it ends or follows; -1 ahead of all.
};

/// What a bone's name says, in lower case: words without the namespace, the side's mark and trailing numbers.
struct BoneName {
  std::vector<std::string> words;
  std::vector<NameNumber> numbers;  ///< In their order.
  Side side = Side::kNone;
  int counterpart = -1;  ///< The bone with the other side's mark, or -1.
};

/// The names of all bones. ASCII letters alone have capitals: the locale must not change what a name means.
std::vector<BoneName> read_names(const std::vector<std::string>& bone_names);

bool has_any_word(const BoneName& name, std::initializer_list<std::string_view> words);

/// How many words a name has beside `keyword`, which may be several of its words together ("up leg"), or -1 where it
/// does not hold the keyword. In alphabets without spaces the keyword may be a part of a word.
int extra_words(const BoneName& name, std::string_view keyword);

bool is_finger(const BoneName& name);

/// The numbers at and behind the first of `words` that a name has: of "Bip01 L Finger12", "finger" 12. None where it
/// has none of them.
std::vector<NameNumber> numbers_from(const BoneName& name, std::initializer_list<std::string_view> words);

}  // namespace fragmotion
