// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <utility>

#include "io/asf_amc.hpp"
#include "io/bvh.hpp"
#include "mocap_files.hpp"

namespace fragmotion {
namespace {

constexpr double kTolerance = 1e-12;
constexpr double kInch = 0.0254;

/// A root that carries an arm of two bones and a tail without freedom; length 1 makes a file unit an inch.
const char* const kAsf =
    "# comment\n"                  // 1
    ":version 1.10\n"              // 2
    ":name small\n"                // 3
    ":units\n"                     // 4
    "  mass 1.0\n"                 // 5
    "  length 1\n"                 // 6
    "  angle deg\n"                // 7
    ":documentation\n"             // 8
    "   any words begin here\n"    // 9
    ":root\n"                      // 10
    "  order TX TY TZ RX RY RZ\n"  // 11
    "  axis XYZ\n"                 // 12
    "  position 0 0 0\n"           // 13
    "  orientation 0 0 0\n"        // 14
    ":bonedata\n"                  // 15
    "  begin\n"                    // 16
    "    id 1\n"                   // 17
    "    name upper\n"             // 18
    "    direction 1 0 0\n"        // 19
    "    length 10\n"              // 20
    "    axis 0 0 90 XYZ\n"        // 21
    "    dof rx ry rz\n"           // 22
    "    limits (-160.0 20.0)\n"   // 23
    "           (-70.0 70.0)\n"    // 24
    "           (-inf inf)\n"      // 25
    "  end\n"                      // 26
    "  begin\n"                    // 27
    "    id 2\n"                   // 28
    "    name lower\n"             // 29
    "    direction 0 1 0\n"        // 30
    "    length 5\n"               // 31
    "    axis 0 0 90 XYZ\n"        // 32
    "    dof rx tx\n"              // 33
    "  end\n"                      // 34
    "  begin\n"                    // 35
    "    id 3\n"                   // 36
    "    name tail\n"              // 37
    "    direction 0 0 -1\n"       // 38
    "    length 2\n"               // 39
    "    axis 0 0 0 XYZ\n"         // 40
    "  end\n"                      // 41
    ":hierarchy\n"                 // 42
    "  begin\n"                    // 43
    "    root upper tail\n"        // 44
    "    upper lower\n"            // 45
    "  end\n";                     // 46

const char* const kAmc =
    "#!OML:ASF small\n"     // 1
    ":FULLY-SPECIFIED\n"    // 2
    ":DEGREES\n"            // 3
    "1\n"                   // 4
    "root 1 2 3 0 0 0\n"    // 5
    "upper 0 0 0\n"         // 6
    "lower 0 0\n"           // 7
    "2\n"                   // 8
    "lower 90 4\n"          // 9
    "upper 0 0 90\n"        // 10
    "root 0 0 0 0 90 0\n";  // 11

Take read_text(const std::string& asf, const std::string& amc) {
  const TemporaryFolder folder;
  return read_asf_amc(folder.write("small.asf", asf), folder.write("moves.amc", amc));
}

/// World positions and rotations of every bone.
struct World {
  explicit World(Take t) : take(std::move(t)) { world_transforms(take, positions, rotations); }

  std::size_t at(int frame, const std::string& bone) const {
    const int index = take.skeleton.find(bone);
    if (index < 0) throw std::logic_error("no bone " + bone);
    return static_cast<std::size_t>(frame) * take.skeleton.names.size() + static_cast<std::size_t>(index);
  }
  Vector3 head(int frame, const std::string& bone) const { return load_vector(&positions[at(frame, bone) * 3]); }
  Quaternion rotation(int frame, const std::string& bone) const {
    return load_quaternion(&rotations[at(frame, bone) * 4]);
  }
  Vector3 tip(int frame, const std::string& bone) const {
    return head(frame, bone) + rotation(frame, bone) * take.skeleton.tips[take.skeleton.find(bone)];
  }

