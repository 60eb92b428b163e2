// SPDX-License-Identifier: MIT
#include "evaluate/suggest.hpp"

#include <algorithm>

#include "base/rates.hpp"
#include "build/build.hpp"
#include "build/stages.hpp"
#include "control/simulated_players.hpp"
#include "evaluate/performance.hpp"
#include "runtime/player.hpp"

namespace fragmotion {
namespace {

constexpr int kTried[] = {24, 34, 48, 68, 97, 137, 194, 274};
constexpr int kFragmentsAClass = 4;
constexpr double kAsGood = 1.05;  // times the smallest error
constexpr double kSeconds = 60;
constexpr std::uint64_t kSeed = 7;

ClassesTried judged(const std::shared_ptr<const Character>& character) {
  ClassesTried tried{character->classes.count, 0, 0};
  double commanded = 0, error = 0;
  const std::vector<std::string>& players = simulated_players();
  for (const std::string& name : players) {
    const Performance p =
        perform(Player(character), simulate_trace(name, kSeconds, kSeed, character->space), kPoseRate);
    tried.quality += p.quality / static_cast<double>(players.size());
    error += p.velocity_error;
    commanded += p.commanded_speed;
  }
  tried.velocity_error = error / commanded;
  return tried;
}

// The numbers of classes that so many fragments can fill; the paper's, or what there is, for very few.
std::vector<int> numbers(int fragments) {
  std::vector<int> numbers;
  for (const int n : kTried) {
    if (n * kFragmentsAClass <= fragments) numbers.push_back(n);
  }
  if (numbers.empty()) numbers.push_back(std::max(1, fragments / kFragmentsAClass));
  return numbers;
}

}  // namespace

Suggestion suggest_classes(const Skeleton& skeleton, const std::vector<Clip>& clips, const std::vector<Trace>& traces,
                           const BuildOptions& options, const Progress& progress) {
  const Material material = prepare(skeleton, clips, traces, options, part_of(progress, 0, 0.1));
  const std::vector<int> counts = numbers(static_cast<int>(material.character->pool.fragments.size()));
  BuildOptions now = options;
  now.policies = {options.policies.front()};
  Suggestion suggestion;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double from = 0.1 + 0.9 * static_cast<double>(i) / static_cast<double>(counts.size());
    now.classes = counts[i];
    learn(material, now, part_of(progress, from, from + 0.9 / static_cast<double>(counts.size())));
    suggestion.tried.push_back(judged(material.character));
  }
  const auto less = [](const ClassesTried& a, const ClassesTried& b) { return a.velocity_error < b.velocity_error; };
  const double least = std::min_element(suggestion.tried.begin(), suggestion.tried.end(), less)->velocity_error;
  suggestion.classes = std::find_if(suggestion.tried.begin(), suggestion.tried.end(), [&](const ClassesTried& each) {
                         return each.velocity_error <= kAsGood * least;
                       })->classes;
  return suggestion;
}

}  // namespace fragmotion
