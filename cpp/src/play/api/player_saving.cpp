// SPDX-License-Identifier: MIT
#include <algorithm>

#include "api/handles.hpp"
#include "api/player_state_of.hpp"
#include "base/rates.hpp"
#include "base/rounding.hpp"

namespace fragmotion {
namespace {

constexpr std::uint32_t kStateVersion = 11;  // of what exchange() and PlayerState hold
constexpr char kStateMagic[9] = "FRAGSTAT";
constexpr std::size_t kStateHeader = 16, kStateEnd = 8;  // bytes: magic, version and size; hash

}  // namespace
}  // namespace fragmotion

using namespace fragmotion;

namespace {

template <typename Archive>
void exchange_pose(Archive& a, Shown& pose) {
  for (int i = 0; i < 3; ++i) a.number(pose.root[i], -kMostPlace, kMostPlace);
  for (int i = 0; i < 2; ++i) a.number(pose.frame.position[i], -kMostPlace, kMostPlace);
  a.number(pose.frame.heading, -kMostPlace, kMostPlace);
  a.number(pose.level, -kMostPlace, kMostPlace);
  for (double& value : pose.rotations) a.number(value, -2, 2);
}

template <typename Archive>
void exchange_options(Archive& a, FragmotionPlayerOptions& options) {
  a.number(options.step_interval, 1, kMostSteps);
  a.bits(options.seed);
  for (double* part : {&options.responsiveness, &options.root_adjustment}) a.number(*part, 0, 1);
  const double stitch = a.told(options.stitch, 0, 1);
  demand(stitch == 0 || stitch >= kShortestStitch, FRAGMOTION_ERROR_REFUSED, "the state's stitch is %g s", stitch);
  if constexpr (Archive::kKeeps) options.stitch = stitch;
  a.number(options.time_scale, 0, 100);
  a.number(options.hold_feet, 0, 1);
}

}  // namespace

template <typename Archive>
void FragmotionPlayer::exchange(Archive& a) {
  a.same(hero->fingerprint, "of another character");
  std::uint64_t step = 0;
  std::memcpy(&step, &options.fixed_step, sizeof step);
  a.same(step, "of a player with another fixed_step");
  a.same(static_cast<std::uint64_t>(options.cross_fades), "of a player with other cross_fades");
  exchange_options(a, options);
  if constexpr (Archive::kKeeps) player.set_options(to_options(options));
  PlayerState::exchange(a, player);
  a.number(shift.none, 0, 1);
  a.number(shift.heading, -kMostPlace, kMostPlace);
  a.number(shift.lift, -kMostPlace, kMostPlace);
  for (int i = 0; i < 2; ++i) a.number(shift.offset[i], -kMostPlace, kMostPlace);
  const int last_style = hero->character->style_count() - 1;
  const int of_steering = a.told(steers_style, 0, last_style);
  if constexpr (Archive::kKeeps) {
    if (of_steering != steers_style) {
      steering = Steering(hero->character->in_style(of_steering).space, hero->turns_well[of_steering]);
      steers_style = of_steering;
    }
  }
  PlayerState::exchange(a, steering);
  PlayerState::exchange(a, way_round);
  a.number(arrived, 0, 1);
  a.number(banked, 0, has_fixed_step() ? options.fixed_step : kLongestCall);
  a.number(left_out, 0, kMostSteps);
  a.same(route ? route->fingerprint : 0, "of a player on another path");
  if (route) PlayerState::exchange(a, route->follower);
  exchange_pose(a, now);
  if (has_fixed_step()) {
    exchange_pose(a, before);
    exchange_pose(a, between);
  }
}

std::size_t FragmotionPlayer::save(unsigned char* bytes) const {
  StateWriter writer(bytes != nullptr ? bytes + kStateHeader : nullptr);
  const_cast<FragmotionPlayer*>(this)->exchange(writer);
  const std::size_t size = kStateHeader + writer.size() + kStateEnd;
  if (bytes == nullptr) return size;
  const std::uint32_t numbers[2] = {kStateVersion, static_cast<std::uint32_t>(writer.size())};
  const std::uint64_t hash = writer.hash();
  std::copy_n(kStateMagic, 8, bytes);
  std::memcpy(bytes + 8, numbers, 8);
  std::memcpy(bytes + size - kStateEnd, &hash, 8);
  return size;
}

std::uint64_t FragmotionPlayer::checksum() const {
  StateWriter writer;
  const_cast<FragmotionPlayer*>(this)->exchange(writer);
  return writer.hash();
}

void FragmotionPlayer::restore(const unsigned char* bytes, std::size_t size) {
  std::uint32_t numbers[2] = {0, 0};
  demand(size >= kStateHeader + kStateEnd && std::memcmp(bytes, kStateMagic, 8) == 0, FRAGMOTION_ERROR_REFUSED,
         "the bytes are no state of a player");
  std::memcpy(numbers, bytes + 8, 8);
  demand(numbers[0] <= kStateVersion, FRAGMOTION_ERROR_NEWER_VERSION,
         "the state is of version %u, newer than the %u that this library knows", static_cast<unsigned>(numbers[0]),
         static_cast<unsigned>(kStateVersion));
  demand(numbers[0] == kStateVersion, FRAGMOTION_ERROR_OLDER_VERSION, "the state is of the older version %u",
         static_cast<unsigned>(numbers[0]));
  const std::size_t payload = size - kStateHeader - kStateEnd;
  demand(numbers[1] == payload && payload % 8 == 0, FRAGMOTION_ERROR_REFUSED,
         "the state is cut short or has bytes too many");
  std::uint64_t hash = 0;
  std::memcpy(&hash, bytes + size - kStateEnd, 8);
  StateWriter again;
  for (std::size_t at = 0; at < payload; at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + kStateHeader + at, 8);
    again.bits(word);
  }
  demand(again.hash() == hash, FRAGMOTION_ERROR_REFUSED, "the state is damaged (checksum)");
  StateChecker checker(bytes + kStateHeader, payload);
  exchange(checker);
  demand(checker.done(), FRAGMOTION_ERROR_REFUSED, "the state has bytes too many");
  StateReader reader(bytes + kStateHeader, payload);
  exchange(reader);
  report = {};
}

void FragmotionPlayer::foresee(const FragmotionInput& input, double seconds, int count, FragmotionPlace* places) {
  std::vector<unsigned char>& state = scratch->state;
  const std::size_t size = save(state.data());
  for (int i = 0; i < count; ++i) {
    for (double rest = seconds / count; rest > kRounding; rest -= kGameStep) advance(input, std::min(rest, kGameStep));
    const CharacterFrame at = shift.frame(now.frame);
    const double level = now.level + shift.lift;
    places[i] = theirs({at.position.x(), at.position.y(), level}, at.heading);
  }
  StateReader reader(state.data() + kStateHeader, size - kStateHeader - kStateEnd);
  exchange(reader);
}
