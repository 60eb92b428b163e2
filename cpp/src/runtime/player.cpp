// SPDX-License-Identifier: MIT
#include "fragmotion/runtime/player.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/ranges.hpp"
#include "fragmotion/motion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kInstant = 1e-9;   // s: no time
constexpr double kChange = 1;       // ControlDis between controls that is "a lot"
constexpr double kHaste = 10;       // m/s, as Dis, by default
constexpr double kWorthIt = 0.05;   // s that must be left of a fragment for leaving it early
constexpr double kHop = 0.9;        // evident jump of what is no run
constexpr double kInTheAir = 0.5;   // evident jump above which a fragment is played to its end
constexpr double kJoinsWell = 1.3;  // times the Dis of the fragment that joins best, and
constexpr double kJoinsNear = 0.3;  // m, summed as Dis, more
constexpr double kAsWell = 0.5;     // of the way from the least error to the representative's
constexpr double kPull = 0.4;       // of speed and turn rate: the most that the root is pulled
constexpr double kPulling = 0.1;    // s: time constant of the pull
constexpr double kStill = 0.2;      // m/s of a 1.8 m character, and of the turn rate, below which it stands
constexpr double kLongest = 3600;   // s that a step may last
constexpr double kFarthest = 1e9;   // m, and rad: where steps are still told apart

constexpr double kLook = kOpening / 2;  // s between the moments at which a fragment may be left early

}  // namespace

Player::Stage::Stage(const Character& character)
    : kinematics(character.pool.skeleton),
      body(std::make_shared<FootLock::Body>(kinematics, character.legs)),
      members(character.classes.members()),
      tips{BodyTips(character.pool.skeleton), BodyTips(character.pool.skeleton), BodyTips(character.pool.skeleton)},
      onward(character.openings.size() / character.pool.fragments.size()) {
  fitting.reserve(character.pool.fragments.size());
  shown.rotations.resize(std::size_t{4} * kinematics.bones());
  poses.fill(shown);
}

Player::Player(std::shared_ptr<const Character> character, const PlayerOptions& options)
    : Player(character, options, std::make_shared<Stage>(*character)) {}

Player::Player(std::shared_ptr<const Character> character, const PlayerOptions& options, std::shared_ptr<Stage> stage)
    : character_(std::move(character)),
      policy_(&character_->policy(options.policy)),
      stage_(std::move(stage)),
      seed_(options.seed),
      random_(options.seed),
      stitch_(options.stitch),
      stitching_(options.stitching),
      lock_feet_(options.lock_feet),
      pull_(options.pull),
      promptness_(options.promptness),
      inertia_(stage_->kinematics.bones()),
      foot_lock_(stage_->body),
      breathing_(stage_->kinematics.skeleton()) {
  if (!(pull_ >= 0 && pull_ <= 1)) throw std::invalid_argument("the pull must be 0 to 1");
  if (!(promptness_ >= 0 && promptness_ <= 1)) throw std::invalid_argument("the promptness must be 0 to 1");
  if (!(stitch_ >= 0 && stitch_ <= 1)) throw std::invalid_argument("the stitching time must be 0 to 1 s");
  reset();
}

// Lets its memory be on its way to the processor: that of a crowd is more than the processor keeps at hand.
void Player::fetch() const {
  prefetch(this, 1);
  inertia_.fetch();
}

void Player::check_step(const Control& control, double seconds) {
  for (const double value : {control.x, control.y, control.turn, control.jump}) {
    if (!std::isfinite(value)) throw std::invalid_argument("the control holds what is not a number");
  }
  if (!(seconds >= 0 && seconds <= kLongest)) throw std::invalid_argument("a step must last 0 s to an hour");
}

