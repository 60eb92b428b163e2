// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "examined_walks.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion {
namespace {

TEST(Doctor, FindsNothingInCleanMotion) {
  for (const double rate : {60.0, 120.0}) {
    for (const double size : {0.9, 1.1}) {
      for (const Clip& clip : gait_takes(rate, size)) {
        const Take take = take_of(humanoid(size), clip);
        const std::size_t still = clip.name == "stand" ? 1 : clip.name == "jump" ? 2 : 0;  // parts without motion
        EXPECT_EQ(codes_of(take), std::vector<std::string>(still, "frozen")) << clip.name << " " << rate << " " << size;
        if (still == 2) continue;
        EXPECT_EQ(mend(take, findings_of(take)).rotations, take.rotations);
        EXPECT_EQ(mend(take, findings_of(take)).translations, take.translations);
      }
    }
  }
}

TEST(Doctor, TellsWhatATakeIs) {
  const Examination told = examine({walk()}, 1)[0];
  EXPECT_NEAR(told.stature, stature(humanoid()), 1e-12);
  EXPECT_EQ(told.scale, 1);
  EXPECT_EQ(told.up, "+Z");
  EXPECT_EQ(told.facing, "-Y");
  EXPECT_EQ(told.rate, 30);
  EXPECT_TRUE(told.root_motion);
  EXPECT_EQ(told.rest_pose, "down");
  EXPECT_EQ(told.roles.at("left_foot"), "foot.L");
}

TEST(Doctor, FillsWhatIsNotANumber) {
  const Take clean = walk();
  Take damaged = clean;
  rotation(damaged, 40, "forearm.L")[2] = kNotANumber;
  place(damaged, 41)[0] = std::numeric_limits<double>::infinity();
  expect_mended(damaged, "missing", 40, 41, clean, 0.01);
}

TEST(Doctor, CutsAnEndThatIsNotANumber) {
  const Take clean = walk();
  Take damaged = clean;
  for (int f = 0; f < 5; ++f) place(damaged, f)[2] = kNotANumber;
  expect_mended(damaged, "missing", 0, 4, picked(clean, counted(clean.frames - 5, 5)));
}

TEST(Doctor, DoesNotInventALongGapUnasked) {
  Take damaged = walk();
  for (int f = 30; f < 60; ++f) place(damaged, f)[2] = kNotANumber;
  const Finding finding = findings_of(damaged).at(0);
  EXPECT_EQ(finding.severity, Severity::kError);
  EXPECT_FALSE(finding.safe);
}

TEST(Doctor, FindsAndFillsSpikes) {
  for (const double rate : {30.0, 120.0}) {
    const Take clean = walk({0, 1.2, 0, 3, rate});
    for (const int frames : {1, 2, 3}) {
      Take damaged = clean;
      for (int f = 50; f < 50 + frames; ++f) {
        double* q = rotation(damaged, f, "upper_arm.R");
        store_quaternion(Quaternion(Eigen::AngleAxisd(0.8, Vector3::UnitY())) * load_quaternion(q), q);
      }
      expect_mended(damaged, "spike", 50, 49 + frames, clean, 0.02);
      for (int f = 50; f < 50 + frames; ++f) place(damaged, f)[0] += 0.5;
      expect_mended(damaged, "spike", 50, 49 + frames, clean, 0.02);
    }
  }
}

// As a foot of a drawn run that flicks in each stride; what broke comes when it comes.
TEST(Doctor, LeavesWhatABoneDoesAgainInTheSameTime) {
  for (const int last : {60, 63}) {
    Take take = walk();
    for (const int begin : {20, 40, last}) {
      for (int f = begin; f < begin + 3; ++f) {
        double* q = rotation(take, f, "upper_arm.R");
        store_quaternion(Quaternion(Eigen::AngleAxisd(0.8, Vector3::UnitY())) * load_quaternion(q), q);
      }
    }
    const std::vector<std::string> codes = codes_of(take);
    EXPECT_EQ(std::count(codes.begin(), codes.end(), "spike"), last == 60 ? 0 : 3) << last;
  }
}

TEST(Doctor, FindsAndFillsFlips) {
  const Take clean = walk();
  for (const Vector3& axis : {Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}}) {
    Take damaged = clean;
    for (const int f : {30, 31}) {
      double* q = rotation(damaged, f, "shin.L");
      store_quaternion(load_quaternion(q) * Quaternion(Eigen::AngleAxisd(kPi, axis)), q);
    }
    expect_mended(damaged, "flip", 30, 31, clean, 0.1);
  }
}

