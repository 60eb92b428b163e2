// SPDX-License-Identifier: MIT
// What the doctor says of bodies on four legs.
#include <gtest/gtest.h>

#include "examined_walks.hpp"
#include "lying_dog.hpp"
#include "motion/told_by_motion.hpp"

namespace fragmotion {
namespace {

Take told(Take take) {
  tell_four_legs({&take});
  return take;
}

Take lying_walk() { return told(lying_dog_take(dog_clip({}, false, "walk"))); }

TEST(FourLeggedPatient, IsWellWhereItsTakeIs) {
  for (const double speed : {0.0, 1.2, 3.0}) {
    Gait gait;
    gait.rate = 60;
    gait.y = speed;
    const Clip clip = dog_clip(gait, speed > 2, "gait");
    const std::vector<std::string> still(speed == 0 ? 1 : 0, "frozen");
    EXPECT_EQ(codes_of(take_from_clip(dog(), clip)), still) << speed;
    EXPECT_EQ(codes_of(told(lying_dog_take(clip))), still) << speed << ", lying at rest";
  }
}

TEST(FourLeggedPatient, HasTheUnitOfAnAnimal) {
  const Take clean = lying_walk();
  Take metres = with_basis(clean, Eigen::Matrix3d::Identity(), 0.01);
  metres.unit = 0.01;
  const std::vector<Finding> findings = findings_of(metres);
  ASSERT_EQ(codes_of(metres), std::vector<std::string>{"unit"});
  EXPECT_NE(findings[0].text.find("metres (a unit of 1 m)"), std::string::npos) << findings[0].text;
  EXPECT_TRUE(findings[0].safe);
  const Take mended = mend(metres, findings);
  EXPECT_NEAR(stature(mended.skeleton), stature(clean.skeleton), 1e-9);
  EXPECT_EQ(mended.unit, 1);
  EXPECT_EQ(mended.skeleton.roles.left_fore_foot, clean.skeleton.roles.left_fore_foot);
  EXPECT_EQ(codes_of(mended), std::vector<std::string>{});
}

// Games' animals are of any size.
TEST(FourLeggedPatient, MayBeLargerAndSmallerThanLife) {
  for (const double times : {0.1, 0.3, 4.0, 8.0})
    EXPECT_EQ(codes_of(with_basis(lying_walk(), Eigen::Matrix3d::Identity(), times)), std::vector<std::string>{})
        << times;
}

TEST(FourLeggedPatient, OfNoAnimalsSizeIsToldSo) {
  const Take speck = with_basis(lying_walk(), Eigen::Matrix3d::Identity(), 1e-9);
  const std::vector<Finding> findings = findings_of(speck);
  ASSERT_EQ(codes_of(speck), std::vector<std::string>{"size"});
  EXPECT_NE(findings[0].text.find("four legs"), std::string::npos) << findings[0].text;
}

TEST(FourLeggedPatient, IsTurnedUp) {
  const Eigen::Matrix3d on_its_nose = Eigen::AngleAxisd(kPi / 2, Vector3::UnitX()).toRotationMatrix().array().round();
  const Take fallen = told(with_basis(lying_dog_take(dog_clip({}, false, "walk")), on_its_nose));
  const std::vector<Finding> findings = findings_of(fallen);
  ASSERT_EQ(codes_of(fallen), std::vector<std::string>{"up"});
  EXPECT_TRUE(findings[0].safe);
  EXPECT_EQ(codes_of(mend(fallen, findings)), std::vector<std::string>{});
}

TEST(FourLeggedPatient, StandsOnTheGroundWithAllItsFeet) {
  Take high = lying_walk();
  for (int f = 0; f < high.frames; ++f) place(high, f)[2] += 0.5;
  EXPECT_EQ(codes_of(high), std::vector<std::string>{"ground"});
}

// Hind feet are aloft for as long as it stands on the others: that is no flight.
TEST(FourLeggedPatient, FallsOnlyWhereAllFeetAreAloft) {
  Take kicks = lying_walk();
  for (int f = 0; f < kicks.frames; ++f) {
    for (const char* thigh : {"LeftUpLeg", "RightUpLeg"}) {
      const double t = 6 * (f / kicks.rate - std::floor(f / kicks.rate)) - 3, lift = std::max(0.0, 1 - t * t / 9);
      double* turn = rotation(kicks, f, thigh);
      store_quaternion(load_quaternion(turn) * Quaternion(Eigen::AngleAxisd(lift, Vector3::UnitY())), turn);
    }
  }
  for (const std::string& code : codes_of(kicks)) EXPECT_NE(code, "rate");
}

}  // namespace
}  // namespace fragmotion
