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

constexpr double kJumpHeight = 9.81 * 0.5 * 0.5 / 8;  // m, of a 1.8 m character: in the air for half a second
constexpr double kSimilar = 0.12;                     // m a bone tip: fragments this near may be interpolated
constexpr int kCandidates = 24;                       // neighbours of a control that interpolation tries in pairs
constexpr double kStandSeconds = 0.5;
constexpr double kShortestCycle = 0.4, kLongestCycle = 1.4;  // s
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

// The strides of a motion as its path is changed: what the balls of the feet do about their middle is turned and scaled
// like the path, so that a foot that stood still on the old path does so on the new one.
class Strides {
 public:
  Strides(const Kinematics& kinematics, const Clip& clip, int begin, int end)
      : kinematics_(kinematics),
        legs_{left_leg(kinematics.skeleton()), right_leg(kinematics.skeleton())},
        posed_(kinematics.bones()) {
    for (int f = begin; f <= end; ++f) {
      pose(body_pose(kinematics, clip, f));
      for (int side = 0; exist() && side < 2; ++side) middles_[side] += balls(side) / (end - begin + 1);
    }
  }

  void change(BodyPose& body, double direction, double scale) {
    if (!exist()) return;
    pose(body);
    for (int side = 0; side < 2; ++side) {
      const Vector2 stride = balls(side) - middles_[side], by = scale * turned(stride, direction) - stride;
      const Vector3 ankle = posed_.heads[legs_[side].foot] + Vector3{by.x(), by.y(), 0};
      reach(kinematics_.skeleton(), legs_[side], posed_, ankle, 0, body.rotations.data());
    }
  }

 private:
  bool exist() const { return legs_[0].exists() && legs_[1].exists(); }
  void pose(const BodyPose& body) {
    kinematics_.world({0, 0, body.height}, body.rotations.data(), posed_.heads.data(), posed_.rotations.data());
  }
  Vector2 balls(int side) const { return ball(kinematics_.skeleton(), legs_[side], posed_).head<2>(); }

  const Kinematics& kinematics_;
  std::array<Leg, 2> legs_;
  std::array<Vector2, 2> middles_{Vector2::Zero(), Vector2::Zero()};
  PosedBones posed_;
};

