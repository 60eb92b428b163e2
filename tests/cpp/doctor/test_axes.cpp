// SPDX-License-Identifier: MIT
// The unit and the axes of a take's file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "examined_walks.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion {
namespace {

TEST(Doctor, PutsRightAnyUnit) {
  const Take clean = walk();
  for (const double unit : {100.0, 0.01, 1000.0, 0.1, 0.001, 1 / 0.0254, 0.45 / 0.0254}) {
    Take damaged = with_basis(clean, Eigen::Matrix3d::Identity(), unit);
    expect_mended(damaged, "unit", 0, clean.frames - 1, clean, 1e-9);
    EXPECT_NEAR(examine({damaged}, 1)[0].scale, 1 / unit, 1e-9 / unit);
  }
}

TEST(Doctor, KnowsTheUnitOfTheFile) {
  Take inches = with_basis(walk(), Eigen::Matrix3d::Identity(), 0.01 / 0.0254);
  inches.unit = 0.01;
  const Finding finding = findings_of(inches).at(0);
  EXPECT_NE(finding.text.find("inches"), std::string::npos) << finding.text;
  EXPECT_NEAR(mend(inches, {finding}).unit, 0.0254, 1e-12);
}

TEST(Doctor, TurnsUpWhateverAxisWasTaken) {
  const Take clean = walk();
  for (const auto& [x, y] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {2, 0}}) {
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(x * kPi / 2, Vector3::UnitX()) * Eigen::AngleAxisd(y * kPi / 2, Vector3::UnitY()))
            .toRotationMatrix()
            .array()
            .round();
    const Take damaged = with_basis(clean, turn);
    const std::vector<Finding> findings = findings_of(damaged);
    ASSERT_FALSE(findings.empty());
    EXPECT_EQ(findings[0].code, "up");
    EXPECT_TRUE(findings[0].safe);
    const Take mended = mend(damaged, findings);
    EXPECT_EQ(codes_of(mended), std::vector<std::string>{});
    expect_near(mended, clean, 1e-9);
  }
}

TEST(Doctor, DoesNotRaiseUnaskedWhoMayLie) {
  Gait gait;
  gait.y = 0, gait.turn = 0.2;
  Take take = walk(gait);
  for (int f = 0; f < take.frames; ++f) {
    double* hips = rotation(take, f, "hips");
    store_quaternion(Quaternion(Eigen::AngleAxisd(kPi / 2, Vector3::UnitX())) * load_quaternion(hips), hips);
  }
  const Finding finding = findings_of(take).at(0);
  EXPECT_EQ(finding.code, "up");
  EXPECT_TRUE(finding.mendable);
  EXPECT_FALSE(finding.safe);
}

TEST(Doctor, RaisesWhoStandsOnTheGroundOfItsFileAndRestsUpright) {
  Gait gait;
  gait.y = 0, gait.turn = 0.2;
  Take take = walk(gait);
  const Quaternion over(Eigen::AngleAxisd(kPi / 2, Vector3::UnitX()));
  for (int f = 0; f < take.frames; ++f) {
    double *hips = rotation(take, f, "hips"), *at = place(take, f);
    store_quaternion(over * load_quaternion(hips), hips);
    Eigen::Map<Vector3>{at} = over * load_vector(at);
  }
  const Finding finding = findings_of(take).at(0);
  EXPECT_EQ(finding.code, "up");
  EXPECT_TRUE(finding.safe) << finding.text;
}

TEST(Doctor, TellsHipsOfWhichTheFileHasNoHeight) {
  Take take = walk();
  for (int f = 0; f < take.frames; ++f) {
    const double bent = 0.5 * (1 - std::cos(2 * kPi * f / take.frames));
    for (const char* side : {".L", ".R"}) {
      for (const auto& [bone, angle] : {std::pair{"thigh", -bent}, {"shin", 2 * bent}, {"foot", -bent}}) {
        store_quaternion(Quaternion(Eigen::AngleAxisd(angle, Vector3::UnitX())),
                         rotation(take, f, bone + std::string(side)));
      }
    }
    place(take, f)[2] = place(take, 0)[2];
  }
  const std::vector<std::string> codes = codes_of(take), as_before = codes_of(walk());
  EXPECT_EQ(std::count(codes.begin(), codes.end(), "height"), 1);
  EXPECT_EQ(std::count(as_before.begin(), as_before.end(), "height"), 0);
}

TEST(Doctor, TurnsToTheFront) {
  const Take clean = walk();
  for (const int quarters : {1, 2, 3}) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(quarters * kPi / 2, Vector3::UnitZ()).toRotationMatrix().array().round();
    expect_mended(with_basis(clean, turn), "facing", 0, clean.frames - 1, clean);
  }
}

TEST(Doctor, MirrorsBackWhatALeftHandedFileMirrors) {
  const Take clean = walk({0.3, 1.2, 0.5});
  for (const Vector3& axis : {Vector3{-1, 1, 1}, Vector3{1, -1, 1}}) {
    const Take damaged = with_basis(clean, axis.asDiagonal());
    const std::vector<Finding> findings = findings_of(damaged);
    ASSERT_FALSE(findings.empty());
    EXPECT_EQ(findings[0].code, "mirrored");
    const Take mended = mend(damaged, findings);
    EXPECT_EQ(codes_of(mended), std::vector<std::string>{});
    expect_near(mended, clean, 1e-9);
  }
}

// As skeletons of research that end at the neck or the chest: without all bones of these names, which have no others
// below them.
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

TEST(Doctor, TellsUnitAndUpOfABodyWithoutAHead) {
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
