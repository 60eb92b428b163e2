// SPDX-License-Identifier: MIT
#include "fragments/borne_gaits.hpp"

#include <algorithm>
#include <cmath>

#include "fragments/distance.hpp"
#include "fragments/strides.hpp"

namespace fragmotion {
namespace {

constexpr int kHalvings = 6;  // of what is not borne whole

GaitCycle thinned(const GaitCycle& cycle) {
  GaitCycle thin;
  const int count = std::min(kPoses, cycle.frames());
  for (int i = 0; i < count; ++i) thin.poses.push_back(cycle.poses[i * cycle.frames() / count]);
  thin.end = cycle.end;
  return thin;
}

std::vector<int> thighs_and_knees(const Legs& legs) {
  std::vector<int> bones;
  for (const Leg& leg : legs) bones.insert(bones.end(), {leg.thigh, leg.knee});
  return bones;
}

// How far the joint of a cycle is beyond its range that is furthest beyond, rad.
double excess(const JointRanges& ranges, const GaitCycle& cycle) {
  double most = 0;
  for (const BodyPose& pose : cycle.poses) most = std::max(most, ranges.excess(pose.rotations.data()));
  return most;
}

// As much as is wanted, or as is borne of it.
template <typename IsBorne>
double most_borne(double wanted, const IsBorne& is_borne) {
  if (is_borne(wanted)) return wanted;
  double borne = 0;
  for (int i = 0, part = 2; i < kHalvings; ++i, part *= 2) {
    const double more = borne + wanted / part;
    if (is_borne(more)) borne = more;
  }
  return borne;
}

// The edit with steps in place, and the one with no longer steps than those of the gait, straight on.
GaitEdit in_place(GaitEdit edit) {
  edit.speed = 0;
  return edit;
}
GaitEdit straight_on(GaitEdit edit) {
  edit.direction = 0;
  edit.speed = std::min(1.0, edit.speed);
  return edit;
}
GaitEdit with(GaitEdit edit, double hips, double hurry) {
  edit.hips = hips;
  edit.tempo *= hurry;
  edit.speed /= hurry;
  return edit;
}

}  // namespace

BorneGaits::BorneGaits(const Kinematics& kinematics, const Legs& legs, const FragmentPool& pool, double most_hurry,
                       int threads)
    : kinematics_(kinematics),
      legs_(legs),
      pool_(pool),
      most_hurry_(most_hurry),
      leg_ranges_(thighs_and_knees(legs), pool.clips, threads),
      spine_ranges_(spine_bones(pool.skeleton), pool.clips, threads) {}

GaitEdit BorneGaits::of(const Clip& clip, int number, int begin, int end, const GaitEdit& edit) {
  GaitEdit changed = edit;
  changed.turn = changed.hips = 0;
  const Change& change = found_.get({number, begin, end, edit.direction, edit.speed, edit.tempo},
                                    [&] { return find(clip, begin, end, changed); });
  return with(edit, change.hips, change.hurry);
}

BorneGaits::Change BorneGaits::find(const Clip& clip, int begin, int end, const GaitEdit& edit) const {
  if (edit.direction == 0 || legs_.count() != 2) return {};
  const GaitCycle whole = gait_cycle_of(kinematics_, clip, begin, end), cycle = thinned(whole);
  const double rate = clip.rate * edit.tempo * cycle.frames() / whole.frames();
  const auto beyond = [&](const GaitEdit& tried) {
    GaitCycle changed = cycle;
    turn_hips(pool_.skeleton, changed, tried.hips);
    Strides strides(kinematics_, legs_, changed, tried, rate);
    for (BodyPose& pose : changed.poses) strides.change(pose);
    return excess(leg_ranges_, changed);
  };
  const double usual =
      std::max({kSeenExcess, excess(leg_ranges_, cycle), beyond(in_place(edit)), beyond(straight_on(edit))});
  if (beyond(edit) <= usual) return {};
  const auto least = [&](double most, const auto& changed) {
    const double borne = std::max(usual, beyond(changed(most)));
    return most - most_borne(most, [&](double less) { return beyond(changed(most - less)) <= borne; });
  };
  const double turn = most_turn(cycle, std::sin(2 * edit.direction) / 2),
               hips = least(turn, [&](double angle) { return with(edit, angle, 1); }),
               more = least(most_hurry_ - 1, [&](double hurry) { return with(edit, hips, 1 + hurry); });
  return {hips, 1 + more};
}

// How far the hips may be turned under the head, rad.
double BorneGaits::most_turn(const GaitCycle& cycle, double wanted) const {
  if (wanted == 0 || spine_bones(pool_.skeleton).empty()) return 0;
  const double usual = std::max(kSeenExcess, excess(spine_ranges_, cycle));
  return most_borne(wanted, [&](double angle) {
    GaitCycle turned = cycle;
    turn_hips(pool_.skeleton, turned, angle);
    return excess(spine_ranges_, turned) <= usual;
  });
}

}  // namespace fragmotion
