// SPDX-License-Identifier: MIT
#include "fragmotion/player.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "fragmotion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kInstant = 1e-9;  // s: no time
constexpr double kChange = 1;      // ControlDis between controls that is "a lot"
constexpr double kWorthIt = 0.05;  // s that must be left of a fragment for leaving it early
constexpr double kInTheAir = 0.5;  // evident jump above which a fragment is played to its end
constexpr double kLongest = 3600;  // s that a step may last

void check_step(const Control& control, double seconds) {
  for (const double value : {control.x, control.y, control.turn, control.jump}) {
    if (!std::isfinite(value)) throw std::invalid_argument("the control holds what is not a number");
  }
  if (!(seconds >= 0 && seconds <= kLongest)) throw std::invalid_argument("a step must last 0 s to an hour");
}

}  // namespace

Player::Player(std::shared_ptr<const Character> character, std::uint64_t seed, double stitch, const std::string& policy)
    : character_(std::move(character)),
      policy_(&character_->policy(policy)),
      kinematics_(character_->pool.skeleton),
      members_(character_->classes.members()),
      seed_(seed),
      random_(seed),
      stitch_(stitch),
      rotations_(std::size_t{4} * kinematics_.bones()),
      other_(rotations_) {
  fitting_.reserve(character_->pool.fragments.size());
  if (!(stitch >= 0 && stitch <= 1)) throw std::invalid_argument("the stitching time must be 0 to 1 s");
  reset();
}

