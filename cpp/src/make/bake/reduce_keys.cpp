// SPDX-License-Identifier: MIT
#include "bake/reduce_keys.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "base/parallel.hpp"
#include "io/rotation.hpp"

namespace fragmotion {
namespace {

constexpr int kRounds = 8;
constexpr double kAim = 0.95;   // of the bound, were deviations in proportion to a track's tolerance
constexpr double kFastest = 2;  // growth of the tolerance from round to round
const char* const kLocation = "LOCATION";

std::vector<double> to_quaternions(const Track& track, const std::vector<double>& values, int frames) {
  if (track.mode == "QUATERNION") return values;
  return track.mode == "AXIS_ANGLE" ? axis_angle_to_quaternion(values.data(), frames)
                                    : euler_to_quaternion(track.mode, values.data(), frames);
}

double angle_between(const Quaternion& a, const Quaternion& b) {
  const double side = a.dot(b) < 0 ? -1 : 1;
  return 4 * std::asin(std::min(1.0, (a.coeffs() - side * b.coeffs()).norm() / 2));
}

FittedKeys every_key(const Track& track, int frames) {
  FittedKeys keys{std::vector<int>(frames), {}, track.values};
  std::iota(keys.key_frames.begin(), keys.key_frames.end(), 0);
  return keys;
}

class Reduction {
 public:
  Reduction(const Rig& rig, const std::vector<Track>& tracks, const ArmatureMotion& motion, const ObjectPlace& place)
      : rig_(rig),
        tracks_(tracks),
        motion_(motion),
        place_(place),
        above_(Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(place.above.data())),
        size_(above_.block<3, 1>(0, 0).norm() * std::abs(place.scale.x())),
        world_(world_of(motion)) {}

  ReducedKeys within(const Deviation& bound, const Progress& progress) const {
    ReducedKeys best;
    for (const Track& track : tracks_) best.tracks.push_back(every_key(track, motion_.bones.frames));
    double share = 1;
    for (int round = 0; round < kRounds; ++round) {
      report(progress, static_cast<double>(round) / kRounds, "Reducing keys");
      ReducedKeys found{fitted({share * bound.distance / size_, share * bound.angle}), {}};
      found.deviation = deviation_of(found.tracks);
      const double excess = std::max(found.deviation.distance / bound.distance, found.deviation.angle / bound.angle);
      if (excess <= 1 && count_keys(found.tracks) < count_keys(best.tracks)) best = std::move(found);
      share *= kAim / std::max(excess, kAim / kFastest);
    }
    return best;
  }

 private:
  // World heads [frames, bones] and orientations [frames, bones, 4] of the skeleton's bones.
  struct World {
    std::vector<Vector3> heads;
    std::vector<Quaternion> orientations;
  };

  std::size_t count_keys(const std::vector<FittedKeys>& keys) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) count += keys[i].key_frames.size() * tracks_[i].width();
    return count;
  }

  // The tolerance is in the armature's units.
  std::vector<FittedKeys> fitted(const Deviation& tolerance) const {
    return parallel_map(static_cast<int>(tracks_.size()), thread_count(0),
                        [&](int i) { return fit_keys(tracks_[i].values, tracks_[i].width(), own(i, tolerance)); });
  }

  // A quaternion's components change half as fast as its angle.
  double own(int track, const Deviation& tolerance) const {
    const std::string& mode = tracks_[track].mode;
    return mode == kLocation ? tolerance.distance : mode == "QUATERNION" ? tolerance.angle / 2 : tolerance.angle;
  }

  ArmatureMotion drawn(const std::vector<FittedKeys>& keys) const {
    ArmatureMotion result = motion_;
    for (std::size_t i = 0; i < keys.size(); ++i) draw(tracks_[i], keys[i].drawn, result);
    return result;
  }

  void draw(const Track& track, const std::vector<double>& values, ArmatureMotion& to) const {
    const int frames = motion_.bones.frames;
    const bool moves = track.mode == kLocation;
    const std::vector<double> shown = moves ? values : to_quaternions(track, values, frames);
    if (track.owner == Track::kObject) {
      (moves ? to.object_locations : to.object_rotations) = shown;
      return;
    }
    const std::size_t width = moves ? 3 : 4;
    std::vector<double>& channel = moves ? to.bones.locations : to.bones.rotations;
    for (int f = 0; f < frames; ++f)
      std::copy_n(&shown[width * f], width,
                  &channel[width * (static_cast<std::size_t>(f) * rig_.bones() + track.owner)]);
  }

