// SPDX-License-Identifier: MIT
#include "motion/one_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/decompositions.hpp"
#include "base/parallel.hpp"
#include "base/quantile.hpp"
#include "base/turn_between.hpp"
#include "motion/soles.hpp"

namespace fragmotion {
namespace {

// How far feet stand over the usual floors, m; not finite where a clip has no feet.
double height_over(const Floors& usual, const Contacts& contacts) {
  const bool on_toes = !contacts.feet[2].empty();  // an animal's heels are on the ground where it sits alone
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t foot = 0; foot < usual.size(); ++foot) {
    if (contacts.feet[foot].empty()) continue;
    const FootHeights& floor = contacts.floors[foot];
    least = std::min(least, floor.ball - usual[foot].ball);
    if (!on_toes) least = std::min(least, floor.heel - usual[foot].heel);
  }
  return least;
}

void lower(double by, Clip& clip, Contacts& contacts) {
  for (std::size_t z = 2; z < clip.root_positions.size(); z += 3) clip.root_positions[z] -= by;
  for (FootHeights& floor : contacts.floors) floor.ball -= by, floor.heel -= by;
}

// Adds where a foot stands in each of its contacts, seen from the mean of these; whether it does in any.
bool add_stands(const FootPath& foot, const std::vector<bool>& contacts, std::vector<Vector3>& all) {
  const std::size_t first = all.size(), frames = contacts.size();
  Vector3 mean = Vector3::Zero();
  for (std::size_t f = 0; f < frames; ++f) {
    Vector3 sum = Vector3::Zero();
    std::vector<double> heights;
    for (; f < frames && contacts[f]; ++f) sum += foot.ball[f], heights.push_back(foot.ball[f].z());
    if (heights.empty()) continue;
    sum /= static_cast<double>(heights.size());
    all.emplace_back(sum.x(), sum.y(), median(std::move(heights)));
    mean += all.back();
  }
  const std::size_t count = all.size() - first;
  for (std::size_t i = first; i < all.size(); ++i) all[i] -= mean / static_cast<double>(count);
  return count > 0;
}

// Contacts wherever the floor is: of feet that are as still as ones that stand, and no higher than another one by more
// than those of a level floor may be.
Contacts contacts_anywhere(const Skeleton& skeleton, const FootPaths& paths, const std::vector<Vector3>& hips,
                           double rate) {
  const double any = std::numeric_limits<double>::infinity();
  Floors anywhere;
  anywhere.fill({any, any});
  Contacts contacts = find_contacts(skeleton, paths, hips, rate, &anywhere);
  for (std::size_t f = 0; f < hips.size(); ++f) {
    double lowest = any;
    for (int foot = 0; foot < paths.count(); ++foot) lowest = std::min(lowest, paths[foot].ball[f].z());
    lowest += kContactHeight / standard_scale(skeleton);
    for (int foot = 0; foot < paths.count(); ++foot)
      contacts.feet[foot][f] = contacts.feet[foot][f] && paths[foot].ball[f].z() <= lowest;
  }
  return contacts;
}

// The slope along an axis by which these rise, and how much of the sum of their squared heights it explains; 0 where
// all are within `near`, or rise by no more than `level`.
struct Rise {
  double slope = 0, explains = 0;
};

Rise rise_along(const Vector3& axis, const std::vector<Vector3>& stands, double near, double level) {
  double least = 0, most = 0, square = 0, product = 0;
  for (const Vector3& stand : stands) {
    const double along = dot(axis, stand);
    least = std::min(least, along), most = std::max(most, along);
    square += along * along, product += along * stand.z();
  }
  const double apart = most - least;
  if (!(apart > near) || !(std::abs(product) * apart > level * square)) return {};
  return {product / square, product * product / square};
}

void turn(const Quaternion& by, int hips, int bones, Clip& clip) {
  for (int f = 0; f < clip.frames; ++f) {
    double *place = &clip.root_positions[std::size_t{3} * f],
           *rotation = &clip.rotations[std::size_t{4} * (std::size_t{1} * bones * f + hips)];
    store_vector(by * load_vector(place), place);
    store_quaternion(by * load_quaternion(rotation), rotation);
  }
}

}  // namespace

Vector2 floor_slope(const Skeleton& skeleton, const FootPaths& paths, const std::vector<Vector3>& hips, double rate) {
  const Contacts contacts = contacts_anywhere(skeleton, paths, hips, rate);
  std::vector<Vector3> stands;
  double unknown = 0, heights = 0;  // the height of each foot that stands, and slopes; the sum of squares
  for (int foot = 0; foot < paths.count(); ++foot)
    unknown += add_stands(paths[foot], contacts.feet[foot], stands) ? 1 : 0;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3& stand : stands) {
    const Vector3 place(stand.x(), stand.y(), 0);
    spread += place * place.transpose();
    heights += stand.z() * stand.z();
  }
  const Eigen::Matrix3d axes = principal_axes(spread);
  const double scale = standard_scale(skeleton), leg = kLegOfStature * stature(skeleton),
               count = static_cast<double>(stands.size()), all = heights / (count - unknown);
  Vector2 slope = Vector2::Zero();
  for (int i = 0; i < 2; ++i) {
    const Rise rise = rise_along(axes.col(i), stands, leg, kFlatSole / scale);
    slope += rise.slope * axes.col(i).head<2>();
    heights -= rise.explains;
    unknown += rise.slope == 0 ? 0 : 1;
  }
  const bool is_told = count > unknown && heights / (count - unknown) < (1 - kExplained) * all,
             is_floor = slope.norm() * leg * scale <= kContactHeight;
  return is_told && is_floor ? slope : Vector2::Zero();
}

Contacts put_level(const Kinematics& kinematics, Clip& clip) {
  const Skeleton& skeleton = kinematics.skeleton();
  const FootPaths paths = foot_paths(kinematics, clip);
  const std::vector<Vector3> hips = hips_path(clip);
  const Vector2 slope = floor_slope(skeleton, paths, hips, clip.rate);
  if (slope.isZero(0)) return find_contacts(skeleton, paths, hips, clip.rate);
  turn(turn_between({-slope.x(), -slope.y(), 1}, Vector3::UnitZ()), skeleton.roles.hips, skeleton.size(), clip);
  return find_contacts(kinematics, clip);
}

void put_on_one_floor(std::vector<Clip>& clips, std::vector<Contacts>& contacts) {
  const Floors usual = usual_floors(contacts);
  for (std::size_t c = 0; c < clips.size(); ++c) {
    const double over = height_over(usual, contacts[c]);
    if (std::isfinite(over)) lower(over, clips[c], contacts[c]);
  }
}

std::vector<Contacts> put_level_on_one_floor(const Kinematics& kinematics, std::vector<Clip>& clips, int threads) {
  std::vector<Contacts> contacts =
      parallel_map(static_cast<int>(clips.size()), threads, [&](int c) { return put_level(kinematics, clips[c]); });
  put_on_one_floor(clips, contacts);
  return contacts;
}

}  // namespace fragmotion