TEST(Doctor, FingersMatterLittle) {
  Take take = walk();
  for (std::string& name : take.skeleton.names) {
    if (name == "hand.L") name = "index_01.L";
  }
  take.skeleton = make_skeleton(take.skeleton);
  double* q = rotation(take, 30, "index_01.L");
  store_quaternion(load_quaternion(q) * Quaternion(Eigen::AngleAxisd(1, Vector3::UnitX())), q);
  EXPECT_EQ(codes_of(take), (std::vector<std::string>{"spike", "body"}));  // an arm that has lost its hand
  EXPECT_EQ(findings_of(take)[0].severity, Severity::kInfo);
}

TEST(Doctor, AQuaternionOfTheOtherSignIsNoFlip) {
  Take take = walk();
  double* q = rotation(take, 30, "shin.L");
  for (int i = 0; i < 4; ++i) q[i] *= -1;
  EXPECT_EQ(codes_of(take), std::vector<std::string>{});
}

TEST(Doctor, LeavesOutDoubledFrames) {
  const Take clean = walk();
  for (const int copies : {2, 3, 4}) {
    std::vector<int> frames;
    for (int f = 0; f < clean.frames; ++f) frames.insert(frames.end(), copies, f);
    Take damaged = picked(clean, frames);
    damaged.rate *= copies;
    expect_mended(damaged, "doubled", 0, damaged.frames - 1, clean);
    EXPECT_EQ(mend(damaged, findings_of(damaged)).rate, clean.rate);
  }
}

TEST(Doctor, FillsFrozenFrames) {
  const Take clean = walk();
  std::vector<int> frames = counted(clean.frames);
  frames[40] = frames[41] = 39;
  expect_mended(picked(clean, frames), "frozen", 40, 41, clean, 0.03);
}

TEST(Doctor, CutsFrozenEnds) {
  const Take clean = walk();
  std::vector<int> frames = counted(clean.frames);
  frames.insert(frames.begin(), 10, 0);
  expect_mended(picked(clean, frames), "frozen", 0, 9, clean);
  frames = counted(clean.frames);
  frames.insert(frames.end(), 10, clean.frames - 1);
  expect_mended(picked(clean, frames), "frozen", clean.frames, clean.frames + 9, clean);
}

TEST(Doctor, TellsALongStandstillAndMendsNothing) {
  const Take clean = walk();
  std::vector<int> frames = counted(clean.frames);
  for (int f = 41; f < 60; ++f) frames[f] = 40;
  const Take damaged = picked(clean, frames);
  ASSERT_EQ(codes_of(damaged), std::vector<std::string>{"frozen"});
  EXPECT_FALSE(findings_of(damaged)[0].mendable);
}

TEST(Doctor, FillsInDroppedFrames) {
  const Take clean = walk();
  for (const int count : {1, 2}) {
    std::vector<int> frames = counted(clean.frames);
    frames.erase(frames.begin() + 40, frames.begin() + 40 + count);
    expect_mended(picked(clean, frames), "dropped", 39, 40, clean, 0.05);
  }
}

TEST(Doctor, CutsCalibrationPosesOff) {
  const Take clean = walk();
  for (const int count : {1, 2, 20}) {
    for (const bool at_start : {true, false}) {
      Take pose = picked(clean, std::vector<int>(count, at_start ? 0 : clean.frames - 1));
      for (int f = 0; f < count; ++f) {
        store_quaternion(Quaternion(Eigen::AngleAxisd(-kPi / 2, Vector3::UnitY())), rotation(pose, f, "upper_arm.L"));
        store_quaternion(Quaternion(Eigen::AngleAxisd(kPi / 2, Vector3::UnitY())), rotation(pose, f, "upper_arm.R"));
      }
      Take damaged = at_start ? pose : clean;
      const Take& rest = at_start ? clean : pose;
      damaged.frames += rest.frames;
      damaged.translations.insert(damaged.translations.end(), rest.translations.begin(), rest.translations.end());
      damaged.rotations.insert(damaged.rotations.end(), rest.rotations.begin(), rest.rotations.end());
      const int begin = at_start ? 0 : clean.frames;
      expect_mended(damaged, "calibration", begin, begin + count - 1, clean);
    }
  }
}