// Keeps planted feet of a clip where they are; `contacts` are those of another clip whose frame `first` is its frame 0.
void plant_feet(const Kinematics& kinematics, Clip& clip, const Contacts& contacts, int first) {
  if (contacts.feet[0].empty()) return;
  FootLock lock(kinematics);
  WorldPose pose;
  pose.rotations.resize(std::size_t{4} * kinematics.bones());
  for (int f = 0; f < clip.frames; ++f) {
    double *root = &clip.root_positions[std::size_t{3} * f], *rotations = &clip.rotations[pose.rotations.size() * f];
    pose.root = load_vector(root);
    pose.heading = clip.headings[f];
    std::copy_n(rotations, pose.rotations.size(), pose.rotations.begin());
    lock.apply(pose, {contacts.feet[0][first + f], contacts.feet[1][first + f]}, f > 0 ? 1 / clip.rate : 0);
    store_vector(pose.root, root);
    std::copy(pose.rotations.begin(), pose.rotations.end(), rotations);
  }
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

  // Adds the clip's frames 0 .. end as a fragment.
  void add(Clip clip, int end, Origin origin) {
    Fragment fragment;
    fragment.clip = static_cast<int>(pool_.clips.size());
    fragment.end = end;
    fragment.origin = origin;
    fragment.evident = evident_control(body_motion(kinematics_, clip), clip.rate, 0, end, usual_, space_);
    pool_.clips.push_back(make_clip(pool_.skeleton, std::move(clip)));
    pool_.fragments.push_back(fragment);
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
      add(std::move(clip), end, Origin::interpolated);
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

  // What it costs a cycle's looks to be made to perform a control.
  double effort(const Cycle& cycle, const Control& control) const {
    const Control& ev = cycle.evident;
    const double moving = kMoving / space_.scale();
    const bool moves = speed(ev) > moving, wants = speed(control) > moving;
    if (moves != wants) return std::numeric_limits<double>::infinity();
    double effort = cycle.gap + 0.5 * std::abs(control.turn - ev.turn) + 2 * std::max(0.0, ev.jump - control.jump);
    if (wants) {
      effort += std::abs(angle_between(ev, control)) / (kPi / 4);
      effort += std::abs(std::log(speed(control) / speed(ev))) / std::log(1.5);
    }
    return effort;
  }

  // Transforms the cheapest cycle for the control, in pieces that follow each other as in the take.
  void transform(const Control& control) {
    const auto cheaper = [&](const Cycle& a, const Cycle& b) { return effort(a, control) < effort(b, control); };
    const auto best = std::min_element(cycles_.begin(), cycles_.end(), cheaper);
    if (best == cycles_.end() || std::isinf(effort(*best, control))) return;
    const Clip& clip = pool_.clips[best->clip];
    Transform change;
    change.turn = (control.turn - best->evident.turn) * space_.turn_rate();
    if (speed(best->evident) > kMoving / space_.scale()) {
      change.speed = speed(control) / speed(best->evident);
      if (speed(control) > 0) change.direction = angle_between(best->evident, control);
    }
    const bool jumps = control.jump > best->evident.jump;
    if (jumps) change.rise = kJumpHeight / space_.scale();
    const int longest = static_cast<int>(options_.longest * clip.rate + 1e-6), length = best->end - best->begin;
    const int pieces = (length + longest - 1) / longest;
    const Contacts contacts = find_contacts(kinematics_, clip);
    std::vector<std::pair<Clip, int>> made;  // with their fragments' ends; added at last, since that moves `clip`
    for (int piece = 0; piece < pieces; ++piece) {
      const int begin = best->begin + length * piece / pieces;
      const int end = jumps ? std::min(clip.frames - 1, begin + longest) : best->begin + length * (piece + 1) / pieces;
      made.emplace_back(transformed(kinematics_, clip, contacts, begin, end, tail(clip), change), end - begin);
    }
    for (auto& [piece, end] : made) add(std::move(piece), end, Origin::transformed);
  }

  FragmentPool& pool_;
  const ControlSpace& space_;
  double usual_;
  SynthesisOptions options_;
  Kinematics kinematics_;
  Trajectories trajectories_;
  int originals_;
  std::vector<Cycle> cycles_;
};

}  // namespace

Clip transformed(const Kinematics& kinematics, const Clip& clip, const Contacts& contacts, int begin, int end, int tail,
                 const Transform& transform) {
  const bool other_path = transform.direction != 0 || transform.speed != 1;
  Strides strides(kinematics, clip, begin, end);
  Clip result;
  result.name = clip.name + " transformed";
  result.rate = clip.rate;
  const int last = std::min(clip.frames - 1, end + tail);
  Vector2 position = frame_at(clip, begin).position, before = position;
  for (int f = begin; f <= last; ++f) {
    BodyPose pose = body_pose(kinematics, clip, f);
    if (other_path) strides.change(pose, transform.direction, transform.speed);
    const double seconds = (f - begin) / clip.rate, phase = static_cast<double>(f - begin) / (end - begin);
    const double turn = transform.turn * seconds;
    const double middle = transform.turn * std::max(0.0, seconds - 0.5 / clip.rate);
    position += transform.speed * turned(pose.frame.position - before, transform.direction + middle);
    before = pose.frame.position;
    if (phase < 1) pose.height += 4 * transform.rise * phase * (1 - phase);
    append(kinematics, result, {position, pose.frame.heading + turn}, pose);
  }
  if (other_path || transform.turn != 0) plant_feet(kinematics, result, contacts, begin);
  return result;
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
