// SPDX-License-Identifier: MIT
#include "skeleton/two_bone_ik.hpp"

#include <algorithm>
#include <cmath>

#include "base/pair.hpp"
#include "base/rounding.hpp"
#include "base/turn_between.hpp"

namespace fragmotion {
namespace {

constexpr double kStraight = 0.1;  // rad: a knee that is bent less than that resists being bent backward
constexpr double kFolded = 2.5;    // rad: a knee that is bent more resists being folded up

const double kBendsWell = std::cos(kStraight), kFoldsWell = std::cos(kFolded);
// Of a leg's length: what it reaches at most, thigh and shin kStraight off the line between its ends, unless it does
// already; and what is left to it where it tires.
const double kStretched = kBendsWell, kRest = kStretched - kTires;

double softly(double distance) {
  return distance < kTires ? distance : kTires + kRest * (1 - std::exp((kTires - distance) / kRest));
}

// How far apart the ends of a leg come that are `now` apart and would be `wanted`, all in lengths of the leg. Where
// they are wanted as they are, they stay.
double apart(double now, double wanted) {
  if (wanted <= kTires) return wanted;
  const double share = now > kTires ? std::min(1.0, (wanted - kTires) / (now - kTires)) : 0;
  return std::min(softly(wanted) + share * (now - softly(now)), std::max(now, kStretched));
}

double square(double value) { return value * value; }

// The rotation about a unit axis by half a turn, or nearly so.
[[gnu::cold]] Quaternion half_turn(const Vector3& axis, double cosine, double sine) {
  return Quaternion{Eigen::AngleAxisd(std::atan2(sine, cosine), axis)};
}

// Rotations about unit axes by angles that are told by their cosines and their sines.
TurnPair rotations(const VectorPair& axes, const Pair& cosine, const Pair& sine) {
  const Pair w = root((1 + cosine) / 2), along = sine / (2 * w);
  TurnPair turns{w, along * axes.x, along * axes.y, along * axes.z};
  for (int i = 0; i < 2; ++i) {
    if (1 + cosine[i] <= kFloatRounding) turns.set(i, half_turn(axes[i], cosine[i], sine[i]));
  }
  return turns;
}

// How a knee is bent. Squares of lengths, m: of the upper leg, and of the lower one along the knee's axis and across
// it.
struct Bend {
  double upper, beside, across, length, twice, cosine, sine;

  // How far apart the leg's ends come that would be `wanted`, m: wanted near to where it is, it may go as the knee
  // does.
  [[gnu::noinline]] double ends(double wanted) const {
    const double now = distance(cosine), natural = bends_well() ? now : distance(std::cos(bearable()));
    wanted /= length;
    wanted += std::max(0.0, 1 - std::abs(wanted - now) / kRest) * (natural - now);
    return length * apart(natural, wanted);
  }

  // The same of an arm, which may be bent as it is; a straight one stays so by as much as `weight` is below 1.
  double ends_of_arm(double wanted, double weight) const {
    wanted /= length;
    const double as_it_is = apart(distance(cosine), wanted);
    return std::max(folded_up(), length * (as_it_is + weight * (softly(wanted) - as_it_is)));
  }

  // How near the leg's ends come, m: as near as they are, or as where it resists being folded up.
  double folded_up() const { return length * std::min(distance(cosine), distance(kFoldsWell)); }

 private:
  bool bends_well() const { return sine > 0 && cosine < kBendsWell && cosine > kFoldsWell; }

  // The knee's bend, rad, which neither goes backward nor folds up the leg: a stitch may overshoot.
  double bearable() const {
    double bend = std::atan2(sine, cosine);
    if (bend < -kPi / 2) bend += 2 * kPi;  // it is folded further than flat, rather than bent backward
    if (bend > kFolded) return kFolded + kStraight * (1 - std::exp((kFolded - bend) / kStraight));
    return kStraight * std::exp(bend / kStraight - 1);
  }

  // Between the leg's ends, in lengths of the leg, by the cosine of the bend.
  double distance(double of_cosine) const {
    return std::sqrt(std::max(0.0, upper + across + beside + twice * of_cosine)) / length;
  }
};

// The knees of two legs, each bent about its hinge.
class Knees {
 public:
  Knees(const VectorPair& upper, const VectorPair& lower, const VectorPair& hinges);

  Bend operator[](int i) const {
    return {upper_[i], beside_[i], across_[i], length_[i], twice_[i], cosine_[i], sine_[i]};
  }

  // What turns the first one back to where it is if it is bent backward, by this share.
  Quaternion backward(double share) const {
    return Quaternion{Eigen::AngleAxisd(share * 2 * std::min(0.0, std::atan2(sine_[0], cosine_[0])), axes_[0])};
  }

