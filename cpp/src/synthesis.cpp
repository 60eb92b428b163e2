// SPDX-License-Identifier: MIT
#include "fragmotion/synthesis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fragmotion/distance.hpp"
#include "fragmotion/foot_lock.hpp"
#include "fragmotion/mirror.hpp"
#include "fragmotion/pose.hpp"

namespace fragmotion {
namespace {

constexpr double kJumpHeight = 0.22;  // m, of a 1.8 m character
constexpr double kCrouch = 0.16;      // of a hop's time: before it, and after it
constexpr double kTuck = 0.35;        // of the body's height: how much further the feet are lifted
constexpr double kSimilar = 0.12;     // m a bone tip: fragments this near may be interpolated
constexpr int kCandidates = 24;       // neighbours of a control that interpolation tries in pairs
constexpr double kHurry = 1.2;        // the most by which steps are hurried, or slowed down
constexpr double kStandSeconds = 0.5;
constexpr double kShortestCycle = 0.4, kLongestCycle = 1.4;  // s
constexpr double kAlike = 1e-6;                              // of effort
constexpr double kClosed = 3;                                // m: Dis between the ends of a cycle

// A pose seen from its character frame: the hips' height, and rotations with the hips' relative to the frame.
struct BodyPose {
  CharacterFrame frame;
  double height = 0;
  std::vector<double> rotations;
};

BodyPose body_pose(const Kinematics& kinematics, const Clip& clip, double at) {
  BodyPose pose;
  pose.rotations.resize(std::size_t{4} * kinematics.bones());
  const Vector3 root = sample_pose(clip, at, pose.rotations.data());
  double* hips = &pose.rotations[std::size_t{4} * kinematics.skeleton().roles.hips];
  pose.frame = frame_at(clip, at);
  pose.height = root.z();
  store_quaternion(pose.frame.rotation().inverse() * load_quaternion(hips), hips);
  return pose;
}

void append(const Kinematics& kinematics, Clip& clip, const CharacterFrame& frame, const BodyPose& pose) {
  const Vector3 root{frame.position.x(), frame.position.y(), pose.height};
  clip.root_positions.insert(clip.root_positions.end(), root.data(), root.data() + 3);
  clip.headings.push_back(frame.heading);
  clip.rotations.insert(clip.rotations.end(), pose.rotations.begin(), pose.rotations.end());
  double* hips =
      &clip.rotations[std::size_t{4} * (clip.frames * kinematics.bones() + kinematics.skeleton().roles.hips)];
  store_quaternion(frame.rotation() * load_quaternion(hips), hips);
  ++clip.frames;
}

Vector2 turned(const Vector2& v, double angle) { return Eigen::Rotation2Dd(angle) * v; }

double angle_between(const Control& a, const Control& b) {
  return std::remainder(std::atan2(b.y, b.x) - std::atan2(a.y, a.x), 2 * kPi);
}

Control mix(const Control& a, const Control& b, double w) {
  return {a.x + w * (b.x - a.x), a.y + w * (b.y - a.y), a.turn + w * (b.turn - a.turn), a.jump + w * (b.jump - a.jump)};
}

double speed(const Control& control) { return std::hypot(control.x, control.y); }

double lowest_tip(const Kinematics& kinematics, const Clip& clip, int frame) {
  std::vector<Vector3> heads(kinematics.bones());
  std::vector<Quaternion> orientations(kinematics.bones());
  kinematics.world(clip, frame, heads.data(), orientations.data());
  double lowest = std::numeric_limits<double>::infinity();
  for (const int b : measured_bones(kinematics.skeleton())) {
    lowest = std::min(lowest, (heads[b] + orientations[b] * kinematics.skeleton().tips[b]).z());
  }
  return lowest;
}

void add_to_mean(BodyPose& mean, const BodyPose& pose) {
  mean.height += pose.height;
  if (mean.rotations.empty()) mean.rotations.resize(pose.rotations.size(), 0);
  for (std::size_t b = 0; b < pose.rotations.size(); b += 4) {
    using Vector4 = Eigen::Vector4d;
    const Eigen::Map<const Vector4> q(&pose.rotations[b]);
    Eigen::Map<Vector4> sum(&mean.rotations[b]);
    sum += sum.dot(q) < 0 ? Vector4{-q} : Vector4{q};
  }
}

// Adds a fragment that stands in place.
void add_standing(FragmentPool& pool, const SynthesisOptions& options) {
  const double rate = pool.clips[0].rate;
  Fragment fragment;
  fragment.clip = static_cast<int>(pool.clips.size());
  fragment.end = static_cast<int>(std::lround(kStandSeconds * rate));
  fragment.origin = Origin::transformed;
  const int frames = fragment.end + 1 + static_cast<int>(std::lround(options.tail * rate));
  pool.clips.push_back(make_clip(pool.skeleton, standing(Kinematics(pool.skeleton), pool, frames, rate)));
  pool.fragments.push_back(fragment);
}

// One round of a gait, each pose seen from its character frame, and the way from each to the next.
struct Round {
  std::vector<BodyPose> poses;
  CharacterFrame end;  // where the next round begins

