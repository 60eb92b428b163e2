// SPDX-License-Identifier: MIT
#include <algorithm>

#include "api/handles.hpp"
#include "base/take_limits.hpp"
#include "control/control.hpp"
#include "runtime/crowd.hpp"

namespace fragmotion {
namespace {

void make_crowd(const std::shared_ptr<const Hero>& hero, const FragmotionPlayerOptions& options, int count,
                FragmotionCrowd& crowd) {
  crowd.players.reserve(static_cast<std::size_t>(count));
  const std::int64_t players = count;
  for (int part = 0; part < crowd.parts; ++part) {
    const FragmotionPlayer* first = nullptr;
    while (static_cast<std::int64_t>(crowd.players.size()) < players * (part + 1) / crowd.parts) {
      FragmotionPlayerOptions own = options;
      own.seed += crowd.players.size();
      auto made = first == nullptr
                      ? make_player(hero, own)
                      : std::make_unique<FragmotionPlayer>(hero, first->player.branch(), first->scratch, own);
      if (first == nullptr) first = made.get();
      made->in_crowd = true;
      made->left_out = static_cast<std::uint32_t>(crowd.players.size()) % own.step_interval;
      list_alive(made.get(), Kind::player);
      crowd.players.push_back(std::move(made));
    }
  }
}

// Of the crowd, then of the others. What each is commanded counts, as it does that next: by what it does now, which
// lags behind, all would correct the same fault again.
void list_walkers(const FragmotionBody* others, int count, double radius, FragmotionCrowd& crowd) {
  crowd.walkers.clear();
  for (const auto& player : crowd.players) {
    const CharacterFrame at = player->frame();
    crowd.walkers.push_back({at.position, turn_by(at.heading) * player->player.commanded_velocity(), radius, true});
    player->way_round.show(crowd.walkers.back());
  }
  for (int i = 0; i < count; ++i) {
    const Axes& axes = crowd.players.front()->hero->axes;
    crowd.walkers.push_back({axes.place(others[i].position).head<2>(), axes.place(others[i].velocity).head<2>(),
                             axes.metres(static_cast<double>(others[i].radius)), false});
  }
}

void check_body(const FragmotionBody& body) {
  demand_range("the radius of a body", static_cast<double>(body.radius), 0, kFarthestBody);
  for (int i = 0; i < 3; ++i) {
    demand(std::abs(body.position[i]) <= kFarthestBody && std::abs(body.velocity[i]) <= kFarthestBody,
           FRAGMOTION_ERROR_ARGUMENT, "a body's position or velocity holds what is not a number, or beyond a million");
  }
}

void step_part_of(FragmotionCrowd& crowd, int part, const FragmotionInput* inputs, double seconds) {
  const auto players = static_cast<std::int64_t>(crowd.players.size());
  const std::int64_t end = players * (part + 1) / crowd.parts;
  const auto player = [&](std::int64_t i) {
    return crowd.players[static_cast<std::size_t>(i < end ? i : end - 1)].get();
  };
  const std::int64_t ahead = 4;  // where each fourth frame is stepped, whoever steps next
  for (std::int64_t i = players * part / crowd.parts; i < end; ++i) {
    player(i + 2 * ahead)->prefetch_turn();
    player(i + ahead)->prefetch();
    player(i)->step(inputs[i], seconds);
  }
}

void check_inputs(const FragmotionCrowd& crowd, const FragmotionInput* inputs, double seconds) {
  check_step_seconds(seconds);
  if (!crowd.players.empty()) demand_given(inputs, "the inputs");
  for (std::size_t i = 0; i < crowd.players.size(); ++i) check_input(inputs + i);
}

}  // namespace
}  // namespace fragmotion

using namespace fragmotion;

