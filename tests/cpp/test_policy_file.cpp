// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include "allocations.hpp"
#include "fragmotion/player.hpp"
#include "fragmotion/policy_file.hpp"
#include "mocap_files.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

const std::string& tiny_file() {
  static const std::string bytes = to_bytes(tiny_character());
  return bytes;
}

// FNV-1a, as the header says.
std::uint64_t fnv1a(const std::string& payload) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char byte : payload) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211ULL;
  return hash;
}

// A file around a payload: magic, version, length, payload, checksum.
std::string file_around(const std::string& payload) {
  std::string bytes = tiny_file().substr(0, 12);
  const std::uint64_t numbers[] = {payload.size(), fnv1a(payload)};
  bytes.append(reinterpret_cast<const char*>(&numbers[0]), 8);
  bytes += payload;
  bytes.append(reinterpret_cast<const char*>(&numbers[1]), 8);
  return bytes;
}

std::string payload_of(const std::string& bytes) { return bytes.substr(20, bytes.size() - 28); }

TEST(PolicyFile, IsLaidOutAsDocumented) {
  EXPECT_EQ(tiny_file().substr(0, 8), "FRAGMOTN");
  EXPECT_EQ(file_around(payload_of(tiny_file())), tiny_file());
}

TEST(PolicyFile, ComesBackBitForBit) {
  for (const std::string& bytes : {tiny_file(), to_bytes(*gait_character())}) {
    EXPECT_TRUE(to_bytes(from_bytes(bytes)) == bytes);
  }
}

TEST(PolicyFile, BringsEverythingBack) {
  const Character& c = *gait_character();
  const Character back = from_bytes(to_bytes(c));
  EXPECT_EQ(back.pool.skeleton.names, c.pool.skeleton.names);
  EXPECT_EQ(back.pool.clips.size(), c.pool.clips.size());
  EXPECT_EQ(back.pool.clips[3].poses, c.pool.clips[3].poses);
  EXPECT_EQ(back.contacts[3].feet, c.contacts[3].feet);
  EXPECT_EQ(back.classes.labels, c.classes.labels);
  EXPECT_EQ(back.classes.representatives, c.classes.representatives);
  EXPECT_EQ(back.quality.smoothness, c.quality.smoothness);
  EXPECT_EQ(back.quality.match, c.quality.match);
  ASSERT_EQ(back.policies.size(), c.policies.size());
  for (std::size_t i = 0; i < c.policies.size(); ++i) {
    EXPECT_EQ(back.policies[i].name, c.policies[i].name);
    EXPECT_EQ(back.policies[i].next, c.policies[i].next);
  }
  EXPECT_EQ(back.bridges, c.bridges);
  EXPECT_EQ(back.space.walk(), c.space.walk());
  EXPECT_EQ(back.coverage.counts, c.coverage.counts);
  EXPECT_EQ(back.coverage.distances, c.coverage.distances);
}

TEST(PolicyFile, PlaysTheSameBits) {
  const auto loaded = std::make_shared<const Character>(from_bytes(to_bytes(*gait_character())));
  Player built(gait_character(), {7}), read(loaded, {7});
  const Trace trace = simulate_trace("explorer", 15, 3, loaded->space);
  const Performance a = built.run(trace, 29.97), b = read.run(trace, 29.97);
  EXPECT_EQ(a.rotations, b.rotations);
  EXPECT_EQ(a.root_positions, b.root_positions);
  EXPECT_EQ(a.quality, b.quality);
}

TEST(PolicyFile, IsSavedAndLoaded) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.policy";
  save_policy(path, tiny_character());
  save_policy(path, from_bytes(tiny_file()));  // over the first
  EXPECT_TRUE(to_bytes(load_policy(path)) == tiny_file());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "leaves a temporary file";
}

TEST(PolicyFile, NamesThePathThatCannotBeReadOrWritten) {
  const TemporaryFolder folder;
  const auto missing = folder.path() / "no folder" / "a.policy";
  EXPECT_EQ(error_of([&] { save_policy(missing, from_bytes(tiny_file())); }),
            "cannot write " + missing.u8string() + ": No such file or directory");
  EXPECT_NE(error_of([&] { save_policy(folder.path(), from_bytes(tiny_file())); }).find("directory"),
            std::string::npos);
  EXPECT_NE(error_of([&] { load_policy(missing); }).find("a.policy"), std::string::npos);
  EXPECT_NE(error_of([&] { load_policy(folder.path()); }), "no error");
  EXPECT_NE(error_of([&] { load_policy(folder.write("empty.policy", "")); }).find("empty.policy"), std::string::npos);
}

