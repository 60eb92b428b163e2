// SPDX-License-Identifier: MIT
// Skeletons of research often end at the neck or the chest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "examined_walks.hpp"

namespace fragmotion {
namespace {

// Without all bones of these names, which have no others below them.
Take without(Take take, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    Skeleton& skeleton = take.skeleton;
    const auto bone = std::find(skeleton.names.begin(), skeleton.names.end(), name) - skeleton.names.begin();
    const auto erase = [&](auto& values, int width) {
      for (int f = take.frames - 1; f >= 0; --f) {
        const auto at = values.begin() + (static_cast<std::ptrdiff_t>(f) * skeleton.size() + bone) * width;
        values.erase(at, at + width);
      }
    };
    erase(take.translations, 3);
    erase(take.rotations, 4);
    for (int& parent : skeleton.parents) parent -= parent > bone ? 1 : 0;
    const auto erase_bone = [&](auto& values) { values.erase(values.begin() + bone); };
    erase_bone(skeleton.names), erase_bone(skeleton.parents), erase_bone(skeleton.rest_rotations);
    erase_bone(skeleton.offsets), erase_bone(skeleton.tips);
  }
  take.skeleton.roles = {};
  take.skeleton = make_skeleton(take.skeleton);
  return take;
}

TEST(Headless, SizeAndUpAreToldAndPutRight) {
  const Take clean = without(walk(), {"head"});
  EXPECT_EQ(codes_of(clean), std::vector<std::string>{});
  EXPECT_EQ(examine({clean}, 1)[0].up, "+Z");
  for (const double unit : {0.01, 100.0})
    expect_mended(with_basis(clean, Eigen::Matrix3d::Identity(), unit), "unit", 0, clean.frames - 1, clean, 1e-9);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(kPi / 2, Vector3::UnitX()).toRotationMatrix().array().round();
  const Take lying = with_basis(clean, turn);
  EXPECT_EQ(codes_of(lying).at(0), "up");
  expect_near(mend(lying, findings_of(lying)), clean, 1e-9);
}

}  // namespace
}  // namespace fragmotion