  int frames() const { return static_cast<int>(poses.size()); }
};

// Frames begin .. end of a clip. Where the last is not as the first, the second half leads to that.
Round round_of(const Kinematics& kinematics, const Clip& clip, int begin, int end) {
  Round round;
  for (int f = begin; f < end; ++f) round.poses.push_back(body_pose(kinematics, clip, f));
  const BodyPose first = round.poses.front(), last = body_pose(kinematics, clip, end);
  round.end = last.frame;
  for (int f = 0; f < round.frames(); ++f) {
    const double weight = ease_in_ease_out(2.0 * f / round.frames() - 1);
    BodyPose& pose = round.poses[f];
    pose.height += weight * (first.height - last.height);
    for (std::size_t b = 0; b < pose.rotations.size(); b += 4) {
      const Quaternion missing = load_quaternion(&first.rotations[b]) * load_quaternion(&last.rotations[b]).conjugate();
      const Quaternion by = Quaternion::Identity().slerp(weight, missing);
      store_quaternion((by * load_quaternion(&pose.rotations[b])).normalized(), &pose.rotations[b]);
    }
  }
  return round;
}

// The strides of a gait as its path is changed: what the balls of the feet do about their middle is turned and scaled
// like the path, so that a foot that stood still on the old path does so on the new one.
class Strides {
 public:
  Strides(const Kinematics& kinematics, const Legs& legs, const Round& round)
      : kinematics_(kinematics), legs_(legs), posed_(kinematics.bones()) {
    for (const BodyPose& body : round.poses) {
      pose(body);
      for (int side = 0; exist() && side < 2; ++side) middles_[side] += balls(side) / round.frames();
    }
  }

  void change(BodyPose& body, double direction, double scale) {
    if (!exist()) return;
    pose(body);
    for (int side = 0; side < 2; ++side) {
      const Vector2 stride = balls(side) - middles_[side], by = scale * turned(stride, direction) - stride;
      const Vector3 ankle = posed_.heads[legs_[side].foot] + Vector3{by.x(), by.y(), 0};
      reach(kinematics_.skeleton(), legs_[side], posed_, ankle, body.rotations.data());
    }
  }

 private:
  bool exist() const { return legs_[0].exists() && legs_[1].exists(); }
  void pose(const BodyPose& body) {
    kinematics_.world({0, 0, body.height}, body.rotations.data(), posed_.heads.data(), posed_.rotations.data());
  }
  Vector2 balls(int side) const { return ball(kinematics_.skeleton(), legs_[side], posed_).head<2>(); }