TEST(PolicyFile, RefusesEveryTruncation) {
  const std::string& bytes = tiny_file();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string error = error_of([&] { from_bytes(bytes.substr(0, size), "short"); });
    ASSERT_EQ(error.find("short is refused"), 0U) << size << ": " << error;
  }
  EXPECT_NE(error_of([&] { from_bytes(bytes + "x"); }), "no error");
}

TEST(PolicyFile, RefusesEveryTruncatedPayload) {
  const std::string payload = payload_of(tiny_file());
  for (std::size_t size = 0; size < payload.size(); ++size) {
    ASSERT_NE(error_of([&] { from_bytes(file_around(payload.substr(0, size))); }), "no error") << size;
  }
  EXPECT_NE(error_of([&] { from_bytes(file_around(payload + "x")); }).find("too many"), std::string::npos);
}

TEST(PolicyFile, RefusesEveryFlippedByte) {
  std::string bytes = tiny_file();
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const int flip : {0x01, 0x80, 0xff}) {
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      ASSERT_NE(error_of([&] { from_bytes(bytes); }), "no error") << at;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
    }
  }
}

TEST(PolicyFile, SaysWhyItIsRefused) {
  std::string other = tiny_file();
  other[8] = 9;
  EXPECT_NE(error_of([&] { from_bytes(other); }).find("version 9"), std::string::npos);
  other = tiny_file();
  other[0] = 'X';
  EXPECT_NE(error_of([&] { from_bytes(other); }).find("no Fragmotion policy file"), std::string::npos);
  other = tiny_file();
  other[100] = static_cast<char>(other[100] ^ 1);
  EXPECT_NE(error_of([&] { from_bytes(other); }).find("damaged"), std::string::npos);
  EXPECT_NE(error_of([&] { from_bytes(tiny_file().substr(0, 500)); }).find("cut short"), std::string::npos);
}

// Reads the bytes and, if they are accepted, plays a second. Anything but std::invalid_argument escapes.
bool accepts(const std::string& bytes) {
  std::shared_ptr<const Character> character;
  try {
    character = std::make_shared<const Character>(from_bytes(bytes));
  } catch (const std::invalid_argument&) {
    return false;
  }
  Player player(character);
  Random random(1);
  for (int i = 0; i < 30; ++i) player.step(character->space.point(random.below(ControlSpace::kPoints)), 1.0 / 30);
  return true;
}

TEST(PolicyFile, BelievesNoCount) {
  const std::string payload = payload_of(tiny_file());
  largest_allocation = 0;
  for (std::size_t at = 0; at + 8 <= payload.size(); ++at) {
    std::string forged = payload;
    const std::uint64_t huge = at % 2 == 0 ? 0x7fffffffffffffffULL : 0x00000000fffffff0ULL;
    std::memcpy(&forged[at], &huge, 8);
    accepts(file_around(forged));
  }
  EXPECT_LT(largest_allocation, std::size_t{64} * tiny_file().size());
}

// Spoils the grid that all clips share.
template <typename Spoil>
std::function<void(Character&)> regrid(Spoil spoil) {
  return [=](Character& c) {
    PoseGrid grid = *c.pool.clips[0].grid;
    spoil(grid);
    for (PackedClip& clip : c.pool.clips) clip.grid = std::make_shared<const PoseGrid>(grid);
  };
}

