// SPDX-License-Identifier: MIT
#include "motion/in_place.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/quantile.hpp"
#include "motion/center_of_mass.hpp"
#include "motion/contacts.hpp"
#include "motion/cycle.hpp"
#include "motion/gait_scale.hpp"
#include "motion/soles.hpp"
#include "motion/treading.hpp"

namespace fragmotion {
namespace {

// Of a character of 1.8 m.
constexpr double kStays = 0.4;       // m that hips on the spot go at most
constexpr double kTurns = kPi / 12;  // rad/s: feet that stand turn by less in a gait that goes straight
// Of its height over its feet, to a side: nine of ten strides of real takes that go straight lean by less.
constexpr double kUpright = 0.02;

Vector2 root_at(const Clip& clip, int f) { return load_vector(&clip.root_positions[std::size_t{3} * f]).head<2>(); }

// Where the clip is turned about: the middle of its hips' places.
Vector2 middle(const Clip& clip) {
  Vector2 sum = Vector2::Zero();
  for (int f = 0; f < clip.frames; ++f) sum += root_at(clip, f);
  return sum / clip.frames;
}

double hips_heading(const Kinematics& kinematics, const Clip& clip, int f) {
  const std::size_t hips = kinematics.bones() * f + kinematics.skeleton().roles.hips;
  return kinematics
      .frame(load_vector(&clip.root_positions[std::size_t{3} * f]), load_quaternion(&clip.rotations[4 * hips]))
      .heading;
}

bool stays(const Kinematics& kinematics, const Clip& clip) {
  const double scale = standard_scale(kinematics.skeleton());
  for (int f = 1; f < clip.frames; ++f) {
    if ((root_at(clip, f) - root_at(clip, 0)).norm() * scale > kStays) return false;
  }
  return true;
}

// Whether the feet, which go back as they stand, come back.
bool tread(const std::vector<SolePath>& soles, double way) {
  double gone = 0;
  for (const SolePath& sole : soles) {
    const std::vector<Vector3>& path = sole.heel().path;
    gone += 0.5 * (path.back() - path.front()).head<2>().norm();
  }
  return gone < kTreads * way;
}

// The mean, as the body sees it.
Vector2 seen_mean(const Velocities& velocities, const Clip& clip) {
  Velocities seen;
  for (std::size_t f = 0; f < velocities.size(); ++f)
    seen.emplace_back(Eigen::Rotation2Dd(-clip.headings[f]) * velocities[f]);
  return mean_velocity(seen);
}

FeetWay halfway(FeetWay a, const FeetWay& b) {
  for (std::size_t f = 0; f < a.velocities.size(); ++f) a.velocities[f] = (a.velocities[f] + b.velocities[f]) / 2;
  return {std::move(a.velocities), (a.turn + b.turn) / 2, (a.mean + b.mean) / 2, a.by_legs || b.by_legs};
}

// What the feet tell of a clip, which may be a cycle's rounds.
class Told {
 public:
  Told(const Kinematics& kinematics, const Clip& clip, bool is_cycle)
      : kinematics_(kinematics),
        clip_(clip),
        scale_(standard_scale(kinematics.skeleton())),
        is_cycle_(is_cycle),
        turns_(turns(kinematics, clip)),
        center_(middle(clip)) {}

  // Of a four-legged body the mean of what the hind feet and the fore feet tell, if both do.
  std::optional<FeetWay> way() const {
    const std::vector<SolePath> soles = find_soles(kinematics_, clip_);
    const std::optional<FeetWay> way = this->way({soles.begin(), soles.begin() + 2});
    if (!way || soles.size() == 2) return way;
    const std::optional<FeetWay> fore = this->way({soles.begin() + 2, soles.end()});
    return fore ? std::optional(halfway(*way, *fore)) : std::nullopt;
  }

