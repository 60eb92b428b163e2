// SPDX-License-Identifier: MIT
#include "feet/foot_on_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "feet/standing_leg.hpp"

namespace fragmotion {
namespace {

constexpr int kTrials = 8;  // times that a sole is moved off an edge, to the front and to the back

// The height of a foot's clearance at a part of its way: full but close to where it leaves and lands, for an edge there
// is passed from above.
double arch(double part) {
  double power = 2 * part - 1;
  for (int i = 0; i < 4; ++i) power *= power;
  return 1 - power;
}

}  // namespace

bool FootOnGround::advance(const FootAhead& foot, double lower, double seconds, GroundProbe& probe, int spared) {
  metre_ = probe.metre();
  const Vector2 place = foot.now.place() + shift();
  const double planned = height_on_way(place, seconds);
  due_ = foot.stands ? 0 : foot.due;
  swing_time_ = foot.stands ? 0 : swing_time_ + seconds;
  if (foot.stands) {
    stand(foot, probe, spared);
  } else {
    swing(foot, probe, spared);
  }
  advance_shift(foot, fresh_ ? kSettles : seconds);
  if (!fresh_) error_.value += planned - height_on_way(place, 0);
  error_.advance(0, std::max(due_, kSettles), seconds);
  if (!foot.stands) clear(foot, lower, seconds, probe);
  const Vector2 now = foot.now.place() + shift();
  plane_ = on_way(now, 0);
  lift_ = lift(now, 0);
  bear(foot, seconds);
  stood_ = foot.stands;
  fresh_ = false;
  return found_;
}

void FootOnGround::stand(const FootAhead& foot, GroundProbe& probe, int spared) {
  const bool lands = fresh_ || !stood_;
  clearance_ = {};
  probe.spare(spared + kAsksAtLeast);
  if (lands) beside_ = fresh_ ? beside_edges(foot, probe) : shift();
  const Sole sole = foot.landing().moved(beside_);
  if (lands || !found_ || (sole.place() - last_.place).norm() > kThere * metre_) {
    const std::optional<Footing> under = ask_under(sole, probe);
    next_ = under.value_or(lands && !fresh_ ? Footing{sole.place(), next_.height, next_.slope}
                                            : Footing{sole.place(), last_.at(sole.place()), last_.slope});
    last_ = next_;
    found_ = under.has_value();
  }
  probe.spare(spared);
  const double edges = known_.edges(sole, probe);
  if (edges >= KnownGround::kInTheWay || (lands && edges > 0)) beside_ = beside_edges(foot, probe);
}

void FootOnGround::swing(const FootAhead& foot, GroundProbe& probe, int spared) {
  if (fresh_ || stood_) next_ = last_;
  probe.spare(spared + kAsksAtLeast);
  beside_ = beside_edges(foot, probe);
  const Sole sole = foot.landing().moved(beside_);
  const std::optional<Footing> under = ask_under(sole, probe);
  next_ = under.value_or(Footing{sole.place(), next_.height, next_.slope});
  if (fresh_) last_ = next_;
  found_ = under.has_value();
  probe.spare(spared);
}

std::optional<Footing> FootOnGround::ask_under(const Sole& sole, GroundProbe& probe) {
  std::array<std::optional<Footing>, 3> points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = known_.ask(sole.points()[i].head<2>(), probe);
  return plane_under(sole, points);
}

// The least move that sets a sole beside edges, rather on the tread that it was on its way to.
Vector2 FootOnGround::beside_edges(const FootAhead& foot, GroundProbe& probe) {
  const Sole& sole = foot.landing();
  const Vector2 along = (sole.tip - sole.heel).head<2>().normalized();
  const bool planned = !fresh_ && !stood_;
  const double keeps = kLoading / std::max(due_, kSettles);  // the sooner it lands, the more
  double least = std::numeric_limits<double>::infinity();
  Vector2 best = Vector2::Zero();
  for (int i = 0; i <= 2 * kTrials; ++i) {
    const int steps = (i + 1) / 2;
    const Vector2 moved = (i % 2 == 0 ? kTried : -kTried) * metre_ * steps * along;
    if (moved.norm() >= least * metre_) break;
    const Sole there = sole.moved(moved);
    const std::optional<Footing> ground = planned ? known_.at(there.place(), {along, kThere}, probe) : std::nullopt;
    const double off = ground ? std::abs(ground->height - next_.height) : 0;
    const double cost = (moved.norm() + keeps * off) / metre_ + known_.edges(there, probe);
    if (cost < least) least = cost, best = moved;
  }
  return best;
}

void FootOnGround::advance_shift(const FootAhead& foot, double seconds) {
  const double due = fresh_ ? 0 : foot.stands ? kSettles : std::max(due_, kSettles);
  for (int axis = 0; axis < 2; ++axis) shift_[axis].advance(beside_[axis], due, seconds);
}

double FootOnGround::part_of_way(const Vector2& place, double later) const {
  const double pace = kStandingSpeed * metre_, gone = (place - last_.place).norm() + pace * (swing_time_ + later),
               left = (next_.place - place).norm() + pace * std::max(0.0, due_ - later);
  return gone + left > 0 ? gone / (gone + left) : 1;
}

// The plane under the foot at a place on its way, so many seconds from now.
Footing FootOnGround::on_way(const Vector2& place, double later) const {
  const double part = part_of_way(place, later);
  return {place, (1 - part) * last_.at(place) + part * next_.at(place), (1 - part) * last_.slope + part * next_.slope};
}

// How much it clears what is in its way at a place on it.
double FootOnGround::lift(const Vector2& place, double later) const {
  return std::max(clearance_.value, 0.0) * arch(part_of_way(place, later));
}

double FootOnGround::height_on_way(const Vector2& place, double later) const {
  return on_way(place, later).height + lift(place, later);
}

// Steps over what is in its way, in one arch.
void FootOnGround::clear(const FootAhead& foot, double lower, double seconds, GroundProbe& probe) {
  const Vector2 now = foot.now.place() + shift();
  const KnownGround::Along along{(foot.landing().place() + beside_ - now).normalized(), kApart};
  double wanted = 0;
  for (std::size_t i = 0; i < FootAhead::kPoints; ++i) {
    const double u = static_cast<double>(i + 1) / FootAhead::kPoints, later = u * due_;
    const Sole at = foot.way[i].moved(shift() + u * (beside_ - shift()));
    const double over = known_.over(at, lower, on_way(at.place(), later), along, probe);
    wanted = std::max(wanted, over + std::min(over, kUneven * metre_));
  }
  clearance_.advance(std::min(wanted, kHighestStep * metre_), fresh_ ? 0 : kLoading, seconds);
}

void FootOnGround::bear(const FootAhead& foot, double seconds) {
  const double wanted = foot.stands ? 1 : std::max(0.0, 1 - std::min(due_, swing_time_) / kLoading),
               most = fresh_ ? 1 : seconds / kLoading;
  weight_ += std::clamp(wanted - weight_, -most, most);
}

}  // namespace fragmotion