// The arms hang after 20 frames of a T pose and 10 in which they are lowered; the last of these are less than half out.
TEST(Doctor, CutsTheSwingOutOfATPoseOff) {
  const Take clean = walk();
  Take pose = picked(clean, std::vector<int>(30, 0));
  for (int f = 0; f < pose.frames; ++f) {
    const double raised = kPi / 2 * std::min(1.0, (30 - f) / 10.0);
    store_quaternion(Quaternion(Eigen::AngleAxisd(-raised, Vector3::UnitY())), rotation(pose, f, "upper_arm.L"));
    store_quaternion(Quaternion(Eigen::AngleAxisd(raised, Vector3::UnitY())), rotation(pose, f, "upper_arm.R"));
  }
  pose.frames += clean.frames;
  pose.translations.insert(pose.translations.end(), clean.translations.begin(), clean.translations.end());
  pose.rotations.insert(pose.rotations.end(), clean.rotations.begin(), clean.rotations.end());
  const std::vector<Finding> findings = examine({&pose})[0].findings;
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].code, "calibration");
  EXPECT_EQ(findings[0].begin, 0);
  EXPECT_NEAR(findings[0].end, 26, 1);
}

TEST(Doctor, TellsAJumpInTheMiddle) {
  Take take = walk();
  for (int f = 45; f < take.frames; ++f) place(take, f)[0] += 1.5;
  const std::vector<Finding> findings = findings_of(take);
  ASSERT_EQ(codes_of(take), std::vector<std::string>{"jump"});
  EXPECT_EQ(findings[0].begin, 44);
  EXPECT_EQ(findings[0].end, 45);
  EXPECT_FALSE(findings[0].mendable);
}

TEST(Doctor, PutsFeetOnTheGround) {
  const Take clean = walk();
  for (const double height : {-0.05, -0.6, 0.1, 1.0}) {
    Take damaged = clean;
    for (int f = 0; f < damaged.frames; ++f) place(damaged, f)[2] += height;
    expect_mended(damaged, "ground", 0, clean.frames - 1, clean, 0.015);
  }
}

// Its clips are another's, whose legs are longer: on the way or on the spot.
TEST(Doctor, TellsFeetThatHoverOverWhereTheyAreAtRest) {
  for (const bool on_the_spot : {false, true}) {
    for (const double height : {0.0, 0.03, -0.03}) {
      Take take = walk();
      for (int f = 0; f < take.frames; ++f) {
        place(take, f)[2] += height;
        if (on_the_spot) place(take, f)[1] -= 1.2 * f / take.rate;
      }
      const std::vector<Finding> found = examine_ground(take);
      ASSERT_EQ(found.size(), height == 0 ? 0 : 1) << on_the_spot << height;
      if (height == 0) continue;
      EXPECT_NE(found[0].text.find(height < 0 ? "cm under the ground" : "cm over the ground"), std::string::npos);
      EXPECT_TRUE(examine_ground(mend(take, found)).empty());
    }
  }
}

Take on_slope(double rises) {
  Take take = walk();
  for (int f = 0; f < take.frames; ++f) place(take, f)[2] += rises * place(take, f)[1];
  return take;
}

// Walks of 3.6 m.
TEST(Doctor, TellsASlope) { EXPECT_EQ(codes_of(on_slope(0.1)), std::vector<std::string>{"slope"}); }

TEST(Doctor, TellsNoSlopeThatBuildPutsLevel) { EXPECT_EQ(codes_of(on_slope(0.04)), std::vector<std::string>{}); }

Take in_place(Take take) {
  for (int f = 0; f < take.frames; ++f) place(take, f)[0] = place(take, f)[1] = 0;
  return take;
}

