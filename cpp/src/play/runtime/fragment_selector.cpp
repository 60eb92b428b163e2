// SPDX-License-Identifier: MIT
#include "runtime/fragment_selector.hpp"

#include <algorithm>
#include <limits>

#include "fragments/entry_poses.hpp"
#include "motion/contacts.hpp"
#include "motion/pose.hpp"
#include "policy/answer.hpp"

namespace fragmotion {

FragmentSelector::FragmentSelector(Workspace& workspace, std::uint64_t seed)
    : workspace_(&workspace), style_(&workspace.styles->front()), seed_(seed), random_(seed) {}

void FragmentSelector::change_style(int style) { style_ = &(*workspace_->styles)[style]; }

// Poses what plays as it is shown at a time since its first pose, but for neck and head.
CharacterFrame FragmentSelector::pose_tips(const Playback& playback, double seconds, BodyTips& tips) const {
  WorldPose& pose = workspace_->poses[0];
  playback.sample_body(seconds, pose);
  tips.pose(pose.root, pose.rotations.data());
  return {pose.root.head<2>(), pose.heading};
}

// The tips of what plays, seen from its frame, and where they would be kEntry later at the speed of as long before.
void FragmentSelector::extrapolate(const CharacterFrame& frame, const BodyTips& before, const BodyTips& now) const {
  std::vector<float>& onward = workspace_->onward;
  const int stride = static_cast<int>(onward.size()) / 3, points = now.points();
  const PlaneTurn facing(frame.heading);
  now.write(frame.position, facing, onward.data(), stride, 0);
  before.write(frame.position, facing, onward.data(), stride, points);
  for (int axis = 0; axis < 3; ++axis) {
    float *is = &onward[static_cast<std::size_t>(axis) * stride], *goes_on = is + points;
    for (int i = 0; i < points; ++i) goes_on[i] = 2 * is[i] - goes_on[i];
  }
}

// The same, of what is shown now.
void FragmentSelector::extrapolate(const Playback& playback) const {
  auto& [before, now, unused] = workspace_->tips;
  pose_tips(playback, playback.seconds() - kEntry, before);
  extrapolate(pose_tips(playback, playback.seconds(), now), before, now);
}

// Finds what is known of the members' costs before they are joined, which is infinite of those that may not be played:
// where the representative jumps, or does not, as is wanted, or answers a control that asks for motion, they do so too.
void FragmentSelector::find_candidates(int next_class, const Control& control, const Left& left,
                                       Candidates& candidates) const {
  const Character& c = *style_->character;
  const Entrants& entrants = style_->members[next_class];
  const Control& usually = c.pool.fragments[entrants.representative].evident;
  const auto of_left = static_cast<std::size_t>(left.fragment.clip);
  const bool is_here = of_left < c.contacts.size() && &left.contacts == &c.contacts[of_left];  // not of another style
  const Entry entry{control, left.fragment.origin == Origin::mirrored, is_here ? left.fragment.clip : -1,
                    matches_jump(usually, control), c.space.asks_to_go(control) && answers(usually, control)};
  float* costs = candidates.costs.data();
  style_->cost.of_entering(entrants, entry, workspace_->entering.data(), costs);
  candidates.best = first_of_least(costs, entrants.stride);
}

bool FragmentSelector::is_moving(const Control& evident) const {
  return evident.speed() * style_->character->space.scale() > kMoving;
}

// The tip_distance() of a fragment's beginning to what was extrapolated.
float FragmentSelector::distance(int fragment) const {
  const std::vector<float>& onward = workspace_->onward;
  const float* entry = style_->character->entry_poses.data() + onward.size() * fragment;
  return tip_distance(onward.data(), entry, static_cast<int>(onward.size()) / 3);
}

// How many feet come down out of turn where a fragment follows what goes, or does not, after these steps.
int FragmentSelector::out_of_turn(const Entrants& entrants, int member, bool went, const StepSequence& steps) const {
  const bool goes_on = went && is_moving(entrants.evident(member));
  return goes_on ? steps_out_of_turn(steps, style_->entry_steps[entrants.fragment(member)]) : 0;
}

// The cost of the candidate that costs least, if that is less than `most`, which is the best from now on. Few distances
// are measured: that to the representative tells how far others are at least.
float FragmentSelector::least_cost(int next_class, const Control& evident, const StepSequence& steps,
                                   Candidates& candidates, float most) const {
  const TransitionCost& cost = style_->cost;
  const Entrants& entrants = style_->members[next_class];
  const bool went = is_moving(evident);
  const float usual = distance(entrants.representative);
  const auto look = [&](int member) {
    const float known = candidates.costs[member], nearest = std::max(0.0F, usual - entrants.beside_usual(member));
    if (known + cost.of_joining(nearest, 0) >= most) return;
    const int feet = out_of_turn(entrants, member, went, steps);
    if (known + cost.of_joining(nearest, feet) >= most) return;
    const float whole = known + cost.of_joining(distance(entrants.fragment(member)), feet);
    if (whole >= most) return;
    most = whole;
    candidates.best = member;
  };
  look(candidates.best);
  for (int first = 0;; first += kLanes) {
    first = cost.next_under(entrants, first, candidates.costs.data(), usual, most);
    if (first >= entrants.count) break;
    for (int member = first; member < first + kLanes; ++member) look(member);
  }
  return most;
}

int FragmentSelector::successor(int fragment, const Control& control) const {
  const int next = style_->successors[fragment];
  return next >= 0 && style_->cost.may_go_on(next, control) ? next : -1;
}

int FragmentSelector::gait_beside(int fragment, const Control& control) const {
  const Character& c = *style_->character;
  const int gait = c.classes.count + c.space.nearest(control);
  const Entrants& entrants = style_->members[gait];
  bool is_other = entrants.count > 0;
  for (int i = 0; i < entrants.count; ++i) is_other = is_other && entrants.fragment(i) != fragment;
  return is_other ? gait : -1;
}

// What is known of the costs tells often enough, without a pose.
Cost FragmentSelector::cost_of_leaving(const std::array<int, 2>& classes, const Control& control,
                                       const Playback& playback, float enough) const {
  Cost least{enough, 0, -1};
  Candidates& candidates = workspace_->candidates[0];
  bool posed = false;
  for (const int each : classes) {
    if (each < 0) continue;
    find_candidates(each, control, {playback.fragment(), playback.contacts()}, candidates);
    if (candidates.costs[candidates.best] >= least.both()) continue;
    if (!posed) extrapolate(playback);
    posed = true;
    const float whole = least_cost(each, playback.evident(), playback.steps(), candidates, least.both());
    const int fragment = style_->members[each].fragment(candidates.best), then = successor(fragment, control);
    const Cost cost{whole, then < 0 ? whole : cost_of_going_on(then, control), fragment, each};
    if (cost.both() < least.both()) least = cost;
  }
  return least;
}

float FragmentSelector::usual_cost(int of_class, int next_class, const Control& control) const {
  const Character& c = *style_->character;
  const double smooth = c.quality.smoothness[static_cast<std::size_t>(of_class) * c.quality.classes + next_class];
  return style_->cost.of_joining(static_cast<float>(2 * (1 / smooth - 1)), 0) +  // of places and of speeds
         style_->cost.of_going_on(c.classes.representatives[next_class], control);
}

[[gnu::cold]] int FragmentSelector::choose(int next_class, const Control& control, const Playback& playback,
                                           bool posed) {
  Candidates& candidates = workspace_->candidates[0];
  find_candidates(next_class, control, {playback.fragment(), playback.contacts()}, candidates);
  if (posed) extrapolate(playback);
  const auto variety = static_cast<float>(weights().variety);
  const bool went = is_moving(playback.evident());
  const Entrants& entrants = style_->members[next_class];
  const float usual = posed ? distance(entrants.representative) : 0;
  const auto feet_of = [&](int member) { return out_of_turn(entrants, member, went, playback.steps()); };
  const int best = candidates.best;
  const float most = posed ? kAny : candidates.costs[best] + style_->cost.of_joining(0, feet_of(best)) + variety;
  auto& drawn = workspace_->drawn;
  drawn.clear();
  for (int i = 0; i < entrants.count; ++i) {
    if (candidates.costs[i] == kAny || candidates.costs[i] > most) continue;
    drawn.emplace_back(candidates.costs[i], i);
    if (drawn.back().first < drawn.front().first) std::swap(drawn.front(), drawn.back());
  }
  float least = std::numeric_limits<float>::infinity();
  for (auto& [cost, member] : drawn) {
    const int feet = feet_of(member), fragment = entrants.fragment(member);
    const float at_least = cost + style_->cost.of_joining(std::max(0.0F, usual - entrants.beside_usual(member)), feet);
    const bool measured = posed && !(at_least > least + variety);
    cost = measured ? cost + style_->cost.of_joining(distance(fragment), feet) : at_least;
    least = std::min(least, cost);
    member = fragment;
  }
  const auto end =
      std::partition(drawn.begin(), drawn.end(), [&](const auto& each) { return each.first <= least + variety; });
  const int count = std::max(1, static_cast<int>(end - drawn.begin()));  // none costs a number in a forged state
  return drawn[random_.below(count)].second;
}

int FragmentSelector::choose_any(int next_class) {
  const Entrants& entrants = style_->members[next_class];
  return entrants.fragment(random_.below(entrants.count));
}

int FragmentSelector::best_class(const Control& control, const Playback& playback) const {
  extrapolate(playback);
  const Character& c = *style_->character;
  const int point = c.space.nearest(control);
  int best = 0;
  double most = -1;
  for (int k = 0; k < c.classes.count; ++k) {
    const double far = distance(c.classes.representatives[k]) / 2,
                 match = c.quality.match[static_cast<std::size_t>(k) * c.quality.controls + point],
                 quality = match / (1 + far);
    if (quality > most) most = quality, best = k;
  }
  return best;
}

double FragmentSelector::distance_to(int move, const Playback& playback) const {
  extrapolate(playback);
  const std::vector<float>& onward = workspace_->onward;
  const float* entry = &workspace_->move_entries[onward.size() * kMoveParts * move];
  return style_->cost.of_joining(tip_distance(onward.data(), entry, static_cast<int>(onward.size()) / 3), 0);
}

// No moment is looked at once waiting, and what of the costs is known, are too much. What is shown kEntry before a
// moment is known from the last but one.
Exit FragmentSelector::best_exit(const std::array<Exit, 2>& classes, const Control& control, const Playback& playback,
                                 double haste, Exit best, bool only_now) const {
  const double seconds = playback.seconds(), rest = playback.left();
  const Left left{playback.fragment(), playback.contacts()};
  auto& tips = workspace_->tips;
  BodyTips *long_before = &tips[0], *before = &tips[1], *now = &tips[2];
  std::array<float, 2> known{};
  for (std::size_t i = 0; i < classes.size(); ++i) {
    known[i] = std::numeric_limits<float>::infinity();
    if (classes[i].next_class < 0) continue;
    find_candidates(classes[i].next_class, control, left, workspace_->candidates[i]);
    known[i] = workspace_->candidates[i].costs[workspace_->candidates[i].best];
  }
  const auto most = [&](std::size_t i, double wait) {
    return static_cast<float>(best.cost - (classes[i].cost + haste * wait));
  };
  const auto may_gain = [&](double wait) { return known[0] < most(0, wait) || known[1] < most(1, wait); };
  if (!may_gain(0)) return best;
  pose_tips(playback, seconds - kEntry, *long_before);
  StepSequence steps = playback.steps();
  for (double wait = 0; may_gain(wait); wait = std::min(wait + kMomentsApart, rest)) {
    if (wait == rest) pose_tips(playback, seconds + wait - kEntry, *long_before);
    extrapolate(pose_tips(playback, seconds + wait, *now), *long_before, *now);
    if (wait > 0) steps.advance(playback.standing_feet(seconds + wait), kMomentsApart);
    for (std::size_t i = 0; i < classes.size(); ++i) {
      if (classes[i].next_class < 0) continue;
      const float limit = most(i, wait), cost = least_cost(classes[i].next_class, left.fragment.evident, steps,
                                                           workspace_->candidates[i], limit);
      if (cost < limit) best = {classes[i].next_class, seconds + wait, cost + (classes[i].cost + haste * wait)};
    }
    if (wait >= rest || (only_now && best.seconds > seconds)) break;
    if (wait == 0) pose_tips(playback, seconds - kMomentsApart, *before);
    std::swap(long_before, before);
    std::swap(before, now);
  }
  return best;
}

}  // namespace fragmotion
