// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <thread>

#ifndef _WIN32
#include <sys/stat.h>
#endif

#include "allocations.hpp"
#include "character/policy_bytes.hpp"
#include "fragmotion/character/policy_file.hpp"
#include "fragmotion/control/simulated_players.hpp"
#include "fragmotion/evaluate/performance.hpp"
#include "fragmotion/fragments/packed_pool.hpp"
#include "fragmotion/policy/anticipate.hpp"
#include "fragmotion/runtime/player.hpp"
#include "fragmotion/skeleton/role_names.hpp"
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

// Where bytes of a tiny file, or of its payload, are spoilt: everywhere but in the control model, of whose
// probabilities, all alike, each 101st byte is.
std::vector<std::size_t> spots(std::size_t size) {
  constexpr std::size_t kModel = sizeof(double) * ControlSpace::kPoints * ControlSpace::kPoints, kAfter = 1000;
  std::vector<std::size_t> spots;
  for (std::size_t at = 0; at < size; at += at + kAfter + kModel < size || at + kAfter >= size ? 1 : 101) {
    spots.push_back(at);
  }
  return spots;
}

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
  const Performance a = perform(built, trace, 29.97), b = perform(read, trace, 29.97);
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
  for (const std::size_t size : spots(bytes.size())) {
    const std::string error = error_of([&] { from_bytes(bytes.substr(0, size), "short"); });
    ASSERT_EQ(error.find("short is refused"), 0U) << size << ": " << error;
  }
  EXPECT_NE(error_of([&] { from_bytes(bytes + "x"); }), "no error");
}

TEST(PolicyFile, RefusesEveryTruncatedPayload) {
  const std::string payload = payload_of(tiny_file());
  for (const std::size_t size : spots(payload.size())) {
    ASSERT_NE(error_of([&] { from_bytes(file_around(payload.substr(0, size))); }), "no error") << size;
  }
  EXPECT_NE(error_of([&] { from_bytes(file_around(payload + "x")); }).find("too many"), std::string::npos);
}

TEST(PolicyFile, RefusesEveryFlippedByte) {
  std::string bytes = tiny_file();
  for (const std::size_t at : spots(bytes.size())) {
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

#ifndef _WIN32

mode_t mode_of(const std::filesystem::path& path) {
  struct stat status {};
  EXPECT_EQ(stat(path.c_str(), &status), 0);
  return status.st_mode & 07777;
}

TEST(PolicyFile, KeepsThePermissionsOfTheFileThatItReplaces) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.policy";
  const mode_t mask = umask(0);
  umask(027);
  save_policy(path, tiny_character());
  EXPECT_EQ(mode_of(path), 0640U);
  chmod(path.c_str(), 0604);
  save_policy(path, tiny_character());
  EXPECT_EQ(mode_of(path), 0604U);
  umask(mask);
}

TEST(PolicyFile, NeverWritesThroughASymbolicLink) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.policy", target = folder.write("precious", "text");
  for (const auto& to : {target, folder.path() / "missing"}) {
    std::filesystem::remove(path);
    std::filesystem::create_symlink(to, path);
    EXPECT_NE(error_of([&] { save_policy(path, tiny_character()); }).find("symbolic link"), std::string::npos);
    EXPECT_TRUE(std::filesystem::is_symlink(path));
  }
  EXPECT_EQ(std::filesystem::file_size(target), 4U);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "missing"));
  const auto real = folder.path() / "real.policy";
  save_policy(real, tiny_character());
  std::filesystem::remove(path);
  std::filesystem::create_symlink(real, path);
  EXPECT_TRUE(to_bytes(load_policy(path)) == tiny_file()) << "a link is read";
}

TEST(PolicyFile, NeitherReadsNorReplacesWhatIsNoRegularFile) {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe.policy";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::filesystem::path& path : {pipe, std::filesystem::path("/dev/zero")}) {
    EXPECT_NE(error_of([&] { load_policy(path); }).find("no regular file"), std::string::npos) << path;
    EXPECT_NE(error_of([&] { save_policy(path, tiny_character()); }).find("no regular file"), std::string::npos)
        << path;
  }
}

#endif

TEST(PolicyFile, IsWholeWhoeverWritesAtTheSameTime) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.policy";
  const Character small = tiny_character(), large = tiny_character({tiny_clip(0), tiny_clip(1.5), tiny_clip(2)});
  const std::string sizes[] = {to_bytes(small), to_bytes(large)};
  save_policy(path, small);
  std::atomic<int> writing{2}, failed{0};
  const auto write = [&](const Character& character) {
    for (int n = 0; n < 150; ++n) failed += error_of([&] { save_policy(path, character); }) == "no error" ? 0 : 1;
    --writing;
  };
  std::thread one(write, std::cref(small)), other(write, std::cref(large));
  int torn = 0, reads = 0;
  for (; writing > 0 || reads < 100; ++reads) {
    std::string bytes;
    const std::string error = error_of([&] { bytes = to_bytes(load_policy(path)); });
    torn += error == "no error" && (bytes == sizes[0] || bytes == sizes[1]) ? 0 : 1;
  }
  one.join();
  other.join();
  EXPECT_EQ(torn, 0) << "of " << reads;
  EXPECT_EQ(failed, 0);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "leaves a temporary file";
}