void Player::reset(const CharacterFrame& frame) {
  for (const double value : {frame.position.x(), frame.position.y(), frame.heading})
    require_range("the place and the heading to stand at", value, -kFarthest, kFarthest);
  const Quality& quality = character_->quality;
  const int still = character_->space.nearest({});
  class_ = 0;
  for (int k = 1; k < quality.classes; ++k) {
    const auto match = [&](int q) {
      return quality.match[static_cast<std::size_t>(q) * ControlSpace::kPoints + still];
    };
    if (match(k) > match(class_)) class_ = k;
  }
  from_ = class_;
  random_ = Random(seed_);
  waiting_ = forced_ = -1;
  held_ = false;
  faded_ = soonest_ = 0;
  exit_ = -1;
  pulling_ = Vector2::Zero();
  turning_ = 0;
  inertia_.clear();
  foot_lock_.reset();
  breathing_.reset();
  jump_waits_ = jump_pressed_ = false;
  decided_for_ = {};
  now_ = place(character_->classes.representatives[class_], frame);
  pose();
  plant(0);
}

Player::Placed Player::place(int fragment, const CharacterFrame& frame) const {
  const Fragment& f = character_->pool.fragments[fragment];
  const CharacterFrame first = frame_at(character_->pool.clips[f.clip], f.begin);
  Placed placed;
  placed.fragment = fragment;
  placed.heading = frame.heading - first.heading;
  placed.offset = frame.position - Eigen::Rotation2Dd(placed.heading) * first.position;
  return placed;
}

void Player::sample(const Placed& placed, WorldPose& pose) const {
  const Fragment& f = character_->pool.fragments[placed.fragment];
  const PackedClip& clip = character_->pool.clips[f.clip];
  const double at = f.begin + placed.seconds * clip.rate;
  const Vector3 root = sample_pose(clip, at, pose.rotations.data());
  // By half the angle, for the quaternion as well as for the plane.
  const double w = std::cos(placed.heading / 2), z = std::sin(placed.heading / 2), c = w * w - z * z, s = 2 * w * z;
  pose.root = {placed.offset.x() + c * root.x() - s * root.y(), placed.offset.y() + s * root.x() + c * root.y(),
               root.z()};
  pose.heading = placed.heading + frame_at(clip, at).heading;
  double* hips = &pose.rotations[std::size_t{4} * stage_->kinematics.skeleton().roles.hips];
  store_quaternion(Quaternion{w, 0, 0, z} * load_quaternion(hips), hips);
}

CharacterFrame Player::frame() const { return {root_.head<2>(), heading_}; }

// Moves and turns what plays, so that it does more of what the control says.
void Player::pull(const Control& control, double seconds) {
  const Control& ev = character_->pool.fragments[now_.fragment].evident;
  const ControlSpace& space = character_->space;
  Vector2 wanted{control.x - ev.x, control.y - ev.y};
  const double most = kPull * ev.speed();
  if (wanted.norm() > most) wanted *= most / wanted.norm();
  const double turn = std::clamp(control.turn - ev.turn, -kPull, kPull) * space.turn_rate();
  const double share = 1 - std::exp(-seconds / kPulling);
  pulling_ += share * (pull_ * wanted - pulling_);
  turning_ += share * (pull_ * turn - turning_);
  const Vector2 root = root_.head<2>(), way = seconds * (Eigen::Rotation2Dd(heading_) * pulling_);
  const Eigen::Matrix2d turned = Eigen::Rotation2Dd(seconds * turning_).toRotationMatrix();
  for (Placed* placed : {&now_, &before_}) {
    placed->heading += seconds * turning_;
    placed->offset = root + way + turned * (placed->offset - root);
  }
}

// Shows what plays, stitched to what played.
void Player::pose() {
  WorldPose& shown = stage_->shown;
  sample(now_, shown);
  if (stitching_ == Stitching::inertialize) {
    inertia_.apply(now_.seconds, shown);
  } else if (now_.seconds < faded_) {
    crossfade(ease_in_ease_out(now_.seconds / faded_), shown);
  }
  root_ = shown.root;
  heading_ = shown.heading;
}

// Goes so far from what played before to the pose.
void Player::crossfade(double weight, WorldPose& pose) const {
  WorldPose& old = stage_->poses[0];
  sample(before_, old);
  blend_rotations(old.rotations.data(), pose.rotations.data(), weight, stage_->kinematics.bones(),
                  pose.rotations.data());
  pose.root = old.root + weight * (pose.root - old.root);
  pose.heading = old.heading + weight * (pose.heading - old.heading);
}