TEST(PolicyFile, RefusesCharactersThatDoNotFitTogether) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const struct {
    const char* label;
    std::function<void(Character&)> spoil;
  } cases[] = {
      {"no poses", [](Character& c) { c.pool.clips[0].poses.clear(); }},
      {"too few poses", [](Character& c) { c.pool.clips[0].poses.pop_back(); }},
      {"too many bits", [](Character& c) { c.pool.clips[0].bits[4] = 25; }},
      {"other bits", [](Character& c) { c.pool.clips[0].bits[5] += 9; }},
      {"too few bits", [](Character& c) { c.pool.clips[0].bits.pop_back(); }},
      {"too few turns", [](Character& c) { c.pool.clips[0].least.pop_back(); }},
      {"turn without end", [](Character& c) { c.pool.clips[0].least[0] = 1 << 30; }},
      {"position not finite", [=](Character& c) { c.pool.clips[0].origin[0] = nan; }},
      {"position too far", [=](Character& c) { c.pool.clips[0].steps[1] = 1e300; }},
      {"no step", [=](Character& c) { c.pool.clips[0].steps[3] = 0; }},
      {"zero rotation", regrid([](PoseGrid& grid) { grid.usual[0] = 0; })},
      {"no step of a turn", regrid([](PoseGrid& grid) { grid.steps[1] = 0; })},
      {"too few steps", regrid([](PoseGrid& grid) { grid.steps.pop_back(); })},
      {"bones of others", regrid([](PoseGrid& grid) { ++grid.bones; })},
      {"contacts of others", [](Character& c) { c.contacts.pop_back(); }},
      {"too few contacts", [](Character& c) { c.contacts[0].feet.fill({true}); }},
      {"no rate", [](Character& c) { c.pool.clips[1].rate = 0; }},
      {"fragments of no time", [](Character& c) { c.pool.clips[1].rate = 1e300; }},
      {"fragments without end", [](Character& c) { c.pool.clips[1].rate = 1e-300; }},
      {"frames of others", [](Character& c) { c.pool.clips[0].frames = 1 << 30; }},
      {"hips that are no bone", [](Character& c) { c.pool.skeleton.roles.hips = 4; }},
      {"negative hips", [](Character& c) { c.pool.skeleton.roles.hips = -7; }},
      {"foot that is no bone", [](Character& c) { c.pool.skeleton.roles.left_foot = 1000000; }},
      {"parent after its child", [](Character& c) { c.pool.skeleton.parents[1] = 3; }},
      {"no bones", [](Character& c) { c.pool.skeleton = {}; }},
      {"no fragments", [](Character& c) { c.pool.fragments.clear(); }},
      {"fragment of no clip", [](Character& c) { c.pool.fragments[0].clip = 2; }},
      {"fragment past its clip", [](Character& c) { c.pool.fragments[0].end = 11; }},
      {"fragment before its clip", [](Character& c) { c.pool.fragments[0].begin = -1; }},
      {"fragment without a frame", [](Character& c) { c.pool.fragments[0].end = c.pool.fragments[0].begin; }},
      {"evident control not finite", [=](Character& c) { c.pool.fragments[0].evident.turn = nan; }},
      {"label too high", [](Character& c) { c.classes.labels[0] = 2; }},
      {"empty class", [](Character& c) { std::fill(c.classes.labels.begin(), c.classes.labels.end(), 0); }},
      {"too few labels", [](Character& c) { c.classes.labels.pop_back(); }},
      {"representatives of other classes",
       [](Character& c) { std::swap(c.classes.representatives[0], c.classes.representatives[1]); }},
      {"no representative", [](Character& c) { c.classes.representatives[0] = -1; }},
      {"no classes", [](Character& c) { c.classes.count = 0; }},
      {"too many classes", [](Character& c) { c.classes.count = 0x7fffffff; }},
      {"quality not finite", [=](Character& c) { c.quality.match[3] = nan; }},
      {"too few qualities", [](Character& c) { c.quality.smoothness.pop_back(); }},
      {"no policy", [](Character& c) { c.policies.clear(); }},
      {"next class too high", [](Character& c) { c.policies[0].next[5] = 2; }},
      {"next class negative", [](Character& c) { c.policies[0].next[5] = -1; }},
      {"too few next classes", [](Character& c) { c.policies[0].next.pop_back(); }},
      {"bridge too high", [](Character& c) { c.bridges[0] = 2; }},
      {"too few bridges", [](Character& c) { c.bridges.pop_back(); }},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.label);
    Character character = tiny_character();
    c.spoil(character);
    EXPECT_EQ(error_of([&] { from_bytes(to_bytes(character), "forged"); }).find("forged is refused: "), 0U);
  }
}

TEST(PolicyFile, SurvivesForgedPayloads) {
  const std::string payload = payload_of(tiny_file());
  Random random(12);
  const double doubles[] = {
      std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300, -1e300, 1e-300, 0, -1};
  const std::int32_t ints[] = {-1, 0, 1, 2, 3, 1000, 0x7fffffff, static_cast<std::int32_t>(0x80000000)};
  largest_allocation = 0;
  int accepted = 0;
  for (int n = 0; n < 3000; ++n) {
    std::string forged = payload;
    for (int times = 1 + random.below(3); times > 0; --times) {
      const std::size_t at = random.below(static_cast<int>(forged.size()) - 8);
      switch (random.below(5)) {
        case 0:
          forged[at] = static_cast<char>(random.below(256));
          break;
        case 1:
          std::memcpy(&forged[at], &ints[random.below(8)], 4);
          break;
        case 2:
          std::memcpy(&forged[at], &doubles[random.below(7)], 8);
          break;
        case 3:
          forged.erase(at, 1 + random.below(8));
          break;
        default:
          forged.insert(at, std::string(1 + random.below(8), static_cast<char>(random.below(256))));
          break;
      }
    }
    accepted += accepts(file_around(forged)) ? 1 : 0;
  }
  EXPECT_LT(largest_allocation, std::size_t{64} * tiny_file().size());
  EXPECT_GT(accepted, 0);
  std::cout << accepted << " of 3000 forged payloads are whole characters\n";
}

}  // namespace
}  // namespace fragmotion
