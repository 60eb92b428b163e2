// SPDX-License-Identifier: MIT
#include "runtime/fragment_selector.hpp"

#include <algorithm>
#include <limits>

#include "fragments/entry_poses.hpp"
#include "motion/pose.hpp"
#include "policy/answer.hpp"

namespace fragmotion {
namespace {

constexpr double kJoinsWell = 1.1;                 // times the Dis of the fragment that joins best, and
constexpr double kJoinsNear = 0.15 / kTunedReach;  // m a metre of reach more
constexpr float kAsWell = 0.5F;                    // of the way from the least error to the representative's
constexpr double kUnsteady = 5;                    // ControlDis a m/s by which a fragment gets faster or slower
constexpr double kStep = 0.4, kHurried = 2;        // s, and ControlDis for all of it that a fragment lacks
constexpr double kOutOfTurn = 2 / kTunedReach;     // m a metre of reach that a step out of turn costs
constexpr double kLook = kEntry / 2;               // s between the moments at which a fragment may be left early

}  // namespace

FragmentSelector::FragmentSelector(Workspace& workspace, std::uint64_t seed)
    : workspace_(&workspace), style_(&workspace.styles.front()), seed_(seed), random_(seed) {}

void FragmentSelector::change_style(int style) { style_ = &workspace_->styles[style]; }

// Poses what plays as it is shown at a time since its first pose.
CharacterFrame FragmentSelector::pose_tips(const Playback& playback, double seconds, BodyTips& tips) const {
  WorldPose& pose = workspace_->poses[0];
  playback.sample(seconds, pose);
  tips.pose(pose.root, pose.rotations.data());
  return {pose.root.head<2>(), pose.heading};
}

// The tips of what plays, seen from its frame, and where they would be kEntry later at the speed of as long before.
void FragmentSelector::extrapolate(const CharacterFrame& frame, const BodyTips& before, const BodyTips& now) const {
  std::vector<float>& onward = workspace_->onward;
  const int stride = static_cast<int>(onward.size()) / 3, points = now.points();
  now.write(frame, onward.data(), stride, 0);
  before.write(frame, onward.data(), stride, points);
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

// The same, of a fragment's end in its take.
void FragmentSelector::extrapolate_end(const Fragment& fragment) const {
  auto& [before, now, unused] = workspace_->tips;
  const PackedClip& clip = style_->character->pool.clips[fragment.clip];
  double* rotations = workspace_->poses[0].rotations.data();
  const double end = fragment.last_played();
  before.pose(sample_pose(clip, end - kEntry * clip.rate, rotations), rotations);
  now.pose(sample_pose(clip, end, rotations), rotations);
  extrapolate(frame_at(clip, end), before, now);
}

float FragmentSelector::error(int fragment, const Control& control) const {
  const Character& c = *style_->character;
  const Fragment& f = c.pool.fragments[fragment];
  const double distance = c.space.distance(f.evident, control), lacks = std::max(0.0, 1 - c.pool.seconds(f) / kStep);
  return static_cast<float>(distance + kUnsteady * style_->velocity_changes[fragment] + kHurried * lacks);
}

// Finds the members that perform the control nearly as well as any of them does; returns the error() that they may
// have. Where the representative jumps, or does not, as is wanted, or answers a control that asks for motion, they do
// so too.
float FragmentSelector::find_candidates(int next_class, const Control& control, Candidates& candidates) const {
  const Character& c = *style_->character;
  const int representative = c.classes.representatives[next_class];
  const Control& usually = c.pool.fragments[representative].evident;
  const bool matches = matches_jump(usually, control),
             goes = control.speed() * c.space.scale() > kMoving && answers(usually, control);
  const auto error_of = [&](int fragment) {
    const Control& evident = c.pool.fragments[fragment].evident;
    const bool other = (matches && !matches_jump(evident, control)) || (goes && !answers(evident, control));
    return other ? std::numeric_limits<float>::infinity() : error(fragment, control);
  };
  candidates.clear();
  const float usual = error_of(representative);
  float best = usual;
  for (const int fragment : style_->members[next_class]) {
    candidates.emplace_back(error_of(fragment), fragment);
    best = std::min(best, candidates.back().first);
  }
  const float allowed = best + std::max(kAsWell * (usual - best), kNearly);
  const auto off = [&](const auto& candidate) { return candidate.first > allowed; };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), off), candidates.end());
  return allowed;
}

