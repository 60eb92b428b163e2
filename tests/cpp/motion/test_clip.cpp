// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "motion/clip.hpp"
#include "skeleton/kinematics.hpp"
#include "skeleton/roles.hpp"
#include "small_skeleton.hpp"

namespace fragmotion {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void expect_error(const std::function<void()>& call, const std::vector<std::string>& parts) {
  try {
    call();
    ADD_FAILURE() << "accepted";
  } catch (const std::invalid_argument& error) {
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << " in: " << error.what();
  }
}

Quaternion rotation(const Clip& clip, int bones, int frame, int bone) {
  return load_quaternion(&clip.rotations[4 * (frame * bones + bone)]);
}

TEST(MakeClip, MakesRotationsUnitAndContinuous) {
  const Skeleton skeleton = small_skeleton();
  Clip raw = random_clip(skeleton, 20, 5);
  for (std::size_t i = 0; i < raw.rotations.size(); ++i) raw.rotations[i] *= i / 4 % 3 == 0 ? -2.5 : 0.3;
  const Clip clip = make_clip(skeleton, raw);
  for (int b = skeleton.roles.hips; b < skeleton.size(); ++b) {
    for (int f = 0; f < clip.frames; ++f) {
      const Quaternion q = rotation(clip, skeleton.size(), f, b);
      EXPECT_NEAR(q.norm(), 1, 1e-14);
      EXPECT_LT(q.angularDistance(rotation(raw, skeleton.size(), f, b).normalized()), 1e-12);
      if (f > 0) {
        EXPECT_GE(q.dot(rotation(clip, skeleton.size(), f - 1, b)), 0);
      }
    }
  }
  EXPECT_EQ(clip.root_positions, raw.root_positions);
}

TEST(MakeClip, RestsTheBonesOutsideTheTreeOfTheHips) {
  Skeleton skeleton = small_skeleton();
  skeleton.rest_rotations[1] = Quaternion{Eigen::AngleAxisd(0.5, Vector3::UnitX())};
  Clip raw = random_clip(skeleton, 3, 6);
  raw.rotations[4] = kNan;  // ignored
  const Clip clip = make_clip(skeleton, raw);
  for (int f = 0; f < 3; ++f) {
    EXPECT_EQ(rotation(clip, skeleton.size(), f, 0).coeffs(), skeleton.rest_rotations[0].coeffs());
    EXPECT_EQ(rotation(clip, skeleton.size(), f, 1).coeffs(), skeleton.rest_rotations[1].coeffs());
  }
}

TEST(MakeClip, FindsHeadingsWhereNoneAreGiven) {
  const Skeleton skeleton = small_skeleton();
  Clip clip = random_clip(skeleton, 4, 9);
  EXPECT_EQ(make_clip(skeleton, clip).headings.size(), 4u);
  clip.headings = {1, 2, 3, 4};
  EXPECT_EQ(make_clip(skeleton, clip).headings, clip.headings);
}

TEST(MakeClip, LeavesItsOwnResultAlone) {
  const Skeleton skeleton = small_skeleton();
  const Clip once = make_clip(skeleton, random_clip(skeleton, 9, 7));
  const Clip twice = make_clip(skeleton, once);
  for (std::size_t i = 0; i < once.rotations.size(); ++i) EXPECT_NEAR(once.rotations[i], twice.rotations[i], 1e-15);
}

TEST(MakeClip, RefusesMalformedClipsNamingThePlace) {
  const Skeleton skeleton = small_skeleton();
  const std::size_t spine = 4 * (2 * 8 + 7);
  const struct {
    const char* label;
    std::function<void(Clip&)> spoil;
    std::vector<std::string> named;
  } cases[] = {
      {"no rate", [](Clip& c) { c.rate = 0; }, {"'clip'", "rate"}},
      {"rate too high", [](Clip& c) { c.rate = 10001; }, {"'clip'", "10001", "to 10000"}},
      {"rate is not a number", [](Clip& c) { c.rate = kNan; }, {"'clip'", "rate"}},
      {"rate of no motion", [](Clip& c) { c.rate = 1e-300; }, {"'clip'", "rate"}},
      {"position beyond any stage",
       [](Clip& c) { c.root_positions[7] = 1e308; },
       {"'clip'", "frame 2", "'hips'", "1000 km"}},
      {"one frame", [](Clip& c) { c.frames = 1; }, {"'clip'", "1 frames"}},
      {"negative frames", [](Clip& c) { c.frames = -3; }, {"'clip'", "-3 frames"}},
      {"too few positions", [](Clip& c) { c.root_positions.pop_back(); }, {"'clip'", "root position", "11"}},
      {"too many rotations", [](Clip& c) { c.rotations.push_back(0); }, {"'clip'", "129 rotation values"}},
      {"too few headings",
       [](Clip& c) {
         c.headings = {0, 0, 0};
       },
       {"'clip'", "heading"}},
      {"heading not finite",
       [](Clip& c) {
         c.headings = {0, 0, kNan, 0};
       },
       {"'clip'", "heading"}},
      {"position not finite", [](Clip& c) { c.root_positions[7] = kNan; }, {"'clip'", "frame 2", "'hips'", "position"}},
      {"rotation not finite", [=](Clip& c) { c.rotations[spine] = INFINITY; }, {"'clip'", "frame 2", "'spine'"}},
      {"zero rotation",
       [=](Clip& c) { std::fill_n(&c.rotations[spine], 4, 0.0); },
       {"'clip'", "frame 2", "'spine'", "zero quaternion"}},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.label);
    Clip clip = random_clip(skeleton, 4, 8);
    c.spoil(clip);
    expect_error([&] { make_clip(skeleton, clip); }, c.named);
  }
}

