// SPDX-License-Identifier: MIT
#include "peers/ozz.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "base/rates.hpp"
#include "motion/clip.hpp"
#include "motion/take.hpp"
#include "ozz/animation/offline/animation_builder.h"
#include "ozz/animation/offline/animation_optimizer.h"
#include "ozz/animation/offline/raw_animation.h"
#include "ozz/animation/offline/raw_skeleton.h"
#include "ozz/animation/offline/skeleton_builder.h"
#include "ozz/animation/runtime/animation.h"
#include "ozz/animation/runtime/blending_job.h"
#include "ozz/animation/runtime/local_to_model_job.h"
#include "ozz/animation/runtime/sampling_job.h"
#include "ozz/animation/runtime/skeleton.h"
#include "ozz/base/maths/simd_math.h"
#include "ozz/base/maths/soa_transform.h"

namespace fragmotion::benchmarks {
namespace {

namespace offline = ozz::animation::offline;

constexpr float kShare = 0.3F;     // of the second take
constexpr double kOff = 0.01;      // m: ozz's optimiser leaves out what moves no bone by 1 mm
constexpr std::size_t kTakes = 2;  // blended
constexpr double kCompared = 0.5;  // of a take: where poses are compared

ozz::math::Float3 float3(const double* v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

ozz::math::Quaternion quaternion(const double* q) {
  return {static_cast<float>(q[1]), static_cast<float>(q[2]), static_cast<float>(q[3]), static_cast<float>(q[0])};
}

offline::RawSkeleton::Joint joint_of(const Skeleton& skeleton, int bone) {
  double rest[4];
  store_quaternion(skeleton.rest_rotations[bone], rest);
  offline::RawSkeleton::Joint joint;
  joint.name = skeleton.names[bone].c_str();
  joint.transform = {float3(skeleton.offsets[bone].data()), quaternion(rest), ozz::math::Float3::one()};
  for (int child = bone + 1; child < skeleton.size(); ++child)
    if (skeleton.parents[child] == bone) joint.children.push_back(joint_of(skeleton, child));
  return joint;
}

ozz::unique_ptr<ozz::animation::Skeleton> skeleton_of(const Skeleton& skeleton) {
  offline::RawSkeleton raw;
  raw.roots.push_back(joint_of(skeleton, 0));
  return offline::SkeletonBuilder()(raw);
}

// Of each joint of ozz's, which sorts them, the bone.
std::vector<int> bones_of(const ozz::animation::Skeleton& joints, const Skeleton& skeleton) {
  std::vector<int> bones;
  for (const char* name : joints.joint_names()) bones.push_back(skeleton.find(name));
  return bones;
}

ozz::unique_ptr<ozz::animation::Animation> animation_of(const Take& take, const std::vector<int>& bones,
                                                        const ozz::animation::Skeleton& joints) {
  offline::RawAnimation raw, optimised;
  const std::size_t all = bones.size();
  raw.duration = static_cast<float>((take.frames - 1) / take.rate);
  raw.tracks.resize(all);
  for (std::size_t joint = 0; joint < all; ++joint) {
    for (int frame = 0; frame < take.frames; ++frame) {
      const std::size_t at = frame * all + bones[joint];
      const float time = std::min(static_cast<float>(frame / take.rate), raw.duration);
      raw.tracks[joint].translations.push_back({time, float3(&take.translations[3 * at])});
      raw.tracks[joint].rotations.push_back({time, quaternion(&take.rotations[4 * at])});
    }
  }
  if (!offline::AnimationOptimizer()(raw, joints, &optimised)) throw std::runtime_error("ozz takes no such take");
  return offline::AnimationBuilder()(optimised);
}

// The longest takes of a character, unpacked.
std::array<Clip, kTakes> longest(const std::vector<PackedClip>& clips) {
  std::vector<std::size_t> order(clips.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return clips[a].frames > clips[b].frames; });
  return {unpack(clips[order[0]]), unpack(clips[order[1]])};
}

class Blended {
 public:
  explicit Blended(const Character& character) : skeleton_(skeleton_of(character.pool.skeleton)) {
    const Skeleton& bones = character.pool.skeleton;
    bones_ = bones_of(*skeleton_, bones);
    const std::array<Clip, kTakes> clips = longest(character.pool.clips);
    for (std::size_t i = 0; i < kTakes; ++i) {
      animations_[i] = animation_of(take_from_clip(bones, clips[i]), bones_, *skeleton_);
      contexts_[i].Resize(skeleton_->num_joints());
      sampled_[i].resize(skeleton_->num_soa_joints());
    }
    blended_.resize(skeleton_->num_soa_joints());
    models_.resize(skeleton_->num_joints());
    compare(bones, clips[0]);
  }