// How far the beginnings of the candidates are from how what plays would go on, and more for feet out of turn; tells
// the least.
float FragmentSelector::measure_candidates(const Control& evident, const StepSequence& steps,
                                           Candidates& candidates) const {
  const std::vector<float>& onward = workspace_->onward;
  const Character& c = *style_->character;
  const float* entries = c.entry_poses.data();
  const Fragment* fragments = c.pool.fragments.data();
  const EntrySteps* entry_steps = style_->entry_steps.data();
  const double scale = c.space.scale();
  const auto goes = [scale](const Control& control) { return control.speed() * scale > kMoving; };
  const bool went = goes(evident);
  const auto out_of_turn = static_cast<float>(kOutOfTurn * workspace_->tips[0].reach());
  float least = std::numeric_limits<float>::infinity();
  for (auto& [distance, fragment] : candidates) {
    const float* entry = entries + onward.size() * fragment;
    distance = tip_distance(onward.data(), entry, static_cast<int>(onward.size()) / 3) / 2;
    if (went && goes(fragments[fragment].evident)) {
      distance += out_of_turn * static_cast<float>(steps_out_of_turn(steps, entry_steps[fragment]));
    }
    least = std::min(least, distance);
  }
  return least;
}

bool FragmentSelector::goes_as_asked(const Control& evident, const Control& control) const {
  return control.speed() * style_->character->space.scale() <= kMoving || answers(evident, control);
}

bool FragmentSelector::goes_as_asked(int of_class, const Control& control) const {
  const Character& c = *style_->character;
  return goes_as_asked(c.pool.fragments[c.classes.representatives[of_class]].evident, control);
}

int FragmentSelector::continuation(int fragment, int next_class, const Control& control) const {
  const int next = style_->successors[fragment];
  if (next < 0) return -1;
  const Character& c = *style_->character;
  const Quality& quality = c.quality;
  const Control& evident = c.pool.fragments[next].evident;
  const bool is_excluded =
      quality.match[static_cast<std::size_t>(class_of(next)) * quality.controls + c.space.nearest(control)] == 0;
  if (is_excluded || !matches_jump(evident, control) || !goes_as_asked(evident, control)) return -1;
  return c.space.distance(evident, control) <= find_candidates(next_class, control, workspace_->candidates[0]) ? next
                                                                                                               : -1;
}

int FragmentSelector::choose(int next_class, const Control& control, const Playback& playback) {
  Candidates& candidates = workspace_->candidates[0];
  find_candidates(next_class, control, candidates);
  extrapolate(playback);
  const float least = measure_candidates(playback.evident(), playback.steps(), candidates);
  const double allowed = kJoinsWell * least + kJoinsNear * workspace_->tips[0].reach();
  const auto joins = [&](const auto& each) { return each.first <= allowed; };
  const auto end = std::partition(candidates.begin(), candidates.end(), joins);
  return candidates[random_.below(static_cast<int>(end - candidates.begin()))].second;
}

int FragmentSelector::choose_any(int next_class) {
  const std::vector<int>& members = style_->members[next_class];
  return members[random_.below(static_cast<int>(members.size()))];
}