  Take take;
  std::vector<double> positions, rotations;
};

void expect_inches(const Vector3& actual, const Vector3& inches) {
  EXPECT_LT((actual - kInch * inches).norm(), kTolerance) << "actual " << (actual / kInch).transpose() << " inches";
}

TEST(AsfAmc, BonesBeginWhereTheirParentsEnd) {
  const TemporaryFolder folder;
  const Skeleton skeleton = read_asf(folder.write("small.asf", kAsf));
  EXPECT_EQ(skeleton.names, (std::vector<std::string>{"root", "upper", "lower", "tail"}));
  EXPECT_EQ(skeleton.parents, (std::vector<int>{-1, 0, 1, 0}));
  expect_inches(skeleton.offsets[1], {0, 0, 0});
  expect_inches(skeleton.offsets[2], {10, 0, 0});
  expect_inches(skeleton.tips[2], {0, 0, 5});
  expect_inches(skeleton.tips[3], {0, 2, 0});
  expect_inches(skeleton.tips[0], {5, 1, 0});
}

TEST(AsfAmc, ScalesByTheLengthUnit) {
  const TemporaryFolder folder;
  const Skeleton skeleton = read_asf(folder.write("small.asf", replaced(kAsf, "length 1\n", "length 0.45\n")));
  expect_inches(skeleton.offsets[2], {10 / 0.45, 0, 0});
}

TEST(AsfAmc, PlacesBonesAsComputedByHand) {
  const World world(read_text(kAsf, kAmc));
  EXPECT_EQ(world.take.name, "moves");
  EXPECT_EQ(world.take.rate, 120);
  ASSERT_EQ(world.take.frames, 2);
  expect_inches(world.head(0, "root"), {1, -3, 2});
  expect_inches(world.head(0, "lower"), {11, -3, 2});
  expect_inches(world.tip(0, "lower"), {11, -3, 7});
  // File axes. The root turns 90 about y: upper's frame then leads x to -z. In it upper turns 90 about z (its axis is
  // turned about z as well, which changes nothing): its tip (10, 0, 0) -> (0, 10, 0), the root leaves it there.
  expect_inches(world.tip(1, "upper"), {0, 0, 10});
  // Lower's own x axis is the file's y: it slides 4 along y and turns 90 about y. Upper takes (10, 4, 0) to
  // (-4, 10, 0), the root to (0, 10, 4), z up (0, -4, 10).
  expect_inches(world.head(1, "lower"), {0, -4, 10});
  // Its tip (0, 5, 0) stays under the turn about y; upper takes it to (-5, 0, 0), the root to (0, 0, 5).
  expect_inches(world.tip(1, "lower"), {0, -9, 10});
}

TEST(AsfAmc, AppliesTheFirstDofFirst) {
  const World world(read_text(kAsf, replaced(kAmc, "root 0 0 0 0 90 0", "root 0 0 0 90 90 0")));
  // Ry(90) Rx(90): the file's z -> -y -> -y, which is down.
  EXPECT_LT((world.rotation(1, "root") * Vector3(0, -1, 0) - Vector3(0, 0, -1)).norm(), kTolerance);
}

TEST(AsfAmc, ReadsRadians) {
  const std::string amc =
      replaced(replaced(kAmc, ":DEGREES", ":RADIANS"), "upper 0 0 90", "upper 0 0 1.5707963267948966");
  const std::string in_radians = replaced(replaced(amc, "0 90 0\n", "0 1.5707963267948966 0\n"), "lower 90", "lower 0");
  expect_inches(World(read_text(kAsf, in_radians)).tip(1, "upper"), {0, 0, 10});
}

TEST(AsfAmc, ReadsWindowsLinesAndComments) {
  std::string asf = replaced(kAsf, "    id 1\n", "    id 1 # the arm\n# more\n");
  for (std::size_t at = 0; (at = asf.find('\n', at)) != std::string::npos; at += 2) asf.replace(at, 1, "\r\n");
  expect_inches(World(read_text(asf, kAmc)).tip(1, "upper"), {0, 0, 10});
}

TEST(AsfAmc, BonesWithoutFreedomMayBeMissingInAFrame) {
  const World world(read_text(kAsf, kAmc));
  expect_inches(world.tip(0, "tail"), {1, -1, 2});
}

TEST(AsfAmc, ParentsMayStandAfterTheirChildren) {
  const std::string asf = replaced(replaced(kAsf, "root upper tail", "root lower tail"), "upper lower", "lower upper");
  const TemporaryFolder folder;
  const Skeleton skeleton = read_asf(folder.write("small.asf", asf));
  EXPECT_EQ(skeleton.names, (std::vector<std::string>{"root", "lower", "upper", "tail"}));
}

struct Broken {
  const char* what;
  std::string text;
  const char* error;
};

std::vector<Broken> broken_skeletons() {
  const std::string asf = kAsf;
  return {
      {"empty file", "", "1: no bones"},
      {"another format", "HIERARCHY", "1: a section such as :bonedata expected, found 'HIERARCHY'"},
      {"truncated in a bone", asf.substr(0, asf.find("  end")),
       "25: the file ends inside bone 'upper', 'end' expected"},
      {"truncated in the hierarchy", asf.substr(0, asf.rfind("  end")), "45: the file ends inside :hierarchy"},
      {"no hierarchy", asf.substr(0, asf.find(":hierarchy")), "41: bone 'upper' has no parent in :hierarchy"},
      {"bone left out", replaced(asf, "root upper tail", "root upper"), "46: bone 'tail' has no parent in :hierarchy"},
      {"unknown child", replaced(asf, "upper lower", "upper hand"), "45: unknown bone 'hand' in :hierarchy"},
      {"unknown parent", replaced(asf, "upper lower", "arm lower"), "45: unknown bone 'arm' in :hierarchy"},
      {"two parents", replaced(asf, "upper lower", "upper tail"), "45: bone 'tail' has two parents"},
      {"cycle", replaced(asf, "    root upper tail\n    upper lower", "    upper lower\n    lower upper"),
       "45: bone 'upper' is above itself"},
      {"cycle through the root", replaced(asf, "upper lower", "upper root"), "45: bone 'root' is above itself"},
      {"own child", replaced(asf, "root upper tail", "upper upper"), "44: bone 'upper' is above itself"},
      {"duplicate bone", replaced(asf, "name lower", "name upper"), "34: bone 'upper' appears twice"},
      {"bone without a name", replaced(asf, "    name tail\n", ""), "40: a bone without a name"},
      {"bone that never begins", replaced(asf, "  begin\n    id 1", "    id 1"), "16: 'begin' expected, found 'id'"},
      {"unknown entry", replaced(asf, "id 2", "colour 2"), "28: an entry of a bone or 'end' expected, found 'colour'"},
      {"direction of two numbers", replaced(asf, "direction 1 0 0", "direction 1 0"),
       "19: a number of the direction expected, found the end of the line"},
      {"length NaN", replaced(asf, "length 10", "length nan"), "20: a length expected, found 'nan'"},
      {"length unit 0", replaced(asf, "length 1\n", "length 0\n"), "6: a length above 0 expected"},
      {"unknown angle unit", replaced(asf, "angle deg", "angle grad"), "7: angle deg or rad expected, found 'grad'"},
      {"axis without an order", replaced(asf, "0 0 90 XYZ", "0 0 90"), "21: an axis order such as XYZ expected"},
      {"axis twice", replaced(asf, "0 0 90 XYZ", "0 0 90 XXZ"), "21: an axis order such as XYZ expected, found 'XXZ'"},
      {"unknown dof", replaced(asf, "dof rx ry rz", "dof rx ry rw"),
       "22: dof tx, ty, tz, rx, ry or rz expected, found 'rw'"},
      {"more dofs than there are", replaced(asf, "dof rx ry rz", "dof rx ry rz rx ry rz rx"), "22: more than 6 dofs"},
      {"length beyond all", replaced(asf, "length 10", "length 1e300"),
       "20: a length from -1e12 to 1e12 expected, found '1e300'"},
      {"length unit without a size", replaced(asf, "length 1\n", "length 1e-320\n"),
       "6: a length from 1e-12 on expected"},
      {"bone that changes its length", replaced(asf, "dof rx tx", "dof rx l"),
       "33: dof 'l' (a bone that changes its length) is not supported"},
      {"unknown word of the root", replaced(asf, "position 0 0 0", "place 0 0 0"),
       "13: order, axis, position or orientation expected, found 'place'"},
  };
}

std::vector<Broken> broken_motions() {
  const std::string amc = kAmc;
  return {
      {"empty file", "", "1: no frames"},
      {"no frames", amc.substr(0, amc.find("1\n")), "3: no frames"},
      {"no frame number", replaced(amc, "1\nroot", "root"), "4: a frame's number expected, found 'root'"},
      {"a gap between frames", replaced(amc, "2\nlower", "3\nlower"), "8: frame 2 expected, found '3'"},
      {"bone not in the skeleton", replaced(amc, "upper 0 0 0", "wing 0 0 0"), "6: bone 'wing' is not in the skeleton"},
      {"bone twice", replaced(amc, "lower 0 0\n", "upper 0 0 0\n"), "7: bone 'upper' appears twice in a frame"},
      {"too few dofs", replaced(amc, "upper 0 0 90", "upper 0 0"), "10: bone 'upper' holds 2 values, 3 expected"},
      {"too many dofs", replaced(amc, "upper 0 0 90", "upper 0 0 90 1"),
       "10: bone 'upper' holds more values, 3 expected"},
      {"values for a bone without dofs", replaced(amc, "lower 0 0\n", "lower 0 0\ntail 1\n"),
       "8: bone 'tail' holds more values, 0 expected"},
      {"missing bone", replaced(amc, "lower 90 4\n", ""), "8: frame 2 lacks bone 'lower'"},
      {"truncated", amc.substr(0, amc.rfind("root")), "8: frame 2 lacks bone 'root'"},
      {"not a number", replaced(amc, "root 1 2 3", "root 1 nan 3"), "5: a number expected, found 'nan'"},
      {"a word", replaced(amc, "root 1 2 3", "root 1 two 3"), "5: a number expected, found 'two'"},
      {"farther than anything", replaced(amc, "root 1 2 3", "root 1 2e12 3"),
       "5: a number from -1e12 to 1e12 expected, found '2e12'"},
  };
}

TEST(AsfAmc, NamesFileLineAndCauseOfABrokenSkeleton) {
  for (const Broken& broken : broken_skeletons()) {
    const std::string error = error_of([&] { read_text(broken.text, kAmc); });
    EXPECT_EQ(error.find(std::string("small.asf:") + broken.error), 0u) << broken.what << ": " << error;
  }
}

TEST(AsfAmc, NamesFileLineAndCauseOfABrokenMotion) {
  for (const Broken& broken : broken_motions()) {
    const std::string error = error_of([&] { read_text(kAsf, broken.text); });
    EXPECT_EQ(error.find(std::string("moves.amc:") + broken.error), 0u) << broken.what << ": " << error;
  }
}

/// kAsf with so many bones more, without dofs, below the tail.
std::string with_still_bones(int count) {
  std::string bones, children = "    tail";
  for (int i = 0; i < count; ++i) {
    const std::string name = " b" + std::to_string(i);
    bones += "begin\nname" + name + "\ndirection 1 0 0\nlength 1\naxis 0 0 0 XYZ\nend\n";
    children += name;
  }
  return replaced(replaced(kAsf, ":hierarchy", bones + ":hierarchy"), "    upper lower",
                  children + "\n    upper lower");
}

TEST(AsfAmc, ReadsBonesAndNamesUpToALimit) {
  EXPECT_EQ(read_text(with_still_bones(4092), kAmc).skeleton.size(), 4096);
  EXPECT_EQ(error_of([] { read_text(with_still_bones(4093), kAmc); }),
            "small.asf:" + std::to_string(42 + 6 * 4092) + ": more than 4096 bones");
  EXPECT_EQ(error_of([] { read_text(replaced(kAsf, "name tail", "name " + std::string(256, 'a')), kAmc); }),
            "small.asf:37: name '" + std::string(40, 'a') + "'... has 256 bytes, at most 255 are allowed");
}

TEST(AsfAmc, TakesMemoryInProportionToTheFile) {
  const std::string asf = with_still_bones(996);
  for (const int frames : {2, 500, 501, 5000}) {
    std::string amc;
    for (int f = 1; f <= frames; ++f) amc += std::to_string(f) + "\nroot 0 0 0 0 0 0\nupper 0 0 0\nlower 0 0\n";
    if (1000 * frames <= 500000 + static_cast<int>(amc.size()) / 4) {
      const Take take = read_text(asf, amc);
      EXPECT_EQ(take.frames, frames);
      EXPECT_LE(8 * (take.translations.capacity() + take.rotations.capacity()), 50000000 + 20 * amc.size());
    } else {
      EXPECT_EQ(
          error_of([&] { read_text(asf, amc); }).find("moves.amc:1: " + std::to_string(frames) + " frames of 1000"),
          0u);
    }
  }
}

TEST(AsfAmc, NamesAFileThatCannotBeRead) {
  const TemporaryFolder folder;
  const auto asf = folder.write("small.asf", kAsf);
  EXPECT_EQ(error_of([&] { read_asf(folder.path() / "none.asf"); }), "none.asf: cannot be read");
  EXPECT_EQ(error_of([&] { read_asf_amc(asf, folder.path() / "none.amc"); }), "none.amc: cannot be read");
}

TEST(AsfAmc, RejectsARateThatIsNone) {
  const TemporaryFolder folder;
  const auto asf = folder.write("small.asf", kAsf), amc = folder.write("moves.amc", kAmc);
  for (const double rate : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_NE(error_of([&] { read_asf_amc(asf, amc, rate); }), "no error") << rate;
  }
}

/// Bones of the ASF and of the BVH file that are the same.
using Pair = std::pair<const char*, const char*>;

/// The BVH file leaves out the lengths of the thorax and of the wrists: Neck, the shoulders and the finger bases stand
/// on their parents (OFFSET 0 0 0). So what comes after those is compared from there on.
struct Limb {
  Pair start;
  std::vector<Pair> bones;
};

std::vector<Limb> body() {
  return {{{"", ""},
           {{"root", "Hips"},
            {"lfemur", "LeftUpLeg"},
            {"ltibia", "LeftLeg"},
            {"lfoot", "LeftFoot"},
            {"ltoes", "LeftToeBase"},
            {"rfemur", "RightUpLeg"},
            {"rtibia", "RightLeg"},
            {"rfoot", "RightFoot"},
            {"rtoes", "RightToeBase"},
            {"lowerback", "LowerBack"},
            {"upperback", "Spine"},
            {"thorax", "Spine1"}}},
          {{"lowerneck", "Neck"},
           {{"upperneck", "Neck1"},
            {"head", "Head"},
            {"lhumerus", "LeftArm"},
            {"lradius", "LeftForeArm"},
            {"lwrist", "LeftHand"},
            {"rhumerus", "RightArm"},
            {"rradius", "RightForeArm"},
            {"rwrist", "RightHand"}}},
          {{"lhand", "LeftFingerBase"}, {{"lfingers", "LFingers"}}},
          {{"rhand", "RightFingerBase"}, {{"rfingers", "RFingers"}}}};
}

/// The head of a bone in a frame, from the head of `start` where there is one.
Vector3 head_from(const World& world, int frame, const std::string& start, const std::string& bone) {
  const Vector3 head = world.head(frame, bone);
  return start.empty() ? head : Vector3(head - world.head(frame, start));
}

/// Largest distance in metres over all frames and all bones of a limb.
double largest_distance(const World& asf, const World& bvh, int bvh_frames_before, const Limb& limb) {
  double largest = 0;
  for (int frame = 0; frame < asf.take.frames; ++frame) {
    for (const auto& [asf_bone, bvh_bone] : limb.bones) {
      const Vector3 expected = head_from(bvh, frame + bvh_frames_before, limb.start.second, bvh_bone);
      largest = std::max(largest, (head_from(asf, frame, limb.start.first, asf_bone) - expected).norm());
    }
  }
  return largest;
}

TEST(AsfAmc, MatchesTheSameTakeAsBvh) {
  const auto cmu = shared_mocap() / "cmu";
  if (!std::filesystem::exists(cmu / "01_01.bvh")) GTEST_SKIP() << "no motion capture beside the project";
  const World asf(read_asf_amc(cmu / "01.asf", cmu / "01_01.amc"));
  const World bvh(read_bvh(cmu / "01_01.bvh", kInch / 0.45));
  // The BVH file begins with a T-pose of its own.
  ASSERT_EQ(bvh.take.frames, asf.take.frames + 1);
  EXPECT_EQ(bvh.take.rate, 120);
  for (const Limb& limb : body()) {
    const double distance = largest_distance(asf, bvh, 1, limb);
    std::cout << "ASF/AMC and BVH, from '" << limb.start.first << "': " << distance * 1000 << " mm\n";
    // BVH rounds angles to 0.0001 degrees and offsets to 0.00001.
    EXPECT_LT(distance, 2e-5) << limb.start.first;
  }
  // Without the frame more, they are 16 cm apart.
  EXPECT_GT(largest_distance(asf, bvh, 0, body()[0]), 0.1);
}

TEST(AsfAmc, ReadsAllTakesOfSubject02) {
  const auto cmu = shared_mocap() / "cmu";
  if (!std::filesystem::exists(cmu / "02.asf")) GTEST_SKIP() << "no motion capture beside the project";
  int takes = 0;
  for (const auto& file : files_in(cmu, ".amc")) {
    if (file.stem().string().rfind("02_", 0) != 0) continue;
    const Take take = read_asf_amc(cmu / "02.asf", file);
    EXPECT_GT(take.frames, 100) << take.name;
    ++takes;
  }
  EXPECT_EQ(takes, 4);
}

TEST(AsfAmc, SubjectsStandAsTallAsPeople) {
  const auto cmu = shared_mocap() / "cmu";
  if (!std::filesystem::exists(cmu / "01.asf")) GTEST_SKIP() << "no motion capture beside the project";
  const double statures[] = {stature(read_asf(cmu / "01.asf")), stature(read_asf(cmu / "02.asf")),
                             stature(read_bvh(cmu / "01_01.bvh", kInch / 0.45).skeleton)};
  for (const double metres : statures) {
    std::cout << "stature " << metres << " m\n";
    EXPECT_GT(metres, 1.4);
    EXPECT_LT(metres, 2.0);
  }
}

}  // namespace
}  // namespace fragmotion
