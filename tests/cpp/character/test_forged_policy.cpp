// SPDX-License-Identifier: MIT
// Policy files with a right checksum that this program did not make.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "add_bone.hpp"
#include "allocations.hpp"
#include "character/policy_bytes.hpp"
#include "fragments/packed_pool.hpp"
#include "mocap_files.hpp"
#include "policy/anticipate.hpp"
#include "policy_payload.hpp"
#include "runtime/player.hpp"
#include "skeleton/role_names.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion {
namespace {

// Reads the bytes and, if they are accepted, plays two seconds of finite poses, one of them uphill. Anything but
// std::invalid_argument escapes.
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
    if (i == 30) player.stand_on([](const Vector3& from) { return GroundPoint{0.2 * from.y(), {0, -0.2, 1}}; });
    player.step(character->space.point(random.below(kPaperPoints)), 1.0 / 30);
    bool finite = player.root_position().allFinite() && std::isfinite(player.frame().heading);
    for (const auto& foot : player.standing_feet()) finite = finite && (!foot || foot->allFinite());
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

// Spoils the poses of the first clip.
template <typename Spoil>
std::function<void(Character&)> repose(Spoil spoil) {
  return [=](Character& c) {
    PackedPoses poses = *c.pool.clips[0].poses;
    spoil(poses);
    c.pool.clips[0].poses = std::make_shared<const PackedPoses>(poses);
  };
}

TEST(PolicyFile, RefusesCharactersThatDoNotFitTogether) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const struct {
    const char* label;
    std::function<void(Character&)> spoil;
  } cases[] = {
      {"no poses", repose([](PackedPoses& poses) { poses.bytes.clear(); })},
      {"too few poses", repose([](PackedPoses& poses) { poses.bytes.pop_back(); })},
      {"too many bits", repose([](PackedPoses& poses) { poses.bits[4] = 25; })},
      {"other bits", repose([](PackedPoses& poses) { poses.bits[5] += 9; })},
      {"too few bits", repose([](PackedPoses& poses) { poses.bits.pop_back(); })},
      {"too few turns", repose([](PackedPoses& poses) { poses.least.pop_back(); })},
      {"turn without end", repose([](PackedPoses& poses) { poses.least[0] = 1 << 30; })},
      {"position not finite", repose([=](PackedPoses& poses) { poses.origin[0] = nan; })},
      {"position too far", repose([=](PackedPoses& poses) { poses.steps[1] = 1e300; })},
      {"no step", repose([=](PackedPoses& poses) { poses.steps[3] = 0; })},
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
      {"looks of other bones", [](Character& c) { c.looks.fastest.push_back(1); }},
      {"look not finite", [=](Character& c) { c.looks.gaze.turn = nan; }},
      {"look that is nowhere", [](Character& c) { c.looks.gaze.forward *= 0; }},
      {"look down that is up", [](Character& c) { c.looks.gaze.down = 0.1; }},
      {"elbow without an axis", [](Character& c) { c.arms[1].arm.hinge *= 0; }},
      {"arm that points nowhere", [](Character& c) { c.arms[0].widest = -1; }},
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
      {"smoothness not finite", [=](Character& c) { c.quality.smoothness[3] = nan; }},
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

TEST(PolicyFile, RefusesMirrorImagesThatDoNotFit) {
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  const struct {
    const char* label;
    std::function<void(Character&)> spoil;
  } cases[] = {
      {"counterpart that is no bone", regrid([](PoseGrid& grid) { grid.mirror.counterparts[1] = 4; })},
      {"counterpart of another", regrid([](PoseGrid& grid) { grid.mirror.counterparts[1] = 2; })},
      {"too few counterparts", regrid([](PoseGrid& grid) { grid.mirror.counterparts.pop_back(); })},
      {"no turn before", regrid([](PoseGrid& grid) { grid.mirror.before[8] = 2; })},
      {"turn after not finite", regrid([=](PoseGrid& grid) { grid.mirror.after[1] = nan; })},
      {"too few turns after", regrid([](PoseGrid& grid) { grid.mirror.after.pop_back(); })},
      {"no mirror", regrid([](PoseGrid& grid) { grid.mirror = {}; })},
      {"image before its original", [](Character& c) { std::swap(c.pool.clips[0], c.pool.clips[2]); }},
  };
  const Character whole = tiny_character({tiny_clip(0), tiny_clip(1.5)}, true);
  ASSERT_TRUE(accepts(to_bytes(whole)));
  for (const auto& c : cases) {
    SCOPED_TRACE(c.label);
    Character character = whole;
    c.spoil(character);
    EXPECT_EQ(error_of([&] { from_bytes(unchecked_bytes(character), "forged"); }).find("forged is refused: "), 0U);
    EXPECT_EQ(error_of([&] { to_bytes(character); }).find("the policy cannot be saved: "), 0U);
  }
}

TEST(PolicyFile, RefusesImagesOfWhatIsNoOriginal) {
  const std::string payload = payload_of(to_bytes(tiny_character({tiny_clip(0), tiny_clip(1.5)}, true)));
  const std::size_t at = payload.rfind("take mirrored") + 13;  // of clip 3, whose original is clip 1
  const auto with_original = [&](std::int32_t original) {
    std::string forged = payload;
    std::memcpy(&forged[at], &original, sizeof original);
    return file_around(forged);
  };
  ASSERT_EQ(with_original(1), file_around(payload));
  for (const int original : {2, 3, 4, 1000000, -1, std::numeric_limits<int>::min()}) {
    EXPECT_FALSE(accepts(with_original(original))) << original;
  }
}

TEST(PolicyFile, IsMadeOfImagesThatHaveTheirOriginals) {
  Character character = tiny_character();
  character.pool.clips[1].mirrored = true;
  EXPECT_NE(error_of([&] { to_bytes(character); }), "no error");
  Character orphaned = tiny_character({tiny_clip(0), tiny_clip(1.5)}, true);
  orphaned.pool.clips[3].poses = std::make_shared<const PackedPoses>(*orphaned.pool.clips[3].poses);
  EXPECT_NE(error_of([&] { to_bytes(orphaned); }).find("mirror images"), std::string::npos);
}

// Which it does not hold.
TEST(PolicyFile, IsNotMadeOfWrongMatches) {
  for (const double match : {-0.1, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    Character character = tiny_character();
    character.quality.match[1] = match;
    EXPECT_NE(error_of([&] { to_bytes(character); }).find("qualities"), std::string::npos);
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
    add_bone(skeleton, "bone" + std::to_string(b), b == 0 ? -1 : 0, {0, 0, 1}, {0, 0, 1});
  }
  clip.root_positions.assign(9, 0);
  for (int i = 0; i < 3 * bones; ++i) clip.rotations.insert(clip.rotations.end(), {1, 0, 0, 0});
  FragmentPool pool{make_skeleton(skeleton), {}, {}};
  pool.clips.push_back(make_clip(pool.skeleton, clip));
  pool.fragments.assign(fragments, {0, 0, 2, Origin::captured, {}});
  Character c;
  c.pool = pack(pool);
  c.classes = {1, std::vector<int>(fragments, 0), {0}, 0};
  c.quality = {1, {1}, std::vector<double>(kPaperPoints, 1)};
  c.policies = {{"greedy", 1, std::vector<int>(kPaperPoints, 0)}};
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

// A character of 4,000 bones in styles that hold next to nothing, as poses of one bone.
std::string hollow_styles(int count, const std::string& name) {
  Character c = same_fragments(4000, 1);
  c.pool.skeleton.names[0] = name;
  const auto style = std::make_shared<Character>(same_fragments(1, 1));
  c.style = style->style = "same";
  style->control_model.clear();
  style->quality.match.clear();
  style->policies.clear();
  c.styles.assign(count, style);
  return unchecked_bytes(c);
}

TEST(PolicyFile, TakesNoMemoryForStylesThatItOnlyAnnounces) {
  for (const int count : {kMostStyles - 1, 1000}) {
    for (const std::size_t letters : {5, 2000000}) {
      SCOPED_TRACE(std::to_string(count) + " styles, " + std::to_string(letters) + " letters");
      const std::string bytes = hollow_styles(count, std::string(letters, 'b'));
      allocated_bytes = 0;
      EXPECT_EQ(error_of([&] { from_bytes(bytes, "forged"); }).find("forged is refused: "), 0U);
      EXPECT_LT(allocated_bytes, 20 * bytes.size());
    }
  }
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
    measure_looks_and_arms(forged);
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
