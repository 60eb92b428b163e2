// SPDX-License-Identifier: MIT
#include <algorithm>

#include "arrays.hpp"
#include "fragmotion/bake/fit_keys.hpp"
#include "fragmotion/bake/motion.hpp"

namespace fragmotion::bindings {
namespace {

constexpr double kMostPlace = 1e9, kMostTime = 1e6, kMostRate = 1000;  // m and rad, s, frames a second

Motion to_motion(const Doubles& root_positions, const Doubles& rotations, const Doubles& frames) {
  check_shape(frames, "frames", {-1, 3});
  check_shape(root_positions, "root_positions", {frames.shape(0), 3});
  check_shape(rotations, "rotations", {frames.shape(0), -1, 4});
  if (frames.shape(0) < 1 || rotations.shape(1) < 1)
    throw std::invalid_argument("a motion has a frame and a bone at least");
  return {to_vector(root_positions, "root_positions", -kMostPlace, kMostPlace),
          to_vector(rotations, "rotations", -2, 2), to_vector(frames, "frames", -kMostPlace, kMostPlace)};
}

py::tuple to_tuple(Motion motion) {
  const py::ssize_t count = motion.frames(), bones = motion.bones();
  return py::make_tuple(to_array(std::move(motion.root_positions), {count, 3}),
                        to_array(std::move(motion.rotations), {count, bones, 4}),
                        to_array(std::move(motion.places), {count, 3}));
}

int checked_bone(const Motion& motion, int bone) {
  if (bone >= 0 && bone < motion.bones()) return bone;
  throw std::invalid_argument("bone " + std::to_string(bone) + " does not exist");
}

py::tuple bound_carried(const Doubles& root_positions, const Doubles& rotations, const Doubles& frames, int hips,
                        const Doubles& to) {
  const Motion motion = to_motion(root_positions, rotations, frames);
  checked_bone(motion, hips);
  check_shape(to, "to", {motion.frames(), 3});
  return to_tuple(carried(motion, hips, to_vector(to, "to", -kMostPlace, kMostPlace)));
}

py::tuple bound_looped(const Doubles& root_positions, const Doubles& rotations, const Doubles& frames, int hips,
                       int count) {
  const Motion motion = to_motion(root_positions, rotations, frames);
  return to_tuple(looped(motion, checked_bone(motion, hips), count));
}

py::tuple bound_resampled(const Doubles& times, const Doubles& root_positions, const Doubles& rotations,
                          const Doubles& frames, double rate) {
  const Motion motion = to_motion(root_positions, rotations, frames);
  check_shape(times, "times", {motion.frames()});
  const std::vector<double> shown = to_vector(times, "times", 0, kMostTime);
  if (!std::is_sorted(shown.begin(), shown.end())) throw std::invalid_argument("times do not ascend");
  if (!(rate > 0 && rate <= kMostRate)) throw std::invalid_argument("rate: 0 to 1000 frames a second expected");
  Resampled result = resampled(shown, motion, rate);
  const auto count = static_cast<py::ssize_t>(result.nearest.size());
  return to_tuple(std::move(result.motion)) + py::make_tuple(to_array(std::move(result.nearest), {count}));
}

py::tuple bound_fit_keys(const Doubles& values, double tolerance) {
  check_shape(values, "values", {-1, -1});
  const auto width = static_cast<int>(values.shape(1));
  const std::vector<double> given = to_vector(values);
  FittedKeys keys = without_gil([&] { return fit_keys(given, width, tolerance); });
  const auto count = static_cast<py::ssize_t>(keys.key_frames.size());
  return py::make_tuple(to_array(std::move(keys.key_frames), {count}), to_array(std::move(keys.slopes), {count, width}),
                        to_array(std::move(keys.drawn), {values.shape(0), width}));
}

}  // namespace

void bind_bake(py::module_& m) {
  m.def("carried_motion", &bound_carried, py::arg("root_positions"), py::arg("rotations"), py::arg("frames"),
        py::arg("hips"), py::arg("to"));
  m.def("looped_motion", &bound_looped, py::arg("root_positions"), py::arg("rotations"), py::arg("frames"),
        py::arg("hips"), py::arg("count"));
  m.def("resampled_motion", &bound_resampled, py::arg("times"), py::arg("root_positions"), py::arg("rotations"),
        py::arg("frames"), py::arg("rate"));
  m.def("fit_keys", &bound_fit_keys, py::arg("values"), py::arg("tolerance"));
}

}  // namespace fragmotion::bindings