TEST(Doctor, LeadsByItsFeetWhatGoesInPlace) {
  const Take clean = walk(), take = in_place(clean);
  const std::vector<Examination> told = examine({take}, 1);
  ASSERT_EQ(codes_of(take), std::vector<std::string>{"in_place"});
  EXPECT_FALSE(told[0].root_motion);
  EXPECT_NE(told[0].findings[0].text.find("1.2 m/s"), std::string::npos) << told[0].findings[0].text;
  const Take mended = mend(take, told[0].findings);
  EXPECT_EQ(codes_of(mended), std::vector<std::string>{});
  Take moved = mended;  // where it goes is the same; where it begins is not told
  const Vector2 begin(place(moved, 0)[0] - clean.translations[0], place(moved, 0)[1] - clean.translations[1]);
  for (int f = 0; f < moved.frames; ++f) place(moved, f)[0] -= begin.x(), place(moved, f)[1] -= begin.y();
  expect_near(moved, clean, 0.05);
}

TEST(Doctor, LeavesWhoStandsOnTheSpot) {
  const Take swaying = walk({0, 0.2, 0.3});
  EXPECT_EQ(codes_of(in_place(swaying)), std::vector<std::string>{});
}

TEST(Doctor, TellsARootThatGoesAlongOtherAxes) {
  Take take = walk({0.2, 1.2, 0.3});
  for (int f = 0; f < take.frames; ++f) std::swap(place(take, f)[0], place(take, f)[1]);
  ASSERT_EQ(codes_of(take), std::vector<std::string>{"axes"});
  EXPECT_NE(findings_of(take)[0].text.find("(+X as +Y, +Y as +X)"), std::string::npos) << findings_of(take)[0].text;
}

TEST(Doctor, TellsFeetThatDrift) {
  Take take = walk({0.2, 1.2, 0.3});
  for (int f = 0; f < take.frames; ++f) place(take, f)[1] -= 0.45 * f / take.rate;
  ASSERT_EQ(codes_of(take), std::vector<std::string>{"drift"});
  EXPECT_NE(findings_of(take)[0].text.find("at 0.45 m/s"), std::string::npos) << findings_of(take)[0].text;
}

TEST(Doctor, TellsNoise) {
  Take take = walk();
  std::mt19937 random(1);
  std::normal_distribution<double> off(0, 4 * kPi / 180 / std::sqrt(3.0));  // about each of three axes
  for (std::size_t i = 0; i < take.rotations.size(); i += 4) {
    const Vector3 turn(off(random), off(random), off(random));
    const Quaternion noisy = load_quaternion(&take.rotations[i]) * Eigen::AngleAxisd(turn.norm(), turn.normalized());
    store_quaternion(noisy, &take.rotations[i]);
  }
  const std::vector<std::string> codes = codes_of(take);
  EXPECT_EQ(std::count(codes.begin(), codes.end(), "noise"), 1);
}

TEST(Doctor, TellsByFallsThatTheRateIsAnother) {
  Gait hop;
  hop.rate = 120;
  hop.jump = kGravity * 0.25 / 8;  // of half a second
  Take take = walk(hop);
  EXPECT_EQ(codes_of(take), std::vector<std::string>{});
  for (const double rate : {30.0, 60.0, 240.0}) {
    take.rate = rate;
    const std::vector<Finding> findings = findings_of(take);
    ASSERT_EQ(codes_of(take), std::vector<std::string>{"rate"});
    EXPECT_NE(findings[0].text.find("in some 12"), std::string::npos) << findings[0].text;
  }
}

TEST(Doctor, TellsARateThatCannotBe) {
  Take take = walk();
  for (const double rate : {2.0, 2000.0}) {
    take.rate = rate;
    const std::vector<std::string> codes = codes_of(take);
    EXPECT_NE(std::find(codes.begin(), codes.end(), "rate"), codes.end());
  }
}

