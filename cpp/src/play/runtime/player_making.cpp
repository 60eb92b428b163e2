// SPDX-License-Identifier: MIT
// What makes players, once.
#include <stdexcept>
#include <utility>

#include "feet/ground_follower.hpp"
#include "runtime/player.hpp"

namespace fragmotion {
namespace {

double within_one(double value, const char* name) {
  if (value >= 0 && value <= 1) return value;
  throw std::invalid_argument(std::string("the ") + name + " must be 0 to 1");
}

}  // namespace

Player::Player(std::shared_ptr<const Character> character, const PlayerOptions& options)
    : Player(character, options, std::make_shared<Workspace>(*character, options.constants)) {
  complete(options);
}

// Makes what a player of a crowd may lack.
void Player::complete(const PlayerOptions& options) {
  reaching_ = std::make_shared<Reaching>(*workspace_);
  reaching_->apply(ground_level(), 0);
  make_extras(options);
}

Player::Player(std::shared_ptr<const Character> character, const PlayerOptions& options,
               std::shared_ptr<Workspace> workspace)
    : character_(std::move(character)),
      workspace_(std::move(workspace)),
      governor_(*character_, workspace_->constants.root, workspace_->settles,
                within_one(options.root_adjustment, "root adjustment"),
                within_one(options.responsiveness, "responsiveness")),
      director_(*character_, character_->policy(options.policy), options.responsiveness),
      selector_(*workspace_, options.seed),
      playback_(*character_, *workspace_, options.stitching, within_one(options.stitch, "stitching time, in s,")),
      correction_(*character_, *workspace_, options.lock_feet),
      gaze_(*workspace_) {
  set_far_away(options);
  reset();
}

void Player::set_options(const PlayerOptions& options) {
  const double responsiveness = within_one(options.responsiveness, "responsiveness"),
               stitch = within_one(options.stitch, "stitching time, in s,"),
               adjustment = within_one(options.root_adjustment, "root adjustment");
  governor_.set(adjustment, responsiveness);
  director_.set_responsiveness(responsiveness);
  playback_.set_stitch(stitch);
  set_far_away(options);
  if (extras_ != nullptr) extras_->upper_body.set_stitch(stitch);
}

void Player::set_far_away(const PlayerOptions& options) {
  far_away_ = options.far_away;
  director_.set_plans(!far_away_);
  playback_.set_far_away(far_away_);
  correction_.set_feet(options.lock_feet && !far_away_, !far_away_);
}

Player Player::another(const PlayerOptions& options) const {
  Player player(character_, options, std::make_shared<Workspace>(workspace_->another()));
  player.complete(options);
  return player;
}

Player Player::branch() const {
  Player player(*this);
  if (reaching_ != nullptr) player.reaching_ = std::make_shared<Reaching>(*reaching_);
  if (extras_ != nullptr) player.extras_ = std::make_shared<Extras>(*extras_);
  if (follower_ != nullptr) player.follower_ = std::make_shared<GroundFollower>(*follower_);
  return player;
}

}  // namespace fragmotion
