// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <stdexcept>

#include "arrays.hpp"
#include "fragmotion/character/character.hpp"
#include "fragmotion/control/simulated_players.hpp"

namespace fragmotion::bindings {
namespace {

py::array_t<double> to_rows(const Trace& trace) {
  std::vector<double> rows;
  for (const Control& c : trace) rows.insert(rows.end(), {c.x, c.y, c.turn, c.jump});
  return to_array(std::move(rows), {static_cast<py::ssize_t>(trace.size()), 4});
}

py::array_t<double> points(const ControlSpace& space) {
  Trace controls;
  for (int c = 0; c < ControlSpace::kPoints; ++c) controls.push_back(space.point(c));
  return to_rows(controls);
}

}  // namespace

void bind_control(py::module_& m) {
  py::class_<ControlSpace> space(m, "ControlSpace", py::module_local());
  space.attr("SHAPE") = py::make_tuple(ControlSpace::kVelocities, ControlSpace::kTurns, ControlSpace::kJumps);
  space
      .def(py::init([](double walk, double run, double turn_rate, double scale) {
             return ControlSpace(walk, run, turn_rate, scale);
           }),
           py::arg("walk") = ControlSpace().walk(), py::arg("run") = ControlSpace().run(),
           py::arg("turn_rate") = ControlSpace().turn_rate(), py::arg("scale") = 1.0)
      .def_property_readonly("walk", &ControlSpace::walk)
      .def_property_readonly("run", &ControlSpace::run)
      .def_property_readonly("turn_rate", &ControlSpace::turn_rate)
      .def_property_readonly("scale", &ControlSpace::scale)
      .def_property_readonly("weights",
                             [](const ControlSpace& space) {
                               const ControlWeights& w = space.weights();
                               return py::make_tuple(w.velocity, w.turn, w.jump);
                             })
      .def_property_readonly("points", &points)
      .def_property_readonly("quickest_turn", &ControlSpace::quickest_turn)
      .def(
          "turn_towards",
          [](const ControlSpace& self, double off) {
            if (!std::isfinite(off)) throw std::invalid_argument("off must be an angle, rad");
            return self.turn_towards(off);
          },
          py::arg("off"))
      .def(
          "nearest",
          [](const ControlSpace& space, const Doubles& controls) {
            const Trace trace = to_trace(controls);
            std::vector<int> indices = without_gil([&] { return snap(space, trace); });
            return to_array(std::move(indices), {controls.shape(0)});
          },
          py::arg("controls"))
      .def(
          "distance",
          [](const ControlSpace& space, const Doubles& a, const Doubles& b) {
            return space.distance(to_control(a), to_control(b));
          },
          py::arg("a"), py::arg("b"));
  m.def(
      "read_trace",
      [](const std::filesystem::path& path) { return to_rows(without_gil([&] { return read_trace(path); })); },
      py::arg("path"));
  m.def(
      "write_trace",
      [](const std::filesystem::path& path, const Doubles& trace) {
        const Trace controls = to_trace(trace);
        without_gil([&] { write_trace(path, controls); });
      },
      py::arg("path"), py::arg("trace"));
  m.def(
      "simulate_trace",
      [](const std::string& player, double seconds, std::uint64_t seed, const std::optional<ControlSpace>& space) {
        return to_rows(
            without_gil([&] { return simulate_trace(player, seconds, seed, space.value_or(ControlSpace())); }));
      },
      py::arg("player"), py::arg("seconds") = 60.0, py::arg("seed") = 1, py::arg("space") = py::none());
  m.attr("PLAYERS") = simulated_players();
}

}  // namespace fragmotion::bindings