  const Kinematics& kinematics_;
  const Legs& legs_;
  std::array<Vector2, 2> middles_{Vector2::Zero(), Vector2::Zero()};
  PosedBones posed_;
};

// Keeps planted feet of a clip where they are. Its frames go round and round frames begin .. end of another clip, whose
// contacts these are.
void plant_feet(const Kinematics& kinematics, const Legs& legs, Clip& clip, const Contacts& contacts, int begin,
                int end) {
  if (contacts.feet[0].empty()) return;
  FootLock lock(kinematics, legs);
  WorldPose pose;
  pose.rotations.resize(std::size_t{4} * kinematics.bones());
  for (int f = 0; f < clip.frames; ++f) {
    double *root = &clip.root_positions[std::size_t{3} * f], *rotations = &clip.rotations[pose.rotations.size() * f];
    pose.root = load_vector(root);
    pose.heading = clip.headings[f];
    std::copy_n(rotations, pose.rotations.size(), pose.rotations.begin());
    lock.apply(pose, contacts, begin + f % (end - begin), f > 0 ? 1 / clip.rate : 0);
    store_vector(pose.root, root);
    std::copy(pose.rotations.begin(), pose.rotations.end(), rotations);
  }
}

// Frames begin .. end of a clip, as a clip of their own.
Clip part(const Clip& clip, int begin, int end) {
  Clip result;
  result.name = clip.name;
  result.rate = clip.rate;
  result.frames = end - begin + 1;
  const std::ptrdiff_t bones = static_cast<std::ptrdiff_t>(clip.rotations.size()) / clip.frames;
  const auto copy = [&](const std::vector<double>& from, std::ptrdiff_t width) {
    return std::vector<double>(from.begin() + width * begin, from.begin() + width * (end + 1));
  };
  result.root_positions = copy(clip.root_positions, 3);
  result.headings = copy(clip.headings, 1);
  result.rotations = copy(clip.rotations, bones);
  return result;
}

// The height of a hop by its phase, of its greatest: a crouch, a parabola that takes off as fast as the crouch ends,
// and a crouch again.
double hop_at(double phase) {
  constexpr double kFlight = 1 - 2 * kCrouch, kDip = 4 * kCrouch / (kPi * kFlight);
  const double air = (phase - kCrouch) / kFlight;
  if (air > 0 && air < 1) return 4 * air * (1 - air);
  return -kDip * std::sin(kPi * std::min(phase, 1 - phase) / kCrouch);
}

// Fills the holes of a pool's control space.
class Synthesizer {
 public:
  Synthesizer(FragmentPool& pool, const ControlSpace& space, double usual, const SynthesisOptions& options)
      : pool_(pool),
        space_(space),
        usual_(usual),
        options_(options),
        kinematics_(pool.skeleton),
        legs_(find_legs(kinematics_, pool.clips)),
        trajectories_(trajectories(pool)),
        originals_(static_cast<int>(pool.fragments.size())) {
    find_cycles();
  }

  void fill() {
    std::vector<int> missing;
    for (int c = 0; c < ControlSpace::kPoints; ++c) missing.push_back(std::max(0, options_.wanted - performers(c)));
    for (int c = 0; c < ControlSpace::kPoints; ++c) {
      if (missing[c] == 0) continue;
      interpolate(space_.point(c), missing[c]);
      transform(space_.point(c));
    }
  }

 private:
  double distance(int fragment, const Control& control) const {
    return space_.distance(pool_.fragments[fragment].evident, control);
  }

  int performers(int c) const {
    int count = 0;
    for (int i = 0; i < originals_; ++i) count += distance(i, space_.point(c)) <= options_.tolerance ? 1 : 0;
    return count;
  }

  int tail(const Clip& clip) const { return static_cast<int>(std::lround(options_.tail * clip.rate)); }

  // Adds a clip whose frames ends[i] .. ends[i + 1] are fragments.
  void add(Clip clip, const std::vector<int>& ends, Origin origin) {
    const BodyMotion motion = body_motion(kinematics_, clip);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      Fragment fragment;
      fragment.clip = static_cast<int>(pool_.clips.size());
      fragment.begin = ends[i];
      fragment.end = ends[i + 1];
      fragment.origin = origin;
      fragment.evident = evident_control(motion, clip.rate, ends[i], ends[i + 1], usual_, space_);
      pool_.fragments.push_back(fragment);
    }
    pool_.clips.push_back(make_clip(pool_.skeleton, std::move(clip)));
  }

  std::vector<int> nearest_originals(const Control& control) const {
    std::vector<int> order(originals_);
    for (int i = 0; i < originals_; ++i) order[i] = i;
    const int count = std::min(kCandidates, originals_);
    std::partial_sort(order.begin(), order.begin() + count, order.end(), [&](int a, int b) {
      const double da = distance(a, control), db = distance(b, control);
      return da != db ? da < db : a < b;
    });
    order.resize(count);
    return order;
  }

  struct Pair {
    int a, b;
    double weight, distance;
  };

