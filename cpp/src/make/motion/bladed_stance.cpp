// SPDX-License-Identifier: MIT
#include "motion/bladed_stance.hpp"

#include <cmath>
#include <optional>

#include "motion/contacts.hpp"
#include "motion/gait_scale.hpp"

namespace fragmotion {
namespace {

// How a take goes, rad from where the rig faces at rest.
struct Going {
  double way, hips, head;
  bool straight;
};

double apart(double a, double b) { return std::abs(wrapped(a - b)); }

// Of the eight ways the one that is nearest, 0 ahead.
long nearest_way(double angle) { return std::lround(angle / (kPi / 4)); }

class Reader {
 public:
  explicit Reader(const Kinematics& kinematics)
      : kinematics_(kinematics),
        roles_(kinematics.skeleton().roles),
        chain_(kinematics.chains({roles_.head})),
        scale_(gait_scale(standard_scale(kinematics.skeleton()))) {
    const CharacterFrame& rest = kinematics.rest_frame();
    rest_ = rest.heading;
    std::vector<Vector3> heads;
    std::vector<Quaternion> rotations;
    rest_pose(kinematics.skeleton(), heads, rotations);
    const Vector3 ahead = rest.rotation() * Vector3::UnitY();
    hips_ahead_ = rotations[roles_.hips].conjugate() * ahead;
    head_ahead_ = rotations[roles_.head].conjugate() * ahead;
  }

  // None where the take goes nowhere.
  std::optional<Going> operator()(const Clip& clip) const {
    std::vector<Vector3> heads(kinematics_.bones());
    std::vector<Quaternion> rotations(kinematics_.bones());
    Vector3 hips = Vector3::Zero(), head = Vector3::Zero();
    Vector2 gone = Vector2::Zero(), before = gone;
    double path = 0;
    for (int f = 0; f < clip.frames; ++f) {
      kinematics_.world_below(load_vector(&clip.root_positions[std::size_t{3} * f]),
                              &clip.rotations[std::size_t{4} * kinematics_.bones() * f], chain_, heads.data(),
                              rotations.data());
      hips += rotations[roles_.hips] * hips_ahead_;
      head += rotations[roles_.head] * head_ahead_;
      const Vector2 here = heads[roles_.hips].head<2>(), step = here - before;
      if (f > 0) gone += step, path += step.norm();
      before = here;
    }
    if (path * clip.rate * scale_ < kMoving * (clip.frames - 1)) return std::nullopt;
    return Going{from_rest(gone), from_rest(hips.head<2>()), from_rest(head.head<2>()),
                 gone.norm() > std::cos(kPi / 8) * path};
  }

 private:
  double from_rest(const Vector2& way) const { return wrapped(std::atan2(-way.x(), way.y()) - rest_); }

  const Kinematics& kinematics_;
  const Roles& roles_;
  std::vector<int> chain_;
  double scale_, rest_ = 0;
  Vector3 hips_ahead_, head_ahead_;
};

bool looks_ahead(const Going& going) { return std::abs(going.head) < apart(going.head, going.hips); }
bool goes_ahead(const Going& going) { return std::abs(going.way) < apart(going.way, going.hips); }

}  // namespace

double bladed_stance(const Kinematics& kinematics, const std::vector<Clip>& clips) {
  const Roles& roles = kinematics.skeleton().roles;
  if (roles.head < 0 || roles.head == roles.hips || !kinematics.skeleton().is_below(roles.head, roles.hips)) return 0;
  const Reader read(kinematics);
  double sum = 0;
  int count = 0;
  bool ahead = false;
  for (const Clip& clip : clips) {
    const std::optional<Going> going = read(clip);
    if (!going) continue;
    if (!going->straight || std::abs(nearest_way(going->hips)) != 1 || going->hips * sum < 0 || !looks_ahead(*going))
      return 0;
    ahead = ahead || goes_ahead(*going);
    sum += going->hips;
    ++count;
  }
  return ahead ? sum / count : 0;
}

void face_ahead(const Kinematics& kinematics, std::vector<Clip>& clips) {
  const double turned = bladed_stance(kinematics, clips);
  if (turned == 0) return;
  for (Clip& clip : clips) {
    for (double& heading : clip.headings) heading -= turned;
  }
}

}  // namespace fragmotion
