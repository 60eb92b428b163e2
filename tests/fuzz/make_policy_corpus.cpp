// SPDX-License-Identifier: MIT
// Writes the policy fuzzers' corpus into the folder given: make_policy_corpus tests/fuzz/corpus
#include <filesystem>
#include <fstream>

#include "build/build.hpp"
#include "made_styles.hpp"
#include "policies.hpp"

namespace fragmotion {
namespace {

/// Legs, contacts and measured feet: a humanoid that stands and walks, also mirrored.
Character walking_character() {
  Gait stand, walk;
  stand.y = 0;
  stand.seconds = walk.seconds = 1.2;
  stand.rate = walk.rate = 15;
  BuildOptions options;
  options.classes = 3;
  options.synthesize = false;
  options.policies = {"greedy", "anticipate"};
  return build(humanoid(), {gait_clip(stand, "stand"), gait_clip(walk, "walk")}, {{{}, {}}}, options);
}

/// With a move of the whole body and a looping one of the upper body.
Character character_with_moves() {
  return with_moves(walking_character(), {{"lunge", lunge_clip(0.6, 0.8, 0.6), false, 0.1, {}},
                                          {"wave", wave_clip(1), true, 0.1, {0.3, 0.7}}});
}

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

void write_corpus(const std::filesystem::path& folder) {
  const std::string tiny = to_bytes(tiny_character());
  write(folder / "forged_policy" / "tiny", core_of(tiny));
  write(folder / "forged_policy" / "walking", core_of(to_bytes(walking_character())));
  const auto walking = std::make_shared<const Character>(walking_character()),
             moving = std::make_shared<const Character>(character_with_moves());
  write(folder / "forged_policy" / "moves", core_of(to_bytes(*moving)));
  write(folder / "forged_policy" / "styles", core_of(to_bytes(with_styles({{"own", moving}, {"other", walking}}))));
  // Cores with calls after them, all kinds of them (fuzz_game.cpp).
  std::string calls;
  for (int i = 0; i < 160; ++i) calls += static_cast<char>(i * 37 % 251);
  write(folder / "game" / "moves", core_of(to_bytes(*moving)) + calls);
  write(folder / "game" / "styles", core_of(to_bytes(with_styles({{"own", moving}, {"other", walking}}))) + calls);
  write(folder / "policy" / "header", tiny.substr(0, kHeaderBytes));
  write(folder / "policy" / "cut", tiny.substr(0, 400));
  write(folder / "policy" / "empty", file_with_core(""));
}

}  // namespace
}  // namespace fragmotion

int main(int count, char** arguments) {
  if (count != 2) return 1;
  fragmotion::write_corpus(arguments[1]);
  return 0;
}
