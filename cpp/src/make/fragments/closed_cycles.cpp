// SPDX-License-Identifier: MIT
#include "fragments/closed_cycles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "fragments/gait_cycle.hpp"
#include "fragments/gait_heights.hpp"
#include "motion/contacts.hpp"

namespace fragmotion {
namespace {

constexpr double kShortestCycle = 0.4, kLongestCycle = 1.4;  // s
constexpr double kClosed = 3 / kTunedReach;                  // m a metre of reach between the ends of a cycle

Control mean(const Control& a, const Control& b, double w) {
  return {a.x + w * (b.x - a.x), a.y + w * (b.y - a.y), a.turn + w * (b.turn - a.turn), a.jump + w * (b.jump - a.jump)};
}

ClosedCycle backward(const ClosedCycle& cycle) {
  const Control& ev = cycle.evident;
  return {cycle.clip, cycle.end, cycle.begin, cycle.image, {-ev.x, -ev.y, -ev.turn, ev.jump}, cycle.flaw};
}

// The fragments of mirror images, by the clip and the frame in which they begin.
std::map<std::pair<int, int>, int> beginnings(const FragmentPool& pool, std::size_t takes) {
  std::map<std::pair<int, int>, int> found;
  for (std::size_t f = 0; f < pool.fragments.size(); ++f) {
    const Fragment& fragment = pool.fragments[f];
    const bool image = fragment.origin == Origin::mirrored && fragment.clip >= static_cast<int>(takes);
    if (image) found[{fragment.clip - static_cast<int>(takes), fragment.begin}] = static_cast<int>(f);
  }
  return found;
}

// The poses of a gait at their frames, from there on.
void append_poses(const Kinematics& kinematics, const GaitCycle& gait, const CharacterFrame& from, Clip& to) {
  const CharacterFrame first = gait.poses[0].frame;
  const double turn = from.heading - first.heading;
  for (const BodyPose& pose : gait.poses) {
    append(kinematics, to,
           {from.position + turned(pose.frame.position - first.position, turn), pose.frame.heading + turn}, pose);
  }
}

// Adds the markers of frames begin .. end of a clip, from a frame of another on.
void append_markers(const Clip& from, int begin, int end, int at, std::vector<Marker>& to) {
  for (Marker marker : markers_in_rounds(from.markers, begin, end - begin, end - begin)) {
    marker.frame += at;
    to.push_back(std::move(marker));
  }
}

}  // namespace

double effort_of_direction(const Control& gait, const Control& control) {
  return std::abs(wrapped(std::atan2(control.y, control.x) - std::atan2(gait.y, gait.x))) / (kPi / 4);
}

namespace {

// Looks for the cycles of a pool.
struct CycleSearch {
  const FragmentPool& pool;
  const Trajectories& trajectories;
  const GaitHeights usual;
  double moving;                                         // m/s
  std::map<std::pair<int, int>, int> images;             // beginnings()
  std::array<std::vector<ClosedCycle>, 2> whole, steps;  // of the walk and of the run

  // Where fragments first .. last lead to the beginning of that one.
  void add(ClosedCycle cycle, int first, int last, int again, std::array<std::vector<ClosedCycle>, 2>& to) const {
    const double gap = double{transition_distance(trajectories, last, again)} / trajectories.reach;
    if (gap > kClosed) return;
    const double speed = cycle.evident.speed();
    cycle.flaw += gap + usual.excess(first, last, speed);
    to[usual.gait_at(speed)].insert(to[usual.gait_at(speed)].end(), {cycle, backward(cycle)});
  }

  // Of a step the gait goes straight on.
  void add_step(const ClosedCycle& cycle, int first, int last) {
    const auto image = images.find({cycle.clip, cycle.begin});
    const Control straight{0, cycle.evident.y, 0, cycle.evident.jump};
    if (image == images.end() || straight.speed() <= moving) return;
    const double bent = effort_of_direction(cycle.evident, straight) + effort_of_turn(cycle.evident, straight);
    add({cycle.clip, cycle.begin, cycle.end, pool.fragments[image->second].clip, straight, bent / kFlawed}, first, last,
        image->second, steps);
  }

  // All that begin with a fragment.
  void look(int first) {
    ClosedCycle cycle;
    double seconds = 0;
    for (int last = first; last < static_cast<int>(pool.fragments.size()); ++last) {
      const Fragment& f = pool.fragments[last];
      if (last > first && (f.clip != cycle.clip || f.begin != cycle.end)) break;
      const double length = pool.seconds(f), share = length / (seconds += length);
      if (last == first) cycle.clip = f.clip, cycle.begin = f.begin;
      cycle.end = f.end;
      cycle.evident = mean(cycle.evident, f.evident, share);
      if (seconds > kLongestCycle) break;
      if (seconds >= kShortestCycle) add(cycle, first, last, first, whole);
      if (2 * seconds >= kShortestCycle && 2 * seconds <= kLongestCycle) add_step(cycle, first, last);
    }
  }
};

}  // namespace

std::vector<ClosedCycle> closed_cycles(const FragmentPool& pool, const Trajectories& trajectories,
                                       const ControlSpace& space, std::size_t takes) {
  CycleSearch search{
      pool, trajectories, {trajectories, pool.fragments, space}, kMoving / space.scale(), beginnings(pool, takes), {},
      {}};
  for (std::size_t f = 0; f < pool.fragments.size(); ++f) search.look(static_cast<int>(f));
  std::vector<ClosedCycle> found;
  for (std::size_t gait = 0; gait < search.whole.size(); ++gait) {
    const auto& cycles = search.whole[gait].empty() ? search.steps[gait] : search.whole[gait];
    found.insert(found.end(), cycles.begin(), cycles.end());
  }
  return found;
}

GaitSource gait_of_step(const Kinematics& kinematics, const FragmentPool& pool, const ClosedCycle& step,
                        const Contacts& contacts, const Contacts& image_contacts) {
  const auto [begin, end] = std::minmax(step.begin, step.end);
  const Clip &clip = pool.clips[step.clip], &image = pool.clips[step.image];
  const BodyPose first = body_pose(kinematics, clip, begin), other = body_pose(kinematics, image, begin);
  const GaitCycle one = gait_cycle_of(kinematics, clip, begin, end, other),
                  two = gait_cycle_of(kinematics, image, begin, end, first);
  const int length = end - begin;
  GaitSource gait{{clip.name, clip.rate, 0, {}, {}, {}}, contacts, 0, 2 * length};
  append_poses(kinematics, one, one.poses[0].frame, gait.clip);
  append_poses(kinematics, two, one.end, gait.clip);
  const double turn = one.end.heading - two.poses[0].frame.heading;
  append(kinematics, gait.clip,
         {one.end.position + turned(two.end.position - two.poses[0].frame.position, turn), two.end.heading + turn},
         first);
  append_markers(clip, begin, end, 0, gait.clip.markers);
  append_markers(image, begin, end, length, gait.clip.markers);
  for (std::size_t foot = 0; foot < contacts.feet.size(); ++foot) {
    std::vector<bool>& stands = gait.contacts.feet[foot];
    stands.clear();
    if (contacts.feet[foot].empty()) continue;
    for (int f = 0; f <= 2 * length; ++f)
      stands.push_back((f / length == 1 ? image_contacts : contacts).stands(foot, begin + f % length));
  }
  if (step.backward()) std::swap(gait.begin, gait.end);
  return gait;
}

}  // namespace fragmotion
