// SPDX-License-Identifier: MIT
// On legs that no names tell, nor the shape of a man or of an animal with knees and feet.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "add_bone.hpp"
#include "skeleton/role_map.hpp"
#include "skeleton/roles.hpp"

namespace fragmotion {
namespace {

// A trunk, named as no part of a body is, whose limbs are pairs of equal bones.
class Limbed {
 public:
  explicit Limbed(const std::string& trunk = "t0") { add(trunk, -1, {0, 0, 1}, {0, 0, 0.5}); }

  // From the trunk, m: where it begins on the left, and its bones.
  Limbed& limb(const std::string& name, const Vector3& begin, const std::vector<Vector3>& bones) {
    for (const double side : {1.0, -1.0}) {
      const auto at = [&](Vector3 v) { return Vector3{v.x() * side, v.y(), v.z()}; };
      int above = 0;
      for (std::size_t i = 0; i < bones.size(); ++i) {
        const std::string label = name + (side > 0 ? "p" : "q") + std::to_string(i);
        above = add(label, above, at(i == 0 ? begin : bones[i - 1]), at(bones[i]));
      }
    }
    return *this;
  }

  int add(const std::string& name, int parent, const Vector3& offset, const Vector3& tip) {
    return add_bone(skeleton_, name, parent, offset, tip);
  }

  std::string told(int Roles::*role) const {
    const int bone = make_skeleton(skeleton_).roles.*role;
    return bone < 0 ? "" : skeleton_.names[bone];
  }

  RoleMap map() const { return find_role_map(skeleton_); }

 private:
  Skeleton skeleton_;
};

const std::vector<Vector3> kLeg = {{0, 0, -0.5}, {0, 0, -0.5}};

TEST(StandingLegs, AreTwoBonesLongEach) {
  Limbed man;
  man.limb("a", {0.1, 0, 0}, kLeg).limb("b", {0.2, 0, 0.5}, {{0, 0, -0.3}, {0, 0, -0.3}});
  EXPECT_EQ(man.told(&Roles::hips), "t0");
  EXPECT_EQ(man.told(&Roles::left_thigh), "ap0");
  EXPECT_EQ(man.told(&Roles::left_foot), "ap1");
  EXPECT_EQ(man.told(&Roles::right_foot), "aq1");
  EXPECT_EQ(man.told(&Roles::left_fore_foot), "");
}

TEST(StandingLegs, AreNoArmsThatHangToTheGround) {
  Limbed ape;
  ape.limb("a", {0.4, 0, 1}, {{0, 0, -1}, {0, 0, -1}}).limb("b", {0.1, 0, 0}, kLeg);
  EXPECT_EQ(ape.told(&Roles::left_foot), "bp1");
  EXPECT_EQ(ape.told(&Roles::left_fore_foot), "");
}

TEST(StandingLegs, AreNoArmsOverABodyWithoutLegs) {
  Limbed bust;
  bust.limb("a", {0.2, 0, 0.5}, {{0.3, 0, -0.1}, {0.3, 0, -0.1}});
  bust.add("t1", 0, {0, 0, 0.1}, {0, 0, 0.2});
  EXPECT_EQ(bust.told(&Roles::left_foot), "");
}

TEST(StandingLegs, AreNoneOnWhatIsNoPartOfABody) {
  Limbed face("jaw");  // as a face's bones that hang on nothing else
  face.limb("lip", {0.02, 0, 0}, kLeg);
  EXPECT_EQ(face.told(&Roles::left_foot), "");
}

TEST(StandingLegs, AreFourOfWhatStandsOnFourAndFacesTheFront) {
  Limbed table;
  table.limb("a", {0.2, -0.5, 0}, kLeg).limb("b", {0.2, 0.5, 0}, kLeg);
  EXPECT_EQ(table.told(&Roles::left_fore_foot), "ap1");
  EXPECT_EQ(table.told(&Roles::left_foot), "bp1");
}

TEST(StandingLegs, AreTheForeOnesNearTheHead) {
  Limbed beast;
  beast.limb("a", {0.2, -0.5, 0}, kLeg).limb("b", {0.2, 0.5, 0}, kLeg);
  beast.add("head", 0, {0, 0.9, 0}, {0, 0.2, 0});
  EXPECT_EQ(beast.told(&Roles::left_fore_foot), "bq1") << "its left is on the other side";
  EXPECT_EQ(beast.told(&Roles::left_thigh), "aq0");
}

TEST(StandingLegs, AreTheMiddleOnesOfASpider) {
  Limbed spider;
  const std::vector<Vector3> leg = {{0.6, 0, 0.4}, {0.5, 0, -0.2}, {0.4, 0, -0.7}, {0.4, 0, 0}};
  for (int pair = 0; pair < 4; ++pair) spider.limb(std::string(1, 'a' + pair), {0.2, 0.2 * pair - 0.3, -0.5}, leg);
  EXPECT_EQ(spider.told(&Roles::left_thigh), "bp0");
  EXPECT_EQ(spider.told(&Roles::left_foot), "bp3");
  EXPECT_EQ(spider.told(&Roles::left_fore_foot), "");
}

TEST(StandingLegs, AreNoFinsNorWhatLeadsUp) {
  Limbed fish;
  fish.limb("a", {0.1, 0, 0}, {{0.3, 0, -0.2}}).limb("b", {0.1, 0.5, 0}, {{0.2, 0, 0.2}, {0.2, 0, 0.2}});
  EXPECT_EQ(fish.told(&Roles::left_foot), "");
}

TEST(StandingLegs, AreAGuessThatNoRetargetingIsBuiltOn) {
  Limbed man;
  man.limb("a", {0.1, 0, 0}, kLeg);
  EXPECT_NE(man.told(&Roles::left_foot), "");
  EXPECT_EQ(man.map().bone(Role::kThigh, Side::kLeft), -1);
}

}  // namespace
}  // namespace fragmotion
