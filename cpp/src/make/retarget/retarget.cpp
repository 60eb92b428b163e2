// SPDX-License-Identifier: MIT
#include "retarget/retarget.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/parallel.hpp"
#include "base/rounding.hpp"
#include "motion/pose.hpp"
#include "motion/skate.hpp"
#include "retarget/drives.hpp"
#include "retarget/feet.hpp"
#include "retarget/limb_angles.hpp"
#include "retarget/remarks.hpp"
#include "retarget/twists.hpp"

namespace fragmotion {
namespace {

constexpr double kRolls = 0.14;      // rad: a foot that is tipped further stands on its ball or heel alone
constexpr double kToeDepth = 0.005;  // m of a 1.8 m character

// Makes the target's compared pose and its feet the source's, of which it is the same body.
void adopt(const Body& source, const std::vector<Drive>& drives, double scale, Body& target) {
  Skeleton skeleton = target.skeleton();
  for (const Drive& drive : drives) {
    target.reference[drive.bone] = source.reference[drive.first.bone] * drive.first.turn;
    for (const Leg& leg : target.legs) {
      const bool is_end = drive.bone == leg.toe || (drive.bone == leg.foot && leg.toe < 0);
      if (!is_end) continue;
      skeleton.tips[drive.bone] = scale * (drive.first.turn.conjugate() * source.skeleton().tips[drive.first.bone]);
    }
  }
  target.kinematics = Kinematics(skeleton);
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
  double toe_depth;  // m that the tip of a toe may be lower than that of a flat foot
  Twists twists;
  std::vector<int> leading, following;
  std::vector<bool> rests;  // which bones of the target rest on their parents

  Parts(const Body& from, Body to, std::vector<Drive> driven)
      : source(from),
        target(std::move(to)),
        drives(std::move(driven)),
        scale(target.leg / source.leg),
        toe_depth(same_body(source, target) ? INFINITY : kToeDepth * scale / standard_scale(source.skeleton())),
        twists(target),
        leading(leading_bones(source, drives)),
        following(below_hips(target.skeleton())),
        rests(target.skeleton().size(), true) {
    for (const Drive& drive : drives) rests[drive.bone] = false;
    for (const int bone : twists.bones()) rests[bone] = false;
  }

  double sole_rise(int side, double FootHeights::*point) const {
    return target.soles[side].*point - scale * source.soles[side].*point;
  }
};

namespace {

using Points = std::array<Vector3, 2>;

Vector3 hips_middle(const Legs& legs, const PosedBones& posed) {
  return (posed.heads[legs[0].thigh] + posed.heads[legs[1].thigh]) / 2;
}

Quaternion about_z(double angle) { return Quaternion(Eigen::AngleAxisd(angle, Vector3::UnitZ())); }

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
    Clip result{clip_.name, clip_.rate, clip_.frames, {}, {}, {}, clip_.markers};
    result.root_positions.resize(std::size_t{3} * clip_.frames);
    result.rotations.resize(std::size_t{4} * parts_.target.kinematics.bones() * clip_.frames);
    for (int f = 0; f < clip_.frames; ++f) store(f, result);
    result = make_clip(parts_.target.skeleton(), std::move(result));
    RetargetReport report = judge(result);
    return {without_added_feet(std::move(result)), std::move(report)};
  }

 private:
  const Skeleton& skeleton() const { return parts_.target.skeleton(); }
  int hips() const { return skeleton().roles.hips; }

  // The target as the source is in a frame, its hips over the ground by the source's, its feet wherever they get.
  void pose(int f) {
    world(parts_.source.kinematics, clip_, f, parts_.leading, from_.heads.data(), from_.rotations.data());
    for (const Drive& drive : parts_.drives) to_.rotations[drive.bone] = followed(drive);
    parts_.twists.apply(to_.rotations);
    to_.heads[hips()].setZero();
    for (const int b : parts_.following) {
      const int parent = skeleton().parents[b];
      if (parts_.rests[b]) to_.rotations[b] = (to_.rotations[parent] * skeleton().rest_rotations[b]).normalized();
      to_.heads[b] = to_.heads[parent] + to_.rotations[parent] * skeleton().offsets[b];
    }
    const double rise = (parts_.sole_rise(0, &FootHeights::heel) + parts_.sole_rise(1, &FootHeights::heel)) / 2;
    move(parts_.scale * hips_middle(parts_.source.legs, from_) + Vector3(0, 0, rise) -
         hips_middle(parts_.target.legs, to_));
  }

