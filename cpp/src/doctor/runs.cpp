// SPDX-License-Identifier: MIT
#include "doctor/runs.hpp"

#include <cmath>

#include "fragmotion/motion/pose.hpp"

namespace fragmotion {
namespace {

struct Values {
  double* translation;
  double* rotation;
};

Values values_of(Take& take, int frame, int bone) {
  const std::size_t at = static_cast<std::size_t>(frame) * take.skeleton.size() + bone;
  return {&take.translations[3 * at], &take.rotations[4 * at]};
}

void mix(const Values& a, const Values& b, double weight, const Values& out) {
  store_vector((1 - weight) * load_vector(a.translation) + weight * load_vector(b.translation), out.translation);
  blend_rotations(a.rotation, b.rotation, weight, 1, out.rotation);
}

}  // namespace

void bridge(Take& take, int bone, const Run& run) {
  Take rest = resting_take(take.skeleton);
  const bool before = run.begin > 0, after = run.end + 1 < take.frames;
  const Values a = before  ? values_of(take, run.begin - 1, bone)
                   : after ? values_of(take, run.end + 1, bone)
                           : values_of(rest, 0, bone);
  const Values b = after ? values_of(take, run.end + 1, bone) : a;
  for (int f = run.begin; f <= run.end; ++f) {
    mix(a, b, static_cast<double>(f - run.begin + 1) / (run.length() + 1), values_of(take, f, bone));
  }
}

void append_between(const Take& from, int frame, double weight, Take& to) {
  const std::size_t bones = from.skeleton.names.size(), first = to.translations.size() / 3;
  to.translations.resize(3 * (first + bones));
  to.rotations.resize(4 * (first + bones));
  ++to.frames;
  const std::size_t at = static_cast<std::size_t>(frame) * bones;
  for (std::size_t i = 0; i < 3 * bones; ++i)
    to.translations[3 * first + i] =
        (1 - weight) * from.translations[3 * at + i] + weight * from.translations[3 * (at + bones) + i];
  blend_rotations(&from.rotations[4 * at], &from.rotations[4 * (at + bones)], weight, static_cast<int>(bones),
                  &to.rotations[4 * first]);
}

}  // namespace fragmotion
