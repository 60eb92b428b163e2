// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace fragmotion {

enum class Side { kNone, kLeft, kRight };

/// What a bone's name says, in lower case: words without the namespace, the side's mark and trailing numbers.
struct BoneName {
  std::vector<std::string> words;
  std::vector<int> numbers;  ///< In their order.
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

}  // namespace fragmotion
