// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <map>

#include "arrays.hpp"
#include "fragmotion/io/asf_amc.hpp"
#include "fragmotion/io/bvh.hpp"
#include "fragmotion/io/rotation.hpp"
#include "fragmotion/motion/clip.hpp"
#include "fragmotion/skeleton/kinematics.hpp"
#include "fragmotion/skeleton/role_names.hpp"

namespace fragmotion::bindings {
namespace {

using RoleNames = std::map<std::string, std::string>;

py::array_t<double> quaternions(const std::vector<Quaternion>& values) {
  std::vector<double> result(4 * values.size());
  for (std::size_t i = 0; i < values.size(); ++i) store_quaternion(values[i], &result[4 * i]);
  return to_array(std::move(result), {static_cast<py::ssize_t>(values.size()), 4});
}

py::array_t<double> vectors(const std::vector<Vector3>& values) {
  std::vector<double> result(3 * values.size());
  for (std::size_t i = 0; i < values.size(); ++i) store_vector(values[i], &result[3 * i]);
  return to_array(std::move(result), {static_cast<py::ssize_t>(values.size()), 3});
}

Skeleton new_skeleton(const std::vector<std::string>& names, const std::vector<int>& parents, const Doubles& rotations,
                      const Doubles& offsets, const Doubles& tips, const std::optional<RoleNames>& roles) {
  const auto bones = static_cast<py::ssize_t>(names.size());
  check_shape(rotations, "rest_rotations", {bones, 4});
  check_shape(offsets, "offsets", {bones, 3});
  check_shape(tips, "tips", {bones, 3});
  for (const std::string& name : names) check_name(name);
  Skeleton skeleton;
  skeleton.names = names;
  skeleton.parents = parents;
  for (py::ssize_t b = 0; b < bones; ++b) {
    skeleton.rest_rotations.push_back(load_quaternion(rotations.data(b, 0)));
    skeleton.offsets.push_back(load_vector(offsets.data(b, 0)));
    skeleton.tips.push_back(load_vector(tips.data(b, 0)));
  }
  if (roles) assign_roles(*roles, skeleton);
  return make_skeleton(std::move(skeleton));
}

py::array_t<double> rest_points(const Skeleton& skeleton, bool tails) {
  std::vector<Vector3> heads;
  std::vector<Quaternion> rotations;
  rest_pose(skeleton, heads, rotations);
  for (int b = 0; tails && b < skeleton.size(); ++b) heads[b] += rotations[b] * skeleton.tips[b];
  return vectors(heads);
}

// World positions [F, B, 3] and rotations [F, B, 4].
struct Transforms {
  std::vector<double> positions, rotations;
};

py::tuple to_tuple(Transforms transforms, int frames, int bones) {
  return py::make_tuple(to_array(std::move(transforms.positions), {frames, bones, 3}),
                        to_array(std::move(transforms.rotations), {frames, bones, 4}));
}

void check_bones(const Clip& clip, const Skeleton& skeleton) {
  if (clip.rotations.size() != std::size_t{4} * skeleton.size() * clip.frames) {
    throw std::invalid_argument("clip \"" + clip.name + "\" has not the skeleton's number of bones");
  }
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

void bind_skeleton(py::module_& m) {
  py::class_<Skeleton>(m, "Skeleton", py::module_local())
      .def(py::init(&new_skeleton), py::arg("names"), py::arg("parents"), py::arg("rest_rotations"), py::arg("offsets"),
           py::arg("tips"), py::arg("roles") = py::none())
      .def_readonly("names", &Skeleton::names)
      .def_readonly("parents", &Skeleton::parents)
      .def_property_readonly("rest_rotations", [](const Skeleton& s) { return quaternions(s.rest_rotations); })
      .def_property_readonly("offsets", [](const Skeleton& s) { return vectors(s.offsets); })
      .def_property_readonly("tips", [](const Skeleton& s) { return vectors(s.tips); })
      .def_property_readonly("roles", &named_roles)
      .def_property_readonly("stature", &stature)
      .def("rest_heads", [](const Skeleton& s) { return rest_points(s, false); })
      .def("rest_tails", [](const Skeleton& s) { return rest_points(s, true); });
}

void bind_take(py::module_& m) {
  py::class_<Take>(m, "Take", py::module_local())
      .def_readonly("name", &Take::name)
      .def_readonly("rate", &Take::rate)
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
      .def("world_transforms", [](const Take& take) {
        return to_tuple(without_gil([&] { return take_transforms(take); }), take.frames, take.skeleton.size());
      });
  m.def("read_bvh", &read_bvh, py::arg("path"), py::arg("unit") = 0.01, py::call_guard<GilRelease>());
  m.def("read_asf_amc", &read_asf_amc, py::arg("asf"), py::arg("amc"), py::arg("rate") = 120.0,
        py::call_guard<GilRelease>());
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
      .def(
          "world_transforms",
          [](const Clip& clip, const Skeleton& skeleton) {
            return to_tuple(without_gil([&] { return clip_transforms(clip, skeleton); }), clip.frames, skeleton.size());
          },
          py::arg("skeleton"))
      .def(
          "character_frames",
          [](const Clip& clip, const Skeleton& skeleton) {
            return to_array(without_gil([&] { return clip_frames(clip, skeleton); }), {clip.frames, 3});
          },
          py::arg("skeleton"));
}

void bind_rotations(py::module_& m) {
  m.def(
      "euler_to_quaternion",
      [](const std::string& order, const Doubles& angles) {
        check_shape(angles, "angles", {-1, 3});
        return to_array(euler_to_quaternion(order, angles.data(), static_cast<int>(angles.shape(0))),
                        {angles.shape(0), 4});
      },
      py::arg("order"), py::arg("angles"));
  m.def(
      "quaternion_to_euler",
      [](const std::string& order, const Doubles& rotations) {
        check_shape(rotations, "rotations", {-1, 4});
        return to_array(quaternion_to_euler(order, rotations.data(), static_cast<int>(rotations.shape(0))),
                        {rotations.shape(0), 3});
      },
      py::arg("order"), py::arg("rotations"));
  m.def(
      "axis_angle_to_quaternion",
      [](const Doubles& values) {
        check_shape(values, "axis_angles", {-1, 4});
        return to_array(axis_angle_to_quaternion(values.data(), static_cast<int>(values.shape(0))),
                        {values.shape(0), 4});
      },
      py::arg("axis_angles"));
  m.def(
      "quaternion_to_axis_angle",
      [](const Doubles& values) {
        check_shape(values, "rotations", {-1, 4});
        return to_array(quaternion_to_axis_angle(values.data(), static_cast<int>(values.shape(0))),
                        {values.shape(0), 4});
      },
      py::arg("rotations"));
}

}  // namespace

void bind_motion(py::module_& m) {
  bind_skeleton(m);
  bind_take(m);
  bind_clip(m);
  bind_rotations(m);
}

}  // namespace fragmotion::bindings