  // The weight in [0, 1] that brings (1 - w) Ev(a) + w Ev(b) nearest to the control.
  Pair pair_for(int a, int b, const Control& control) const {
    Pair best{a, b, 0, std::numeric_limits<double>::infinity()};
    for (int i = 1; i < 10; ++i) {
      const double w = 0.1 * i;
      const double d = space_.distance(mix(pool_.fragments[a].evident, pool_.fragments[b].evident, w), control);
      if (d < best.distance) best.weight = w, best.distance = d;
    }
    return best;
  }

  // Interpolates up to `count` pairs of similar fragments that together perform the control.
  void interpolate(const Control& control, int count) {
    const float similar = static_cast<float>(kSimilar * trajectory_points());
    const std::vector<int> near = nearest_originals(control);
    std::vector<Pair> pairs;
    for (const int a : near) {
      for (const int b : near) {
        if (a >= b) continue;
        const Pair pair = pair_for(a, b, control);
        if (pair.distance > options_.tolerance || fragment_distance(trajectories_, a, b) > similar) continue;
        pairs.push_back(pair);
      }
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
      return p.distance != q.distance ? p.distance < q.distance : p.a != q.a ? p.a < q.a : p.b < q.b;
    });
    const int used = std::min(count, static_cast<int>(pairs.size()));
    for (int i = 0; i < used; ++i) {
      const Fragment a = pool_.fragments[pairs[i].a], b = pool_.fragments[pairs[i].b];
      const int frames = tail(pool_.clips[a.clip]);
      Clip clip = interpolated(kinematics_, pool_, a, b, pairs[i].weight, frames);
      const int end = clip.frames - 1 - frames;
      add(std::move(clip), {0, end}, Origin::interpolated);
    }
  }

  int trajectory_points() const { return kPoses * static_cast<int>(measured_bones(pool_.skeleton).size()); }

  // Fragments that follow each other in a take and end nearly as they began: played again and again, they are a gait.
  struct Cycle {
    int clip = 0, begin = 0, end = 0;  // frames
    Control evident;
    double gap = 0;  // Dis from its last pose to its first
  };

  void find_cycles() {
    for (int first = 0; first < originals_; ++first) {
      Cycle cycle;
      double seconds = 0;
      for (int last = first; last < originals_; ++last) {
        const Fragment& f = pool_.fragments[last];
        if (last > first && (f.clip != cycle.clip || f.begin != cycle.end)) break;
        const double length = pool_.seconds(f), share = length / (seconds += length);
        if (last == first) cycle.clip = f.clip, cycle.begin = f.begin;
        cycle.end = f.end;
        cycle.evident = mix(cycle.evident, f.evident, share);
        if (seconds > kLongestCycle) break;
        cycle.gap = transition_distance(trajectories_, last, first);
        if (seconds > kShortestCycle && cycle.gap < kClosed) cycles_.push_back(cycle);
      }
    }
  }

  // What it costs a cycle's looks to be made to perform a control. Whether it jumps makes no difference: what hops is
  // made of what goes, so that the one follows the other.
  double effort(const Cycle& cycle, const Control& control) const {
    const Control& ev = cycle.evident;
    const double moving = kMoving / space_.scale();
    const bool moves = speed(ev) > moving, wants = speed(control) > moving, steps = wants || control.turn != 0;
    if (moves != steps) return std::numeric_limits<double>::infinity();
    double effort = cycle.gap + 0.5 * std::abs(control.turn - ev.turn) + 2 * ev.jump;
    if (steps && !wants) effort += speed(ev) / space_.walk();  // it steps in place
    if (wants) {
      effort += std::abs(angle_between(ev, control)) / (kPi / 4);
      const double faster = std::log(speed(control) / speed(ev)) / std::log(1.5);
      effort += faster > 0 ? faster * faster : -faster;
    }
    return effort;
  }