 private:
  // As a pair of feet tells it.
  std::optional<FeetWay> way(const std::vector<SolePath>& soles) const {
    const Treading treading(soles, clip_, scale_);
    if (!treading.is_long_enough()) return std::nullopt;
    FeetWay way;
    way.turn = turn(treading);
    const Velocities stands = treading.velocities(way.turn, center_), strides = treading.striding(way.turn, center_);
    way.by_legs = soles[0].points.size() > 1 && stands == strides;
    if (auto told = this->way(treading, soles, stands, way)) return told;
    way.by_legs = soles[0].points.size() > 1;
    return this->way(treading, soles, strides, way);
  }

  // If it goes anywhere and the feet tread as the body goes.
  std::optional<FeetWay> way(const Treading& treading, const std::vector<SolePath>& soles, const Velocities& windows,
                             FeetWay way) const {
    if (windows.empty()) return std::nullopt;
    way.velocities = treading.steps(windows);
    way.mean = seen_mean(way.velocities, clip_);
    const double speed = way.mean.norm();
    const bool treads = treading.slowest() > kTreads * speed && tread(soles, speed * (clip_.frames - 1) / clip_.rate);
    if (speed * gait_scale(scale_) < kMoving || !treads) return std::nullopt;
    return way;
  }

  double turn(const Treading& treading) const {
    const double turn = turns_ ? 0 : treading.turn();
    return std::abs(turn) < kTurns || (is_cycle_ && !leans(treading, turn)) ? 0 : turn;
  }

  // Whether the body leans, on the mean, as one that turns as it goes: into the turn, as far as that pulls it out, or
  // more so than not. Feet may pivot as they land and leave.
  bool leans(const Treading& treading, double turn) const {
    const Velocities stands = treading.velocities(turn, center_);
    const Vector2 velocity = stands.empty() ? Vector2(0, 0) : seen_mean(treading.steps(stands), clip_);
    const double pull = velocity.norm() * turn * scale_ / kGravity;
    if (std::abs(pull) < kUpright) return true;
    const Vector3 over_feet = treading.over_feet(center_of_mass(kinematics_, clip_));
    const Vector2 left = Vector2(-velocity.y(), velocity.x()).normalized();
    return left.dot(over_feet.head<2>()) / pull > 0.5 * over_feet.z();
  }

