// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <algorithm>

#include "arrays.hpp"
#include "build/styles.hpp"

namespace fragmotion::bindings {
namespace {

void bind_options(py::module_& m) {
  py::class_<BuildOptions>(m, "BuildOptions", py::module_local())
      .def(py::init<>())
      .def_property(
          "cut", [](const BuildOptions& o) { return o.cut.at_gait_events ? "gait" : "windows"; },
          [](BuildOptions& o, const std::string& cut) {
            if (cut != "gait" && cut != "windows")
              throw std::invalid_argument("cut is \"gait\" or \"windows\", not \"" + cut + "\"");
            o.cut.at_gait_events = cut == "gait";
          })
      .def_property(
          "shortest", [](const BuildOptions& o) { return o.cut.shortest; },
          [](BuildOptions& o, double seconds) { o.cut.shortest = seconds; })
      .def_property(
          "longest", [](const BuildOptions& o) { return o.cut.longest; },
          [](BuildOptions& o, double seconds) { o.cut.longest = seconds; })
      .def_property(
          "find_controls", [](const BuildOptions& o) { return o.controls.find; },
          [](BuildOptions& o, bool find) { o.controls.find = find; })
      .def_property(
          "speeds", [](const BuildOptions& o) { return o.controls.layout.speeds; },
          [](BuildOptions& o, int speeds) { o.controls.layout.speeds = speeds; })
      .def_property(
          "directions", [](const BuildOptions& o) { return o.controls.layout.directions; },
          [](BuildOptions& o, int directions) { o.controls.layout.directions = directions; })
      .def_property(
          "turn", [](const BuildOptions& o) { return o.controls.layout.turn; },
          [](BuildOptions& o, bool turn) { o.controls.layout.turn = turn; })
      .def_property(
          "jump", [](const BuildOptions& o) { return o.controls.layout.jump; },
          [](BuildOptions& o, bool jump) { o.controls.layout.jump = jump; })
      .def_property_readonly("usual_space", [](const BuildOptions& o) { return usual_space(o.controls); })
      .def_readwrite("mirror", &BuildOptions::mirror)
      .def_readwrite("synthesize", &BuildOptions::synthesize)
      .def_readwrite("classes", &BuildOptions::classes)
      .def_readwrite("restarts", &BuildOptions::restarts)
      .def_readwrite("seed", &BuildOptions::seed)
      .def_readwrite("policies", &BuildOptions::policies)
      .def_property(
          "policy", [](const BuildOptions& o) { return o.policies.empty() ? std::string() : o.policies.front(); },
          [](BuildOptions& o, const std::string& name) {
            o.policies.erase(std::remove(o.policies.begin(), o.policies.end(), name), o.policies.end());
            o.policies.insert(o.policies.begin(), name);
          })
      .def_readwrite("threads", &BuildOptions::threads);
  m.attr("POLICIES") = policy_names();
}

}  // namespace

void bind_build(py::module_& m) {
  bind_options(m);
  m.def(
      "build",
      [](const Skeleton& skeleton, const std::vector<Clip>& clips, const std::vector<Doubles>& traces,
         const std::optional<BuildOptions>& options, const py::object& progress) {
        const std::vector<Trace> controls = to_traces(traces);
        return without_gil(progress, [&](const Progress& told) {
          return std::make_shared<Character>(build(skeleton, clips, controls, options.value_or(BuildOptions{}), told));
        });
      },
      py::arg("skeleton"), py::arg("clips"), py::arg("traces"), py::arg("options") = py::none(),
      py::arg("progress") = py::none());
  m.def(
      "build_styles",
      [](const Skeleton& skeleton, const std::vector<std::pair<std::string, std::vector<Clip>>>& styles,
         const std::vector<Doubles>& traces, const std::optional<BuildOptions>& options, const py::object& progress) {
        std::vector<StyleTakes> takes;
        for (const auto& [name, clips] : styles) {
          check_name(name);
          takes.push_back({name, clips});
        }
        const std::vector<Trace> controls = to_traces(traces);
        return without_gil(progress, [&](const Progress& told) {
          return std::make_shared<Character>(
              build_styles(skeleton, takes, controls, options.value_or(BuildOptions{}), told));
        });
      },
      py::arg("skeleton"), py::arg("styles"), py::arg("traces"), py::arg("options") = py::none(),
      py::arg("progress") = py::none());
}

}  // namespace fragmotion::bindings
