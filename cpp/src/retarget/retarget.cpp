// SPDX-License-Identifier: MIT
#include "fragmotion/retarget/retarget.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "fragmotion/base/parallel.hpp"
#include "fragmotion/motion/pose.hpp"
#include "retarget/drives.hpp"
#include "retarget/feet.hpp"
#include "retarget/twists.hpp"

namespace fragmotion {
namespace {

constexpr double kRolls = 0.14;  // rad: a foot that is tipped further stands on its ball or heel alone
constexpr double kThere = 1e-9;  // of a leg's length: a foot that is so near to its place is there
constexpr double kStandHeight = 0.025, kSlowest = 1e-3;  // of a 1.8 m character, m and m/s
constexpr double kFree = std::numeric_limits<double>::infinity();

// Makes the target's compared pose the source's, of which it is the same body.
void adopt(const Body& source, const std::vector<Drive>& drives, double scale, Body& target) {
  for (const Drive& drive : drives) {
    target.reference[drive.bone] = source.reference[drive.first.bone] * drive.first.turn;
  }
  for (int side = 0; side < 2; ++side) {
    target.feet[side] = scale * source.feet[side];
    target.soles[side] = {scale * source.soles[side].ball, scale * source.soles[side].heel};
    target.legs[side].hinge = target.reference[target.legs[side].thigh].conjugate() * -Vector3::UnitX();
  }
}

// Bones in the tree of the hips but for them, in order.
std::vector<int> below_hips(const Skeleton& skeleton) {
  std::vector<int> bones;
  for (int b = 0; b < skeleton.size(); ++b) {
    if (b != skeleton.roles.hips && skeleton.is_below(b, skeleton.roles.hips)) bones.push_back(b);
  }
  return bones;
}

// The bones of a source that drive something, its legs too.
std::vector<int> leading_bones(const Body& source, const std::vector<Drive>& drives) {
  std::vector<int> ends{source.legs[0].foot, source.legs[0].toe, source.legs[1].foot, source.legs[1].toe};
  for (const Drive& drive : drives) {
    ends.push_back(drive.first.bone);
    ends.push_back(drive.second.bone);
  }
  return source.kinematics.chains(ends);
}

void check(const Clip& clip, const Skeleton& skeleton) {
  if (clip.rotations.size() == std::size_t{4} * skeleton.size() * clip.frames) return;
  throw std::invalid_argument("clip '" + clip.name + "' has not the source's " + std::to_string(skeleton.size()) +
                              " bones: make it of the skeleton of the source");
}

}  // namespace

struct Retarget::Parts {
  Body source, target;
  std::vector<Drive> drives;
  double scale;
  Twists twists;
  std::vector<int> leading, following;

  Parts(const Body& from, Body to, std::vector<Drive> driven)
      : source(from),
        target(std::move(to)),
        drives(std::move(driven)),
        scale(target.leg / source.leg),
        twists(target),
        leading(leading_bones(source, drives)),
        following(below_hips(target.skeleton())) {}

  double sole_rise(int side, double FootHeights::*point) const {
    return target.soles[side].*point - scale * source.soles[side].*point;
  }
};

namespace {

using Points = std::array<Vector3, 2>;

Vector3 hips_middle(const Legs& legs, const PosedBones& posed) {
  return (posed.heads[legs[0].thigh] + posed.heads[legs[1].thigh]) / 2;
}

// From a foot that stands on its heel (0) to one on its ball (1), by where it points: a flat one is on both.
double on_ball(const Vector3& ahead) {
  return ease_in_ease_out(0.5 - std::asin(std::clamp(ahead.z(), -1.0, 1.0)) / (2 * kRolls));
}

}  // namespace

// One clip on its way.
class Transfer {
 public:
  Transfer(const Retarget::Parts& parts, const Clip& clip)
      : parts_(parts),
        clip_(clip),
        motion_(parts.source, clip),
        contacts_(find_contacts(parts.source.kinematics, clip)),
        from_(parts.source.kinematics.bones()),
        to_(parts.target.kinematics.bones()) {
    for (int side = 0; side < 2; ++side) headings_[side] = held_headings(contacts_.feet[side], clip.headings);
  }

  RetargetedClip run() {
    find_moves();
    Clip result{clip_.name, clip_.rate, clip_.frames, {}, {}, {}};
    result.root_positions.resize(std::size_t{3} * clip_.frames);
    result.rotations.resize(std::size_t{4} * parts_.target.kinematics.bones() * clip_.frames);
    for (int f = 0; f < clip_.frames; ++f) store(f, result);
    result = make_clip(parts_.target.skeleton(), std::move(result));
    return {result, judge(result)};
  }

 private:
  const Skeleton& skeleton() const { return parts_.target.skeleton(); }
  int hips() const { return skeleton().roles.hips; }

