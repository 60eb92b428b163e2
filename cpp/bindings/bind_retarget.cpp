// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <algorithm>
#include <map>

#include "arrays.hpp"
#include "clips.hpp"
#include "retarget/doubts.hpp"
#include "retarget/retarget.hpp"
#include "skins.hpp"

namespace fragmotion::bindings {
namespace {

ObservedPoses observed(const Skeleton& skeleton, const std::vector<Clip>& clips) {
  const Kinematics kinematics(skeleton);
  PosedBones posed(skeleton.size());
  int frames = 0;
  for (const Clip& clip : clips) frames += clip.frames;
  ObservedPoses poses;
  for (const Clip& clip : clips) {
    for (int f = 0; f < clip.frames; f += frames_between_looks(frames)) {
      world(kinematics, clip, f, posed.heads.data(), posed.rotations.data());
      poses.heads.insert(poses.heads.end(), posed.heads.begin(), posed.heads.end());
      ++poses.poses;
    }
  }
  return poses;
}

using NamedBones = std::map<std::string, std::string>;

RoleMap found_map(const Skeleton& skeleton, const std::vector<Clip>& clips, const Skin* skin) {
  if (clips.empty()) return find_role_map(skeleton, nullptr, Sides::of_the_body, skin);
  const ObservedPoses poses = observed(skeleton, clips);
  return find_role_map(skeleton, &poses, Sides::of_the_body, skin);
}

Body new_body(const Skeleton& skeleton, const std::vector<Clip>& clips, const std::optional<NamedBones>& roles,
              const NamedBones& told, const BoundSkin* bound) {
  check_bones(clips, skeleton);
  const Skin* skin = skin_of(bound, skeleton);
  const RoleMap map = roles ? role_map_of(skeleton, *roles) : found_map(skeleton, clips, skin);
  return make_body(skeleton, told.empty() ? map : with_told(skeleton, map, told), clips, skin);
}

NamedBones own_roles(const Body& body) {
  RoleMap map = body.map;
  const auto is_added = [&](const RoleBone& bone) { return bone.bone >= body.own_skeleton().size(); };
  map.bones.erase(std::remove_if(map.bones.begin(), map.bones.end(), is_added), map.bones.end());
  return named_bones(body.own_skeleton(), map);
}

}  // namespace

void bind_retarget(py::module_& m) {
  m.def(
      "role_doubts",
      [](const Skeleton& skeleton, const std::optional<NamedBones>& roles, const BoundSkin* bound) {
        const Skin* skin = skin_of(bound, skeleton);
        const RoleMap map = roles ? role_map_of(skeleton, *roles) : found_map(skeleton, {}, skin);
        std::vector<std::tuple<std::string, std::string, std::string>> doubts;
        for (const RoleDoubt& doubt : find_doubts(skeleton, map, skin)) {
          doubts.emplace_back(doubt.role, skeleton.names[doubt.bone], doubt.text);
        }
        return doubts;
      },
      py::arg("skeleton"), py::arg("roles") = py::none(), py::arg("skin") = py::none());
  py::class_<Body>(m, "Body", py::module_local())
      .def(py::init([](const Skeleton& skeleton, const std::vector<Clip>& clips, const std::optional<NamedBones>& roles,
                       const NamedBones& told, const BoundSkin* skin) {
             return without_gil([&] { return new_body(skeleton, clips, roles, told, skin); });
           }),
           py::arg("skeleton"), py::arg("clips") = std::vector<Clip>(), py::arg("roles") = py::none(),
           py::arg("told") = NamedBones(), py::arg("skin") = py::none())
      .def_property_readonly("skeleton", &Body::own_skeleton)
      .def_property_readonly("roles", &own_roles)
      .def_readonly("stands", &Body::stands)
      .def_property_readonly("reference", [](const Body& body) {
        const int bones = body.own_skeleton().size();
        std::vector<double> rotations(std::size_t{4} * bones);
        for (int b = 0; b < bones; ++b) store_quaternion(body.reference[b], &rotations[std::size_t{4} * b]);
        return to_array(std::move(rotations), {bones, 4});
      });
  py::class_<RetargetedClip>(m, "RetargetedClip", py::module_local())
      .def_readonly("clip", &RetargetedClip::clip)
      .def_property_readonly("foot_skate", [](const RetargetedClip& r) { return r.report.foot_skate; })
      .def_property_readonly("source_foot_skate", [](const RetargetedClip& r) { return r.report.source_foot_skate; })
      .def_property_readonly("foot_skate_ratio", [](const RetargetedClip& r) { return r.report.foot_skate_ratio; })
      .def_property_readonly("contact_error", [](const RetargetedClip& r) { return r.report.contact_error; })
      .def_property_readonly("knee_beyond", [](const RetargetedClip& r) { return r.report.knee_beyond; })
      .def_property_readonly("hips_moved", [](const RetargetedClip& r) { return r.report.hips_moved; })
      .def_property_readonly("limb_angles", [](const RetargetedClip& r) { return r.report.limb_angles; })
      .def_property_readonly("remarks", [](const RetargetedClip& r) {
        std::vector<std::tuple<std::string, std::string, std::string>> remarks;
        for (const RetargetRemark& remark : r.report.remarks) {
          remarks.emplace_back(remark.code, remark.is_error ? "error" : "warning", remark.text);
        }
        return remarks;
      });
  py::class_<Retarget>(m, "Retarget", py::module_local())
      .def(py::init([](const Body& source, const Body& target) {
             return without_gil([&] { return Retarget(source, target); });
           }),
           py::arg("source"), py::arg("target"))
      .def_property_readonly("scale", &Retarget::scale)
      .def(
          "apply", [](const Retarget& r, const Clip& clip) { return without_gil([&] { return r.apply(clip); }); },
          py::arg("clip"))
      .def(
          "apply_all",
          [](const Retarget& r, const std::vector<Clip>& clips, int threads) {
            return without_gil([&] { return r.apply(clips, threads); });
          },
          py::arg("clips"), py::arg("threads") = 0);
}

}  // namespace fragmotion::bindings
