// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "fragments/packed_pool.hpp"
#include "io/bvh.hpp"
#include "mocap_files.hpp"
#include "motion/pack_clip.hpp"
#include "motion/pose.hpp"
#include "rolled_humanoid.hpp"
#include "runtime/inertialization.hpp"
#include "skeleton/roles.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

// The largest differences between the frames of two clips.
struct Differences {
  double joint = 0;  // rad, in the parent and in the world
  double tip = 0;    // m
  double heading = 0;

  void add(const Kinematics& kinematics, const Clip& a, const Clip& b) {
    const int bones = kinematics.bones();
    std::vector<Vector3> heads_a(bones), heads_b(bones);
    std::vector<Quaternion> worlds_a(bones), worlds_b(bones);
    for (int f = 0; f < a.frames; ++f) {
      world(kinematics, a, f, heads_a.data(), worlds_a.data());
      world(kinematics, b, f, heads_b.data(), worlds_b.data());
      heading = std::max(heading, std::abs(a.headings[f] - b.headings[f]));
      for (int i = 0; i < bones; ++i) {
        if (!kinematics.skeleton().is_below(i, kinematics.skeleton().roles.hips)) continue;
        const std::size_t at = 4 * (static_cast<std::size_t>(f) * bones + i);
        const Quaternion local_a = load_quaternion(&a.rotations[at]), local_b = load_quaternion(&b.rotations[at]);
        joint = std::max({joint, local_a.angularDistance(local_b), worlds_a[i].angularDistance(worlds_b[i])});
        const Vector3& offset = kinematics.skeleton().tips[i];
        tip = std::max(tip, (heads_a[i] + worlds_a[i] * offset - heads_b[i] - worlds_b[i] * offset).norm());
      }
    }
  }
};

void expect_small(const Differences& d, double scale = 1) {
  EXPECT_LT(d.joint, 0.1 * kPi / 180);
  EXPECT_LT(d.tip * scale, 1e-3);
  EXPECT_LT(d.heading, 1e-3);
}

std::size_t bytes_of(const PackedClip& clip) {
  return clip.mirrored ? 0 : clip.poses->bytes.size() + 5 * clip.poses->least.size() + 64;
}

// What the poses of a clip take in single precision.
std::size_t single_bytes(const Clip& clip) { return 4 * (clip.root_positions.size() + clip.rotations.size()); }

Quaternion any_rotation(Random& random) {
  const auto value = [&] { return 2 * random.uniform() - 1; };
  return Quaternion(value(), value(), value(), value()).normalized();
}

// Bones of any length that hang on each other anyhow, some of them above the hips.
Skeleton any_skeleton(Random& random) {
  Skeleton s;
  const auto vector = [&](double size) {
    return Vector3(size * (random.uniform() - 0.5), size * (random.uniform() - 0.5), size * (random.uniform() - 0.5));
  };
  const int bones = 2 + random.below(30);
  for (int b = 0; b < bones; ++b) {
    s.names.push_back("bone" + std::to_string(b));
    s.parents.push_back(b == 0 ? -1 : b < 3 ? b - 1 : 1 + random.below(b - 1));
    s.rest_rotations.push_back(any_rotation(random));
    s.offsets.push_back(vector(std::pow(10, random.uniform() - 1)));
    s.tips.push_back(vector(0.5));
  }
  s.roles.hips = random.below(2);
  return make_skeleton(s);
}

// Motion without any bounds or continuity.
Clip any_clip(const Skeleton& skeleton, Random& random) {
  Clip clip{"any", 30, 2 + random.below(40), {}, {}, {}};
  for (int f = 0; f < clip.frames; ++f) {
    for (int axis = 0; axis < 3; ++axis) clip.root_positions.push_back(20 * random.uniform() - 10);
    for (int b = 0; b < skeleton.size(); ++b) {
      clip.rotations.resize(clip.rotations.size() + 4);
      store_quaternion(any_rotation(random), &clip.rotations[clip.rotations.size() - 4]);
    }
  }
  return make_clip(skeleton, clip);
}