void Player::reset(const CharacterFrame& frame) {
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
  waiting_ = -1;
  stitching_ = 0;
  jump_waits_ = jump_pressed_ = false;
  decided_for_ = {};
  now_ = place(character_->classes.representatives[class_], frame);
  show();
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

Vector3 Player::sample(const Placed& placed, double* rotations) const {
  const Fragment& f = character_->pool.fragments[placed.fragment];
  const Clip& clip = character_->pool.clips[f.clip];
  const CharacterFrame world{placed.offset, placed.heading};
  const Vector3 root = sample_pose(clip, f.begin + placed.seconds * clip.rate, rotations);
  double* hips = rotations + std::ptrdiff_t{4} * kinematics_.skeleton().roles.hips;
  store_quaternion(world.rotation() * load_quaternion(hips), hips);
  return world.to_world(root);
}

double Player::heading(const Placed& placed) const {
  const Fragment& f = character_->pool.fragments[placed.fragment];
  const Clip& clip = character_->pool.clips[f.clip];
  return placed.heading + frame_at(clip, f.begin + placed.seconds * clip.rate).heading;
}

CharacterFrame Player::frame() const { return {root_.head<2>(), heading_}; }

void Player::show() {
  root_ = sample(now_, rotations_.data());
  heading_ = heading(now_);
  if (now_.seconds >= stitching_) return;
  const Vector3 old = sample(before_, other_.data());
  const double weight = ease_in_ease_out(now_.seconds / stitching_), old_heading = heading(before_);
  blend_rotations(other_.data(), rotations_.data(), weight, kinematics_.bones(), rotations_.data());
  root_ = old + weight * (root_ - old);
  heading_ = old_heading + weight * (heading_ - old_heading);
}

double Player::left() const {
  return character_->pool.seconds(character_->pool.fragments[now_.fragment]) - now_.seconds;
}

int Player::draw(int next_class, const Control& control) {
  const Character& c = *character_;
  const auto error = [&](int fragment) { return c.space.distance(c.pool.fragments[fragment].evident, control); };
  const double allowed = error(c.classes.representatives[next_class]);
  fitting_.clear();
  for (const int fragment : members_[next_class]) {
    if (!(error(fragment) > allowed)) fitting_.push_back(fragment);
  }
  return fitting_[random_.below(static_cast<int>(fitting_.size()))];
}

void Player::start(int next_class, const Control& control) {
  before_ = now_;
  now_ = place(draw(next_class, control), frame());
  from_ = class_;
  class_ = next_class;
  stitching_ = std::min(stitch_, left());
  show();
}

bool Player::changed(const Control& wanted) const { return character_->space.distance(wanted, decided_for_) > kChange; }

int Player::decide(const Control& wanted) {
  const Character& c = *character_;
  const int waiting = std::exchange(waiting_, -1);
  if (waiting >= 0 && !changed(wanted)) return waiting;
  decided_for_ = wanted;
  const int next = (*policy_)(class_, c.space.nearest(wanted));
  const int bridge = c.bridges[static_cast<std::size_t>(class_) * c.classes.count + next];
  if (bridge < 0) return next;
  waiting_ = next;
  return bridge;
}

bool Player::leaves_early(const Control& wanted) const {
  return now_.seconds >= stitching_ && left() > kWorthIt && waiting_ < 0 &&
         character_->pool.fragments[now_.fragment].evident.jump < kInTheAir && changed(wanted);
}

void Player::go_on(const Control& control, const Control& wanted) {
  start(decide(wanted), wanted);
  if (waiting_ >= 0) return;  // the jump, too, waits for the end of the stand-in-place fragment
  jump_waits_ = false;
  decided_for_.jump = control.jump;
}

double Player::quality(int control) const { return character_->quality(from_, class_, control); }

void Player::step(const Control& control, double seconds) {
  check_step(control, seconds);
  const bool pressed = control.jump > 0.5;
  jump_waits_ = jump_waits_ || (pressed && !jump_pressed_);
  jump_pressed_ = pressed;
  while (seconds > 0) {
    Control wanted = control;
    if (jump_waits_) wanted.jump = 1;
    if (left() < kInstant || leaves_early(wanted)) go_on(control, wanted);
    const double part = std::min(seconds, left());
    now_.seconds += part;
    before_.seconds += part;
    seconds -= part;
    show();
  }
}

void Player::judge(Performance& p, const Control& control, const CharacterFrame& before) const {
  const ControlSpace& space = character_->space;
  const double weight = 1.0 / (p.frames - 1);
  const CharacterFrame now = frame();
  const Vector2 velocity = Eigen::Rotation2Dd(-before.heading) * (now.position - before.position) * p.rate;
  const bool jumps = character_->pool.fragments[now_.fragment].evident.jump > kInTheAir;
  p.velocity_error += weight * (velocity - Vector2{control.x, control.y}).norm();
  p.turn_error += weight * std::abs((now.heading - before.heading) * p.rate - control.turn * space.turn_rate());
  p.jump_error += jumps != (control.jump > 0.5) ? weight : 0;
  p.commanded_speed += weight * std::hypot(control.x, control.y);
  p.quality += weight * quality(space.nearest(control));
}

Performance Player::run(const Trace& trace, double rate, const Progress& progress) {
  if (trace.empty()) throw std::invalid_argument("the trace has no controls");
  if (!(rate > 0 && rate <= 1000)) throw std::invalid_argument("the frame rate must be over 0 and at most 1000");
  Performance p;
  p.rate = rate;
  p.frames = static_cast<int>(std::lround(static_cast<double>(trace.size()) / kTraceRate * rate)) + 1;
  for (int f = 0; f < p.frames; ++f) {
    if (f % 256 == 0) report(progress, static_cast<double>(f) / p.frames, "Playing");
    const int at = static_cast<int>(std::max(0.0, (f - 1) / rate) * kTraceRate + 1e-9);
    const Control& control = trace[std::min<std::size_t>(at, trace.size() - 1)];
    const CharacterFrame before = frame();
    if (f > 0) step(control, 1 / rate);
    const CharacterFrame now = frame();
    p.root_positions.insert(p.root_positions.end(), root_.data(), root_.data() + 3);
    p.rotations.insert(p.rotations.end(), rotations_.begin(), rotations_.end());
    p.path.insert(p.path.end(), {now.position.x(), now.position.y(), now.heading});
    p.classes.push_back(class_);
    p.fragments.push_back(now_.fragment);
    if (f > 0) judge(p, control, before);
  }
  return p;
}

}  // namespace fragmotion