TEST(Doctor, FindsTheSameMotionTwice) {
  const Take one = walk({0.2, 1.2, 0.3, 4}), other = walk({-0.3, 1.0, -0.4, 4, 30, 1.1});
  Take copy = with_basis(one, Eigen::AngleAxisd(2, Vector3::UnitZ()).toRotationMatrix());
  for (int f = 0; f < copy.frames; ++f) place(copy, f)[0] += 3;
  const std::vector<Take> takes = {one, other, copy, picked(one, counted(70, 30)), walk({0.2, 1.2, 0.3, 4, 60})};
  const std::vector<Examination> told = examine(takes, 2);
  const auto other_of = [&](int take) {
    for (const Finding& finding : told[take].findings) {
      if (finding.code == "duplicate") return finding.other;
    }
    return -1;
  };
  EXPECT_EQ(other_of(0), -1);
  EXPECT_EQ(other_of(1), -1);
  EXPECT_EQ(other_of(2), 0);
  EXPECT_EQ(other_of(3), 0);
  EXPECT_EQ(other_of(4), 0);
}

TEST(Doctor, SaysTheSameOnAnyNumberOfThreads) {
  const std::vector<Take> takes = {walk(), walk({0, 3, 0, 2}), walk(), walk({0, 1, 1})};
  const std::vector<Examination> one = examine(takes, 1), two = examine(takes, 3);
  for (std::size_t i = 0; i < takes.size(); ++i) {
    ASSERT_EQ(one[i].findings.size(), two[i].findings.size());
    for (std::size_t f = 0; f < one[i].findings.size(); ++f)
      EXPECT_EQ(one[i].findings[f].text, two[i].findings[f].text);
  }
}

TEST(Doctor, MendsOnlyWhatItIsAskedTo) {
  Take damaged = walk();
  for (int f = 0; f < damaged.frames; ++f) place(damaged, f)[2] -= 0.1;
  place(damaged, 30)[0] = kNotANumber;
  std::vector<Finding> findings = findings_of(damaged);
  ASSERT_EQ(findings.size(), 2);
  EXPECT_EQ(codes_of(mend(damaged, {findings[0]})), std::vector<std::string>{"ground"});
  EXPECT_EQ(codes_of(mend(damaged, findings)), std::vector<std::string>{});
}

TEST(Doctor, SaysPlainlyWhatIsNoBody) {
  const auto expect_told = [](const Take& take, const std::string& code) {
    const std::vector<std::string> codes = codes_of(take);
    EXPECT_NE(std::find(codes.begin(), codes.end(), code), codes.end()) << code;
    mend(take, findings_of(take));
  };
  expect_told(picked(walk(), {0}), "short");
  Skeleton bone;
  bone.names = {"bone"}, bone.parents = {-1}, bone.rest_rotations = {Quaternion::Identity()};
  bone.offsets = {Vector3::Zero()}, bone.tips = {Vector3::UnitZ()};
  const Take one_bone{make_skeleton(bone), "bone", 30, 2, std::vector<double>(6, 0), {1, 0, 0, 0, 1, 0, 0, 0}};
  expect_told(one_bone, "body");
  expect_told(with_basis(walk(), Eigen::Matrix3d::Zero(), 0), "size");
  for (const char* limb : {"thigh", "upper_arm"}) {
    Take renamed = walk();
    Skeleton& skeleton = renamed.skeleton;
    skeleton.roles = {};
    std::vector<int> kept;
    for (int b = 0; b < skeleton.size(); ++b) {
      bool is_limb = false;
      for (int a = b; a >= 0; a = skeleton.parents[a]) is_limb = is_limb || skeleton.names[a].rfind(limb, 0) == 0;
      if (!is_limb) kept.push_back(b);
    }
    Take less{{}, "less", 30, 1, {}, {}};
    for (const int b : kept) {
      less.skeleton.names.push_back(skeleton.names[b]);
      const auto parent = std::find(kept.begin(), kept.end(), skeleton.parents[b]);
      less.skeleton.parents.push_back(parent == kept.end() ? -1 : static_cast<int>(parent - kept.begin()));
      less.skeleton.rest_rotations.push_back(Quaternion::Identity());
      less.skeleton.offsets.push_back(skeleton.offsets[b]);
      less.skeleton.tips.push_back(skeleton.tips[b]);
      less.translations.insert(less.translations.end(), skeleton.offsets[b].data(), skeleton.offsets[b].data() + 3);
      less.rotations.insert(less.rotations.end(), {1, 0, 0, 0});
    }
    less.skeleton = make_skeleton(less.skeleton);
    expect_told(less, "body");
  }
}

}  // namespace
}  // namespace fragmotion
