// SPDX-License-Identifier: MIT
// The same game by the C++ wrapper, and nothing that needs exceptions or run-time types.
#include <cstdio>
#include <fragmotion/fragmotion.hpp>
#include <vector>

namespace fm = fragmotion::game;

static std::uint64_t add(std::uint64_t hash, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211U;
  return hash;
}

static std::vector<char> read_file(const char* path) {
  std::vector<char> bytes;
  if (std::FILE* file = std::fopen(path, "rb")) {
    char block[4096];
    for (std::size_t read = 0; (read = std::fread(block, 1, sizeof block, file)) > 0;) {
      bytes.insert(bytes.end(), block, block + read);
    }
    std::fclose(file);
  }
  return bytes;
}

int main(int count, char** arguments) {
  const std::vector<char> bytes = read_file(count > 1 ? arguments[1] : "");
  FragmotionLoadOptions options = fragmotion_load_options();
  options.axes = FRAGMOTION_AXES_BLENDER;
  fm::Character hero = fm::Character::load(bytes.data(), bytes.size(), options);
  fm::Player player(hero);
  if (!player) {
    std::fprintf(stderr, "%s\n", fm::last_error());
    return 1;
  }
  const std::int32_t bones = hero.info().bones;
  std::vector<fm::Transform> pose(static_cast<std::size_t>(bones));
  std::vector<unsigned char> state;
  std::uint64_t hash = 14695981039346656037U;
  for (int frame = 0; frame < 600; ++frame) {
    const int part = frame / 45;
    const fm::Input input =
        fm::by_character(static_cast<float>(part * 7 % 5 - 2), static_cast<float>(part * 11 % 7 - 2),
                         static_cast<float>(part * 5 % 3 - 1), part % 6 == 5);
    if (frame % 50 == 0) player.save(state);
    player.step(input, 1.0F / 60);
    if (frame % 50 == 0) {  // and again
      player.restore(state);
      player.step(input, 1.0F / 60);
    }
    player.pose(FRAGMOTION_SPACE_WORLD, pose.data(), bones);
    hash = add(hash, pose.data(), pose.size() * sizeof pose[0]);
  }
  std::printf("%016llx\n", static_cast<unsigned long long>(hash));
  return 0;
}