  // Rotations of the bones that the target has itself.
  Clip without_added_feet(Clip clip) const {
    if (!parts_.target.has_added_feet()) return clip;
    const std::size_t all = std::size_t{4} * skeleton().size(), own = std::size_t{4} * parts_.target.given.size();
    for (int f = 1; f < clip.frames; ++f) {
      const auto frame = clip.rotations.begin() + static_cast<std::ptrdiff_t>(f * all);
      std::copy_n(frame, own, clip.rotations.begin() + static_cast<std::ptrdiff_t>(f * own));
    }
    clip.rotations.resize(own * clip.frames);
    return clip;
  }

  Quaternion followed(const Drive& drive) const {
    const Quaternion first = from_.rotations[drive.first.bone] * drive.first.turn;
    if (drive.weight == 0) return first;
    return first.slerp(drive.weight, from_.rotations[drive.second.bone] * drive.second.turn);
  }

  void move(const Vector3& by) {
    to_.heads[hips()] += by;
    for (const int b : parts_.following) to_.heads[b] += by;
  }

  // Where the ankle of a posed target belongs: its feet are further apart as its hips are wider, and stand on heel or
  // ball where the source's do.
  Vector3 ankle(int side, int f) const {
    const Body &source = parts_.source, &target = parts_.target;
    const int foot = source.legs[side].foot;
    const FootPath& path = motion_.paths[side];
    const Vector3 ahead = from_.rotations[foot] * (source.reference[foot].conjugate() * Vector3::UnitY());
    Vector3 longer =
        about_z(std::atan2(-ahead.x(), ahead.y())) * (parts_.scale * source.feet[side] - target.feet[side]);
    longer.z() = parts_.sole_rise(side, &FootHeights::heel);
    const Vector3 by_heel = parts_.scale * path.heel[f] + longer;
    const Vector3 by_ball = parts_.scale * path.ball[f] + Vector3(0, 0, parts_.sole_rise(side, &FootHeights::ball)) -
                            (ball(skeleton(), target.legs[side], to_) - to_.heads[target.legs[side].foot]);
    const double wider = (target.hip_width - parts_.scale * source.hip_width) / 2, weight = on_ball(ahead);
    const Vector3 beside = about_z(headings_[side][f]) * Vector3((side == 0 ? -1 : 1) * wider, 0, 0);
    return beside + (1 - weight) * by_heel + weight * by_ball;
  }

  // How far the hips must rise or sink for the legs of standing feet to reach their places.
  void find_moves() {
    std::vector<double> least(clip_.frames, -INFINITY), most(clip_.frames, INFINITY);
    for (int f = 0; f < clip_.frames; ++f) {
      pose(f);
      for (int side = 0; side < 2; ++side) {
        if (!contacts_.feet[side][f]) continue;
        const Reach rise = bearable_rise(side, ankle(side, f));
        least[f] = std::max(least[f], rise.least);
        most[f] = std::min(most[f], rise.most);
      }
    }
    moves_ = smooth_moves(least, most, clip_.rate);
  }

  Reach bearable_rise(int side, const Vector3& ankle) const {
    const Leg& leg = parts_.target.legs[side];
    const Vector3 way = to_.heads[leg.thigh] - ankle;
    const Reach reach = reach_of(leg, to_, motion_.knees[side]);
    const auto height = [&](double length) {
      return std::sqrt(std::max(0.0, length * length - way.head<2>().squaredNorm()));
    };
    return {height(reach.least) - way.z(), height(reach.most) - way.z()};
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
    for (int side = 0; side < 2; ++side) {
      put_foot(side, ankles[side], rotations);
      lift_toe(side, ankles[side], rotations);
    }
  }

