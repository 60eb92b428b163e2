// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <map>

#include "arrays.hpp"
#include "skeleton/other_feet.hpp"
#include "skeleton/relaxed_hands.hpp"
#include "skeleton/role_map.hpp"
#include "skeleton/role_names.hpp"
#include "skeleton/roles.hpp"
#include "skeleton/same_skeleton.hpp"
#include "skeleton/skeleton.hpp"
#include "skins.hpp"

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

/// Role -> (bone's name, confidence).
std::map<std::string, std::pair<std::string, double>> role_map(const Skeleton& skeleton,
                                                               const std::optional<Doubles>& heads,
                                                               const BoundSkin* skin) {
  ObservedPoses motion;
  if (heads) {
    check_shape(*heads, "heads", {-1, skeleton.size(), 3});
    motion.poses = static_cast<int>(heads->shape(0));
    for (py::ssize_t i = 0; i < heads->size(); i += 3) motion.heads.push_back(load_vector(heads->data() + i));
    for (const Vector3& head : motion.heads) {
      if (!head.allFinite()) throw std::invalid_argument("heads: a place is not finite");
    }
  }
  std::map<std::string, std::pair<std::string, double>> roles;
  for (const RoleBone& bone :
       find_role_map(skeleton, heads ? &motion : nullptr, Sides::of_the_body, skin_of(skin, skeleton)).bones) {
    roles[role_label(bone)] = {skeleton.names[bone.bone], bone.confidence};
  }
  return roles;
}

}  // namespace

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
      .def("role_map", &role_map, py::arg("heads") = py::none(), py::arg("skin") = py::none())
      .def("other_feet",
           [](const Skeleton& s) {
             std::vector<std::string> feet;
             for (const int bone : other_feet(s)) feet.push_back(s.names[bone]);
             return feet;
           })
      .def_property_readonly("stature", &stature)
      .def("relaxed_pose",
           [](const Skeleton& s) {
             return to_array(relaxed_pose(s), {s.size(), 4});
           })
      .def("rest_heads", [](const Skeleton& s) { return rest_points(s, false); })
      .def("rest_tails", [](const Skeleton& s) { return rest_points(s, true); });
  py::class_<BoundSkin>(m, "Skin", py::module_local())
      .def(py::init<const Skeleton&>(), py::arg("skeleton"))
      .def("add", &BoundSkin::add, py::arg("world"), py::arg("points"), py::arg("groups"), py::arg("weights"));
  std::vector<std::string> roles;
  for (const auto& [name, member] : role_names()) roles.push_back(name);
  m.attr("ROLES") = roles;
  m.def("group_skeletons", &group_skeletons, py::arg("skeletons"), py::call_guard<GilRelease>());
}

}  // namespace fragmotion::bindings
