// SPDX-License-Identifier: MIT
#include "motion/soles.hpp"

#include <algorithm>
#include <limits>

#include "motion/contacts.hpp"
#include "skeleton/two_bone_ik.hpp"

namespace fragmotion {
namespace {

constexpr double kThick = 0.1;  // m of a character of 1.8 m, at most from the joints of a foot to its sole

// The joints of a foot, each seen from the bone that it moves with.
struct Joint {
  int bone = -1;
  Vector3 place = Vector3::Zero();
};

std::vector<Joint> joints_of(const Skeleton& skeleton, const LegRoles& leg) {
  const auto [thigh, foot, toe] = leg;
  if (ends_without_foot(skeleton, leg)) return {{foot, skeleton.tips[foot]}};
  if (toe < 0) return {{foot, Vector3::Zero()}, {foot, skeleton.tips[foot]}};
  return {{foot, Vector3::Zero()}, {toe, Vector3::Zero()}, {toe, skeleton.tips[toe]}};
}

// Where the soles of a clip's feet are: what is under the joints, on the ground, when the foot stands flattest.
class Soles {
 public:
  Soles(const Kinematics& kinematics, const Clip& clip) : kinematics_(kinematics), clip_(clip) {
    std::vector<int> ends;
    for (const LegRoles& leg : legs_with_feet(kinematics.skeleton().roles)) {
      feet_.push_back(joints_of(kinematics.skeleton(), leg));
      ankles_.push_back(feet_.back().front());
      ends.insert(ends.end(), {leg.foot, leg.toe});
    }
    bones_ = kinematics.chains(ends);
  }

  std::vector<SolePath> find() {
    std::vector<int> flattest(feet_.size(), 0);
    std::vector<double> lowest(feet_.size(), std::numeric_limits<double>::infinity());
    visit([&](int f, const PosedBones& posed) {
      for (std::size_t side = 0; side < feet_.size(); ++side) {
        const double height = at(posed, feet_[side].front()).z() + at(posed, feet_[side][feet_[side].size() > 1]).z();
        if (height < lowest[side]) lowest[side] = height, flattest[side] = f;
      }
    });
    visit([&](int f, const PosedBones& posed) {
      for (std::size_t side = 0; side < feet_.size(); ++side) {
        if (f == flattest[side]) drop(posed, feet_[side]);
      }
    });
    return follow();
  }

 private:
  template <typename Visitor>
  void visit(Visitor visitor) const {
    PosedBones posed(kinematics_.bones());
    for (int f = 0; f < clip_.frames; ++f) {
      world(kinematics_, clip_, f, bones_, posed.heads.data(), posed.rotations.data());
      visitor(f, posed);
    }
  }

  static Vector3 at(const PosedBones& posed, const Joint& joint) {
    return posed.heads[joint.bone] + posed.rotations[joint.bone] * joint.place;
  }

  // To the ground, which is at height 0 where that may be under the joints, else as high as the lowest of them.
  void drop(const PosedBones& posed, std::vector<Joint>& joints) const {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Joint& joint : joints) lowest = std::min(lowest, at(posed, joint).z());
    const bool is_over = lowest >= 0 && lowest * standard_scale(kinematics_.skeleton()) <= kThick;
    for (Joint& joint : joints) {
      Vector3 under = at(posed, joint);
      under.z() = is_over ? 0 : lowest;
      joint.place = posed.rotations[joint.bone].conjugate() * (under - posed.heads[joint.bone]);
    }
  }

  std::vector<SolePath> follow() const {
    std::vector<SolePath> soles(feet_.size());
    for (std::size_t side = 0; side < feet_.size(); ++side) soles[side].points.resize(feet_[side].size());
    visit([&](int, const PosedBones& posed) {
      for (std::size_t side = 0; side < feet_.size(); ++side) {
        soles[side].ankle.push_back(at(posed, ankles_[side]));
        for (std::size_t i = 0; i < feet_[side].size(); ++i)
          soles[side].points[i].path.push_back(at(posed, feet_[side][i]));
      }
    });
    for (SolePath& sole : soles) {
      for (SolePoint& point : sole.points) point.lowest = floor_of(point.path);
    }
    return soles;
  }

  const Kinematics& kinematics_;
  const Clip& clip_;
  std::vector<std::vector<Joint>> feet_;
  std::vector<Joint> ankles_;
  std::vector<int> bones_;
};

}  // namespace

std::vector<SolePath> find_soles(const Kinematics& kinematics, const Clip& clip) {
  return Soles(kinematics, clip).find();
}

}  // namespace fragmotion