bool Player::stands(const Control& evident) const {
  return evident.speed() * character_->space.scale() < kStill && std::abs(evident.turn) < kStill &&
         evident.jump < kInTheAir;
}

// Lets the pose breathe and keeps planted feet where they are, `seconds` after the last one.
void Player::plant(double seconds) {
  const Fragment& f = character_->pool.fragments[now_.fragment];
  breathing_.apply(stage_->kinematics.skeleton(), stage_->shown, stands(f.evident), seconds);
  const Contacts& contacts = character_->contacts[f.clip];
  if (!lock_feet_ || contacts.feet[0].empty()) return;
  const PackedClip& clip = character_->pool.clips[f.clip];
  const long at = std::lround(f.begin + now_.seconds * clip.rate);
  const auto frame = static_cast<std::size_t>(std::clamp(at, 0L, static_cast<long>(clip.frames) - 1));
  foot_lock_.apply(stage_->shown, contacts, frame, seconds);
  root_ = stage_->shown.root;
}

double Player::left() const {
  return character_->pool.seconds(character_->pool.fragments[now_.fragment]) - now_.seconds;
}

// What plays as it is shown at a time since its first pose.
void Player::sample_shown(Placed placed, double seconds, WorldPose& pose) const {
  placed.seconds = seconds;
  sample(placed, pose);
  if (stitching_ == Stitching::inertialize) inertia_.apply(std::max(0.0, seconds), pose);
}

// Poses what plays as it is shown at a time since its first pose.
CharacterFrame Player::pose_tips(double seconds, BodyTips& tips) const {
  WorldPose& pose = stage_->poses[0];
  sample_shown(now_, seconds, pose);
  tips.pose(pose.root, pose.rotations.data());
  return {pose.root.head<2>(), pose.heading};
}

// The tips of what plays, seen from its frame, and of how it would go on for kOpening: as it did for as long until
// then.
void Player::find_onward(const CharacterFrame& frame, const BodyTips& before, const BodyTips& now) const {
  std::vector<float>& onward = stage_->onward;
  const int stride = static_cast<int>(onward.size()) / 3, points = now.points();
  now.write(frame, onward.data(), stride, 0);
  before.write(frame, onward.data(), stride, points);
  for (int axis = 0; axis < 3; ++axis) {
    float *is = &onward[static_cast<std::size_t>(axis) * stride], *goes_on = is + points;
    for (int i = 0; i < points; ++i) goes_on[i] = 2 * is[i] - goes_on[i];
  }
}

// Whether a fragment hops, or does not, as is wanted.
bool Player::obeys(int fragment, const Control& wanted) const {
  const double jump = character_->pool.fragments[fragment].evident.jump;
  return wanted.jump > kInTheAir ? jump > kInTheAir : jump < kHop;
}

// Finds the members that perform the control nearly as well as any of them does. Where the representative hops, or does
// not, as is wanted, they do so too.
void Player::find_fitting(int next_class, const Control& control) const {
  const Character& c = *character_;
  const int meant = c.classes.representatives[next_class];
  const auto error = [&](int fragment) {
    if (obeys(meant, control) && !obeys(fragment, control)) return std::numeric_limits<double>::infinity();
    return c.space.distance(c.pool.fragments[fragment].evident, control);
  };
  double best = error(meant);
  const double usual = best;
  for (const int fragment : stage_->members[next_class]) best = std::min(best, error(fragment));
  const double allowed = best + kAsWell * (usual - best);
  stage_->fitting.clear();
  for (const int fragment : stage_->members[next_class]) {
    if (error(fragment) > allowed) continue;
    stage_->fitting.emplace_back(0.0F, fragment);
  }
}

// How far the beginnings of the fragments found are from how what plays would go on; tells the least.
float Player::measure_fitting() const {
  const std::vector<float>& onward = stage_->onward;
  float least = std::numeric_limits<float>::infinity();
  for (auto& [distance, fragment] : stage_->fitting) {
    const float* opening = &character_->openings[onward.size() * fragment];
    distance = tip_distance(onward.data(), opening, static_cast<int>(onward.size()) / 3) / 2;
    least = std::min(least, distance);
  }
  return least;
}

