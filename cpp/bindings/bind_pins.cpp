// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "direct/join.hpp"
#include "direct/pin.hpp"
#include "player_options.hpp"

namespace fragmotion::bindings {
namespace {

CharacterFrame to_frame(const Doubles& values, const std::string& name) {
  check_shape(values, name, {3});
  return {Vector2{values.at(0), values.at(1)}, values.at(2)};
}

py::array_t<double> frame_array(const CharacterFrame& frame) {
  return to_array(std::vector<double>{frame.position.x(), frame.position.y(), frame.heading}, {3});
}

Motion make_motion(double rate, const Doubles& roots, const Doubles& rotations, const Doubles& path) {
  check_shape(roots, "root_positions", {-1, 3});
  check_shape(rotations, "rotations", {roots.shape(0), -1, 4});
  check_shape(path, "path", {roots.shape(0), 3});
  return {rate, to_vector(roots), to_vector(rotations), to_vector(path)};
}

py::array_t<double> rotations_of(const py::object& self) {
  const auto& motion = self.cast<const Motion&>();
  const auto bones = static_cast<py::ssize_t>(motion.rotations.size()) / std::max(4 * motion.frames(), 1);
  return view(motion.rotations, {motion.frames(), bones, 4}, self);
}

void bind_motions(py::module_& m) {
  py::class_<Motion>(m, "Motion", py::module_local())
      .def(py::init(&make_motion), py::arg("rate"), py::arg("root_positions"), py::arg("rotations"), py::arg("path"))
      .def_readonly("rate", &Motion::rate)
      .def_property_readonly("root_positions",
                             [](const py::object& self) {
                               const auto& motion = self.cast<const Motion&>();
                               return view(motion.root_positions, {motion.frames(), 3}, self);
                             })
      .def_property_readonly("rotations", &rotations_of)
      .def_property_readonly("path", [](const py::object& self) {
        const auto& motion = self.cast<const Motion&>();
        return view(motion.path, {motion.frames(), 3}, self);
      });
  m.def("join", &join, py::arg("skeleton"), py::arg("first"), py::arg("end"), py::arg("second"), py::arg("beginning"),
        py::call_guard<GilRelease>());
  m.def(
      "find_seam",
      [](const Skeleton& skeleton, const Motion& first, const std::vector<int>& ends, const Motion& second,
         const std::vector<int>& beginnings) {
        const Seam seam = without_gil([&] { return find_seam(skeleton, first, ends, second, beginnings); });
        return py::make_tuple(seam.end, seam.beginning, seam.distance);
      },
      py::arg("skeleton"), py::arg("first"), py::arg("ends"), py::arg("second"), py::arg("beginnings"));
  m.def(
      "spread",
      [](const Skeleton& skeleton, const Motion& motion, int begin, int end, const Doubles& target) {
        const CharacterFrame frame = to_frame(target, "target");
        return without_gil([&] { return spread(skeleton, motion, begin, end, frame); });
      },
      py::arg("skeleton"), py::arg("motion"), py::arg("begin"), py::arg("end"), py::arg("target"));
}

void bind_pin(py::module_& m) {
  py::class_<Pin>(m, "Pin", py::module_local())
      .def_property_readonly("trace",
                             [](const Pin& pin) {
                               std::vector<double> values;
                               for (const Control& c : pin.trace)
                                 values.insert(values.end(), {c.x, c.y, c.turn, c.jump});
                               return to_array(std::move(values), {static_cast<py::ssize_t>(pin.trace.size()), 4});
                             })
      .def_readonly("seed", &Pin::seed)
      .def_property_readonly("reached", [](const Pin& pin) { return frame_array(pin.reached); })
      .def_readonly("asked", &Pin::asked)
      .def_readonly("asked_angle", &Pin::asked_angle)
      .def_readonly("distance", &Pin::distance)
      .def_readonly("angle", &Pin::angle)
      .def_readonly("tries", &Pin::tries)
      .def_readonly("fits", &Pin::fits);
  const PinOptions defaults;
  for_option_arguments([&](const auto&... options) {
    m.def("find_pin",
          with_options(Types<SharedCharacter, Doubles, Doubles, double, Doubles>{},
                       Types<double, double, double, int, int, py::object>{},
                       [](const SharedCharacter& character, const Doubles& start, const Doubles& trace, double seconds,
                          const Doubles& target, const PlayerOptions& player, double begin, double distance,
                          double angle, int tries, int threads, const py::object& progress) {
                         const Trace controls = to_trace(trace);
                         const CharacterFrame from = to_frame(start, "start");
                         const PinGoal goal{seconds, to_frame(target, "target")};
                         return without_gil(progress, [&](const Progress& told) {
                           return find_pin(character, player, from, controls, goal,
                                           {begin, distance, angle, tries, threads}, told);
                         });
                       }),
          py::arg("character").none(false), py::arg("start"), py::arg("trace"), py::arg("seconds"), py::arg("target"),
          options..., py::arg("begin") = defaults.begin, py::arg("distance") = defaults.distance,
          py::arg("angle") = defaults.angle, py::arg("tries") = defaults.tries, py::arg("threads") = defaults.threads,
          py::arg("progress") = py::none());
  });
}

}  // namespace

void bind_pins(py::module_& m) {
  bind_motions(m);
  bind_pin(m);
}

}  // namespace fragmotion::bindings
