// SPDX-License-Identifier: MIT
#include "runtime/playback.hpp"

#include <algorithm>
#include <cmath>

#include "base/rates.hpp"
#include "base/rounding.hpp"
#include "motion/pose.hpp"

namespace fragmotion {

Playback::Playback(const Character& character, Workspace& workspace, Stitching stitching, double stitch)
    : character_(&character),
      workspace_(&workspace),
      stitching_(stitching),
      inertialization_(workspace.kinematics.bones(), workspace.constants.stitch),
      look_(workspace) {
  set_stitch(stitch);
}

void Playback::reset(int fragment, const CharacterFrame& frame) {
  faded_ = turning_ = stitched_ = 0;
  inertialization_.clear();
  look_.clear();
  play(place(style_, fragment, frame));
  steps_ = {standing_feet(0), -1, 0};
  show();
}

// Whether it follows what plays in its take, now.
bool Playback::goes_on(const Placed& next) const {
  return &clip(next) == &clip(now_) && std::abs(fragment(next).first_played() - at()) < kFloatRounding;
}

void Playback::play(const Placed& placed) {
  const double first = fragment(placed).first_played(), after = goes_on(placed) ? at() : first - 2 * kFloatRounding;
  now_ = placed;
  pass_markers(after, first);
  const Vector2 velocity = hips_velocity(clip(now_), fragment());
  evident_of_hips_ = {velocity.x(), velocity.y(), evident().turn, evident().jump};
  beside_ends_ = Vector2::Zero();
  if (!far_away_) beside_ends_ = velocity - mean_velocity_around(clip(now_), fragment(), step_seconds());
}

Playback::Placed Playback::place(int style, int number, const CharacterFrame& frame) const {
  Placed placed;
  placed.style = style;
  placed.number = number;
  const CharacterFrame first = frame_at(clip(placed), fragment(placed).first_played());
  placed.heading = frame.heading - first.heading;
  placed.offset = frame.position - PlaneTurn(placed.heading) * first.position;
  return placed;
}

// Places hips and heading of a frame of the clip, which is turned by twice half an angle.
void Playback::put(const Placed& placed, const PlaneTurn& half, const RootPose& root, WorldPose& pose) {
  const auto [c, s] = half.twice();
  const Vector3& place = root.place;
  pose.root = {placed.offset.x() + c * place.x() - s * place.y(), placed.offset.y() + s * place.x() + c * place.y(),
               place.z()};
  pose.heading = placed.heading + root.heading;
}

void Playback::sample(const Placed& placed, WorldPose& pose, const FadingTurns& fading) const {
  const PackedClip& source = clip(placed);
  const double at = fragment(placed).first_played() + placed.seconds * source.rate;
  const PlaneTurn half(placed.heading / 2);
  const PoseTurns further{character_->pool.skeleton.roles.hips, half, fading};
  put(placed, half, workspace_->unpacked.sample(source, at, further, pose.rotations.data()), pose);
}

void Playback::sample_stitched(Placed placed, double seconds, bool looks, WorldPose& pose) const {
  placed.seconds = seconds;
  if (stitching_ != Stitching::inertialize) return sample(placed, pose);
  const double time = std::max(0.0, stitched_ + seconds);
  const Fade left = inertialization_.left(time);
  sample(placed, pose, inertialization_.turns(left));
  if (looks) look_.apply(time, inertialization_, clip(placed), pose);
  inertialization_.move(left, pose);
}

void Playback::sample(double seconds, WorldPose& pose) const { sample_stitched(now_, seconds, true, pose); }

void Playback::sample_body(double seconds, WorldPose& pose) const { sample_stitched(now_, seconds, false, pose); }

Vector2 Playback::start(int fragment) { return start(place(style_, fragment, frame_)); }

Vector2 Playback::start_move(int part) { return start(place(0, part, frame_)); }

Vector2 Playback::start(const Placed& next) {
  const bool inertializes = stitching_ == Stitching::inertialize;
  if (inertializes && goes_on(next)) return go_on(next);
  before_ = now_;
  const Vector2 went = far_away_ ? mean_travel().velocity : Vector2::Zero();
  play(next);
  Vector2 faster = Vector2::Zero();
  if (inertializes && stitch_ > 0) faster = far_away_ ? begin_far_stitch(before_, went) : begin_stitch(before_);
  stitched_ = 0;
  faded_ = inertializes ? 0 : std::min(stitch_, left());
  steps_.advance(standing_feet(0), 0);
  find_frame();
  return faster;
}

// Its take, and the stitch under way, go on.
Vector2 Playback::go_on(const Placed& next) {
  Placed placed = now_;
  placed.number = next.number;
  placed.seconds = 0;
  stitched_ += now_.seconds;
  before_ = now_;
  play(placed);
  return Vector2::Zero();
}

// Keeps the pose, and of velocities that of the mean of the steps alone.
Vector2 Playback::begin_far_stitch(const Placed& old, const Vector2& went) {
  auto& [shown, unused, fresh, unused_too] = workspace_->poses;
  sample_stitched(old, old.seconds, true, shown);
  sample(now_, fresh);
  inertialization_.begin(shown, shown, fresh, fresh, 1, stitch_, &clip(now_));
  look_.clear();
  return went - mean_travel().velocity;
}

// Begins a stitch from the old fragment, as it is shown, to the one that plays now; returns what start() does.
Vector2 Playback::begin_stitch(const Placed& old) {
  auto& [old_now, old_later, fresh, fresh_later] = workspace_->poses;
  sample_stitched(old, old.seconds, true, old_now);
  if (fragment(old).first_played() + (old.seconds + kGameStep) * clip(old).rate <= clip(old).frames - 1) {
    sample_stitched(old, old.seconds + kGameStep, true, old_later);
  } else {
    sample_stitched(old, old.seconds - kGameStep, true, fresh);
    extrapolate(fresh, old_now, old_later);
  }
  sample(now_, fresh);
  Placed later = now_;
  later.seconds += kGameStep;
  sample(later, fresh_later);
  const PackedClip& played = clip(now_);
  const Vector2 faster = inertialization_.begin(old_now, old_later, fresh, fresh_later, kGameStep, stitch_, &played);
  look_.begin(old_now, old_later, fresh, fresh_later, kGameStep, stitch_, turning_, played, inertialization_);
  return PlaneTurn(-frame_.heading) * faster;
}

void Playback::advance(double seconds) {
  const double before = at();
  now_.seconds += seconds;
  pass_markers(before, at());
  before_.seconds += seconds;
  steps_.advance(standing_feet(now_.seconds), seconds);
}

// Those of the clip that plays after a frame of it, until another.
void Playback::pass_markers(double after, double until) {
  for (const Marker& marker : clip(now_).markers) {
    const double frame = marker.frame - kFloatRounding;
    if (frame <= after || frame > until) continue;
    if (passed_.count < static_cast<int>(passed_.markers.size())) passed_.markers[passed_.count++] = &marker;
  }
}

void Playback::move(const Vector2& velocity, double turn_rate, double seconds) {
  turning_ = turn_rate;
  const Vector2 root = frame_.position, way = seconds * (facing_ * velocity);
  const PlaneTurn turn(seconds * turn_rate);
  for (Placed* placed : {&now_, &before_}) {
    placed->heading += seconds * turn_rate;
    placed->offset = root + way + turn * (placed->offset - root);
  }
}

void Playback::show() {
  WorldPose& shown = workspace_->shown;
  sample(now_.seconds, shown);
  if (stitching_ == Stitching::crossfade && now_.seconds < faded_)
    crossfade(ease_in_ease_out(now_.seconds / faded_), shown);
  stand(shown);
}

void Playback::find_frame() {
  if (stitching_ == Stitching::crossfade) return show();
  WorldPose place;
  put(now_, PlaneTurn(now_.heading / 2), root_at(clip(now_), at()), place);
  inertialization_.move(inertialization_.left(stitched_ + now_.seconds), place);
  stand(place);
}

void Playback::stand(const WorldPose& pose) {
  frame_ = {pose.root.head<2>(), pose.heading};
  facing_ = PlaneTurn(pose.heading);
}

// Goes so far from what played before to the pose.
void Playback::crossfade(double weight, WorldPose& pose) const {
  WorldPose& old = workspace_->poses[0];
  sample(before_, old);
  blend_rotations(old.rotations.data(), pose.rotations.data(), weight, workspace_->kinematics.bones(),
                  pose.rotations.data());
  pose.root = old.root + weight * (pose.root - old.root);
  pose.heading = old.heading + weight * (pose.heading - old.heading);
}

bool Playback::is_jumping() const {
  const Fragment& f = fragment();
  const double landed = f.end + f.lead_out / 2.0 - f.first_played();
  return f.evident.jumps() && now_.seconds * clip(now_).rate < landed;
}

bool Playback::has_landed() const {
  if (contacts().feet[0].empty()) return !is_jumping();
  const Fragment& f = fragment();
  const bool flown = now_.seconds * clip(now_).rate >= f.end - f.first_played();
  return !f.evident.jumps() || (flown && !is_in_the_air());
}

std::size_t Playback::frame_of_clip(double seconds) const {
  const PackedClip& source = clip(now_);
  const double at = std::min(source.frames - 1.0, std::max(0.0, fragment().first_played() + seconds * source.rate));
  const auto before = static_cast<std::size_t>(at);
  return before + (at - static_cast<double>(before) < 0.5 ? 0 : 1);
}

std::array<bool, 2> Playback::standing_feet(double seconds) const {
  return fragmotion::standing_feet(contacts(), frame_of_clip(seconds));
}

double Playback::until_standing(int side) const {
  const Fragment& f = fragment();
  const double rate = clip(now_).rate, at = f.first_played() + now_.seconds * rate;
  const std::vector<bool>& stands = contacts().feet[side];
  std::size_t next = frame_of_clip();
  while (next < stands.size() && !stands[next]) ++next;
  return std::max(0.0, (static_cast<double>(next) - at) / rate);
}

BothStand Playback::both_stand() const {
  const Contacts& contacts = this->contacts();
  const std::size_t frames = contacts.feet[0].size(), now = frame_of_clip();
  const int stance = contacts.stands(0, now) ? 0 : 1;
  std::size_t begins = now;
  while (contacts.stands(stance, begins) && !contacts.both_stand(begins)) ++begins;
  if (!contacts.both_stand(begins)) return {};
  std::size_t ends = begins + 1;
  while (ends < frames && contacts.both_stand(ends)) ++ends;
  const double rate = clip(now_).rate, at = fragment().first_played() + now_.seconds * rate;
  const double from = begins > now ? static_cast<double>(begins) : at;
  return {(from - at) / rate, std::max(1.0, static_cast<double>(ends) - from) / rate};
}

bool Playback::is_in_the_air() const {
  if (!evident().jumps()) return false;
  return !contacts().feet[0].empty() && !contacts().any_stands(frame_of_clip());
}

double Playback::left() const {
  const Fragment& f = fragment();
  return (f.last_played() - f.first_played()) / clip(now_).rate - now_.seconds;
}

double Playback::step_seconds() const {
  return plays_move() ? kLongestStep : (*workspace_->styles)[now_.style].step_seconds[now_.number];
}

Travel Playback::mean_travel() const {
  if (far_away_)
    return {{evident_of_hips_.x, evident_of_hips_.y}, evident_of_hips_.turn * styled(now_).space.turn_rate()};
  const PackedClip& source = clip(now_);
  Travel travel = travel_around(source, fragment().first_played() + now_.seconds * source.rate, step_seconds());
  travel.velocity += beside_ends_;
  return travel;
}

Vector2 Playback::velocity() const {
  auto& [before, now, unused, unused_too] = workspace_->poses;
  sample(now_.seconds - kGameStep, before);
  sample(now_.seconds, now);
  return PlaneTurn(-frame_.heading) * (now.root - before.root).head<2>() / kGameStep;
}

}  // namespace fragmotion
