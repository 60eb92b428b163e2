// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/armature.hpp"
#include "motion/clip.hpp"

namespace fragmotion {

class ShownFeet;

/// What an animation keys: per frame each bone's location and rotation relative to its rest in its parent.
struct Channels {
  int frames = 0;
  std::vector<double> locations;  ///< [frames, bones, 3] in the armature's units
  std::vector<double> rotations;  ///< [frames, bones, 4] unit quaternions, successive ones on the same side
};

/// Turns an armature's channels into clips, and poses back into channels. Its skeleton is the tree of bones that holds
/// the hips, in world metres; bones of other trees are as they are held, else at rest. An armature that its object
/// stretches along the vertical moves as it is without that: heights of skeleton, clips and poses are rise() times as
/// great in the world. A bone that hangs on another than its parent is there in the skeleton, at its place at rest, and
/// its channels are such that it keeps that. The skeleton rests as its bones are held, and as large; but what is below
/// the hips is not turned so, as clips say how it is. Legs without feet reach to the height of the object's origin. A
/// bone that Blender connects to its parent ignores its location: the hips and the first bone must not be connected,
/// for take_channels no bone.
class Rig {
 public:
  /// Throws std::invalid_argument on wrong sizes or order, on rest matrices that are not rigid, on a world matrix whose
  /// scale is not positive and, but for a hundredth and along the vertical, uniform (naming it), on roles or bones that
  /// do not exist or lie in different trees, on a bone that hangs on one that it moves, and on one that is held as, or
  /// is as large as, nothing can be.
  explicit Rig(Armature armature);

  int bones() const { return static_cast<int>(armature_.names.size()); }
  const Skeleton& skeleton() const { return kinematics_.skeleton(); }
  /// The armature's bone that each of the skeleton's is.
  const std::vector<int>& skeleton_bones() const { return skeleton_bones_; }
  /// What takes the hips, and what they carry, from the armature's rest to where they are held and as large as they are
  /// then, in the armature's space. Row-major [4, 4].
  std::array<double, 16> carried() const;
  /// How much taller the object makes it than it makes it wide; 1 but for a hundredth.
  double rise() const { return rise_; }

  /// Channels [frames, bones, 3] and [frames, bones, 4] (need not be unit) to a clip. `worlds` [frames, 4, 4], or null
  /// where the object stands still; its scale must stay. Of the locations what they do to the hips is kept, and
  /// where they bring the feet, as far as legs reach. Throws std::invalid_argument naming the clip, frame and bone.
  Clip clip(const std::string& name, double rate, int frames, const double* locations, const double* rotations,
            const double* worlds = nullptr) const;

  /// Pose matrices [frames, bones, 4, 4] in the armature's space to a clip; their scale is dropped, but for where it
  /// brings the feet. A bone that carries no other, an eye that blinks, may be squashed: it stays turned as it was seen
  /// last. Throws as clip does, also on a mirrored or flat matrix of another bone.
  Clip clip_from_matrices(const std::string& name, double rate, int frames, const double* matrices,
                          const double* worlds = nullptr) const;

  /// Poses as in Clip, [frames, 3] and [frames, skeleton's bones, 4], to channels for the object at `Armature::world`.
  /// The bones above the hips follow the character frame. Inverse of clip.
  Channels channels(int frames, const double* root_positions, const double* rotations) const;

  /// The take as channels of an armature made from a take's skeleton (equal names and directions at rest, any roll):
  /// every head's world position and every bone's rotation away from rest are the take's. Bones that the take lacks
  /// rest. Throws std::invalid_argument naming the take's bones that the rig lacks.
  Channels take_channels(const Take& take) const;

 private:
  struct Rigid {
    Vector3 head = Vector3::Zero();
    Quaternion rotation = Quaternion::Identity();
  };
  struct Object {
    double scale = 1;
    Vector3 uneven = Vector3::Ones();  // times that, along its axes
    Rigid rigid;
  };

  Object parse_object(const double* matrix, const std::string& label) const;
  static std::vector<Rigid> parse_rest(const Armature& armature);
  static std::vector<Rigid> parse_held(const Armature& armature);
  static std::vector<double> parse_sizes(const Armature& armature);
  static std::vector<Rigid> sized(const std::vector<Rigid>& rest, const Armature& armature,
                                  const std::vector<double>& sizes);
  static std::vector<Rigid> in_parents(const std::vector<Rigid>& rest, const std::vector<int>& parents);
  Skeleton make_tree(int root, const std::vector<Rigid>& rest, std::vector<int>& members) const;
  Skeleton choose_tree(std::vector<int>& members) const;
  Skeleton make_body(std::vector<int>& members) const;
  std::vector<Rigid> held_pose(const Skeleton& skeleton) const;

  Object object_at(const std::string& clip, const double* worlds, int frame) const;
  Rigid to_armature(const Vector3& head, const Quaternion& rotation) const;

  /// Forward kinematics in the armature's space; `pose` holds the bone's parent.
  Rigid unmoved(int bone, const Rigid* pose) const;
  Quaternion location_axes(int bone, const Rigid* pose) const;
  double location_unit(int bone) const;
  Rigid moved(int bone, const Rigid* pose, const Vector3& location, const Quaternion& rotation) const;

  Clip empty_clip(const std::string& name, double rate, int frames) const;
  void store_pose(const Object& object, const Rigid* pose, int frame, Clip& clip, ShownFeet& feet) const;
  Channels resting_channels(int frames) const;
  void store_rotation(int bone, const Rigid* pose, int frame, Channels& channels) const;
  void store_location(int bone, const Rigid* pose, int frame, Channels& channels) const;
  std::vector<int> match_take(const Take& take) const;

  Armature armature_;
  double rise_;
  Object object_;              // not stretched
  std::vector<double> sizes_;  // times as large as it rests, with all above it
  std::vector<Rigid> rest_;    // in the armature's space, so large
  std::vector<Rigid> local_;   // in the parent at rest
  std::vector<Rigid> held_;    // away from rest
  std::vector<int> hangs_;     // on which bone each does: by default its parent
  std::vector<int> order_;     // all bones, each after its parent and the one that it hangs on
  std::vector<int> skeleton_bones_;
  Kinematics kinematics_;
};

}  // namespace fragmotion
