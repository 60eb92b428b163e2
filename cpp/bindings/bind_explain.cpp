// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "fragmotion/evaluate/explain.hpp"

namespace fragmotion::bindings {

void bind_explain(py::module_& m) {
  py::class_<Alternative>(m, "Alternative", py::module_local())
      .def_readonly("next", &Alternative::next)
      .def_readonly("smoothness", &Alternative::smoothness)
      .def_readonly("match", &Alternative::match)
      .def_readonly("to_come", &Alternative::to_come)
      .def_property_readonly("value", &Alternative::value)
      .def_readonly("fragments", &Alternative::fragments);
  py::class_<Explainer>(m, "Explainer", py::module_local())
      .def(py::init([](std::shared_ptr<Character> character, const std::string& policy) {
             return Explainer(std::move(character), policy);
           }),
           py::arg("character").none(false), py::arg("policy") = "", py::call_guard<GilRelease>())
      .def("__call__", &Explainer::operator(), py::arg("playing"), py::arg("control"));
}

}  // namespace fragmotion::bindings