  // The pose at a time of both takes, which go round and round.
  void pose(double seconds, float share) {
    ozz::animation::BlendingJob::Layer layers[kTakes];
    for (std::size_t i = 0; i < kTakes; ++i) {
      ozz::animation::SamplingJob sample;
      sample.animation = animations_[i].get();
      sample.context = &contexts_[i];
      sample.ratio = static_cast<float>(std::fmod(seconds / animations_[i]->duration(), 1.0));
      sample.output = ozz::make_span(sampled_[i]);
      require(sample.Run());
      layers[i].transform = ozz::make_span(sampled_[i]);
      layers[i].weight = i == 0 ? 1 - share : share;
    }
    ozz::animation::BlendingJob blend;
    blend.layers = layers;
    blend.rest_pose = skeleton_->joint_rest_poses();
    blend.output = ozz::make_span(blended_);
    require(blend.Run());
    ozz::animation::LocalToModelJob bring;
    bring.skeleton = skeleton_.get();
    bring.input = ozz::make_span(blended_);
    bring.output = ozz::make_span(models_);
    require(bring.Run());
  }

  const ozz::math::Float4x4* models() const { return models_.data(); }

 private:
  static void require(bool ran) {
    if (!ran) throw std::runtime_error("ozz refuses a job");
  }

  // That ozz shows what the take shows; in takes, bones above the hips rest.
  void compare(const Skeleton& skeleton, const Clip& clip) {
    const int frame = static_cast<int>(kCompared * clip.frames);
    std::vector<Vector3> heads(skeleton.size());
    std::vector<Quaternion> orientations(skeleton.size());
    world(Kinematics(skeleton), clip, frame, heads.data(), orientations.data());
    pose(frame / clip.rate, 0);
    for (std::size_t joint = 0; joint < bones_.size(); ++joint) {
      if (!skeleton.is_below(bones_[joint], skeleton.roles.hips)) continue;
      float place[4];
      ozz::math::StorePtrU(models_[joint].cols[3], place);
      const Vector3 shown(place[0], place[1], place[2]);
      if ((shown - heads[bones_[joint]]).norm() > kOff)
        throw std::runtime_error("ozz has another pose: " + skeleton.names[bones_[joint]]);
    }
  }

  ozz::unique_ptr<ozz::animation::Skeleton> skeleton_;
  std::vector<int> bones_;
  std::array<ozz::unique_ptr<ozz::animation::Animation>, kTakes> animations_;
  std::array<ozz::animation::SamplingJob::Context, kTakes> contexts_;
  std::array<ozz::vector<ozz::math::SoaTransform>, kTakes> sampled_;
  ozz::vector<ozz::math::SoaTransform> blended_;
  ozz::vector<ozz::math::Float4x4> models_;
};

void measure_ozz(benchmark::State& state, const std::shared_ptr<const Character>& character) {
  Blended blended(*character);
  double seconds = 0;
  for (auto _ : state) {
    blended.pose(seconds += kGameStep, kShare);
    benchmark::DoNotOptimize(blended.models());
    benchmark::ClobberMemory();
  }
}

}  // namespace

void register_ozz_frame(const std::string& name, const std::shared_ptr<const Character>& character) {
  benchmark::RegisterBenchmark((name + " frame, ozz").c_str(), measure_ozz, character);
}

}  // namespace fragmotion::benchmarks
