// SPDX-License-Identifier: MIT
#include "motion/discontinuities.hpp"

#include <algorithm>
#include <cmath>

#include "motion/cycle.hpp"

namespace fragmotion {
namespace {

constexpr double kTurn = kPi / 3;  // rad, from one frame to the next
constexpr double kSpeed = 20;      // m/s

// A clip's bones, as they turn from frame to frame.
class Turns {
 public:
  Turns(const Skeleton& skeleton, const Clip& clip)
      : clip_(clip), width_(std::size_t{4} * skeleton.size()), near_(std::cos(kTurn / 2)) {}

  // By more than kTurn, and by so much otherwise than in the frames before and after: a limb that is swung fast is in
  // line with one of them.
  bool tear(int bone, int f) const {
    if (std::abs(at(bone, f).dot(at(bone, f - 1))) >= near_) return false;
    const Vector3 turn = to(bone, f);
    const bool goes_on = f > 1 && (turn - to(bone, f - 1)).norm() <= kTurn,
               goes_on_after = f + 1 < clip_.frames && (turn - to(bone, f + 1)).norm() <= kTurn;
    return !goes_on && !goes_on_after;
  }

 private:
  Quaternion at(int bone, int f) const { return load_quaternion(&clip_.rotations[width_ * f + std::size_t{4} * bone]); }

  // Rotation vector from the frame before, as the bone sees it, rad.
  Vector3 to(int bone, int f) const {
    Quaternion turn = at(bone, f - 1).conjugate() * at(bone, f);
    if (turn.w() < 0) turn.coeffs() *= -1;
    const Eigen::AngleAxisd way(turn);
    return way.angle() * way.axis();
  }

  const Clip& clip_;
  std::size_t width_;
  double near_;  // cosine of half of kTurn
};

// Whether it ends in the pose in which it begins: a cycle that somebody drew, or closed by hand.
bool is_closed(const Skeleton& skeleton, const Clip& clip) {
  return cycle_of(Kinematics(skeleton), clip) == clip.frames - 1;
}

}  // namespace

std::vector<int> discontinuities(const Skeleton& skeleton, const Clip& clip) {
  const std::vector<int> bones = measured_bones(skeleton);
  const double farthest = kSpeed / (clip.rate * standard_scale(skeleton));
  const Turns turns(skeleton, clip);
  const auto torn = [&](int f) {
    const double* root = &clip.root_positions[std::size_t{3} * f];
    if ((load_vector(root) - load_vector(root - 3)).norm() > farthest) return true;
    return std::any_of(bones.begin(), bones.end(), [&](int bone) { return turns.tear(bone, f); });
  };
  std::vector<int> frames;
  for (int f = 1; f < clip.frames; ++f) {
    if (torn(f)) frames.push_back(f);
  }
  if (!frames.empty() && is_closed(skeleton, clip)) return {};
  return frames;
}

void close_way(const std::vector<int>& discontinuities, Clip& clip) {
  for (const int f : discontinuities) {
    for (std::size_t axis : {0, 1}) {
      const std::size_t first = std::size_t{3} * f + axis;
      const double jump = clip.root_positions[first] - clip.root_positions[first - 3];
      for (std::size_t i = first; i < clip.root_positions.size(); i += 3) clip.root_positions[i] -= jump;
    }
  }
}

}  // namespace fragmotion