TEST(PackedClip, KeepsAnyMotionOfAnySkeleton) {
  Random random(1);
  for (int n = 0; n < 200; ++n) {
    const Skeleton skeleton = any_skeleton(random);
    const Clip clip = any_clip(skeleton, random);
    const auto grid = std::make_shared<const PoseGrid>(pose_grid(skeleton, {clip}));
    Differences differences;
    const PackedClip packed = pack(skeleton, grid, clip);
    EXPECT_NO_THROW(check(packed));
    EXPECT_NO_THROW(check(*grid, skeleton));
    differences.add(Kinematics(skeleton), clip, unpack(packed));
    expect_small(differences, standard_scale(skeleton));
  }
}

TEST(PackedClip, KeepsFarPlacesAndLongWays) {
  Clip clip = tiny_clip(1.5);
  for (double& value : clip.root_positions) value += 1e5;
  clip.root_positions[4] += 1e6;
  const auto grid = std::make_shared<const PoseGrid>(pose_grid(tiny_skeleton(), {clip}));
  const Clip back = unpack(pack(tiny_skeleton(), grid, clip));
  for (std::size_t i = 0; i < clip.root_positions.size(); ++i)
    EXPECT_NEAR(back.root_positions[i], clip.root_positions[i], i % 3 == 1 ? 0.05 : 1e-4);
}

TEST(PackedClip, ShowsBetweenFramesWhatTheClipShows) {
  const Skeleton skeleton = humanoid();
  const FragmentPool pool = gait_pool(gait_takes());
  const PackedPool packed = pack(pool);
  std::vector<double> rotations(std::size_t{4} * skeleton.size()), expected = rotations;
  Random random(2);
  for (int n = 0; n < 2000; ++n) {
    const int c = random.below(static_cast<int>(pool.clips.size()));
    const Clip& clip = pool.clips[c];
    const double at = (clip.frames + 1) * random.uniform() - 1;  // and before and beyond the clip
    const Vector3 root = sample_pose(packed.clips[c], at, rotations.data());
    EXPECT_LT((root - sample_pose(clip, at, expected.data())).norm(), 2e-4);
    EXPECT_NEAR(frame_at(packed.clips[c], at).heading, frame_at(clip, at).heading, 1e-3);
    EXPECT_LT((frame_at(packed.clips[c], at).position - frame_at(clip, at).position).norm(), 2e-4);
    for (std::size_t i = 0; i < rotations.size(); i += 4) {
      const Quaternion q = load_quaternion(&rotations[i]);
      EXPECT_NEAR(q.norm(), 1, 1e-6);
      EXPECT_LT(q.angularDistance(load_quaternion(&expected[i])), 0.15 * kPi / 180);
    }
  }
}

TEST(PackedClip, ShowsSomeBonesAsItShowsAll) {
  const Skeleton skeleton = humanoid();
  const PackedPool packed = pack(gait_pool(gait_takes()));
  std::vector<double> all(std::size_t{4} * skeleton.size());
  Random random(4);
  for (int n = 0; n < 1000; ++n) {
    const PackedClip& clip = packed.clips[random.below(static_cast<int>(packed.clips.size()))];
    const double at = n % 2 == 0 ? random.below(clip.frames) : clip.frames * random.uniform();
    const Vector3 root = sample_pose(clip, at, all.data());
    const int bones = random.below(skeleton.size() + 1);
    std::vector<double> some(all.size());
    EXPECT_EQ(sample_pose(clip, at, bones, some.data()).place, root);
    for (int i = 0; i < 4 * bones; ++i) EXPECT_EQ(some[i], all[i]);
  }
}

