// SPDX-License-Identifier: MIT
#include "skeleton/body_words.hpp"

#include <algorithm>
#include <string_view>

namespace fragmotion {
namespace {

struct Term {
  std::string_view phrase;
  Role role;
  double score;
};

constexpr double kExtraWord = 0.1;

constexpr Term kTrunk[] = {
    {"hips", Role::kHips, 3},        {"hip", Role::kHips, 3},          {"pelvis", Role::kHips, 3},
    {"lowerbody", Role::kHips, 1},   {"spine", Role::kSpine, 3},       {"chest", Role::kSpine, 3},
    {"upperchest", Role::kSpine, 3}, {"abdomen", Role::kSpine, 3},     {"torso", Role::kSpine, 2.5},
    {"thorax", Role::kSpine, 3},     {"ribs", Role::kSpine, 2},        {"ribcage", Role::kSpine, 2.5},
    {"waist", Role::kSpine, 2},      {"lowerback", Role::kSpine, 3},   {"upperback", Role::kSpine, 3},
    {"back", Role::kSpine, 2},       {"stomach", Role::kSpine, 2.5},   {"upperbody", Role::kSpine, 2.5},
    {"neck", Role::kNeck, 3},        {"head", Role::kHead, 3},         {"skull", Role::kHead, 2.5},
    {"センター", Role::kHips, 1},    {"下半身", Role::kHips, 1},       {"腰", Role::kHips, 2},
    {"骨盆", Role::kHips, 3},        {"골반", Role::kHips, 3},         {"엉덩이", Role::kHips, 2},
    {"таз", Role::kHips, 3},         {"上半身", Role::kSpine, 3},      {"胸", Role::kSpine, 3},
    {"脊椎", Role::kSpine, 3},       {"脊柱", Role::kSpine, 3},        {"척추", Role::kSpine, 3},
    {"가슴", Role::kSpine, 3},       {"позвоночник", Role::kSpine, 3}, {"спина", Role::kSpine, 3},
    {"грудь", Role::kSpine, 3},      {"首", Role::kNeck, 3},           {"颈", Role::kNeck, 3},
    {"脖子", Role::kNeck, 3},        {"목", Role::kNeck, 3},           {"шея", Role::kNeck, 3},
    {"頭", Role::kHead, 3},          {"头", Role::kHead, 3},           {"머리", Role::kHead, 3},
    {"голова", Role::kHead, 3},
};

constexpr Term kLimbs[] = {
    {"clavicle", Role::kShoulder, 3},
    {"collar", Role::kShoulder, 3},
    {"collarbone", Role::kShoulder, 3},
    {"scapula", Role::kShoulder, 2.5},
    {"shoulder", Role::kShoulder, 2},
    {"shoulder", Role::kUpperArm, 1},
    {"upperarm", Role::kUpperArm, 3},
    {"uparm", Role::kUpperArm, 3},
    {"armupper", Role::kUpperArm, 3},
    {"humerus", Role::kUpperArm, 3},
    {"shldr", Role::kUpperArm, 3},
    {"arm", Role::kUpperArm, 1.5},
    {"arm", Role::kLowerArm, 0.5},
    {"forearm", Role::kLowerArm, 3},
    {"lowerarm", Role::kLowerArm, 3},
    {"lowarm", Role::kLowerArm, 3},
    {"armlower", Role::kLowerArm, 3},
    {"radius", Role::kLowerArm, 3},
    {"ulna", Role::kLowerArm, 2},
    {"elbow", Role::kLowerArm, 2.5},
    {"hand", Role::kHand, 3},
    {"wrist", Role::kHand, 2},
    {"thigh", Role::kThigh, 3},
    {"upleg", Role::kThigh, 3},
    {"upperleg", Role::kThigh, 3},
    {"legupper", Role::kThigh, 3},
    {"femur", Role::kThigh, 3},
    {"hip", Role::kThigh, 2},
    {"leg", Role::kThigh, 1},
    {"leg", Role::kShin, 1},
    {"shin", Role::kShin, 3},
    {"calf", Role::kShin, 3},
    {"lowerleg", Role::kShin, 3},
    {"lowleg", Role::kShin, 3},
    {"leglower", Role::kShin, 3},
    {"tibia", Role::kShin, 3},
    {"knee", Role::kShin, 2.5},
    {"foot", Role::kFoot, 3},
    {"foot", Role::kToe, 1},
    {"ankle", Role::kFoot, 2},
    {"toe", Role::kToe, 3},
    {"toes", Role::kToe, 3},
    {"toebase", Role::kToe, 3},
    {"ball", Role::kToe, 2.5},
    {"metatarsals", Role::kToe, 1.5},
    {"肩", Role::kShoulder, 3},
    {"鎖骨", Role::kShoulder, 3},
    {"锁骨", Role::kShoulder, 3},
    {"어깨", Role::kShoulder, 3},
    {"쇄골", Role::kShoulder, 3},
    {"ключица", Role::kShoulder, 3},
    {"腕", Role::kUpperArm, 2.5},
    {"上腕", Role::kUpperArm, 3},
    {"上臂", Role::kUpperArm, 3},
    {"大臂", Role::kUpperArm, 3},
    {"위팔", Role::kUpperArm, 3},
    {"плечо", Role::kUpperArm, 2.5},
    {"ひじ", Role::kLowerArm, 3},
    {"肘", Role::kLowerArm, 3},
    {"前腕", Role::kLowerArm, 3},
    {"前臂", Role::kLowerArm, 3},
    {"小臂", Role::kLowerArm, 3},
    {"팔꿈치", Role::kLowerArm, 3},
    {"아래팔", Role::kLowerArm, 3},
    {"предплечье", Role::kLowerArm, 3},
    {"локоть", Role::kLowerArm, 2.5},
    {"手首", Role::kHand, 3},
    {"手腕", Role::kHand, 2.5},
    {"手", Role::kHand, 2},
    {"손목", Role::kHand, 2.5},
    {"손", Role::kHand, 3},
    {"кисть", Role::kHand, 3},
    {"запястье", Role::kHand, 2},
    {"足", Role::kThigh, 2},
    {"太もも", Role::kThigh, 3},
    {"大腿", Role::kThigh, 3},
    {"허벅지", Role::kThigh, 3},
    {"бедро", Role::kThigh, 3},
    {"ひざ", Role::kShin, 3},
    {"膝", Role::kShin, 3},
    {"すね", Role::kShin, 3},
    {"小腿", Role::kShin, 3},
    {"종아리", Role::kShin, 3},
    {"무릎", Role::kShin, 2.5},
    {"голень", Role::kShin, 3},
    {"колено", Role::kShin, 2.5},
    {"足首", Role::kFoot, 3},
    {"脚", Role::kFoot, 2},
    {"脚踝", Role::kFoot, 2.5},
    {"발목", Role::kFoot, 2.5},
    {"발", Role::kFoot, 3},
    {"стопа", Role::kFoot, 3},
    {"ступня", Role::kFoot, 3},
    {"つま先", Role::kToe, 3},
    {"足先", Role::kToe, 3},
    {"脚趾", Role::kToe, 3},
    {"발가락", Role::kToe, 3},
    {"носок", Role::kToe, 3},
    {"指", Role::kFinger, 3},
    {"손가락", Role::kFinger, 3},
    {"палец", Role::kFinger, 3},
};

/// A phrase says nothing inside a longer one: "arm" in "fore arm", and where words stand unseparated that of a neck in
/// those of wrists.
template <std::size_t N>
std::size_t longest_phrase(const BoneName& name, const Term (&terms)[N]) {
  std::size_t longest = 0;
  for (const Term& term : terms) {
    if (term.phrase.size() > longest && extra_words(name, term.phrase) >= 0) longest = term.phrase.size();
  }
  return longest;
}

bool is_vertebra(const BoneName& name) {  // Xsens: L5, L3, T12, T8
  if (name.words.size() != 1 || name.numbers.size() != 1) return false;
  const int number = name.numbers[0].value;
  return (name.words[0] == "l" && number >= 1 && number <= 5) || (name.words[0] == "t" && number >= 1 && number <= 12);
}

/// The best score of each role; whether any phrase says something.
template <std::size_t N>
bool score_terms(const BoneName& name, const Term (&terms)[N], std::array<double, kRoles>& scores) {
  const std::size_t longest = longest_phrase(name, terms);
  for (const Term& term : terms) {
    if (term.phrase.size() != longest) continue;
    const int extra = extra_words(name, term.phrase);
    double& score = scores[static_cast<int>(term.role)];
    if (extra >= 0) score = std::max(score, term.score - kExtraWord * extra);
  }
  return longest > 0;
}

/// Of a joint that is named after both of what it joins, "torso_head", the last word counts: that hangs from it.
bool score_trunk(const BoneName& name, std::array<double, kRoles>& scores) {
  const bool something = score_terms(name, kTrunk, scores);
  if (name.words.size() < 2) return something;
  BoneName last = name;
  last.words.erase(last.words.begin(), last.words.end() - 1);
  std::array<double, kRoles> of_last{};
  if (score_terms(last, kTrunk, of_last)) {
    bool agrees = false;
    for (int role = 0; role < kRoles; ++role) agrees = agrees || (scores[role] > 0 && of_last[role] > 0);
    if (!agrees) scores = of_last;
  }
  return something;
}

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

}  // namespace

std::array<double, kRoles> says(const BoneName& name) {
  std::array<double, kRoles> scores{};
  bool something = true;
  if (name.side != Side::kNone) {
    something = is_finger(name) || score_terms(name, kLimbs, scores);
    if (is_finger(name) && extra_words(name, "foot") >= 0) scores[static_cast<int>(Role::kToe)] = 1;  // "FootThumb1"
    if (!something) {
      std::array<double, kRoles> trunk{};
      something = score_terms(name, kTrunk, trunk);
    }
    for (int role = 0; role < static_cast<int>(Role::kShoulder); ++role) scores[role] = kContradicts;
  } else if (is_vertebra(name)) {
    scores[static_cast<int>(Role::kSpine)] = 2.5;
  } else {
    something = score_trunk(name, scores);
  }
  for (double& score : scores) {
    if (something && score <= 0) score = kContradicts;
  }
  return scores;
}

int finger_of(const BoneName& name, const FingerNumbers& usual) {
  constexpr std::string_view kFingers[][5] = {{"thumb", "親指", "엄지", "拇指", "大拇指"},
                                              {"index", "人指", "人差指", "검지", "食指"},
                                              {"middle", "mid", "中指", "중지", "中指"},
                                              {"ring", "薬指", "약지", "无名指", "薬指"},
                                              {"pinky", "little", "小指", "새끼", "pinkie"}};
  for (int finger = 0; finger < 5; ++finger) {
    for (const std::string_view word : kFingers[finger]) {
      if (extra_words(name, word) >= 0) return finger;
    }
  }
  const std::vector<NameNumber> numbers = numbers_from(name, {"finger"});
  if (numbers.empty()) return -1;
  int number = numbers[0].value;
  const bool of_thumb = usual.first == 0 && usual.one_digit && numbers[0].digits == 2;
  if (numbers.size() == 1 && (number >= 10 || of_thumb)) number /= 10;  // Finger12, and Finger01
  number -= usual.first;
  return number >= 0 && number < 5 ? number : -1;
}

bool says_helper(const BoneName& name) {
  return has_any_word(
             name, {"end",       "nub",     "top",    "tip",    "site",   "leaf",       "ik",     "pole",     "target",
                    "ctrl",      "control", "mch",    "helper", "share",  "corrective", "sec",    "adj",      "dummy",
                    "prop",      "props",   "weapon", "tweak",  "vis",    "socket",     "attach", "heel",     "hair",
                    "skirt",     "cloth",   "eye",    "jaw",    "tongue", "ear",        "breast", "pectoral", "tail",
                    "footsteps", "marker",  "widget", "wgt",    "parent", "metacarpal", "ｉｋ",   "pivot",    "spin",
                    "rock",      "bck",     "fwd",    "inn"}) ||
         std::any_of(name.words.begin(), name.words.end(), [](const std::string& word) {
           return ends_with(word, "ｉｋ") || ends_with(word, "ＩＫ") || ends_with(word, "親") ||
                  ends_with(word, "キャンセル");
         });
}

bool says_twist(const BoneName& name) {
  const bool twists = std::any_of(name.words.begin(), name.words.end(), [](const std::string& word) {
    return word == "roll" || word == "stretch2" || word.find("twist") != std::string::npos ||
           word.find("捩") != std::string::npos || word.find("ひねり") != std::string::npos;
  });
  return twists && extra_words(name, "neck") < 0;  // Character Creator's necks are "NeckTwist01"
}

}  // namespace fragmotion