// Made by the test below in the program of the version in its name. Read for good.
const std::filesystem::path kVersion3 = "tests/data/version-3.policy";

TEST(PolicyFile, DISABLED_WritesTheFileOfThisVersion) { save_policy(kVersion3, legged_character()); }

TEST(PolicyFile, OfVersion3IsReadForGood) {
  const auto character = std::make_shared<const Character>(load_policy(kVersion3));
  std::ifstream file(kVersion3, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {}), saved = to_bytes(*character);
  EXPECT_EQ(saved.size(), bytes.size());  // the tables were repaired
  EXPECT_TRUE(to_bytes(from_bytes(saved)) == saved);
  EXPECT_EQ(character->pool.clips[1].name, "walk");
  EXPECT_EQ(character->policies.size(), 2U);
  for (const Leg& leg : character->legs) EXPECT_TRUE(leg.exists());
  Player player(character);
  for (int i = 0; i < 90; ++i) player.step({0, 1.2, 0, 0}, 1.0 / 30);
  const double way = player.frame().position.y();
  EXPECT_GT(way, 2) << "m in 3 s";
  EXPECT_LT(way, 5) << "m in 3 s";
}

// Reads the bytes and, if they are accepted, plays two seconds of finite poses. Anything but std::invalid_argument
// escapes.
bool accepts(const std::string& bytes) {
  std::shared_ptr<const Character> character;
  try {
    character = std::make_shared<const Character>(from_bytes(bytes));
  } catch (const std::invalid_argument&) {
    return false;
  }
  Player player(character);
  Random random(1);
  for (int i = 0; i < 60; ++i) {
    player.step(character->space.point(random.below(ControlSpace::kPoints)), 1.0 / 30);
    bool finite = player.root_position().allFinite() && std::isfinite(player.frame().heading);
    for (const double value : player.rotations()) finite = finite && std::isfinite(value);
    EXPECT_TRUE(finite) << "step " << i;
    if (!finite) break;
  }
  return true;
}

TEST(PolicyFile, BelievesNoCount) {
  const std::string payload = payload_of(tiny_file());
  largest_allocation = 0;
  for (const std::size_t at : spots(payload.size() - 7)) {
    std::string forged = payload;
    const std::uint64_t huge = at % 2 == 0 ? 0x7fffffffffffffffULL : 0x00000000fffffff0ULL;
    std::memcpy(&forged[at], &huge, 8);
    error_of([&] { from_bytes(file_around(forged)); });
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
      {"evident control out of all proportion", [](Character& c) { c.pool.fragments[0].evident.x = 1.7e308; }},
      {"smoothness over 1", [](Character& c) { c.quality.smoothness[0] = 1.1; }},
      {"smoothness of 0", [](Character& c) { c.quality.smoothness[1] = 0; }},
      {"match below 0", [](Character& c) { c.quality.match[1] = -0.1; }},
      {"match over 1", [](Character& c) { c.quality.match[1] = 1e300; }},
      {"inertia not finite", [=](Character& c) { c.classes.inertia = nan; }},
      {"scale out of all proportion", [](Character& c) { c.space = ControlSpace(1, 3, 1, 1e-300); }},
      {"floor out of all proportion", [](Character& c) { c.contacts[0].floors[1].heel = 1.7e308; }},
      {"offset out of all proportion", [](Character& c) { c.pool.skeleton.offsets[1].x() = 1.7e308; }},
      {"tip out of all proportion", [](Character& c) { c.pool.skeleton.tips[2].x() = -1.7e308; }},
      {"no stature",
       [](Character& c) {
         for (auto* part : {&c.pool.skeleton.tips, &c.pool.skeleton.offsets}) part->assign(4, {0, 0, 1e-9});
       }},
      {"hinge of a leg", [](Character& c) { c.legs[0].hinge *= 1.1; }},
      {"rate out of all proportion", [](Character& c) { c.pool.clips[0].rate = 1e5; }},
      {"fragment under 20 ms", [](Character& c) { c.pool.clips[0].rate = 550; }},
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
    EXPECT_EQ(error_of([&] { from_bytes(unchecked_bytes(character), "forged"); }).find("forged is refused: "), 0U);
    EXPECT_EQ(error_of([&] { to_bytes(character); }).find("the policy cannot be saved: "), 0U);
  }
}

TEST(PolicyFile, IsNotMadeOfFeetOfDifferentFrames) {
  Character character = tiny_character();
  character.contacts[0].feet[0].assign(11, true);
  EXPECT_NE(error_of([&] { to_bytes(character); }).find("contacts"), std::string::npos);
}