  const Kinematics& kinematics_;
  const Clip& clip_;
  double scale_;
  bool is_cycle_, turns_;
  Vector2 center_;
};

// The mean speed of each bone's end, seen from the hips, m/s.
std::vector<double> bone_speeds(const Kinematics& kinematics, const Clip& clip) {
  const std::size_t bones = kinematics.bones(), hips = kinematics.skeleton().roles.hips;
  std::vector<double> gone(bones, 0);
  std::vector<Vector3> heads(bones), ends(bones), before;
  std::vector<Quaternion> rotations(bones);
  for (int f = 0; f < clip.frames; ++f) {
    kinematics.world(load_vector(&clip.root_positions[std::size_t{3} * f]), &clip.rotations[4 * bones * f],
                     heads.data(), rotations.data());
    for (std::size_t b = 0; b < bones; ++b) {
      ends[b] = heads[b] - heads[hips] + rotations[b] * kinematics.skeleton().tips[b];
      if (f > 0) gone[b] += (ends[b] - before[b]).norm();
    }
    before = ends;
  }
  for (double& way : gone) way *= clip.rate / std::max(clip.frames - 1, 1);
  return gone;
}

}  // namespace

bool turns(const Kinematics& kinematics, const Clip& clip) {
  double turned = clip.headings.back() - clip.headings.front();
  if (cycle_of(kinematics, clip) > 0)
    turned += wrapped(hips_heading(kinematics, clip, clip.frames - 1) - hips_heading(kinematics, clip, 0) - turned);
  return std::abs(turned) * clip.rate > kTurns * (clip.frames - 1);
}

double mean_facing(const Clip& clip) {
  Vector2 facing = Vector2::Zero();
  for (const double heading : clip.headings) facing += Eigen::Rotation2Dd(heading) * Vector2::UnitY();
  return std::atan2(-facing.x(), facing.y());
}

bool stays_mostly(const Kinematics& kinematics, const Clip& clip) {
  std::vector<double> x, y;
  for (int f = 0; f < clip.frames; ++f) x.push_back(root_at(clip, f).x()), y.push_back(root_at(clip, f).y());
  const Vector2 middle(median(x), median(y));
  const double most = kStays / standard_scale(kinematics.skeleton());
  int near = 0;
  for (int f = 0; f < clip.frames; ++f) near += (root_at(clip, f) - middle).norm() <= most;
  return 2 * near > clip.frames;
}

std::optional<FeetWay> way_ahead(const Kinematics& kinematics, const Clip& clip, double speed) {
  if (!stays(kinematics, clip)) return std::nullopt;
  FeetWay way;
  way.velocities.assign(clip.frames - 1, speed * (Eigen::Rotation2Dd(mean_facing(clip)) * Vector2::UnitY()));
  way.mean = seen_mean(way.velocities, clip);
  return way;
}

bool may_go(const Kinematics& kinematics, const Clip& clip) {
  const Skeleton& skeleton = kinematics.skeleton();
  const double scale = standard_scale(skeleton);
  if (!stays(kinematics, clip) || cycle_of(kinematics, clip) == 0) return false;
  const std::vector<double> speeds = bone_speeds(kinematics, clip);
  double fastest = 0;
  const std::vector<LegRoles> legs = legs_with_feet(skeleton.roles);
  for (const LegRoles& leg : legs) fastest = std::max(fastest, speeds[leg.foot]);
  if (legs.empty()) fastest = *std::max_element(speeds.begin(), speeds.end());
  return fastest * gait_scale(scale) > kMoving;
}

std::optional<FeetWay> find_feet_way(const Kinematics& kinematics, const Clip& held) {
  const Clip clip = without_held_end(held);
  const Skeleton& skeleton = kinematics.skeleton();
  if (legs_with_feet(skeleton.roles).empty() || !stays(kinematics, clip)) return std::nullopt;
  const int period = cycle_of(kinematics, clip);
  const Clip round = period > 0 ? unrolled(kinematics, clip, period, 2 * period + clip.frames) : clip;
  const bool is_cycle = period > 0 || clip.frames <= kLongestCycle * clip.rate;  // or is meant to be one
  std::optional<FeetWay> way = Told(kinematics, round, is_cycle).way();
  if (!way) return way;
  way->velocities.erase(way->velocities.begin(), way->velocities.begin() + period);
  way->velocities.resize(clip.frames - 1);
  way->mean = seen_mean(way->velocities, clip);
  way->velocities.resize(held.frames - 1, Vector2::Zero());
  return way;
}

std::vector<CharacterFrame> placements(const FeetWay& way, const Clip& clip, double faster) {
  const Vector2 center = middle(clip);
  std::vector<CharacterFrame> result(clip.frames);
  Vector2 gone = Vector2::Zero();
  for (int f = 0; f < clip.frames; ++f) {
    const double turned = way.turn * faster * f / clip.rate;
    const Eigen::Rotation2Dd rotation(turned);
    result[f] = {center + gone - rotation * center, turned};
    if (f + 1 < clip.frames) gone += rotation * way.velocities[f] * faster / clip.rate;
  }
  return result;
}

Clip led(const Kinematics& kinematics, Clip clip, const FeetWay& way, double faster) {
  const std::vector<CharacterFrame> places = placements(way, clip, faster);
  const std::size_t bones = kinematics.bones(), hips = kinematics.skeleton().roles.hips;
  for (int f = 0; f < clip.frames; ++f) {
    const Vector2 place = places[f].position + Eigen::Rotation2Dd(places[f].heading) * root_at(clip, f);
    clip.root_positions[std::size_t{3} * f] = place.x();
    clip.root_positions[std::size_t{3} * f + 1] = place.y();
    double* rotation = &clip.rotations[4 * (bones * f + hips)];
    store_quaternion(places[f].rotation() * load_quaternion(rotation), rotation);
    clip.headings[f] += places[f].heading;
  }
  clip.led = true;
  return clip;
}

}  // namespace fragmotion
