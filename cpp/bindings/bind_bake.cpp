// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <tuple>

#include "arrays.hpp"
#include "bake/fit_keys.hpp"
#include "bake/loop.hpp"
#include "bake/reduce_keys.hpp"
#include "bake/resample.hpp"
#include "base/ranges.hpp"

namespace fragmotion::bindings {
namespace {

constexpr double kMostTime = 1e6, kMostRate = 1000;  // s, frames a second

Motion to_motion(const Doubles& root_positions, const Doubles& rotations, const Doubles& path) {
  check_shape(path, "path", {-1, 3});
  check_shape(root_positions, "root_positions", {path.shape(0), 3});
  check_shape(rotations, "rotations", {path.shape(0), -1, 4});
  if (path.shape(0) < 1 || rotations.shape(1) < 1)
    throw std::invalid_argument("a motion has a frame and a bone at least");
  return {0, to_vector(root_positions, "root_positions", -kFarthestPlace, kFarthestPlace),
          to_vector(rotations, "rotations", -2, 2), to_vector(path, "path", -kFarthestPlace, kFarthestPlace)};
}

py::tuple to_tuple(Motion motion) {
  const py::ssize_t count = motion.frames(), bones = motion.bones();
  return py::make_tuple(to_array(std::move(motion.root_positions), {count, 3}),
                        to_array(std::move(motion.rotations), {count, bones, 4}),
                        to_array(std::move(motion.path), {count, 3}));
}

int checked_bone(const Motion& motion, int bone) {
  if (bone >= 0 && bone < motion.bones()) return bone;
  throw std::invalid_argument("bone " + std::to_string(bone) + " does not exist");
}

py::tuple bound_carried(const Doubles& root_positions, const Doubles& rotations, const Doubles& path, int hips,
                        const Doubles& to) {
  const Motion motion = to_motion(root_positions, rotations, path);
  checked_bone(motion, hips);
  check_shape(to, "to", {motion.frames(), 3});
  return to_tuple(carried(motion, hips, to_vector(to, "to", -kFarthestPlace, kFarthestPlace)));
}

py::tuple bound_looped(const Doubles& root_positions, const Doubles& rotations, const Doubles& path, int hips,
                       int count) {
  const Motion motion = to_motion(root_positions, rotations, path);
  return to_tuple(looped(motion, checked_bone(motion, hips), count));
}

py::tuple bound_resampled(const Doubles& times, const Doubles& root_positions, const Doubles& rotations,
                          const Doubles& path, double rate) {
  const Motion motion = to_motion(root_positions, rotations, path);
  check_shape(times, "times", {motion.frames()});
  const std::vector<double> shown = to_vector(times, "times", 0, kMostTime);
  if (!std::is_sorted(shown.begin(), shown.end())) throw std::invalid_argument("times do not ascend");
  if (!(rate > 0 && rate <= kMostRate)) throw std::invalid_argument("rate: 0 to 1000 frames a second expected");
  Resampled result = resampled(shown, motion, rate);
  const auto count = static_cast<py::ssize_t>(result.nearest.size());
  return to_tuple(std::move(result.motion)) + py::make_tuple(to_array(std::move(result.nearest), {count}));
}

py::tuple keys_tuple(FittedKeys keys, py::ssize_t width) {
  const auto count = static_cast<py::ssize_t>(keys.key_frames.size()),
             frames = static_cast<py::ssize_t>(keys.drawn.size()) / width;
  py::object slopes = py::none();
  if (!keys.slopes.empty()) slopes = to_array(std::move(keys.slopes), {count, width});
  return py::make_tuple(to_array(std::move(keys.key_frames), {count}), slopes,
                        to_array(std::move(keys.drawn), {frames, width}));
}

py::tuple bound_fit_keys(const Doubles& values, double tolerance) {
  check_shape(values, "values", {-1, -1});
  const auto width = static_cast<int>(values.shape(1));
  const std::vector<double> given = to_vector(values);
  return keys_tuple(without_gil([&] { return fit_keys(given, width, tolerance); }), width);
}

Track to_track(const std::tuple<int, std::string, Doubles>& given, py::ssize_t frames) {
  Track track{std::get<0>(given), std::get<1>(given), {}};
  check_shape(std::get<2>(given), "a track's values", {frames, track.width()});
  track.values = to_vector(std::get<2>(given));
  return track;
}

ArmatureMotion to_armature_motion(const Rig& rig, const Doubles& locations, const Doubles& rotations,
                                  const std::optional<Doubles>& object_locations,
                                  const std::optional<Doubles>& object_rotations) {
  check_shape(rotations, "rotations", {-1, rig.bones(), 4});
  check_shape(locations, "locations", {rotations.shape(0), rig.bones(), 3});
  ArmatureMotion motion{{static_cast<int>(rotations.shape(0)), to_vector(locations), to_vector(rotations)}, {}, {}};
  if (object_locations) motion.object_locations = to_vector(*object_locations);
  if (object_rotations) motion.object_rotations = to_vector(*object_rotations);
  return motion;
}

py::tuple bound_reduce_keys(const Rig& rig, const std::vector<std::tuple<int, std::string, Doubles>>& tracks,
                            const Doubles& locations, const Doubles& rotations,
                            const std::optional<Doubles>& object_locations,
                            const std::optional<Doubles>& object_rotations, const Doubles& above, const Doubles& scale,
                            double distance, double angle, const py::object& progress) {
  const ArmatureMotion motion = to_armature_motion(rig, locations, rotations, object_locations, object_rotations);
  std::vector<Track> given;
  for (const auto& track : tracks) given.push_back(to_track(track, motion.bones.frames));
  check_shape(above, "above", {4, 4});
  check_shape(scale, "scale", {3});
  const ObjectPlace place{to_vector(above), {scale.at(0), scale.at(1), scale.at(2)}};
  ReducedKeys reduced = without_gil(progress, [&](const Progress& told) {
    return reduce_keys(rig, given, motion, place, {distance, angle}, told);
  });
  py::list keys;
  for (std::size_t i = 0; i < given.size(); ++i)
    keys.append(keys_tuple(std::move(reduced.tracks[i]), given[i].width()));
  return py::make_tuple(keys, reduced.deviation.distance, reduced.deviation.angle);
}

}  // namespace

void bind_bake(py::module_& m) {
  m.def("carried_motion", &bound_carried, py::arg("root_positions"), py::arg("rotations"), py::arg("path"),
        py::arg("hips"), py::arg("to"));
  m.def("looped_motion", &bound_looped, py::arg("root_positions"), py::arg("rotations"), py::arg("path"),
        py::arg("hips"), py::arg("count"));
  m.def("resampled_motion", &bound_resampled, py::arg("times"), py::arg("root_positions"), py::arg("rotations"),
        py::arg("path"), py::arg("rate"));
  m.def("fit_keys", &bound_fit_keys, py::arg("values"), py::arg("tolerance"));
  m.def("reduce_keys", &bound_reduce_keys, py::arg("rig"), py::arg("tracks"), py::arg("locations"),
        py::arg("rotations"), py::arg("object_locations"), py::arg("object_rotations"), py::arg("above"),
        py::arg("scale"), py::arg("distance"), py::arg("angle"), py::arg("progress") = py::none());
}

}  // namespace fragmotion::bindings
