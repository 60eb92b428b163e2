// SPDX-License-Identifier: MIT
#include "api/handles.hpp"

using namespace fragmotion;

std::size_t fragmotion_player_save_size(const FragmotionPlayer* player) noexcept {
  std::size_t size = 0;
  call("fragmotion_player_save_size", [&] { size = alive(player).save(nullptr); });
  return size;
}

FragmotionResult fragmotion_player_save(const FragmotionPlayer* player, void* bytes, std::size_t capacity,
                                        std::size_t* written) noexcept {
  return call("fragmotion_player_save", [&] {
    const FragmotionPlayer& p = alive(player);
    demand_given(bytes, "the room for the state");
    demand_given(written, "the place for the size");
    const std::size_t size = p.save(nullptr);
    demand(size <= capacity, FRAGMOTION_ERROR_CAPACITY, "there is room for %zu bytes, and %zu are to be written",
           capacity, size);
    *written = p.save(static_cast<unsigned char*>(bytes));
  });
}

FragmotionResult fragmotion_player_restore(FragmotionPlayer* player, const void* bytes, std::size_t size) noexcept {
  return call("fragmotion_player_restore", [&] {
    FragmotionPlayer& p = alive(player);
    demand_given(bytes, "the state");
    p.restore(static_cast<const unsigned char*>(bytes), size);
  });
}

FragmotionResult fragmotion_player_checksum(const FragmotionPlayer* player, std::uint64_t* checksum) noexcept {
  return call("fragmotion_player_checksum", [&] {
    const FragmotionPlayer& p = alive(player);
    demand_given(checksum, "the place for the checksum");
    *checksum = p.checksum();
  });
}