  // The cycle that performs the control with the least effort, the first of those that are alike but for rounding.
  const Cycle* cheapest(const Control& control) const {
    const Cycle* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Cycle& cycle : cycles_) {
      const double cost = effort(cycle, control);
      if (cost < least - kAlike) least = cost, best = &cycle;
    }
    return best;
  }

  // Transforms the cheapest cycle for the control, in pieces that follow each other as in the take.
  void transform(const Control& control) {
    const Cycle* best = cheapest(control);
    if (!best) return;
    const Clip& clip = pool_.clips[best->clip];
    Transform change;
    change.turn = (control.turn - best->evident.turn) * space_.turn_rate();
    const bool moves = speed(best->evident) > kMoving / space_.scale();
    const double faster = moves ? speed(control) / speed(best->evident) : 1;
    if (moves && speed(control) > 0) change.direction = angle_between(best->evident, control);
    const int length = best->end - best->begin;
    const double usual = length / (options_.longest * clip.rate);  // pieces, each as long as may be
    const int pieces = std::max(1, static_cast<int>(std::ceil(usual / kHurry - 1e-6)));
    change.tempo = std::max(usual / pieces, std::clamp(std::sqrt(faster), 1 / kHurry, kHurry));
    change.speed = faster / change.tempo;
    const int longest = static_cast<int>(options_.longest * clip.rate * change.tempo + 1e-6);
    const Clip made = transformed(kinematics_, legs_, clip, find_contacts(kinematics_, clip), best->begin, best->end,
                                  length + longest + tail(clip), change);
    std::vector<int> ends;
    for (int piece = 0; piece <= pieces; ++piece) ends.push_back(length * piece / pieces);
    if (control.jump <= best->evident.jump) return add(part(made, 0, length + tail(clip)), ends, Origin::transformed);
    for (int piece = 0; piece < pieces; ++piece) {
      Clip jump = part(made, ends[piece], ends[piece] + longest + tail(clip));
      hop(kinematics_, legs_, jump, longest, kJumpHeight / space_.scale());
      add(std::move(jump), {0, longest}, Origin::transformed);
    }
  }

  FragmentPool& pool_;
  const ControlSpace& space_;
  double usual_;
  SynthesisOptions options_;
  Kinematics kinematics_;
  Legs legs_;
  Trajectories trajectories_;
  int originals_;
  std::vector<Cycle> cycles_;
};

}  // namespace

Clip transformed(const Kinematics& kinematics, const Legs& legs, const Clip& clip, const Contacts& contacts, int begin,
                 int end, int frames, const Transform& transform) {
  const bool other_path = transform.direction != 0 || transform.speed != 1, plants = other_path || transform.turn != 0;
  const Round round = round_of(kinematics, clip, begin, end);
  Strides strides(kinematics, legs, round);
  Clip result;
  result.name = clip.name + " transformed";
  result.rate = clip.rate * transform.tempo;
  const int length = round.frames(), before = plants ? length : 0;  // a round more, in which the feet find their places
  const CharacterFrame start = round.poses[0].frame;
  const double bend = round.end.heading - start.heading;  // of the path, each round
  Vector2 position = Vector2::Zero(), origin = Vector2::Zero();
  for (int f = -before; f <= frames; ++f) {
    const int at = (f + before) % length, rounds = (f + before) / length - (before > 0 ? 1 : 0);
    BodyPose pose = round.poses[at];
    if (other_path) strides.change(pose, transform.direction, transform.speed);
    if (f == 0) origin = position;
    const double seconds = f / result.rate, heading = pose.frame.heading + rounds * bend;
    append(kinematics, result, {position, heading + transform.turn * seconds}, pose);
    const Vector2 next = at + 1 < length ? round.poses[at + 1].frame.position : round.end.position;
    const double middle = transform.turn * (seconds + 0.5 / result.rate);
    position += transform.speed * turned(next - pose.frame.position, transform.direction + middle + rounds * bend);
  }
  for (int f = 0; f < result.frames; ++f) {
    Eigen::Map<Vector2>(&result.root_positions[std::size_t{3} * f]) += start.position - origin;
  }
  if (!plants) return result;
  plant_feet(kinematics, legs, result, contacts, begin, end);
  return part(result, before, result.frames - 1);
}

