// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "build/exclude_classes.hpp"
#include "build/styles.hpp"
#include "character/policy_file.hpp"
#include "made_styles.hpp"
#include "mocap_files.hpp"
#include "runtime/player.hpp"

namespace fragmotion {
namespace {

std::string refusal_of_styles(const std::vector<StyledCharacter>& styles) {
  return error_of([&] { with_styles(styles); });
}

// As it is without its style's name and the other styles.
std::string bytes_alone(Character character) {
  character.style.clear();
  character.styles.clear();
  measure_looks_and_arms(character);
  return to_bytes(character);
}

TEST(Styles, AreWhatABuildMakesOfTheirTakesAlone) {
  const Character both =
      build_styles(humanoid(), {{"normal", gait_takes()}, {"tired", tired_takes()}}, style_traces(), style_options());
  ASSERT_EQ(both.style_count(), 2);
  EXPECT_TRUE(bytes_alone(both) == to_bytes(build(humanoid(), gait_takes(), style_traces(), style_options())));
  EXPECT_TRUE(bytes_alone(both.in_style(1)) == to_bytes(*tired_character()));
}

TEST(Styles, OfOneNameHaveAPolicyFileOfTheirOwnAndAreOneStyle) {
  const Character one = with_styles({{"normal", gait_character()}});
  EXPECT_EQ(from_bytes(to_bytes(one)).style, "normal");
  EXPECT_EQ(one.style_count(), 1);
  EXPECT_TRUE(bytes_alone(one) == to_bytes(*gait_character()));
}

TEST(Styles, AreInThePolicyFile) {
  const std::string bytes = to_bytes(*styled_character());
  const Character back = from_bytes(bytes);
  EXPECT_TRUE(to_bytes(back) == bytes);
  ASSERT_EQ(back.style_count(), 2);
  EXPECT_EQ(back.style, "normal");
  EXPECT_EQ(back.in_style(1).style, "tired");
  EXPECT_EQ(back.in_style(1).entry_poses, styled_character()->in_style(1).entry_poses);
  EXPECT_EQ(back.in_style(1).quality.match, tired_character()->quality.match);
  EXPECT_EQ(back.moves.size(), 4U);
}

TEST(Styles, OfAFileThatIsCutShortAreRefused) {
  const std::string bytes = to_bytes(*styled_character());
  for (std::size_t size = bytes.size() - 1; size > bytes.size() - 300; --size) {
    EXPECT_NE(error_of([&] { from_bytes(bytes.substr(0, size)); }), "no error") << size;
  }
}

TEST(Styles, StayWhenMovesAndClassesChange) {
  EXPECT_EQ(with_moves(*styled_character(), {}).style_count(), 2);
  EXPECT_EQ(without_classes(*styled_character(), {3}).style_count(), 2);
}

TEST(Styles, LeaveOutClassesOfTheirOwn) {
  const Character& tired = styled_character()->in_style(1);
  const int often = tired.policies[0].next[0];
  const Character left = without_classes(*styled_character(), {often}, 1);
  EXPECT_TRUE(bytes_alone(left) == bytes_alone(*styled_character()));
  EXPECT_TRUE(bytes_alone(left.in_style(1)) == bytes_alone(without_classes(tired, {often})));
  const std::vector<int>& next = left.in_style(1).policies[0].next;
  EXPECT_EQ(std::count(next.begin(), next.end(), often), 0);
  EXPECT_EQ(error_of([] { without_classes(*styled_character(), {0}, 2); }),
            "style 2 does not exist; the character has 2");
}

TEST(Styles, AreRefusedWithTheirNameAndTheCause) {
  const auto normal = gait_character();
  EXPECT_EQ(refusal_of_styles({}), "a character has one style at least");
  EXPECT_EQ(refusal_of_styles({{"", normal}}), "a style has no name");
  EXPECT_EQ(refusal_of_styles({{"a", normal}, {"a", normal}}),
            "style \"a\": it is there twice; give one of them another name");
  EXPECT_EQ(refusal_of_styles({{"a", normal}, {"b", styled_character()}}),
            "style \"b\": its character has styles itself; give each by itself");
  EXPECT_EQ(refusal_of_styles({{"a", normal}, {"b", std::make_shared<const Character>(tiny_character())}}),
            "style \"b\": it is of another skeleton than the first style; build it on that");
  EXPECT_EQ(refusal_of_styles(std::vector<StyledCharacter>(65, {"a", normal})),
            "65 styles are too many: a character has at most 64");
  Character other = *normal;
  other.policies.pop_back();
  EXPECT_EQ(refusal_of_styles({{"a", normal}, {"b", std::make_shared<const Character>(other)}}),
            "style \"b\": it has other policies than the first style; build it with the same");
}

TEST(Styles, ThatCannotBeBuiltAreNamed) {
  const std::vector<Clip> short_take{part(gait_takes().front(), 0, 2)};
  EXPECT_EQ(
      error_of([&] {
        build_styles(humanoid(), {{"normal", gait_takes()}, {"odd", short_take}}, style_traces(), style_options());
      }),
      "style \"odd\": the takes are too short: none holds a fragment of 0.100000 s");
  EXPECT_EQ(error_of([&] {
              build_styles(humanoid(), {{"none", {}}}, style_traces(), style_options());
            }),
            "style \"none\": there are no takes to build from");
}

TEST(Styles, ThatAFileForgesAreRefused) {
  const auto forged = [](auto change) {
    Character character = *styled_character(), other = *character.styles[0];
    change(character, other);
    if (!character.styles.empty()) character.styles[0] = std::make_shared<const Character>(other);
    return error_of([&] { to_bytes(character); });
  };
  EXPECT_EQ(forged([](Character&, Character&) {}), "no error");
  EXPECT_NE(forged([](Character& c, Character&) { c.style.clear(); }), "no error");
  EXPECT_NE(forged([](Character& c, Character&) { c.styles.resize(64, c.styles[0]); }), "no error");
  EXPECT_NE(forged([](Character&, Character& other) { other.style = "normal"; }), "no error");
  EXPECT_NE(forged([](Character&, Character& other) { other.style.clear(); }), "no error");
  EXPECT_NE(forged([](Character&, Character& other) { other.policies.pop_back(); }), "no error");
  EXPECT_NE(forged([](Character&, Character& other) { other.policies[0].next[0] = 40; }), "no error");
  EXPECT_NE(forged([](Character&, Character& other) { other.moves = styled_character()->moves; }), "no error");
  EXPECT_NE(forged([](Character&, Character& other) { other.pool.fragments[0].clip = -1; }), "no error");
}

}  // namespace
}  // namespace fragmotion