int Player::draw(int next_class, const Control& control) {
  auto& [before, now, unused] = stage_->tips;
  find_fitting(next_class, control);
  pose_tips(now_.seconds - kOpening, before);
  find_onward(pose_tips(now_.seconds, now), before, now);
  const float least = measure_fitting();
  std::vector<std::pair<float, int>>& fitting = stage_->fitting;
  const auto joins = [&](const auto& each) { return each.first <= kJoinsWell * least + kJoinsNear; };
  const auto end = std::partition(fitting.begin(), fitting.end(), joins);
  return fitting[random_.below(static_cast<int>(end - fitting.begin()))].second;
}

// Begins a stitch from the old fragment, as it is shown, to the one that plays now.
void Player::stitch(const Placed& old) {
  constexpr double kApart = 1.0 / 60;  // s over which speeds are measured, within both fragments
  auto& [old_before, old_now, fresh, fresh_later] = stage_->poses;
  sample_shown(old, old.seconds, old_now);
  sample_shown(old, old.seconds - kApart, old_before);
  sample(now_, fresh);
  Placed later = now_;
  later.seconds += kApart;
  sample(later, fresh_later);
  inertia_.begin(old_before, old_now, fresh, fresh_later, kApart, stitch_);
}

void Player::start(int next_class, int fragment) {
  before_ = now_;
  now_ = place(fragment, frame());
  ++entered_;
  held_ = false;
  from_ = class_;
  class_ = next_class;
  const bool inertial = stitching_ == Stitching::inertialize;
  if (inertial && stitch_ > 0) stitch(before_);
  exit_ = -1;
  faded_ = inertial ? 0 : std::min(stitch_, left());
  soonest_ = std::max(kSoonest, faded_);
  pose();
}

void Player::force(int next_class) {
  if (next_class < 0 || next_class >= character_->classes.count) {
    throw std::invalid_argument("class " + std::to_string(next_class) + " does not exist");
  }
  forced_ = next_class;
}

void Player::start_forced() {
  const int next = std::exchange(forced_, -1);
  waiting_ = -1;
  start(next, stage_->members[next][random_.below(static_cast<int>(stage_->members[next].size()))]);
  held_ = true;
}

bool Player::changed(const Control& wanted) const { return character_->space.distance(wanted, decided_for_) > kChange; }

// Whether a fragment goes back from where is wanted, though what plays goes there: a table may find that such a detour
// joins best, both ways.
bool Player::turns_back(int fragment, const Control& wanted) const {
  const auto along = [&](int f) {
    const Control& ev = character_->pool.fragments[f].evident;
    return ev.x * wanted.x + ev.y * wanted.y;
  };
  return along(now_.fragment) > 0 && along(fragment) < 0;
}

// The class that the table tells. Where a jump was pressed and that class does not jump, or the other way round, since
// the transition is thought too bad or too good for it, or where it turns back, the one of the table's that suits best
// and does not: nothing is worse than a button that does nothing, and a hop that nobody asked for.
int Player::tell(const Control& wanted) const {
  const Character& c = *character_;
  const bool free = wanted.jump > kInTheAir && !jump_waits_;
  const auto suits = [&](int k) {
    const int fragment = c.classes.representatives[k];
    return (free || obeys(fragment, wanted)) && !turns_back(fragment, wanted);
  };
  const int control = c.space.nearest(wanted);
  int told = (*policy_)(class_, control);
  if (suits(told)) return told;
  double best = 0;
  for (int k = 0; k < c.classes.count; ++k) {
    const double match = c.quality.match[static_cast<std::size_t>(k) * ControlSpace::kPoints + control],
                 worth = c.quality(class_, k, control) * match;
    if (!suits(k) || worth <= best || !policy_->leads_to(k)) continue;
    best = worth;
    told = k;
  }
  return told;
}

int Player::decide(const Control& wanted) {
  const Character& c = *character_;
  const int waiting = std::exchange(waiting_, -1);
  if (waiting >= 0 && !changed(wanted)) return waiting;
  decided_for_ = wanted;
  const int next = tell(wanted);
  const int bridge = c.bridges[static_cast<std::size_t>(class_) * c.classes.count + next];
  if (bridge < 0) return next;
  waiting_ = next;
  return bridge;
}