void hop(const Kinematics& kinematics, const Legs& legs, Clip& clip, int end, double height) {
  PosedBones posed(kinematics.bones());
  for (int f = 0; f < end; ++f) {
    const double rise = height * hop_at(static_cast<double>(f) / end), lift = std::max(0.0, rise) * (1 + kTuck);
    double* root = &clip.root_positions[std::size_t{3} * f];
    double* rotations = &clip.rotations[std::size_t{4} * kinematics.bones() * f];
    kinematics.world(clip, f, posed.heads.data(), posed.rotations.data());
    root[2] += rise;
    for (const Leg& leg : legs) {
      if (!leg.exists()) continue;
      const Vector3 ankle = posed.heads[leg.foot] + lift * Vector3::UnitZ();
      PosedBones risen = posed;
      for (Vector3& head : risen.heads) head.z() += rise;
      reach(kinematics.skeleton(), leg, risen, ankle, rotations);
    }
  }
}

Clip interpolated(const Kinematics& kinematics, const FragmentPool& pool, const Fragment& a, const Fragment& b,
                  double w, int tail) {
  const Clip &clip_a = pool.clips[a.clip], &clip_b = pool.clips[b.clip];
  const double seconds = (1 - w) * pool.seconds(a) + w * pool.seconds(b);
  const int end = std::max(1, static_cast<int>(std::lround(seconds * clip_a.rate)));
  const CharacterFrame start_a = frame_at(clip_a, a.begin), start_b = frame_at(clip_b, b.begin);
  Clip result;
  result.name = clip_a.name + " + " + clip_b.name;
  result.rate = clip_a.rate;
  for (int f = 0; f <= end + tail; ++f) {
    const double phase = static_cast<double>(f) / end;
    BodyPose pose = body_pose(kinematics, clip_a, a.begin + phase * (a.end - a.begin));
    const BodyPose other = body_pose(kinematics, clip_b, b.begin + phase * (b.end - b.begin));
    blend_rotations(pose.rotations.data(), other.rotations.data(), w, kinematics.bones(), pose.rotations.data());
    pose.height += w * (other.height - pose.height);
    const auto moved = [](const CharacterFrame& start, const CharacterFrame& now) {
      return turned(now.position - start.position, -start.heading);
    };
    const auto headed = [](const CharacterFrame& start, const CharacterFrame& now) {
      return now.heading - start.heading;
    };
    append(kinematics, result,
           {(1 - w) * moved(start_a, pose.frame) + w * moved(start_b, other.frame),
            (1 - w) * headed(start_a, pose.frame) + w * headed(start_b, other.frame)},
           pose);
  }
  return result;
}

Clip standing(const Kinematics& kinematics, const FragmentPool& pool, int frames, double rate) {
  std::vector<int> slowest(pool.fragments.size());
  for (std::size_t i = 0; i < slowest.size(); ++i) slowest[i] = static_cast<int>(i);
  std::stable_sort(slowest.begin(), slowest.end(),
                   [&](int a, int b) { return speed(pool.fragments[a].evident) < speed(pool.fragments[b].evident); });
  slowest.resize(std::min(slowest.size(), std::max<std::size_t>(10, slowest.size() / 5)));
  BodyPose mean;
  double floor = 0, count = 0;
  for (const int i : slowest) {
    const Fragment& fragment = pool.fragments[i];
    for (int f = fragment.begin; f < fragment.end; ++f) {
      add_to_mean(mean, body_pose(kinematics, pool.clips[fragment.clip], f));
      floor += lowest_tip(kinematics, pool.clips[fragment.clip], f);
      ++count;
    }
  }
  for (int b = 0; b < 4 * kinematics.bones(); b += 4) {
    store_quaternion(load_quaternion(&mean.rotations[b]).normalized(), &mean.rotations[b]);
  }
  mean.height /= count;
  Clip clip;
  clip.name = "standing";
  clip.rate = rate;
  append(kinematics, clip, {}, mean);
  mean.height += floor / count - lowest_tip(kinematics, clip, 0);
  clip.root_positions[2] = mean.height;
  while (clip.frames < frames) append(kinematics, clip, {}, mean);
  return clip;
}

void synthesize(FragmentPool& pool, const ControlSpace& space, double usual, const SynthesisOptions& options) {
  const auto stands = [&](const Fragment& f) { return space.distance(f.evident, {}) <= options.tolerance; };
  if (std::none_of(pool.fragments.begin(), pool.fragments.end(), stands)) add_standing(pool, options);
  Synthesizer(pool, space, usual, options).fill();
}

}  // namespace fragmotion