TEST(ClipFromTake, KeepsTheHipsAndAllRotationsBelow) {
  const Skeleton skeleton = small_skeleton();
  const Take take = random_take(skeleton, 5, 9);
  const Clip clip = clip_from_take(skeleton, take);
  EXPECT_EQ(clip.name, "take");
  EXPECT_EQ(clip.rate, 60);
  std::vector<double> positions, rotations;
  world_transforms(take, positions, rotations);
  std::vector<Vector3> heads(8);
  std::vector<Quaternion> orientations(8);
  for (int f = 0; f < take.frames; ++f) {
    const Vector3 root = load_vector(&clip.root_positions[3 * f]);
    Kinematics(skeleton).world(root, &clip.rotations[32 * f], heads.data(), orientations.data());
    EXPECT_LT((root - load_vector(&positions[3 * (8 * f + 2)])).norm(), 1e-12);
    for (int b = 2; b < 8; ++b)
      EXPECT_LT(orientations[b].angularDistance(load_quaternion(&rotations[4 * (8 * f + b)])), 1e-12);
  }
}

TEST(ClipFromTake, PlacesEveryHeadWhereTheTakeDoesNotWander) {
  const Skeleton skeleton = small_skeleton();
  const Take take = random_take(skeleton, 5, 10, 0);
  const Clip clip = clip_from_take(skeleton, take);
  std::vector<double> positions, rotations;
  world_transforms(take, positions, rotations);
  std::vector<Vector3> heads(8);
  std::vector<Quaternion> orientations(8);
  for (int f = 0; f < take.frames; ++f) {
    Kinematics(skeleton).world(load_vector(&clip.root_positions[3 * f]), &clip.rotations[32 * f], heads.data(),
                               orientations.data());
    for (int b = 2; b < 8; ++b) EXPECT_LT((heads[b] - load_vector(&positions[3 * (8 * f + b)])).norm(), 1e-12);
  }
}

TEST(ClipFromTake, MatchesBonesByName) {
  const Skeleton skeleton = small_skeleton();
  const Take take = random_take(skeleton, 3, 11);
  Skeleton legs;  // without root, prop and spine, and right before left
  legs.names = {"hips", "thigh.R", "foot.R", "thigh.L", "foot.L"};
  legs.parents = {-1, 0, 1, 0, 3};
  legs.rest_rotations.assign(5, Quaternion::Identity());
  legs.offsets.assign(5, Vector3(0, 0, 0.1));
  legs.tips.assign(5, Vector3(0, 0, 0.1));
  legs = make_skeleton(legs);
  const Clip all = clip_from_take(skeleton, take), some = clip_from_take(legs, take);
  EXPECT_EQ(some.root_positions, all.root_positions);
  for (int f = 0; f < 3; ++f) {
    for (int b = 0; b < 5; ++b)
      EXPECT_EQ(rotation(some, 5, f, b).coeffs(), rotation(all, 8, f, skeleton.find(legs.names[b])).coeffs());
  }
}

TEST(ClipFromTake, NamesTheBoneThatDoesNotFit) {
  const Skeleton skeleton = small_skeleton();
  const struct {
    const char* label;
    std::function<void(Skeleton&)> change;
    std::vector<std::string> named;
  } cases[] = {
      {"missing", [](Skeleton& s) { s.names[7] = "torso"; }, {"'take'", "'torso'"}},
      {"other parent", [](Skeleton& s) { s.parents[7] = 3; }, {"'spine'", "'thigh.L'"}},
      {"other rest",
       [](Skeleton& s) {
         s.rest_rotations[5] = {0, 1, 0, 0};
       },
       {"'thigh.R'", "rotation"}},
      {"other rest above",
       [](Skeleton& s) {
         s.rest_rotations[0] = {0, 1, 0, 0};
       },
       {"'hips'", "rotation"}},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.label);
    Skeleton changed = skeleton;
    c.change(changed);
    expect_error([&] { clip_from_take(changed, random_take(skeleton, 2, 1)); }, c.named);
  }
}

}  // namespace
}  // namespace fragmotion
