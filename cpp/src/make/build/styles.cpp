// SPDX-License-Identifier: MIT
#include "build/styles.hpp"

#include <set>
#include <stdexcept>

#include "build/stages.hpp"
#include "fragments/entry_poses.hpp"
#include "skeleton/same_skeleton.hpp"

namespace fragmotion {
namespace {

[[noreturn]] void refuse_style(const std::string& name, const std::string& why) {
  throw std::invalid_argument("style \"" + name + "\": " + why);
}

template <typename Style>
void check_names(const std::vector<Style>& styles) {
  if (styles.empty()) throw std::invalid_argument("a character has one style at least");
  if (styles.size() > kMostStyles) {
    throw std::invalid_argument(std::to_string(styles.size()) + " styles are too many: a character has at most " +
                                std::to_string(kMostStyles));
  }
  std::set<std::string> names;
  for (const Style& style : styles) {
    if (style.name.empty()) throw std::invalid_argument("a style has no name");
    if (!names.insert(style.name).second) refuse_style(style.name, "it is there twice; give one of them another name");
  }
}

std::vector<std::string> policies_of(const Character& character) {
  std::vector<std::string> names;
  for (const Policy& policy : character.policies) names.push_back(policy.name);
  return names;
}

void check(const StyledCharacter& style, const Character& first) {
  const Character& character = *style.character;
  if (!character.styles.empty()) refuse_style(style.name, "its character has styles itself; give each by itself");
  if (!same_skeleton(character.pool.skeleton, first.pool.skeleton)) {
    refuse_style(style.name, "it is of another skeleton than the first style; build it on that");
  }
  if (policies_of(character) != policies_of(first)) {
    refuse_style(style.name, "it has other policies than the first style; build it with the same");
  }
}

}  // namespace

Character with_styles(const std::vector<StyledCharacter>& styles) {
  check_names(styles);
  for (const StyledCharacter& style : styles) check(style, *styles.front().character);
  Character result = *styles.front().character;
  result.style = styles.front().name;
  for (std::size_t i = 1; i < styles.size(); ++i) {
    Character other = without_moves(*styles[i].character);
    other.style = styles[i].name;
    other.pool.skeleton = result.pool.skeleton;
    other.entry_poses = entry_poses(other.pool);
    result.styles.push_back(std::make_shared<const Character>(std::move(other)));
  }
  measure_looks_and_arms(result);
  return result;
}

Character build_styles(const Skeleton& skeleton, const std::vector<StyleTakes>& styles,
                       const std::vector<Trace>& traces, const BuildOptions& options, const Progress& progress) {
  check_names(styles);
  std::vector<StyledCharacter> built;
  const auto share = [&](std::size_t i) { return static_cast<double>(i) / static_cast<double>(styles.size()); };
  for (std::size_t i = 0; i < styles.size(); ++i) {
    const auto& [name, clips] = styles[i];
    try {
      const Progress part = part_of(progress, share(i), share(i + 1));
      built.push_back({name, std::make_shared<const Character>(build(skeleton, clips, traces, options, part))});
    } catch (const std::invalid_argument& error) {
      refuse_style(name, error.what());
    }
  }
  return with_styles(built);
}

}  // namespace fragmotion