  // The target as the source is in a frame, its hips over the ground by the source's, its feet wherever they get.
  void pose(int f) {
    world(parts_.source.kinematics, clip_, f, parts_.leading, from_.heads.data(), from_.rotations.data());
    std::vector<bool>& driven = driven_;
    driven.assign(skeleton().size(), false);
    for (const Drive& drive : parts_.drives) {
      const Quaternion first = from_.rotations[drive.first.bone] * drive.first.turn;
      to_.rotations[drive.bone] =
          drive.weight > 0 ? first.slerp(drive.weight, from_.rotations[drive.second.bone] * drive.second.turn) : first;
      driven[drive.bone] = true;
    }
    parts_.twists.apply(to_.rotations);
    for (const TwistBone& twist : parts_.target.map.twists) driven[twist.bone] = true;
    to_.heads[hips()].setZero();
    for (const int b : parts_.following) {
      const int parent = skeleton().parents[b];
      if (!driven[b]) to_.rotations[b] = (to_.rotations[parent] * skeleton().rest_rotations[b]).normalized();
      to_.heads[b] = to_.heads[parent] + to_.rotations[parent] * skeleton().offsets[b];
    }
    const double rise = (parts_.sole_rise(0, &FootHeights::heel) + parts_.sole_rise(1, &FootHeights::heel)) / 2;
    move(parts_.scale * hips_middle(parts_.source.legs, from_) + Vector3(0, 0, rise) -
         hips_middle(parts_.target.legs, to_));
  }

  void move(const Vector3& by) {
    to_.heads[hips()] += by;
    for (const int b : parts_.following) to_.heads[b] += by;
  }

  // Where the ankle of a posed target belongs.
  Vector3 ankle(int side, int f) const {
    const Body &source = parts_.source, &target = parts_.target;
    const Leg& leg = target.legs[side];
    const FootPath& path = motion_.paths[side];
    const Quaternion foot =
        from_.rotations[source.legs[side].foot] * source.reference[source.legs[side].foot].conjugate();
    const Vector3 ahead = foot * Vector3::UnitY();
    const Quaternion yaw(Eigen::AngleAxisd(std::atan2(-ahead.x(), ahead.y()), Vector3::UnitZ()));
    const Quaternion heading(Eigen::AngleAxisd(headings_[side][f], Vector3::UnitZ()));
    const double wider = (target.hip_width - parts_.scale * source.hip_width) / 2;
    const Vector3 beside = heading * Vector3((side == 0 ? -1 : 1) * wider, 0, 0);
    Vector3 longer = yaw * (parts_.scale * source.feet[side] - target.feet[side]);
    longer.z() = parts_.sole_rise(side, &FootHeights::heel);
    const Vector3 by_heel = parts_.scale * path.heel[f] + longer;
    const Vector3 by_ball = parts_.scale * path.ball[f] + Vector3(0, 0, parts_.sole_rise(side, &FootHeights::ball)) -
                            (ball(skeleton(), leg, to_) - to_.heads[leg.foot]);
    const double weight = on_ball(ahead);
    return beside + (1 - weight) * by_heel + weight * by_ball;
  }

  // How far the hips must rise or sink for a leg to reach its place.
  void find_moves() {
    std::vector<double> least(clip_.frames, -kFree), most(clip_.frames, kFree);
    for (int f = 0; f < clip_.frames; ++f) {
      pose(f);
      for (int side = 0; side < 2; ++side) {
        if (!contacts_.feet[side][f]) continue;
        const Vector3 way = to_.heads[parts_.target.legs[side].thigh] - ankle(side, f);
        const Reach reach = reach_of(parts_.target.legs[side], to_, motion_.knees[side]);
        const double beside = way.head<2>().squaredNorm();
        most[f] = std::min(most[f], std::sqrt(std::max(0.0, reach.most * reach.most - beside)) - way.z());
        least[f] = std::max(least[f], std::sqrt(std::max(0.0, reach.least * reach.least - beside)) - way.z());
      }
    }
    moves_ = smooth_moves(least, most, clip_.rate);
  }

  void store(int f, Clip& result) {
    pose(f);
    Points ankles{ankle(0, f), ankle(1, f)};
    move({0, 0, moves_[f]});
    double* rotations = &result.rotations[std::size_t{4} * skeleton().size() * f];
    store_vector(to_.heads[hips()], &result.root_positions[std::size_t{3} * f]);
    store_quaternion(to_.rotations[hips()], rotations + std::ptrdiff_t{4} * hips());
    for (const int b : parts_.following) {
      const Quaternion local = to_.rotations[skeleton().parents[b]].conjugate() * to_.rotations[b];
      store_quaternion(local.normalized(), rotations + std::ptrdiff_t{4} * b);
    }
    for (int side = 0; side < 2; ++side) put_foot(side, ankles[side], rotations);
  }