PackedPool with_mirror_images(const Skeleton& skeleton) {
  const Kinematics kinematics(skeleton);
  std::vector<Clip> clips = gait_takes();
  const Mirror mirror(kinematics, clips);
  std::vector<int> originals(clips.size(), -1);
  for (int c = static_cast<int>(clips.size()) - 1; c >= 0; --c) {
    clips.push_back(mirror(clips[c]));
    originals.push_back(c);
  }
  return pack({skeleton, clips, {}}, {originals, mirror.turns()});
}

TEST(UnpackedPoses, TurnTheHipsInTheWorldAndThenEachBoneByWhatIsLeft) {
  const Skeleton skeleton = humanoid();
  const int hips = skeleton.roles.hips;
  const PackedPool packed = with_mirror_images(skeleton);
  UnpackedPoses unpacked(skeleton.size());
  Random random(6);
  std::vector<double> rotations(std::size_t{4} * skeleton.size()), plain = rotations;
  for (int n = 0; n < 200; ++n) {
    const PackedClip& clip = packed.clips[random.below(static_cast<int>(packed.clips.size()))];
    const double at = clip.frames * random.uniform(), heading = 10 * random.uniform();
    WorldPose old, fresh;
    for (int b = 0; b < skeleton.size(); ++b) {
      for (WorldPose* pose : {&old, &fresh}) {
        pose->rotations.resize(rotations.size());
        store_quaternion(any_rotation(random), &pose->rotations[std::size_t{4} * b]);
      }
    }
    Inertialization stitch(skeleton.size());
    stitch.begin(old, fresh, fresh, old, 1, 0.3, &clip);
    const Fade left = stitch.left(0.2 * random.uniform());
    sample_pose(clip, at, plain.data());
    unpacked.sample(clip, at, {hips, PlaneTurn(heading / 2), stitch.turns(left)}, rotations.data());
    for (int b = 0; b < skeleton.size(); ++b) {
      Quaternion expected = load_quaternion(&plain[std::size_t{4} * b]);
      if (b == hips) expected = Eigen::AngleAxisd(heading, Vector3::UnitZ()) * expected;
      unpacked.plain(clip, b, plain.data());
      EXPECT_LT(load_quaternion(&plain[std::size_t{4} * b]).angularDistance(expected), 1e-6);
      expected = stitch.turn(clip.lane_of(b), left) * expected;
      EXPECT_LT(load_quaternion(&rotations[std::size_t{4} * b]).angularDistance(expected), 1e-6);
    }
  }
}

TEST(UnpackedPoses, ShowTheSameBitsWhateverWasAskedForBefore) {
  const Skeleton skeleton = humanoid();
  const PackedPool packed = with_mirror_images(skeleton);
  UnpackedPoses unpacked(skeleton.size());
  std::vector<double> rotations(std::size_t{4} * skeleton.size()), expected = rotations;
  Random random(5);
  double at = 0;
  for (int n = 0; n < 3000; ++n) {
    const PackedClip& clip = packed.clips[random.below(static_cast<int>(packed.clips.size()))];
    at = n % 5 == 0 ? (clip.frames + 1) * random.uniform() - 1 : at + 2 * random.uniform() - 0.9;
    if (n % 7 == 0) at = std::round(at);
    const RootPose root = unpacked.sample(clip, at, {}, rotations.data());
    EXPECT_EQ(root.place, sample_pose(clip, at, expected.data()));
    EXPECT_EQ(root.heading, frame_at(clip, at).heading);
    EXPECT_EQ(rotations, expected);
  }
}

// Of a packed clip at these times.
Clip sampled(const PackedClip& packed, const std::vector<double>& times) {
  const std::size_t width = std::size_t{4} * packed.grid->bones;
  Clip clip{packed.name, packed.rate, static_cast<int>(times.size()), {}, {}, {}};
  clip.rotations.resize(width * times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Vector3 root = sample_pose(packed, times[i], &clip.rotations[width * i]);
    clip.root_positions.insert(clip.root_positions.end(), root.begin(), root.end());
    clip.headings.push_back(frame_at(packed, times[i]).heading);
  }
  return clip;
}

