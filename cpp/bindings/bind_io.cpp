// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <map>

#include "arrays.hpp"
#include "base/ranges.hpp"
#include "io/asf_amc.hpp"
#include "io/bvh.hpp"
#include "io/hanging.hpp"
#include "io/joints.hpp"
#include "io/rig.hpp"
#include "io/rotation.hpp"

namespace fragmotion::bindings {
namespace {

std::vector<bool> to_flags(const std::optional<Flags>& flags, const std::string& name, py::ssize_t bones) {
  if (!flags) return {};
  check_shape(*flags, name, {bones});
  return std::vector<bool>(flags->data(), flags->data() + flags->size());
}

Rig new_rig(const std::vector<std::string>& names, const std::vector<int>& parents, const Doubles& rest,
            const Doubles& lengths, const Doubles& world, const std::optional<Flags>& inherit_rotation,
            const std::optional<Flags>& local_location, const std::optional<std::map<std::string, std::string>>& roles,
            const std::optional<std::map<std::string, std::string>>& hangs,
            const std::optional<std::map<std::string, std::array<double, 7>>>& held,
            const std::optional<std::map<std::string, double>>& sizes) {
  const auto bones = static_cast<py::ssize_t>(names.size());
  check_shape(lengths, "lengths", {bones});
  check_shape(world, "world", {4, 4});
  for (const std::string& name : names) check_name(name);
  Armature armature;
  armature.names = names;
  armature.parents = parents;
  armature.rest = to_vector(rest);
  armature.lengths = to_vector(lengths);
  armature.world = to_vector(world);
  armature.inherit_rotation = to_flags(inherit_rotation, "inherit_rotation", bones);
  armature.local_location = to_flags(local_location, "local_location", bones);
  if (roles) armature.roles = *roles;
  if (hangs) armature.hangs = *hangs;
  if (held) armature.held = *held;
  if (sizes) armature.sizes = *sizes;
  return Rig(std::move(armature));
}

const double* checked_worlds(const std::optional<Doubles>& worlds, py::ssize_t frames) {
  if (!worlds) return nullptr;
  check_shape(*worlds, "worlds", {frames, 4, 4});
  return worlds->data();
}

py::tuple to_tuple(Channels channels, py::ssize_t bones) {
  return py::make_tuple(to_array(std::move(channels.locations), {channels.frames, bones, 3}),
                        to_array(std::move(channels.rotations), {channels.frames, bones, 4}));
}

void bind_files(py::module_& m) {
  m.def("read_bvh", &read_bvh, py::arg("path"), py::arg("unit") = 0.01, py::call_guard<GilRelease>());
  m.def("write_bvh", &write_bvh, py::arg("take"), py::arg("path"), py::arg("unit") = 0.01,
        py::call_guard<GilRelease>());
  m.def("read_asf", &read_asf, py::arg("path"), py::call_guard<GilRelease>());
  m.def("find_asf", &find_asf, py::arg("amc"), py::call_guard<GilRelease>());
  m.def("read_asf_amc", &read_asf_amc, py::arg("asf"), py::arg("amc"), py::arg("rate") = 120.0,
        py::call_guard<GilRelease>());
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

void bind_rig(py::module_& m) {
  py::class_<Rig>(m, "Rig", py::module_local())
      .def(py::init(&new_rig), py::arg("names"), py::arg("parents"), py::arg("rest"), py::arg("lengths"),
           py::arg("world"), py::arg("inherit_rotation") = py::none(), py::arg("local_location") = py::none(),
           py::arg("roles") = py::none(), py::arg("hangs") = py::none(), py::arg("held") = py::none(),
           py::arg("sizes") = py::none())
      .def_property_readonly("skeleton", &Rig::skeleton)
      .def_property_readonly("rise", &Rig::rise)
      .def_property_readonly("carried",
                             [](const Rig& rig) {
                               const std::array<double, 16> matrix = rig.carried();
                               return to_array(std::vector<double>(matrix.begin(), matrix.end()), {4, 4});
                             })
      .def(
          "clip",
          [](const Rig& rig, const std::string& name, double rate, const Doubles& locations, const Doubles& rotations,
             const std::optional<Doubles>& worlds) {
            check_name(name);
            check_shape(rotations, "rotations", {-1, rig.bones(), 4});
            const py::ssize_t frames = rotations.shape(0);
            check_shape(locations, "locations", {frames, rig.bones(), 3});
            const double* objects = checked_worlds(worlds, frames);
            return without_gil([&] {
              return rig.clip(name, rate, static_cast<int>(frames), locations.data(), rotations.data(), objects);
            });
          },
          py::arg("name"), py::arg("rate"), py::arg("locations"), py::arg("rotations"), py::arg("worlds") = py::none())
      .def(
          "clip_from_matrices",
          [](const Rig& rig, const std::string& name, double rate, const Doubles& matrices,
             const std::optional<Doubles>& worlds) {
            check_name(name);
            check_shape(matrices, "matrices", {-1, rig.bones(), 4, 4});
            const py::ssize_t frames = matrices.shape(0);
            const double* objects = checked_worlds(worlds, frames);
            return without_gil(
                [&] { return rig.clip_from_matrices(name, rate, static_cast<int>(frames), matrices.data(), objects); });
          },
          py::arg("name"), py::arg("rate"), py::arg("matrices"), py::arg("worlds") = py::none())
      .def(
          "channels",
          [](const Rig& rig, const Doubles& roots, const Doubles& rotations) {
            check_shape(roots, "root_positions", {-1, 3});
            check_shape(rotations, "rotations", {roots.shape(0), rig.skeleton().size(), 4});
            const int frames = static_cast<int>(roots.shape(0));
            return to_tuple(without_gil([&] { return rig.channels(frames, roots.data(), rotations.data()); }),
                            rig.bones());
          },
          py::arg("root_positions"), py::arg("rotations"))
      .def(
          "take_channels",
          [](const Rig& rig, const Take& take) {
            return to_tuple(without_gil([&] { return rig.take_channels(take); }), rig.bones());
          },
          py::arg("take"));
}

int checked_bones(const std::vector<std::string>& names, const std::vector<int>& parents, const Doubles& poses,
                  const std::vector<int>& told) {
  const int bones = static_cast<int>(parents.size());
  check_shape(poses, "poses", {-1, bones, 4, 4});
  for (int b = 0; b < bones; ++b) require_range("a bone's parent", parents[b], -1, b - 1);
  for (const int bone : told) require_range("a bone", bone, 0, bones - 1);
  if (names.size() != parents.size()) throw std::invalid_argument("there must be as many names as parents");
  return static_cast<int>(poses.shape(0));
}

std::map<int, int> hanging(const std::vector<std::string>& names, const std::vector<int>& parents, const Doubles& poses,
                           const std::vector<int>& candidates) {
  const int frames = checked_bones(names, parents, poses, candidates);
  return without_gil([&] { return find_hanging(names, parents, poses.data(), frames, candidates); });
}

std::map<int, int> joints(const std::vector<std::string>& names, const std::vector<int>& parents, const Doubles& poses,
                          const std::vector<int>& bearing) {
  const int frames = checked_bones(names, parents, poses, bearing);
  return without_gil([&] { return find_joints(names, parents, poses.data(), frames, bearing); });
}

double beside(const Doubles& poses, int bone, int other) {
  check_shape(poses, "poses", {-1, -1, 4, 4});
  const int frames = static_cast<int>(poses.shape(0)), bones = static_cast<int>(poses.shape(1));
  for (const int each : {bone, other}) require_range("a bone", each, 0, bones - 1);
  return without_gil([&] { return span_beside(poses.data(), frames, bones, bone, other); });
}

}  // namespace

void bind_io(py::module_& m) {
  bind_files(m);
  bind_rotations(m);
  bind_rig(m);
  m.def("find_hanging", &hanging, py::arg("names"), py::arg("parents"), py::arg("poses"), py::arg("candidates"));
  m.def("find_joints", &joints, py::arg("names"), py::arg("parents"), py::arg("poses"), py::arg("bearing"));
  m.def("span_beside", &beside, py::arg("poses"), py::arg("bone"), py::arg("other"));
}

}  // namespace fragmotion::bindings