  // Of the skeleton's bones in the world, and of all bones' channels, as a clip leaves out those above the hips.
  Deviation deviation_of(const std::vector<FittedKeys>& keys) const {
    const ArmatureMotion after = drawn(keys);
    const World world = world_of(after);
    Deviation most;
    for (std::size_t i = 0; i < world.heads.size(); ++i) {
      most.distance = std::max(most.distance, (world.heads[i] - world_.heads[i]).norm());
      most.angle = std::max(most.angle, angle_between(world_.orientations[i], world.orientations[i]));
    }
    const std::size_t channels = static_cast<std::size_t>(motion_.bones.frames) * rig_.bones();
    for (std::size_t i = 0; i < channels; ++i) {
      const Vector3 was = load_vector(&motion_.bones.locations[3 * i]), is = load_vector(&after.bones.locations[3 * i]);
      most.distance = std::max(most.distance, size_ * (is - was).norm());
      most.angle = std::max(most.angle, angle_between(load_quaternion(&motion_.bones.rotations[4 * i]),
                                                      load_quaternion(&after.bones.rotations[4 * i]).normalized()));
    }
    return most;
  }

  World world_of(const ArmatureMotion& motion) const {
    const std::vector<double> worlds = object_matrices(motion);
    const Clip clip = rig_.clip("", 1, motion.bones.frames, motion.bones.locations.data(),
                                motion.bones.rotations.data(), worlds.empty() ? nullptr : worlds.data());
    const Kinematics kinematics(rig_.skeleton());
    const std::size_t bones = kinematics.bones();
    World result{std::vector<Vector3>(bones * clip.frames), std::vector<Quaternion>(bones * clip.frames)};
    for (int f = 0; f < clip.frames; ++f)
      world(kinematics, clip, f, &result.heads[bones * f], &result.orientations[bones * f]);
    return result;
  }

  // The object's world matrices [frames, 4, 4], or none where it stands still.
  std::vector<double> object_matrices(const ArmatureMotion& motion) const {
    std::vector<double> matrices;
    for (std::size_t f = 0; 3 * f < motion.object_locations.size(); ++f) {
      Eigen::Matrix4d own = Eigen::Matrix4d::Identity();
      own.block<3, 3>(0, 0) =
          load_quaternion(&motion.object_rotations[4 * f]).normalized().toRotationMatrix() * place_.scale.asDiagonal();
      own.block<3, 1>(0, 3) = load_vector(&motion.object_locations[3 * f]);
      const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix = above_ * own;
      matrices.insert(matrices.end(), matrix.data(), matrix.data() + 16);
    }
    return matrices;
  }

  const Rig& rig_;
  const std::vector<Track>& tracks_;
  const ArmatureMotion& motion_;
  const ObjectPlace& place_;
  Eigen::Matrix4d above_;
  double size_;  // metres in one of the armature's units
  World world_;
};

void check_track(const Rig& rig, const Track& track, const ArmatureMotion& motion) {
  if (track.owner != Track::kObject && (track.owner < 0 || track.owner >= rig.bones()))
    throw std::invalid_argument("a track's owner is no bone of the armature: " + std::to_string(track.owner));
  if (track.owner == Track::kObject && motion.object_locations.empty())
    throw std::invalid_argument("a track is of the object, which does not move");
  if (track.values.size() != static_cast<std::size_t>(track.width()) * motion.bones.frames)
    throw std::invalid_argument("a track of mode " + track.mode + " has not " + std::to_string(track.width()) +
                                " values for each frame");
  if (track.mode != kLocation) to_quaternions(track, track.values, motion.bones.frames);
}

void check(const Rig& rig, const std::vector<Track>& tracks, const ArmatureMotion& motion, const ObjectPlace& place,
           const Deviation& bound) {
  const std::size_t frames = std::max(motion.bones.frames, 0);
  if (frames < 1) throw std::invalid_argument("there is no frame to key");
  if (motion.bones.locations.size() != 3 * frames * rig.bones() ||
      motion.bones.rotations.size() != 4 * frames * rig.bones())
    throw std::invalid_argument("a location and a rotation of every bone of the armature expected for each frame");
  const bool moves = !motion.object_locations.empty() || !motion.object_rotations.empty();
  if (moves && (motion.object_locations.size() != 3 * frames || motion.object_rotations.size() != 4 * frames))
    throw std::invalid_argument("a location and a rotation of the object expected for each frame, or neither");
  if (place.above.size() != 16) throw std::invalid_argument("a matrix [4, 4] above the object expected");
  if (!(bound.distance > 0 && bound.angle > 0))
    throw std::invalid_argument("the distance and the angle that keys may be off must be above 0");
  for (const Track& track : tracks) check_track(rig, track, motion);
}

}  // namespace

ReducedKeys reduce_keys(const Rig& rig, const std::vector<Track>& tracks, const ArmatureMotion& motion,
                        const ObjectPlace& place, const Deviation& bound, const Progress& progress) {
  check(rig, tracks, motion, place, bound);
  return Reduction(rig, tracks, motion, place).within(bound, progress);
}

}  // namespace fragmotion