TEST(PackedClip, ShowsTheMirrorImageOfAnother) {
  std::vector<double> times;
  Random random(3);
  for (int i = 0; i < 100; ++i) times.push_back(41 * random.uniform() - 1);
  for (const Skeleton& skeleton : {humanoid(), rolled_humanoid(3), small_skeleton()}) {
    const Kinematics kinematics(skeleton);
    const Clip clip = make_clip(skeleton, random_clip(skeleton, 40, 5));
    const Mirror mirror(kinematics, {clip});
    const PackedPool packed = pack({skeleton, {clip, mirror(clip)}, {}}, {{-1, 0}, mirror.turns()});
    EXPECT_EQ(packed.clips[1].poses, packed.clips[0].poses);
    EXPECT_EQ(packed.clips[1].name, "clip mirrored");
    EXPECT_NO_THROW(check(packed.clips[1]));
    EXPECT_NO_THROW(check(*packed.clips[1].grid, skeleton));
    Differences differences;
    differences.add(kinematics, sampled(packed.clips[1], times),
                    mirror(make_clip(skeleton, sampled(packed.clips[0], times))));
    EXPECT_LT(differences.joint, 2e-3);  // of single precision, near to which an angle is a square root
    EXPECT_LT(differences.tip, 1e-5);
    EXPECT_EQ(differences.heading, 0);
  }
}

TEST(PackedClip, IsTheSameForAnyNumberOfThreads) {
  const FragmentPool pool = gait_pool(gait_takes());
  const PackedPool one = pack(pool, {}, 1), three = pack(pool, {}, 3);
  for (std::size_t c = 0; c < pool.clips.size(); ++c) {
    EXPECT_EQ(one.clips[c].poses->bytes, three.clips[c].poses->bytes);
    EXPECT_EQ(one.clips[c].poses->least, three.clips[c].poses->least);
  }
}

TEST(PackedClip, KeepsAllTakesInLessThanAnEighthOfTheirSize) {
  const auto files = files_in(shared_mocap() / "bandai-namco", ".bvh");
  if (files.empty()) GTEST_SKIP() << "no motion capture beside the project";
  FragmentPool pool;
  for (const auto& file : files) {
    const Take take = read_bvh(file, 0.01);
    if (pool.clips.empty()) pool.skeleton = take.skeleton;
    pool.clips.push_back(clip_from_take(pool.skeleton, take));
  }
  const Kinematics kinematics(pool.skeleton);
  const Mirror mirror(kinematics, pool.clips);
  MirrorImages images{std::vector<int>(files.size(), -1), mirror.turns()};
  for (std::size_t c = 0; c < files.size(); ++c) {
    pool.clips.push_back(mirror(pool.clips[c]));
    images.originals.push_back(static_cast<int>(c));
  }
  const PackedPool packed = pack(pool, images);
  Differences differences;
  std::size_t before = 0, after = 0, samples = 0;
  for (std::size_t c = 0; c < pool.clips.size(); ++c) {
    differences.add(kinematics, pool.clips[c], unpack(packed.clips[c]));
    before += single_bytes(pool.clips[c]);
    after += bytes_of(packed.clips[c]);
    samples += pool.clips[c].rotations.size() / 4;
  }
  expect_small(differences, standard_scale(pool.skeleton));
  EXPECT_LT(8 * after, before);
  EXPECT_LT(differences.tip, 1e-4);
  EXPECT_LT(static_cast<double>(after), 2.0 * static_cast<double>(samples));
  std::cout << files.size() << " takes and their images, " << samples << " rotations: " << before
            << " bytes in single precision, " << after << " packed (" << static_cast<double>(after) / samples
            << " a rotation); off by at most " << differences.joint * 180 / kPi << " degrees and "
            << 1e3 * differences.tip << " mm\n";
}

}  // namespace
}  // namespace fragmotion