  void put_foot(int side, const Vector3& ankle, double* rotations) {
    Leg leg = parts_.target.legs[side];
    const Reach reach = reach_of(leg, to_, motion_.knees[side]);
    const double apart = (ankle - to_.heads[leg.thigh]).norm(), tolerance = kThere * parts_.target.leg;
    const bool there = (ankle - to_.heads[leg.foot]).norm() < tolerance && apart < reach.most + tolerance &&
                       apart > reach.least - tolerance;
    if (!there) fragmotion::reach(skeleton(), leg, to_, ankle, reach, rotations);
  }

  RetargetReport judge(const Clip& result) const {
    const LegMotion motion(parts_.target, result);
    RetargetReport report;
    for (int side = 0; side < 2; ++side) {
      const KneeRange &mine = motion.knees[side], &theirs = motion_.knees[side];
      report.knee_beyond = std::max({report.knee_beyond, theirs.least - mine.least, mine.most - theirs.most});
      report.contact_error = std::max(report.contact_error, contact_error(side, motion.paths[side]));
    }
    for (const double move : moves_) report.hips_moved = std::max(report.hips_moved, std::abs(move));
    const double size = standard_scale(parts_.source.skeleton());
    report.foot_skate = skate(motion.paths, parts_.scale, size / parts_.scale);
    report.source_foot_skate = parts_.scale * skate(motion_.paths, 0, size);
    const double slowest = kSlowest * parts_.scale / size;
    report.foot_skate_ratio = (report.foot_skate + slowest) / (report.source_foot_skate + slowest);
    return report;
  }

  double contact_error(int side, const FootPath& path) const {
    const FootPath& source = motion_.paths[side];
    double most = 0;
    for (int f = 0; f < clip_.frames; ++f) {
      if (!contacts_.feet[side][f]) continue;
      const auto height = [&](const FootPath& of, const FootHeights& sole) {
        return std::min(of.ball[f].z() - sole.ball, of.heel[f].z() - sole.heel);
      };
      most = std::max(most, std::abs(height(path, parts_.target.soles[side]) -
                                     parts_.scale * height(source, parts_.source.soles[side])));
    }
    return most;
  }

  // `scale` of a target, 0 of the source; times `size`, lengths are those of a character of 1.8 m.
  double skate(const std::array<FootPath, 2>& paths, double scale, double size) const {
    double sum = 0;
    for (int side = 0; side < 2; ++side) {
      const auto floor = [&](double FootHeights::*point) {
        const double source = contacts_.floors[side].*point;
        return scale > 0 ? scale * source + parts_.sole_rise(side, point) : source;
      };
      sum += skate(paths[side].ball, floor(&FootHeights::ball), size);
      sum += skate(paths[side].heel, floor(&FootHeights::heel), size);
    }
    return sum / 4;
  }

  double skate(const std::vector<Vector3>& path, double floor, double size) const {
    double sum = 0;
    for (std::size_t f = 1; f < path.size(); ++f) {
      const double height = (path[f].z() - floor) * size;
      sum += (path[f] - path[f - 1]).head<2>().norm() * clip_.rate *
             std::clamp(2 - std::exp2(height / kStandHeight), 0.0, 1.0);
    }
    return sum / static_cast<double>(path.size() - 1);
  }

  const Retarget::Parts& parts_;
  const Clip& clip_;
  LegMotion motion_;
  Contacts contacts_;
  std::array<std::vector<double>, 2> headings_;
  std::vector<double> moves_;  // of the hips, up
  PosedBones from_, to_;
  std::vector<bool> driven_;
};

Retarget::Retarget(const Body& source, const Body& target) {
  const bool same = same_body(source, target);
  for (const Body* body : {&source, &target}) {
    if (body->stands || same) continue;
    throw std::invalid_argument("the rest pose of '" + body->skeleton().names[0] +
                                "' and its bones is not that of a standing body: give clips of it in which it stands "
                                "or walks");
  }
  std::vector<Drive> drives = find_drives(source, target);
  Body adopted = target;
  if (same) adopt(source, drives, target.leg / source.leg, adopted);
  parts_ = std::make_unique<const Parts>(source, std::move(adopted), std::move(drives));
}

Retarget::~Retarget() = default;
Retarget::Retarget(Retarget&&) noexcept = default;
Retarget& Retarget::operator=(Retarget&&) noexcept = default;

double Retarget::scale() const { return parts_->scale; }

RetargetedClip Retarget::apply(const Clip& clip) const {
  check(clip, parts_->source.skeleton());
  return Transfer(*parts_, clip).run();
}

std::vector<RetargetedClip> Retarget::apply(const std::vector<Clip>& clips, int threads) const {
  std::vector<RetargetedClip> results(clips.size());
  parallel_for(static_cast<int>(clips.size()), thread_count(threads), [&](int begin, int end) {
    for (int c = begin; c < end; ++c) results[c] = apply(clips[c]);
  });
  return results;
}

}  // namespace fragmotion