TEST(PolicyFile, TakesFragmentsOfTwentyMilliseconds) {
  Character character = tiny_character();
  for (PackedClip& clip : character.pool.clips) clip.rate = 500;
  EXPECT_TRUE(accepts(to_bytes(character)));
  Player player(std::make_shared<const Character>(character));
  player.step({0, 1.5, 0, 0}, 3600);
  EXPECT_TRUE(player.root_position().allFinite());
}

// A character of one class and one clip that stands, all of whose fragments are the same.
Character same_fragments(int bones, int fragments) {
  Skeleton skeleton;
  Clip clip{"still", 10, 3, {}, {}, {}};
  for (int b = 0; b < bones; ++b) {
    skeleton.names.push_back("bone" + std::to_string(b));
    skeleton.parents.push_back(b == 0 ? -1 : 0);
    skeleton.rest_rotations.push_back(Quaternion::Identity());
    skeleton.offsets.emplace_back(0, 0, 1);
    skeleton.tips.emplace_back(0, 0, 1);
  }
  clip.root_positions.assign(9, 0);
  for (int i = 0; i < 3 * bones; ++i) clip.rotations.insert(clip.rotations.end(), {1, 0, 0, 0});
  FragmentPool pool{make_skeleton(skeleton), {}, {}};
  pool.clips.push_back(make_clip(pool.skeleton, clip));
  pool.fragments.assign(fragments, {0, 0, 2, Origin::captured, {}});
  Character c;
  c.pool = pack(pool);
  c.classes = {1, std::vector<int>(fragments, 0), {0}, 0};
  c.quality = {1, {1}, std::vector<double>(ControlSpace::kPoints, 1)};
  c.policies = {{"greedy", 1, std::vector<int>(ControlSpace::kPoints, 0)}};
  c.bridges = {-1};
  c.control_model = control_model({}, kGenericPrior);
  c.contacts.resize(1);
  return c;
}

TEST(PolicyFile, TakesNoMemoryOutOfProportionToItsSize) {
  EXPECT_TRUE(accepts(to_bytes(same_fragments(1000, 500))));
  const Character huge = same_fragments(2000, 20000);
  const std::string bytes = unchecked_bytes(huge);
  ASSERT_LT(bytes.size(), 2000000U);
  largest_allocation = 0;
  const std::string error = error_of([&] { from_bytes(bytes); });
  EXPECT_NE(error.find("20000 fragments of 2000 bones would take 960 MB of memory"), std::string::npos) << error;
  EXPECT_LT(largest_allocation, 10 * bytes.size());
  EXPECT_NE(error_of([&] { to_bytes(huge); }).find("960 MB"), std::string::npos);
}

// Numbers that files of strangers may hold.
constexpr double kDoubles[] = {std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity(),
                               1.7e308,
                               -1e300,
                               1e150,
                               1e20,
                               1e9,
                               1e-9,
                               1e-300,
                               0,
                               -1,
                               0.5};

// Puts such a number in the place of another, or a small whole one, or any byte.
void mutate(std::string& payload, Random& random) {
  const std::size_t at = random.below(static_cast<int>(payload.size()) - 8);
  const std::int32_t whole = random.below(24) - 2;
  switch (random.below(3)) {
    case 0:
      payload[at] = static_cast<char>(random.below(256));
      break;
    case 1:
      std::memcpy(&payload[at], &whole, 4);
      break;
    default:
      std::memcpy(&payload[at], &kDoubles[random.below(12)], 8);
      break;
  }
}

TEST(PolicyFile, OfLegsAndContactsPlaysFinitePosesHoweverItIsForged) {
  const std::string payload = payload_of(to_bytes(legged_character()));
  const std::size_t poses = payload.find("stand");  // before it lie the skeleton and the grid: half of all mutations
  ASSERT_NE(poses, std::string::npos);
  Random random(21);
  int accepted = 0;
  for (int n = 0; n < 2000; ++n) {
    std::string forged = payload;
    for (int times = 1 + random.below(3); times > 0; --times) {
      std::string part = n % 2 == 0 ? forged.substr(0, poses) : forged.substr(poses);
      mutate(part, random);
      forged.replace(n % 2 == 0 ? 0 : poses, part.size(), part);
    }
    SCOPED_TRACE(n);
    accepted += accepts(file_around(forged)) ? 1 : 0;
  }
  EXPECT_GT(accepted, 100);
  EXPECT_LT(accepted, 1900);
}

TEST(PolicyFile, PlaysFinitePosesWhateverItsRolesAre) {
  Random random(22);
  const Character whole = legged_character();
  for (int n = 0; n < 300; ++n) {
    Character forged = whole;
    for (const auto& [name, role] : role_names()) {
      const int bone = random.below(forged.pool.skeleton.size() + 1) - 1;
      if (random.below(3) == 0 && (name != "hips" || bone >= 0)) forged.pool.skeleton.roles.*role = bone;
    }
    SCOPED_TRACE(n);
    EXPECT_TRUE(accepts(unchecked_bytes(forged)));
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
