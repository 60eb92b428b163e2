// SPDX-License-Identifier: MIT
#include <algorithm>

#include "api/handles.hpp"
#include "api/transforms.hpp"

namespace fragmotion {
namespace {

constexpr int kMostRigBones = 65536;

void check_numbers(const char* what, const float* values, std::size_t count) {
  demand(std::all_of(values, values + count, [](float value) { return std::isfinite(value); }),
         FRAGMOTION_ERROR_ARGUMENT, "%s hold what is not a number", what);
}

std::unique_ptr<FragmotionRig> make_rig(const std::shared_ptr<const Hero>& hero, const FragmotionRigOptions& wanted) {
  auto rig = std::make_unique<FragmotionRig>();
  rig->hero = hero;
  for (int i = 0; i < wanted.bones; ++i) {
    demand(wanted.names[i] != nullptr, FRAGMOTION_ERROR_ARGUMENT, "the name of the rig's bone %d is null", i);
    rig->bones.push_back(hero->find_bone(wanted.names[i]));
  }
  const auto count = static_cast<std::size_t>(wanted.bones);
  if (wanted.parents != nullptr) {
    rig->parents.assign(wanted.parents, wanted.parents + count);
    for (int i = 0; i < wanted.bones; ++i) {
      const int parent = rig->parents[i], bone = rig->bones[i];
      demand(parent >= -1 && parent < i, FRAGMOTION_ERROR_ARGUMENT,
             "the parent of the rig's bone %d is %d: parents come before their children", i, parent);
      const int above = parent < 0 ? -1 : rig->bones[parent];
      if (bone >= 0 && above != hero->skeleton().parents[bone]) rig->same_parents = false;
    }
  }
  if (wanted.rest != nullptr) {
    check_numbers("the rig's rest transforms", wanted.rest->position, 7 * count);
    rig->rest.assign(wanted.rest, wanted.rest + count);
  }
  if (wanted.inverse_binds != nullptr) check_numbers("the rig's inverse binds", wanted.inverse_binds, 16 * count);
  for (std::size_t i = 0; i < count; ++i) {
    Matrix16 inverse{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    if (wanted.inverse_binds != nullptr) {
      std::copy_n(wanted.inverse_binds + 16 * i, 16, inverse.begin());
    } else if (rig->bones[i] >= 0) {
      inverse = matrix_of(fragmotion::inverse(hero->rest[rig->bones[i]]));
    }
    rig->inverse.push_back(inverse);
  }
  return rig;
}

}  // namespace
}  // namespace fragmotion

using namespace fragmotion;

FragmotionResult fragmotion_rig_create(const FragmotionCharacter* character, const FragmotionRigOptions* options,
                                       FragmotionRig** rig) noexcept {
  return call("fragmotion_rig_create", [&] {
    demand_given(rig, "the place for the rig");
    *rig = nullptr;
    demand_alive(character, Kind::character);
    demand_struct(options, "the options");
    demand_range("the number of the rig's bones", options->bones, 1, kMostRigBones);
    demand_given(options->names, "the names of the rig's bones");
    auto made = make_rig(character->hero, *options);
    list_alive(made.get(), Kind::rig);
    *rig = made.release();
  });
}

void fragmotion_rig_release(FragmotionRig* rig) noexcept {
  if (rig == nullptr) return;
  if (call("fragmotion_rig_release", [&] { demand_alive(rig, Kind::rig); }) != FRAGMOTION_OK) return;
  unlist_alive(rig);
  delete rig;
}

std::int32_t fragmotion_rig_bone(const FragmotionRig* rig, std::int32_t index) noexcept {
  std::int32_t bone = -1;
  call("fragmotion_rig_bone", [&] {
    demand_alive(rig, Kind::rig);
    demand_index("the rig's bone", index, static_cast<int>(rig->bones.size()));
    bone = rig->bones[index];
  });
  return bone;
}

FragmotionResult fragmotion_blend(const FragmotionTransform* a, const FragmotionTransform* b, float weight,
                                  const float* mask, std::int32_t count, FragmotionTransform* out) noexcept {
  return call("fragmotion_blend", [&] {
    demand_range("the number of bones", count, 0, kMostRigBones);
    if (count == 0) return;
    demand_given(a, "the first pose");
    demand_given(b, "the second pose");
    demand_given(out, "the place for the pose");
    demand_range("the weight", static_cast<double>(weight), 0, 1);
    for (int i = 0; mask != nullptr && i < count; ++i) {
      demand_range("what the mask holds", static_cast<double>(mask[i]), 0, 1);
    }
    for (int i = 0; i < count; ++i) {
      const float part = mask != nullptr ? weight * mask[i] : weight;
      const Eigen::Vector4f from(a[i].rotation), to(b[i].rotation);
      const Eigen::Vector4f mixed = (1 - part) * from + (dot(from, to) < 0 ? -part : part) * to;
      const float length = mixed.norm();
      for (int k = 0; k < 3; ++k) out[i].position[k] = (1 - part) * a[i].position[k] + part * b[i].position[k];
      for (int k = 0; k < 4; ++k) out[i].rotation[k] = length > 0 ? mixed[k] / length : from[k];
    }
  });
}