  // What turns the lower legs for the legs' ends to be so far apart.
  TurnPair bent_by(const Pair& ends) const;

 private:
  Pair upper_;
  VectorPair axes_;
  Pair beside_, across_, length_, twice_, cosine_, sine_;
};

[[gnu::noinline]] Knees::Knees(const VectorPair& upper, const VectorPair& lower, const VectorPair& hinges)
    : upper_(dot(upper, upper)), axes_(hinges - dot(hinges, upper) / upper_ * upper) {
  Pair length = root(dot(axes_, axes_));
  for (int i = 0; i < 2; ++i) length[i] = length[i] > 0 ? length[i] : 1;
  axes_ = axes_ / length;
  const Pair along = dot(lower, axes_);
  beside_ = along * along;
  across_ = dot(lower, lower) - beside_;
  for (int i = 0; i < 2; ++i) across_[i] = std::max(kFloatRounding * kFloatRounding, across_[i]);
  length_ = root(upper_) + root(beside_ + across_);
  twice_ = 2 * root(upper_ * across_);
  cosine_ = 2 * dot(upper, lower) / twice_;
  sine_ = 2 * dot(axes_, cross(upper, lower)) / twice_;
}

[[gnu::noinline]] TurnPair Knees::bent_by(const Pair& ends) const {
  Pair cosine = (ends * ends - beside_ - across_ - upper_) / twice_;
  for (int i = 0; i < 2; ++i) cosine[i] = std::clamp(cosine[i], -1.0, 1.0);
  const Pair sine = root((1 - cosine) * (1 + cosine));
  return rotations(axes_, cosine * cosine_ + sine * sine_, sine * cosine_ - cosine * sine_);
}

// As turn_between() of each.
TurnPair turns_between(const VectorPair& from, const VectorPair& to) {
  const Pair product = root(dot(from, from) * dot(to, to)), w = product + dot(from, to);
  const VectorPair axis = cross(from, to);
  const Pair square = axis.x * axis.x + axis.y * axis.y + (axis.z * axis.z + w * w), length = root(square);
  TurnPair turns{w / length, axis.x / length, axis.y / length, axis.z / length};
  for (int i = 0; i < 2; ++i) {
    const bool is_plain = product[i] > 0 && !std::isinf(product[i]) && w[i] > kFloatRounding * product[i];
    if (!is_plain || !(square[i] > 0)) turns.set(i, turn_between(from[i], to[i]));
  }
  return turns;
}

// Places and rotations of the same bone of two legs, and of those above it.
struct PosedLegs {
  const Skeleton& skeleton;
  const LegPair& legs;
  const PosedBones& posed;