int FragmentSelector::best_class(const Control& control, const Playback& playback) const {
  extrapolate(playback);
  const std::vector<float>& onward = workspace_->onward;
  const Character& c = *style_->character;
  const int point = c.space.nearest(control);
  int best = 0;
  double most = -1;
  for (int k = 0; k < c.classes.count; ++k) {
    const float* entry = &c.entry_poses[onward.size() * c.classes.representatives[k]];
    const double distance = tip_distance(onward.data(), entry, static_cast<int>(onward.size()) / 3) / 2,
                 match = c.quality.match[static_cast<std::size_t>(k) * c.quality.controls + point],
                 quality = match / (1 + distance);
    if (quality > most) most = quality, best = k;
  }
  return best;
}

double FragmentSelector::distance_to_class(int next_class, const Control& control, const Playback& playback) const {
  Candidates& candidates = workspace_->candidates[0];
  find_candidates(next_class, control, candidates);
  extrapolate(playback);
  return measure_candidates(playback.evident(), playback.steps(), candidates) / workspace_->tips[0].reach();
}

double FragmentSelector::distance_after(int fragment, int next_class, const Control& control,
                                        StepSequence steps) const {
  const Character& c = *style_->character;
  const Fragment& f = c.pool.fragments[fragment];
  const Contacts& contacts = c.contacts[f.clip];
  for (int frame = f.first_played(); frame < f.last_played(); ++frame) {
    steps.advance(standing_feet(contacts, frame + 1), 1 / c.pool.clips[f.clip].rate);
  }
  Candidates& candidates = workspace_->candidates[0];
  find_candidates(next_class, control, candidates);
  extrapolate_end(f);
  return measure_candidates(f.evident, steps, candidates) / workspace_->tips[0].reach();
}

double FragmentSelector::distance_to(int move, const Playback& playback) const {
  extrapolate(playback);
  const std::vector<float>& onward = workspace_->onward;
  const float* entry = &workspace_->move_entries[onward.size() * kMoveParts * move];
  return tip_distance(onward.data(), entry, static_cast<int>(onward.size()) / 3) / 2 / workspace_->tips[0].reach();
}

// For neither class a moment is looked at once waiting alone costs too much. What is shown kEntry before a moment is
// known from the last but one.
std::array<Exit, 2> FragmentSelector::best_exits(const std::array<int, 2>& classes, const Control& control,
                                                 const Playback& playback, double haste) const {
  const double seconds = playback.seconds(), rest = playback.left();
  auto& [long_before, before, now] = workspace_->tips;
  haste *= now.reach();
  std::array<Exit, 2> exits;
  for (std::size_t i = 0; i < exits.size(); ++i) {
    exits[i] = {classes[i], seconds, std::numeric_limits<double>::infinity()};
    if (classes[i] >= 0) find_candidates(classes[i], control, workspace_->candidates[i]);
  }
  const auto is_open = [&](std::size_t i, double wait) { return classes[i] >= 0 && haste * wait < exits[i].cost; };
  pose_tips(playback, seconds - kEntry, long_before);
  pose_tips(playback, seconds - kLook, before);
  StepSequence steps = playback.steps();
  for (double wait = 0; is_open(0, wait) || is_open(1, wait); wait = std::min(wait + kLook, rest)) {
    if (wait == rest) pose_tips(playback, seconds + wait - kEntry, long_before);
    extrapolate(pose_tips(playback, seconds + wait, now), long_before, now);
    if (wait > 0) steps.advance(playback.standing_feet(seconds + wait), kLook);
    for (std::size_t i = 0; i < exits.size(); ++i) {
      if (!is_open(i, wait)) continue;
      const double cost = measure_candidates(playback.evident(), steps, workspace_->candidates[i]) + haste * wait;
      if (cost < exits[i].cost) exits[i].cost = cost, exits[i].seconds = seconds + wait;
    }
    if (wait >= rest) break;
    std::swap(long_before, before);
    std::swap(before, now);
  }
  for (Exit& exit : exits) exit.cost /= now.reach();
  return exits;
}

}  // namespace fragmotion
