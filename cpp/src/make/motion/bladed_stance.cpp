// SPDX-License-Identifier: MIT
#include "motion/bladed_stance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "motion/contacts.hpp"
#include "motion/gait_scale.hpp"
#include "motion/in_place.hpp"

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

// Where a take goes, rad from where the rig faces at rest.
double way_from_rest(const Kinematics& kinematics, const Clip& clip) {
  const double* last = &clip.root_positions[std::size_t{3} * (clip.frames - 1)];
  const Vector3 way = load_vector(last) - load_vector(clip.root_positions.data());
  return wrapped(std::atan2(-way.x(), way.y()) - kinematics.rest_frame().heading);
}

// From the nearest of ahead, back, left and right, rad.
double off_four_ways(double angle) { return std::abs(wrapped(4 * angle)) / 4; }

// A take that is told to be on the spot: where it would go and where its hips face, rad from where the rig does at
// rest.
struct OnTheSpot {
  std::size_t take;
  double way, hips;
};

// Where they all face if they go straight ahead, back or aside: of the four ways the one that their hips are nearest
// to.
double common_facing(const std::vector<OnTheSpot>& takes) {
  Vector2 sum = Vector2::Zero();
  for (const OnTheSpot& take : takes) sum += Vector2(std::cos(4 * take.way), std::sin(4 * take.way));
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double facing = (std::atan2(sum.y(), sum.x()) + 2 * kPi * quarter) / 4;
    double off = 0;
    for (const OnTheSpot& take : takes) off += apart(take.hips, facing);
    if (off < least) best = facing, least = off;
  }
  return best;
}

// Ahead, to the left, back or to the right of where a body faces.
int nearest_way(double way, double facing) {
  return static_cast<int>(std::lround(wrapped(way - facing) * 2 / kPi)) & 3;
}

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

std::vector<double> take_told_turns(const Kinematics& kinematics, const std::vector<Clip>& takes) {
  std::vector<double> result(takes.size(), 0);
  std::vector<OnTheSpot> told;
  for (std::size_t c = 0; c < takes.size(); ++c) {
    if (!takes[c].led || turns(kinematics, takes[c])) continue;
    told.push_back(
        {c, way_from_rest(kinematics, takes[c]), wrapped(mean_facing(takes[c]) - kinematics.rest_frame().heading)});
  }
  if (told.empty()) return result;
  const double facing = common_facing(told);
  const auto goes_as_the_first = [&](const OnTheSpot& each) {
    return nearest_way(each.way, facing) == nearest_way(told.front().way, facing);
  };
  if (std::all_of(told.begin(), told.end(), goes_as_the_first)) return result;
  double by_hips = 0, by_facing = 0;
  for (const OnTheSpot& each : told)
    by_hips += off_four_ways(each.way - each.hips), by_facing += off_four_ways(each.way - facing);
  if (by_facing >= by_hips) return result;
  for (const OnTheSpot& each : told) result[each.take] = wrapped(facing - each.hips);
  return result;
}

void face_ahead(const Kinematics& kinematics, const std::vector<double>& told, std::vector<Clip>& clips) {
  const double bladed = bladed_stance(kinematics, clips);
  for (std::size_t c = 0; c < clips.size(); ++c) {
    const double turn = told[c] != 0 ? told[c] : -bladed;
    if (turn == 0) continue;
    for (double& heading : clips[c].headings) heading += turn;
  }
}

}  // namespace fragmotion