// The moment at which what plays is best left for what the table tells now: every second of waiting counts as much as
// so many metres between the poses that are joined, and no later moment is looked at once that alone is too much. What
// is shown kOpening before a moment is known from the last but one.
double Player::find_exit(const Control& wanted) const {
  const double haste = kHaste * promptness_ / std::max(1 - promptness_, kInstant);
  const double rest = left();
  find_fitting(tell(wanted), wanted);
  auto& [long_before, before, now] = stage_->tips;
  pose_tips(now_.seconds - kOpening, long_before);
  pose_tips(now_.seconds - kLook, before);
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (double wait = 0; haste * wait < least; wait = std::min(wait + kLook, rest)) {
    if (wait == rest) pose_tips(now_.seconds + wait - kOpening, long_before);
    find_onward(pose_tips(now_.seconds + wait, now), long_before, now);
    const double cost = measure_fitting() + haste * wait;
    if (cost < least) least = cost, best = wait;
    if (wait >= rest) break;
    std::swap(long_before, before);
    std::swap(before, now);
  }
  return now_.seconds + best;
}

bool Player::leaves_early(const Control& wanted) {
  if (now_.seconds <= soonest_ - kInstant || left() <= kWorthIt || waiting_ >= 0 || held_) return false;
  if (character_->pool.fragments[now_.fragment].evident.jump >= kInTheAir || !changed(wanted)) return false;
  if (exit_ < 0 || character_->space.distance(wanted, planned_for_) > 0) {
    exit_ = find_exit(wanted);
    planned_for_ = wanted;
  }
  return now_.seconds > exit_ - kInstant;
}

void Player::go_on(const Control& control, const Control& wanted) {
  const int next = decide(wanted);
  start(next, draw(next, wanted));
  if (waiting_ >= 0) return;  // the jump, too, waits for the end of the stand-in-place fragment
  jump_waits_ = false;
  decided_for_.jump = control.jump;
}

double Player::quality(int control) const { return character_->quality(from_, class_, control); }

void Player::step(const Control& control, double seconds) {
  check_step(control, seconds);
  const double whole = seconds;
  const bool pressed = control.jump > 0.5;
  jump_waits_ = jump_waits_ || (pressed && !jump_pressed_);
  jump_pressed_ = pressed;
  while (seconds > 0) {
    Control wanted = control;
    if (jump_waits_) wanted.jump = 1;
    if (forced_ >= 0 && now_.seconds > soonest_ - kInstant) {
      start_forced();
    } else if (left() < kInstant || leaves_early(wanted)) {
      go_on(control, wanted);
    }
    const auto until = [&](double time) { return time - now_.seconds > kInstant ? time - now_.seconds : seconds; };
    const double part = std::min({seconds, left(), until(soonest_), until(exit_)});
    now_.seconds += part;
    before_.seconds += part;
    pull(control, part);
    seconds -= part;
    pose();
  }
  if (whole == 0) pose();
  plant(whole);
}

Performance Player::run(const Trace& trace, double rate, const Progress& progress) {
  if (trace.empty()) throw std::invalid_argument("the trace has no controls");
  Performance p;
  const int entered = entered_;
  p.rate = rate;
  p.frames = frame_count(trace.size(), rate);
  for (int f = 0; f < p.frames; ++f) {
    if (f % 256 == 0) report(progress, static_cast<double>(f) / p.frames, "Playing");
    const Control& control = trace[control_at(f, rate, trace.size())];
    if (f > 0) step(control, 1 / rate);
    const CharacterFrame now = frame();
    p.root_positions.insert(p.root_positions.end(), root_.data(), root_.data() + 3);
    p.rotations.insert(p.rotations.end(), rotations().begin(), rotations().end());
    p.path.insert(p.path.end(), {now.position.x(), now.position.y(), now.heading});
    p.classes.push_back(class_);
    p.fragments.push_back(now_.fragment);
    p.entered.push_back(entered_ - entered);
    if (f > 0) p.quality += quality(character_->space.nearest(control)) / (p.frames - 1);
  }
  judge(p, *character_, trace);
  return p;
}

}  // namespace fragmotion