  VectorPair heads(int Leg::*bone) const { return {posed.heads[legs[0]->*bone], posed.heads[legs[1]->*bone]}; }
  VectorPair ankles() const { return {ankle_of(*legs[0], posed), ankle_of(*legs[1], posed)}; }
  VectorPair hinges() const { return {legs[0]->hinge, legs[1]->hinge}; }
  TurnPair turns(int Leg::*bone) const { return {posed.rotations[legs[0]->*bone], posed.rotations[legs[1]->*bone]}; }
  TurnPair above(int Leg::*bone) const {
    const std::vector<int>& parents = skeleton.parents;
    return {posed.rotations[parents[legs[0]->*bone]], posed.rotations[parents[legs[1]->*bone]]};
  }
};

// The leg from a thigh to a foot that has a knee between them; none where the thigh carries the body or both legs. What
// does not hang from the foot is no toe of it.
Leg leg_of(const Skeleton& skeleton, int thigh, int foot, int toe, int other_foot) {
  const int hips = skeleton.roles.hips;
  const bool hangs = thigh != hips && skeleton.is_below(thigh, hips) && skeleton.is_below(foot, thigh);
  if (!hangs || foot == thigh || skeleton.is_below(other_foot, thigh)) return {};
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  const bool has_toe = toe != foot && skeleton.is_below(toe, foot);
  Leg leg{thigh, -1, foot, has_toe ? toe : -1, skeleton.parents[foot]};
  double most = kFileRounding / standard_scale(skeleton);
  if (ends_without_foot(skeleton, {thigh, foot, toe})) {
    leg.ankle = skeleton.tips[foot];
    if (skeleton.offsets[foot].norm() > most && leg.ankle.norm() > most) leg.knee = foot;
    return leg;
  }
  for (int b = leg.above_foot; b != thigh; b = skeleton.parents[b]) {
    const double shorter = std::min((heads[b] - heads[thigh]).norm(), (heads[foot] - heads[b]).norm());
    if (shorter > most) most = shorter, leg.knee = b;
  }
  return leg;
}

// To the character's left at rest, as thighs and feet see it.
void hinge_at_rest(const Skeleton& skeleton, Leg& of_left, Leg& of_right) {
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  const Vector3 left = (heads[of_left.thigh] - heads[of_right.thigh]).normalized();
  for (Leg* leg : {&of_left, &of_right}) {
    leg->hinge = rotations[leg->thigh].conjugate() * left;
    leg->across = rotations[leg->foot].conjugate() * left;
  }
}

// How well two joints serve as shoulder and elbow of a hand, m.
double evenness(const Vector3& shoulder, const Vector3& elbow, const Vector3& hand) {
  const double upper = (elbow - shoulder).norm(), lower = (hand - elbow).norm();
  return square(std::min(upper, lower)) / std::max({upper, lower, kFloatRounding});
}

// The arm to a hand from below the bone `trunk`, which carries both.
Arm arm_of(const Skeleton& skeleton, int trunk, int hand, int other_hand) {
  if (hand < 0 || hand == trunk || skeleton.is_below(other_hand, hand)) return {};
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  Arm arm{-1, -1, hand};
  double best = kFileRounding / standard_scale(skeleton);
  for (int elbow = skeleton.parents[hand]; elbow != trunk; elbow = skeleton.parents[elbow]) {
    for (int upper = skeleton.parents[elbow]; upper != trunk; upper = skeleton.parents[upper]) {
      const double found = evenness(heads[upper], heads[elbow], heads[hand]);
      if (found > best) best = found, arm.upper = upper, arm.elbow = elbow;
    }
  }
  return arm;
}

// The lowest bone that carries both; -1 where there is none.
int carrier(const Skeleton& skeleton, int a, int b) {
  while (a >= 0 && !skeleton.is_below(b, a)) a = skeleton.parents[a];
  return a;
}

}  // namespace

std::array<Arm, 2> resting_arms(const Skeleton& skeleton) {
  const Roles& roles = skeleton.roles;
  if (roles.left_hand < 0 || roles.right_hand < 0) return {};
  const int trunk = carrier(skeleton, roles.left_hand, roles.right_hand);
  if (trunk < 0 || !skeleton.is_below(trunk, roles.hips)) return {};
  return {arm_of(skeleton, trunk, roles.left_hand, roles.right_hand),
          arm_of(skeleton, trunk, roles.right_hand, roles.left_hand)};
}

Vector3 palm(const Skeleton& skeleton, const Arm& arm, const PosedBones& posed) {
  return posed.heads[arm.hand] + posed.rotations[arm.hand] * (skeleton.tips[arm.hand] / 2);
}

double arm_length(const Skeleton& skeleton, const Arm& arm, const PosedBones& posed) {
  const Vector3& elbow = posed.heads[arm.elbow];
  return (elbow - posed.heads[arm.upper]).norm() + (palm(skeleton, arm, posed) - elbow).norm();
}

[[gnu::cold]] void reach(const Skeleton& skeleton, const Arm& arm, const PosedBones& posed, const Vector3& place,
                         double weight, const Vector3& halfway, double* rotations) {
  const Vector3 upper = posed.heads[arm.elbow] - posed.heads[arm.upper],
                lower = palm(skeleton, arm, posed) - posed.heads[arm.elbow], way = place - posed.heads[arm.upper];
  const Vector3 hinge = posed.rotations[arm.upper] * arm.hinge;
  const Knees elbow({upper, upper}, {lower, lower}, {hinge, hinge});
  const double ends = elbow[0].ends_of_arm(way.norm(), weight);
  const Quaternion bend = elbow.backward(1 - weight) * elbow.bent_by(Pair{ends, ends})[0],
                   swing = turn_between(halfway, way) * turn_between(upper + bend * lower, halfway);
  const auto turn = [&](int bone, const Quaternion& by) {
    const Quaternion& parent = posed.rotations[skeleton.parents[bone]];
    store_quaternion((parent.conjugate() * by * posed.rotations[bone]).normalized(),
                     rotations + std::ptrdiff_t{4} * bone);
  };
  turn(arm.upper, swing);
  turn(arm.elbow, bend);
}

[[gnu::cold]] Legs resting_legs(const Skeleton& skeleton) {
  const std::array<LegRoles, kMostLegs> roles = leg_roles(skeleton.roles);
  Legs legs;
  for (int left = 0; left < kMostLegs; left += 2) {
    const LegRoles &of_left = roles[left], &of_right = roles[left + 1];
    const Leg pair[] = {leg_of(skeleton, of_left.thigh, of_left.foot, of_left.toe, of_right.foot),
                        leg_of(skeleton, of_right.thigh, of_right.foot, of_right.toe, of_left.foot)};
    if (!pair[0].exists() || !pair[1].exists()) break;
    legs[left] = pair[0], legs[left + 1] = pair[1];
    hinge_at_rest(skeleton, legs[left], legs[left + 1]);
  }
  return legs;
}

Vector3 ball(const Skeleton& skeleton, int foot, int toe, const PosedBones& posed) {
  if (toe >= 0) return posed.heads[toe];
  return posed.heads[foot] + turned(posed.rotations[foot], skeleton.tips[foot]);
}

Vector3 ankle_of(const Leg& leg, const PosedBones& posed) {
  return leg.has_foot() ? posed.heads[leg.foot] : posed.heads[leg.foot] + posed.rotations[leg.foot] * leg.ankle;
}

Vector3 sole(const Skeleton& skeleton, const LegRoles& leg, const PosedBones& posed) {
  const Vector3 front = ball(skeleton, leg.foot, leg.toe, posed);
  if (ends_without_foot(skeleton, leg)) return front;
  const Vector3 &heel = posed.heads[leg.foot], middle = (heel + front) / 2;
  return {middle.x(), middle.y(), std::min(heel.z(), front.z())};
}

double leg_length(const Leg& leg, const PosedBones& posed) {
  const Vector3& knee = posed.heads[leg.knee];
  return (knee - posed.heads[leg.thigh]).norm() + (ankle_of(leg, posed) - knee).norm();
}

double longest(const Leg& leg, const PosedBones& posed) { return kStretched * leg_length(leg, posed); }

double shortest(const Leg& leg, const PosedBones& posed) {
  const Vector3 upper = posed.heads[leg.knee] - posed.heads[leg.thigh],
                lower = ankle_of(leg, posed) - posed.heads[leg.knee],
                hinge = turned(posed.rotations[leg.thigh], leg.hinge);
  const Knees knee({upper, upper}, {lower, lower}, {hinge, hinge});
  return std::min(knee[0].folded_up(), longest(leg, posed));  // a short lower leg hardly folds the leg up
}

// Turns the lower legs and swings the legs towards their ankles; the feet keep their rotations.
void reach(const Skeleton& skeleton, const LegPair& legs, const PosedBones& posed, const std::array<Vector3, 2>& ankles,
           double* rotations, const Reach* within) {
  const PosedLegs pair{skeleton, legs, posed};
  const VectorPair hips = pair.heads(&Leg::thigh), knees = pair.heads(&Leg::knee), upper = knees - hips,
                   lower = pair.ankles() - knees, way = VectorPair{ankles[0], ankles[1]} - hips;
  const TurnPair thighs = pair.turns(&Leg::thigh);
  const Knees bent(upper, lower, turned(thighs, pair.hinges()));
  Pair ends = root(dot(way, way));
  for (int i = 0; i < 2; ++i)
    ends[i] = within != nullptr ? std::clamp(ends[i], within[i].least, within[i].most) : bent[i].ends(ends[i]);
  const TurnPair bend = bent.bent_by(ends), swing = turns_between(upper + turned(bend, lower), way);
  // A shin that is the foot is written again, as the knee.
  const struct {
    int Leg::*bone;
    TurnPair above, world;
  } turns[] = {{&Leg::foot, product(swing, product(bend, pair.above(&Leg::foot))), pair.turns(&Leg::foot)},
               {&Leg::thigh, pair.above(&Leg::thigh), product(swing, thighs)},
               {&Leg::knee, pair.above(&Leg::knee), product(bend, pair.turns(&Leg::knee))}};
  for (const auto& [bone, above, world] : turns) {
    const TurnPair local = rounded_off(product(above.conjugate(), world));
    for (int i = 0; i < 2; ++i) store_quaternion(local[i], rotations + std::ptrdiff_t{4} * (legs[i]->*bone));
  }
}

void reach(const Skeleton& skeleton, const Leg& leg, const PosedBones& posed, const Vector3& ankle, double* rotations) {
  reach(skeleton, {&leg, &leg}, posed, {ankle, ankle}, rotations);
}

void reach(const Skeleton& skeleton, const Leg& leg, const PosedBones& posed, const Vector3& ankle, const Reach& within,
           double* rotations) {
  const Reach both[] = {within, within};
  reach(skeleton, {&leg, &leg}, posed, {ankle, ankle}, rotations, both);
}

}  // namespace fragmotion
