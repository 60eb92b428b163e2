// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "doctor/examine.hpp"
#include "doctor/mend.hpp"

namespace fragmotion::bindings {
namespace {

constexpr const char* kSeverities[] = {"info", "warning", "error"};

void bind_findings(py::module_& m) {
  py::class_<Finding>(m, "Finding", py::module_local())
      .def_readonly("code", &Finding::code)
      .def_property_readonly("severity", [](const Finding& f) { return kSeverities[static_cast<int>(f.severity)]; })
      .def_property_readonly("frames", [](const Finding& f) { return py::make_tuple(f.begin, f.end); })
      .def_readonly("text", &Finding::text)
      .def_readonly("mendable", &Finding::mendable)
      .def_readonly("safe", &Finding::safe)
      .def_property_readonly("other",
                             [](const Finding& f) { return f.other < 0 ? py::object(py::none()) : py::int_(f.other); });
  py::class_<Examination>(m, "Examination", py::module_local())
      .def_readonly("stature", &Examination::stature)
      .def_readonly("scale", &Examination::scale)
      .def_readonly("up", &Examination::up)
      .def_readonly("facing", &Examination::facing)
      .def_readonly("rate", &Examination::rate)
      .def_readonly("root_motion", &Examination::root_motion)
      .def_readonly("rest_pose", &Examination::rest_pose)
      .def_readonly("roles", &Examination::roles)
      .def_readonly("findings", &Examination::findings);
}

}  // namespace

void bind_doctor(py::module_& m) {
  bind_findings(m);
  m.attr("FINDING_CODES") = finding_codes();
  m.def(
      "examine",
      [](const std::vector<std::shared_ptr<Take>>& takes, int threads, const py::object& progress) {
        std::vector<const Take*> each;
        for (const std::shared_ptr<Take>& take : takes) {
          if (take == nullptr) throw py::type_error("a take is None");
          each.push_back(take.get());
        }
        return without_gil(progress, [&](const Progress& told) { return examine(each, threads, told); });
      },
      py::arg("takes"), py::arg("threads") = 0, py::arg("progress") = py::none());
  m.def("examine_ground", &examine_ground, py::arg("take"));
  m.def(
      "mend",
      [](const Take& take, const std::vector<Finding>& findings, const py::object& progress) {
        return without_gil(progress, [&](const Progress& told) { return mend(take, findings, told); });
      },
      py::arg("take"), py::arg("findings"), py::arg("progress") = py::none());
}

}  // namespace fragmotion::bindings