  void put_foot(int side, const Vector3& ankle, double* rotations) {
    Leg leg = parts_.target.legs[side];
    const Reach reach = reach_of(leg, to_, motion_.knees[side]);
    const double apart = (ankle - to_.heads[leg.thigh]).norm(), tolerance = kRounding * parts_.target.leg;
    const bool there = (ankle - to_.heads[leg.foot]).norm() < tolerance && apart < reach.most + tolerance &&
                       apart > reach.least - tolerance;
    if (!there) fragmotion::reach(skeleton(), leg, to_, ankle, reach, rotations);
  }

  static double ball_of(const Body& body, int side, const PosedBones& posed) {
    return ball(body.skeleton(), body.legs[side], posed).z();
  }

  // How far the tip of a toe is lower than where it is when the foot stands flat, m; `ball`: of the foot, its place.
  static double toe_depth(const Body& body, int side, double ball, const PosedBones& posed) {
    const int toe = body.legs[side].toe;
    if (toe < 0) return 0;
    const Vector3& tip = body.skeleton().tips[toe];
    return body.soles[side].ball + (body.reference[toe] * tip).z() - ball - (posed.rotations[toe] * tip).z();
  }

  // Bends a toe that would be deeper in the ground than the source's, which may be shorter or stiff, or than any may.
  void lift_toe(int side, const Vector3& ankle, double* rotations) {
    const Leg& leg = parts_.target.legs[side];
    if (leg.toe < 0) return;
    const double ball = ankle.z() + to_.heads[leg.toe].z() - to_.heads[leg.foot].z(),
                 depth = parts_.scale * toe_depth(parts_.source, side, ball_of(parts_.source, side, from_), from_),
                 deeper = toe_depth(parts_.target, side, ball, to_) - std::clamp(depth, 0.0, parts_.toe_depth);
    const Vector3 tip = to_.rotations[leg.toe] * skeleton().tips[leg.toe], axis = tip.cross(Vector3::UnitZ());
    const double length = tip.norm();
    if (deeper < kRounding * parts_.target.leg || axis.norm() < kRounding * length) return;
    const double rise = std::asin(std::min(1.0, (tip.z() + deeper) / length)) - std::asin(tip.z() / length);
    const Quaternion bent = Eigen::AngleAxisd(rise, axis.normalized()) * to_.rotations[leg.toe];
    const Quaternion local = to_.rotations[skeleton().parents[leg.toe]].conjugate() * bent;
    store_quaternion(local.normalized(), rotations + std::ptrdiff_t{4} * leg.toe);
  }

  RetargetReport judge(const Clip& result) const {
    const LegMotion motion(parts_.target, result);
    RetargetReport report;
    report.limb_angles = limb_angles(parts_.source, clip_, parts_.target, result);
    for (int side = 0; side < 2; ++side) {
      const KneeRange &mine = motion.knees[side], &theirs = motion_.knees[side];
      report.knee_beyond = std::max({report.knee_beyond, theirs.least - mine.least, mine.most - theirs.most});
      report.contact_error = std::max(report.contact_error, contact_error(side, motion.paths[side]));
    }
    for (const double move : moves_) report.hips_moved = std::max(report.hips_moved, std::abs(move));
    const double size = standard_scale(parts_.source.skeleton());
    report.foot_skate = skate(motion.paths, parts_.scale, size / parts_.scale);
    report.source_foot_skate = parts_.scale * skate(motion_.paths, 0, size);
    const double slowest = kFileRounding * parts_.scale / size;
    report.foot_skate_ratio = (report.foot_skate + slowest) / (report.source_foot_skate + slowest);
    report.remarks = remarks_on(report, standard_scale(skeleton()));
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
  double skate(const FootPaths& paths, double scale, double size) const {
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
      sum += (path[f] - path[f - 1]).head<2>().norm() * clip_.rate * skate_weight(height);
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
};

Retarget::Retarget(const Body& source, const Body& target) {
  if (source.has_added_feet()) {
    throw std::invalid_argument("'" + source.skeleton().names[0] + "' and its bones have no feet: motion is brought " +
                                "from bodies whose feet tell when they stand");
  }
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
  return parallel_map(static_cast<int>(clips.size()), thread_count(threads), [&](int c) { return apply(clips[c]); });
}

}  // namespace fragmotion
