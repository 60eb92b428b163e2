// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "base/ranges.hpp"
#include "base/take_limits.hpp"
#include "clips.hpp"
#include "motion/bobbing.hpp"
#include "motion/clip.hpp"
#include "motion/cycle.hpp"
#include "motion/discontinuities.hpp"
#include "motion/fingers.hpp"
#include "motion/in_place.hpp"
#include "motion/mirror.hpp"
#include "motion/motions_within.hpp"
#include "motion/one_floor.hpp"
#include "motion/stands.hpp"
#include "motion/told_by_motion.hpp"
#include "skeleton/kinematics.hpp"

namespace fragmotion::bindings {
namespace {

// World positions [F, B, 3] and rotations [F, B, 4].
struct Transforms {
  std::vector<double> positions, rotations;
};

py::tuple to_tuple(Transforms transforms, int frames, int bones) {
  return py::make_tuple(to_array(std::move(transforms.positions), {frames, bones, 3}),
                        to_array(std::move(transforms.rotations), {frames, bones, 4}));
}

// A function of a clip on its skeleton, as a method of the clip.
template <typename Function>
auto on_skeleton(const Function& function) {
  return [function](const Clip& clip, const Skeleton& skeleton) {
    check_bones(clip, skeleton);
    return without_gil([&] { return function(clip, skeleton); });
  };
}

// [begin, end) of each.
std::vector<std::pair<int, int>> spans_within(const Clip& clip, const Skeleton& skeleton) {
  std::vector<std::pair<int, int>> spans;
  for (const Span& span : motions_within(Kinematics(skeleton), clip)) spans.emplace_back(span.first, span.last + 1);
  return spans;
}

/// x, y and heading of the character frame in each frame of the clip.
std::vector<double> clip_frames(const Clip& clip, const Skeleton& skeleton) {
  check_bones(clip, skeleton);
  const Kinematics kinematics(skeleton);
  std::vector<double> frames;
  for (int f = 0; f < clip.frames; ++f) {
    const std::size_t hips = std::size_t{4} * (std::size_t(skeleton.size()) * f + skeleton.roles.hips);
    const CharacterFrame frame =
        kinematics.frame(load_vector(&clip.root_positions[3 * std::size_t(f)]), load_quaternion(&clip.rotations[hips]));
    frames.insert(frames.end(), {frame.position.x(), frame.position.y(), frame.heading});
  }
  return frames;
}

Transforms clip_transforms(const Clip& clip, const Skeleton& skeleton) {
  check_bones(clip, skeleton);
  const Kinematics kinematics(skeleton);
  const std::size_t bones = kinematics.bones();
  Transforms world{std::vector<double>(3 * bones * clip.frames), std::vector<double>(4 * bones * clip.frames)};
  std::vector<Vector3> heads(bones);
  std::vector<Quaternion> orientations(bones);
  for (int f = 0; f < clip.frames; ++f) {
    fragmotion::world(kinematics, clip, f, heads.data(), orientations.data());
    for (std::size_t b = 0; b < bones; ++b) {
      store_vector(heads[b], &world.positions[3 * (f * bones + b)]);
      store_quaternion(orientations[b], &world.rotations[4 * (f * bones + b)]);
    }
  }
  return world;
}

Transforms take_transforms(const Take& take) {
  Transforms world;
  world_transforms(take, world.positions, world.rotations);
  return world;
}

Clip new_clip(const Skeleton& skeleton, const std::string& name, double rate, const Doubles& roots,
              const Doubles& rotations) {
  check_name(name);
  check_shape(roots, "root_positions", {-1, 3});
  check_shape(rotations, "rotations", {roots.shape(0), skeleton.size(), 4});
  Clip clip{name, rate, static_cast<int>(roots.shape(0)), to_vector(roots), to_vector(rotations), {}};
  return without_gil([&] { return make_clip(skeleton, std::move(clip)); });
}

/// The clip on the way that its feet tell, at `speed` m/s or, where that is 0, as fast as they tell; and how fast that
/// is, m/s: 0 where they tell none, and it goes straight ahead.
std::optional<std::tuple<Clip, double>> led_by_feet(const Clip& clip, const Skeleton& skeleton, double speed) {
  const Kinematics kinematics(skeleton);
  std::optional<FeetWay> way = find_feet_way(kinematics, clip);
  const double found = way ? way->mean.norm() : 0;
  if (!way && speed > 0) way = way_ahead(kinematics, clip, speed);
  if (!way) return std::nullopt;
  const double faster = speed > 0 && found > 0 ? speed / found : 1;
  return std::tuple(without_held_end(led(kinematics, clip, *way, faster)), found);
}

Take new_take(const Skeleton& skeleton, const std::string& name, double rate, const Doubles& translations,
              const Doubles& rotations, double unit) {
  check_name(name);
  check_shape(translations, "translations", {-1, skeleton.size(), 3});
  check_shape(rotations, "rotations", {translations.shape(0), skeleton.size(), 4});
  Take take{skeleton, name, rate, static_cast<int>(translations.shape(0)), to_vector(translations), {}, unit};
  take.rotations = to_vector(rotations);
  return make_take(std::move(take));
}

using Markers = std::vector<std::pair<double, std::string>>;

Markers markers_of(const Clip& clip) {
  Markers markers;
  for (const Marker& marker : clip.markers) markers.emplace_back(marker.frame, marker.name);
  return markers;
}

Clip with_markers(Clip clip, const Markers& markers) {
  clip.markers.clear();
  for (const auto& [frame, name] : markers) {
    check_name(name);
    clip.markers.push_back({name, frame});
  }
  check_markers(clip.markers, clip.frames);
  return clip;
}

Clip as_led(Clip clip) {
  clip.led = true;
  return clip;
}

double too_far(const Skeleton& skeleton, const std::vector<Clip>& clips) {
  check_bones(clips, skeleton);
  return bobs_too_far(Kinematics(skeleton), clips);
}

std::vector<Clip> mirrored(const Skeleton& skeleton, const std::vector<Clip>& clips) {
  check_bones(clips, skeleton);
  if (clips.empty()) return {};
  const Kinematics kinematics(skeleton);
  const Mirror mirror(kinematics, clips);
  std::vector<Clip> images;
  for (const Clip& clip : clips) images.push_back(mirror(clip));
  return images;
}

std::vector<Clip> on_one_floor(const Skeleton& skeleton, std::vector<Clip> clips) {
  check_bones(clips, skeleton);
  put_level_on_one_floor(Kinematics(skeleton), clips);
  return clips;
}

void bind_take(py::module_& m) {
  py::class_<Take, std::shared_ptr<Take>>(m, "Take", py::module_local())
      .def(py::init(&new_take), py::arg("skeleton"), py::arg("name"), py::arg("rate"), py::arg("translations"),
           py::arg("rotations"), py::arg("unit") = 1.0)
      .def_readonly("name", &Take::name)
      .def_readonly("rate", &Take::rate)
      .def_readonly("unit", &Take::unit)
      .def_readonly("skeleton", &Take::skeleton)
      .def_property_readonly("translations",
                             [](const py::object& self) {
                               const auto& take = self.cast<const Take&>();
                               return view(take.translations, {take.frames, take.skeleton.size(), 3}, self);
                             })
      .def_property_readonly("rotations",
                             [](const py::object& self) {
                               const auto& take = self.cast<const Take&>();
                               return view(take.rotations, {take.frames, take.skeleton.size(), 4}, self);
                             })
      .def_static(
          "from_clip",
          [](const Clip& clip, const Skeleton& skeleton) {
            check_bones(clip, skeleton);
            return without_gil([&] { return take_from_clip(skeleton, clip); });
          },
          py::arg("clip"), py::arg("skeleton"))
      .def("world_transforms", [](const Take& take) {
        return to_tuple(without_gil([&] { return take_transforms(take); }), take.frames, take.skeleton.size());
      });
}

void bind_four_legs(py::module_& m) {
  m.def(
      "tell_four_legs",
      [](const std::vector<std::shared_ptr<Take>>& takes) {
        std::vector<Take*> each;
        for (const std::shared_ptr<Take>& take : takes) {
          if (take == nullptr) throw py::type_error("a take is None");
          each.push_back(take.get());
        }
        without_gil([&] { tell_four_legs(each); });
      },
      py::arg("takes"));
}

void bind_clip(py::module_& m) {
  py::class_<Clip>(m, "Clip", py::module_local())
      .def(py::init(&new_clip), py::arg("skeleton"), py::arg("name"), py::arg("rate"), py::arg("root_positions"),
           py::arg("rotations"))
      .def_static(
          "from_take",
          [](const Take& take, const std::optional<Skeleton>& skeleton) {
            return without_gil([&] { return clip_from_take(skeleton ? *skeleton : take.skeleton, take); });
          },
          py::arg("take"), py::arg("skeleton") = py::none())
      .def_readonly("name", &Clip::name)
      .def_readonly("rate", &Clip::rate)
      .def_property_readonly("root_positions",
                             [](const py::object& self) {
                               const auto& clip = self.cast<const Clip&>();
                               return view(clip.root_positions, {clip.frames, 3}, self);
                             })
      .def_property_readonly("rotations",
                             [](const py::object& self) {
                               const auto& clip = self.cast<const Clip&>();
                               const auto bones = static_cast<py::ssize_t>(clip.rotations.size()) / clip.frames / 4;
                               return view(clip.rotations, {clip.frames, bones, 4}, self);
                             })
      .def_property_readonly("markers", &markers_of)
      .def_readonly("led", &Clip::led)
      .def("as_led", &as_led)
      .def("with_markers", &with_markers, py::arg("markers"), py::call_guard<GilRelease>())
      .def(
          "world_transforms",
          [](const Clip& clip, const Skeleton& skeleton) {
            return to_tuple(without_gil([&] { return clip_transforms(clip, skeleton); }), clip.frames, skeleton.size());
          },
          py::arg("skeleton"))
      .def(
          "with_fingers",
          [](const Clip& clip, const Skeleton& skeleton, const Doubles& pose) {
            check_bones(clip, skeleton);
            check_shape(pose, "pose", {skeleton.size(), 4});
            const std::vector<double> rotations = to_vector(pose, "pose", -1.001, 1.001);
            return without_gil([&] { return with_fingers(skeleton, clip, rotations); });
          },
          py::arg("skeleton"), py::arg("pose"))
      .def(
          "led_by_feet",
          [](const Clip& clip, const Skeleton& skeleton, double speed) -> std::optional<std::tuple<Clip, double>> {
            check_bones(clip, skeleton);
            require_range("speed", speed, 0, kFastestBody);
            return without_gil([&] { return led_by_feet(clip, skeleton, speed); });
          },
          py::arg("skeleton"), py::arg("speed") = 0.0)
      .def("may_go",
           on_skeleton([](const Clip& clip, const Skeleton& skeleton) { return may_go(Kinematics(skeleton), clip); }),
           py::arg("skeleton"))
      .def("bobs",
           on_skeleton([](const Clip& clip, const Skeleton& skeleton) { return bobs(Kinematics(skeleton), clip); }),
           py::arg("skeleton"))
      .def("discontinuities",
           on_skeleton([](const Clip& clip, const Skeleton& skeleton) { return discontinuities(skeleton, clip); }),
           py::arg("skeleton"))
      .def("stands",
           on_skeleton([](const Clip& clip, const Skeleton& skeleton) { return stands(Kinematics(skeleton), clip); }),
           py::arg("skeleton"))
      .def("motions_within", on_skeleton(&spans_within), py::arg("skeleton"))
      .def(
          "character_frames",
          [](const Clip& clip, const Skeleton& skeleton) {
            return to_array(without_gil([&] { return clip_frames(clip, skeleton); }), {clip.frames, 3});
          },
          py::arg("skeleton"));
}

}  // namespace

void bind_motion(py::module_& m) {
  bind_take(m);
  bind_four_legs(m);
  bind_clip(m);
  m.def("mirrored", &mirrored, py::arg("skeleton"), py::arg("clips"), py::call_guard<GilRelease>());
  m.def("bobs_too_far", &too_far, py::arg("skeleton"), py::arg("clips"), py::call_guard<GilRelease>());
  m.def("on_one_floor", &on_one_floor, py::arg("skeleton"), py::arg("clips"), py::call_guard<GilRelease>());
}

}  // namespace fragmotion::bindings