FragmotionResult fragmotion_crowd_create(const FragmotionCharacter* character, const FragmotionPlayerOptions* options,
                                         std::int32_t count, std::int32_t parts, FragmotionCrowd** crowd) noexcept {
  return call("fragmotion_crowd_create", [&] {
    demand_given(crowd, "the place for the crowd");
    *crowd = nullptr;
    demand_alive(character, Kind::character);
    demand_range("the number of a crowd's players", count, 0, kMostPlayers);
    demand(parts >= 1, FRAGMOTION_ERROR_ARGUMENT, "a crowd has 1 part or more, not %d", static_cast<int>(parts));
    auto made = std::make_unique<FragmotionCrowd>();
    made->parts = std::clamp(parts, 1, std::max(1, count));
    try {
      make_crowd(character->hero, checked(options), count, *made);
      list_alive(made.get(), Kind::crowd);
    } catch (...) {
      for (const auto& player : made->players) unlist_alive(player.get());
      throw;
    }
    *crowd = made.release();
  });
}

void fragmotion_crowd_release(FragmotionCrowd* crowd) noexcept {
  if (crowd == nullptr) return;
  if (call("fragmotion_crowd_release", [&] { demand_alive(crowd, Kind::crowd); }) != FRAGMOTION_OK) return;
  // The list is in the order of addresses, and who was made last has mostly a high one: less is moved in it.
  std::for_each(crowd->players.rbegin(), crowd->players.rend(), [](const auto& each) { unlist_alive(each.get()); });
  unlist_alive(crowd);
  delete crowd;
}

std::int32_t fragmotion_crowd_count(const FragmotionCrowd* crowd) noexcept {
  std::int32_t count = 0;
  call("fragmotion_crowd_count", [&] {
    demand_alive(crowd, Kind::crowd);
    count = static_cast<std::int32_t>(crowd->players.size());
  });
  return count;
}

std::int32_t fragmotion_crowd_parts(const FragmotionCrowd* crowd) noexcept {
  std::int32_t parts = 0;
  call("fragmotion_crowd_parts", [&] {
    demand_alive(crowd, Kind::crowd);
    parts = crowd->parts;
  });
  return parts;
}

FragmotionPlayer* fragmotion_crowd_player(FragmotionCrowd* crowd, std::int32_t index) noexcept {
  FragmotionPlayer* player = nullptr;
  call("fragmotion_crowd_player", [&] {
    demand_alive(crowd, Kind::crowd);
    demand_index("player", index, static_cast<int>(crowd->players.size()));
    player = crowd->players[static_cast<std::size_t>(index)].get();
  });
  return player;
}

FragmotionResult fragmotion_crowd_step(FragmotionCrowd* crowd, const FragmotionInput* inputs, double seconds) noexcept {
  return call("fragmotion_crowd_step", [&] {
    demand_alive(crowd, Kind::crowd);
    check_inputs(*crowd, inputs, seconds);
    for (int part = 0; part < crowd->parts; ++part) step_part_of(*crowd, part, inputs, seconds);
  });
}

FragmotionResult fragmotion_crowd_step_part(FragmotionCrowd* crowd, std::int32_t part, const FragmotionInput* inputs,
                                            double seconds) noexcept {
  return call("fragmotion_crowd_step_part", [&] {
    demand_alive(crowd, Kind::crowd);
    demand_index("part", part, crowd->parts);
    check_inputs(*crowd, inputs, seconds);
    step_part_of(*crowd, part, inputs, seconds);
  });
}

FragmotionResult fragmotion_crowd_make_way(FragmotionCrowd* crowd, float radius, double seconds,
                                           const FragmotionBody* others, std::int32_t count) noexcept {
  return call("fragmotion_crowd_make_way", [&] {
    demand_alive(crowd, Kind::crowd);
    demand(radius > 0 && radius <= kFarthestBody, FRAGMOTION_ERROR_ARGUMENT,
           "the radius of a crowd's players must be over 0 to a million, not %g", static_cast<double>(radius));
    check_step_seconds(seconds);
    demand_range("the number of others", count, 0, kMostPlayers);
    if (count > 0) demand_given(others, "the others");
    for (int i = 0; i < count; ++i) check_body(others[i]);
    if (crowd->players.empty()) return;
    list_walkers(others, count, crowd->players.front()->hero->axes.metres(static_cast<double>(radius)), *crowd);
    crowd->make_way.look(crowd->walkers);
    for (std::size_t i = 0; i < crowd->players.size(); ++i) {
      crowd->players[i]->clearance = crowd->make_way.clearance(i, std::max(seconds, kControlStep));
    }
  });
}
