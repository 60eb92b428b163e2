// SPDX-License-Identifier: MIT
// The C API as a game calls it: a core of a policy file (policies.hpp) at first, then words that are calls. What is
// loaded plays finite poses, and a state that a stranger changed is refused or plays them, too.
#include <array>

#include "fragmotion/fragmotion.h"
#include "policies.hpp"

namespace fragmotion {
namespace {

constexpr std::size_t kStateHeader = 16, kStateEnd = 8;
constexpr std::size_t kCalls = 160;  // bytes at an input's end that are calls

// Takes the words of an input from its end.
class Words {
 public:
  Words(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  std::uint8_t byte() { return size_ == 0 ? 0 : data_[--size_]; }
  float number() {
    constexpr float kNumbers[] = {0, 1, -1, 0.5F, 3, -20, 1e-30F, 1e6F, 1e9F, 3e38F};
    const std::uint8_t which = byte();
    return which < 10 ? kNumbers[which] : which == 10 ? std::nanf("") : static_cast<float>(which - 128) / 16;
  }
  bool done() const { return size_ == 0; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

struct Game {
  FragmotionCharacter* character = nullptr;
  FragmotionPlayer* player = nullptr;
  int bones = 0;
  std::vector<FragmotionTransform> pose;
  std::vector<unsigned char> state;

  ~Game() {
    fragmotion_player_release(player);
    fragmotion_character_release(character);
  }
};

std::int32_t strange_ground_hit(void* user, const float from[3], FragmotionGroundHit* hit) {
  const auto found = strange_ground(*static_cast<int*>(user))({from[0], from[1], from[2]});
  if (!found) return 0;
  hit->height = static_cast<float>(found->height);
  for (int i = 0; i < 3; ++i) hit->normal[i] = static_cast<float>(found->normal[i]);
  return 1;
}

// Some words of a state changed, and its checksum put right.
void restore_changed(Game& game, Words& words) {
  std::vector<unsigned char> bytes(fragmotion_player_save_size(game.player));
  std::size_t size = 0;
  require(fragmotion_player_save(game.player, bytes.data(), bytes.size(), &size) == FRAGMOTION_OK, "a state is saved");
  const std::size_t count = (size - kStateHeader - kStateEnd) / 8;
  for (int change = words.byte() % 4; change >= 0; --change) {
    const std::size_t at = (words.byte() + std::size_t{256} * words.byte()) % count;
    const double value = words.number();
    const std::int64_t whole = words.byte();
    std::memcpy(&bytes[kStateHeader + 8 * at], words.byte() % 2 == 0 ? static_cast<const void*>(&value) : &whole, 8);
  }
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t word = 0;
    std::memcpy(&word, &bytes[kStateHeader + 8 * i], 8);
    hash = (hash ^ word) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 32;
  }
  std::memcpy(&bytes[size - kStateEnd], &hash, 8);
  fragmotion_player_restore(game.player, bytes.data(), size);
}

FragmotionInput input_of(Words& words) {
  FragmotionInput input = fragmotion_input();
  input.steer = static_cast<FragmotionSteer>(words.byte() % 5);
  for (float* value : {&input.move[0], &input.move[1], &input.move[2], &input.facing[0], &input.facing[1], &input.turn})
    *value = words.number();
  input.jump = words.byte() % 2;
  return input;
}

void set_options(Game& game, Words& words) {
  FragmotionPlayerOptions options = fragmotion_player_options();
  for (double* value : {&options.responsiveness, &options.root_adjustment, &options.stitch, &options.time_scale})
    *value = static_cast<double>(words.number());
  options.step_interval = words.byte() % 3;
  options.fixed_step = words.byte() % 3 == 0 ? 0.03 : 0;
  options.hold_feet = words.byte() % 2;
  fragmotion_player_set_options(game.player, &options);
}

void set_path(Game& game, Words& words) {
  std::array<float, 9> points{};
  for (float& value : points) value = words.number();
  FragmotionPath path = fragmotion_path();
  path.points = words.byte() % 4;
  path.positions = points.data();
  path.closed = words.byte() % 2;
  path.end = static_cast<FragmotionPathEnd>(words.byte() % 3);
  path.speed = words.number();
  path.arrive = words.number();
  fragmotion_player_set_path(game.player, &path);
}

void call(Game& game, Words& words, int& ground) {
  switch (words.byte() % 13) {
    case 0:
      ground = words.byte() % 6;
      fragmotion_player_set_ground(game.player, ground < 5 ? &strange_ground_hit : nullptr, &ground);
      break;
    case 1:
      fragmotion_player_start_move(game.player, words.byte() % 4 - 1);
      break;
    case 2:
      fragmotion_player_release_move(game.player, words.byte() % 4);
      break;
    case 3:
      fragmotion_player_change_style(game.player, words.byte() % 3);
      break;
    case 12: {
      const float place[] = {words.number(), words.number(), words.number()};
      fragmotion_player_look(game.player, words.byte() % 4, place);
      const FragmotionReach held{
          {place[0], place[1], place[2]}, words.byte() % 3, static_cast<float>(words.byte()) / 200};
      fragmotion_player_reach(game.player, words.byte() % 3, &held);
      break;
    }
    case 4:
      fragmotion_player_force_class(game.player, words.byte() % 8);
      break;
    case 5:
      set_options(game, words);
      break;
    case 6:
      set_path(game, words);
      break;
    case 7: {
      const FragmotionPlace place{{words.number(), words.number(), words.number()}, words.number()};
      words.byte() % 2 == 0 ? fragmotion_player_move_to(game.player, &place)
                            : fragmotion_player_reset(game.player, &place, words.byte() % 3);
      break;
    }
    case 8:
      restore_changed(game, words);
      break;
    case 9: {
      FragmotionPlace places[3];
      const FragmotionInput input = input_of(words);
      fragmotion_player_foresee(game.player, &input, 0.2, 3, places);
      break;
    }
    default: {
      const FragmotionInput input = input_of(words);
      fragmotion_player_step(game.player, &input, words.byte() / 500.0);
    }
  }
}

void check_pose(Game& game) {
  require(fragmotion_player_pose(game.player, nullptr, FRAGMOTION_SPACE_LOCAL, game.pose.data(), game.bones) ==
              FRAGMOTION_OK,
          "a pose is told");
  for (const FragmotionTransform& bone : game.pose) {
    for (const float value : bone.rotation) require(std::isfinite(value), "poses are numbers");
  }
}

void play_game(const std::string& file, Words words) {
  Game game;
  if (fragmotion_character_load(file.data(), file.size(), nullptr, &game.character) != FRAGMOTION_OK) return;
  static Count played("stat::played_policies");
  ++played.value;
  require(fragmotion_player_create(game.character, nullptr, &game.player) == FRAGMOTION_OK, "what is loaded plays");
  FragmotionCharacterInfo info = fragmotion_info();
  fragmotion_character_info(game.character, &info);
  game.bones = info.bones;
  game.pose.resize(static_cast<std::size_t>(info.bones));
  int ground = 0;
  for (int calls = 0; calls < 24 && !words.done(); ++calls) {
    call(game, words, ground);
    check_pose(game);
  }
}

}  // namespace
}  // namespace fragmotion

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

/// Changes the calls, and seldom the policy, of which little is readable then.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  using namespace fragmotion;
  if (size <= kCalls || seed % 8 == 0) return LLVMFuzzerMutate(data, size, most);
  std::uint8_t* calls = data + size - kCalls;
  const std::size_t kept = LLVMFuzzerMutate(calls, kCalls, kCalls);
  std::memset(calls + kept, 0, kCalls - kept);
  return size;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fragmotion;
  const std::size_t core = size > kCalls ? size - kCalls : 0;
  play_game(file_with_core(text_of(data, core)), Words(data + core, size - core));
  return 0;
}
