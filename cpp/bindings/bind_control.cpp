// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "character/character.hpp"
#include "control/gaits.hpp"
#include "control/simulated_players.hpp"

namespace fragmotion::bindings {
namespace {

py::array_t<double> points(const ControlSpace& space) {
  Trace controls;
  for (int c = 0; c < space.size(); ++c) controls.push_back(space.point(c));
  return to_rows(controls);
}

ControlSpace new_space(double walk, double run, double turn_rate, double scale,
                       const std::optional<std::vector<double>>& speeds, int directions, bool turn, bool jump) {
  const std::vector<double> given = speeds.value_or(std::vector{walk, run});
  const auto count = static_cast<int>(std::min<std::size_t>(given.size(), kMostSpeeds + 1));  // more are refused
  return ControlSpace({count, directions, turn, jump}, given, turn_rate, scale);
}

py::tuple shape_of(const ControlSpace& space) {
  const ControlLayout& layout = space.layout();
  return py::make_tuple(layout.velocities(), layout.turns(), layout.jumps());
}

std::vector<std::string> gaits_named(const ControlSpace& space) {
  std::vector<std::string> names;
  for (const int gait : space.gaits()) names.emplace_back(kGaits[gait].name);
  return names;
}

using NamedMoves = std::vector<std::tuple<int, std::string, int>>;
using NamedStyles = std::vector<std::tuple<int, std::string>>;

using LookRows = std::vector<std::tuple<int, int, double, double, double>>;
using ReachRows = std::vector<std::tuple<int, int, double, int, double, double, double>>;

std::tuple<NamedMoves, NamedStyles, LookRows, ReachRows> to_lists(const Asked& asked) {
  std::tuple<NamedMoves, NamedStyles, LookRows, ReachRows> lists;
  auto& [moves, styles, looks, reaches] = lists;
  for (const Asked::Move& move : asked.moves) moves.emplace_back(move.control, move.name, move.held);
  for (const Asked::Style& style : asked.styles) styles.emplace_back(style.control, style.name);
  for (const auto& [control, look, place] : asked.looks)
    looks.emplace_back(control, look, place.x(), place.y(), place.z());
  for (const auto& [control, hand, weight, carried, place] : asked.reaches)
    reaches.emplace_back(control, hand, weight, carried ? 1 : 0, place.x(), place.y(), place.z());
  return lists;
}

// Numbers that are no look, hand or weight, and no place, are refused.
void add_rows(const LookRows& looks, const ReachRows& reaches, Asked& asked) {
  const auto check = [](bool sound) {
    if (!sound) throw std::invalid_argument("looks and reaches must be rows as Player.run has them");
  };
  for (const auto& [control, look, x, y, z] : looks) {
    check(look >= 0 && look <= 2 && std::isfinite(x) && std::isfinite(y) && std::isfinite(z));
    asked.looks.push_back({control, look, {x, y, z}});
  }
  for (const auto& [control, hand, weight, carried, x, y, z] : reaches) {
    check(hand >= 0 && hand <= 1 && weight >= 0 && weight <= 1 && (carried == 0 || carried == 1) && std::isfinite(x) &&
          std::isfinite(y) && std::isfinite(z));
    asked.reaches.push_back({control, hand, weight, carried == 1, {x, y, z}});
  }
}

Asked to_asked(const NamedMoves& moves, const NamedStyles& styles) {
  Asked asked;
  for (const auto& [control, name, held] : moves) {
    check_name(name);
    asked.moves.push_back({control, name, held});
  }
  for (const auto& [control, name] : styles) {
    check_name(name);
    asked.styles.push_back({control, name});
  }
  return asked;
}

}  // namespace

void bind_control(py::module_& m) {
  py::class_<ControlSpace> space(m, "ControlSpace", py::module_local());
  const ControlLayout paper;
  space
      .def(py::init(&new_space), py::arg("walk") = ControlSpace().walk(), py::arg("run") = ControlSpace().run(),
           py::arg("turn_rate") = ControlSpace().turn_rate(), py::arg("scale") = 1.0, py::arg("speeds") = py::none(),
           py::arg("directions") = paper.directions, py::arg("turn") = paper.turn, py::arg("jump") = paper.jump)
      .def_property_readonly("shape", &shape_of)
      .def_property_readonly("speeds", &ControlSpace::speeds)
      .def_property_readonly("gaits", &gaits_named)
      .def_property_readonly("directions", [](const ControlSpace& space) { return space.layout().directions; })
      .def_property_readonly("turns", [](const ControlSpace& space) { return space.layout().turn; })
      .def_property_readonly("jumps", [](const ControlSpace& space) { return space.layout().jump; })
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
      "read_asked",
      [](const std::filesystem::path& path) { return to_lists(without_gil([&] { return read_asked(path); })); },
      py::arg("path"));
  m.def(
      "write_trace",
      [](const std::filesystem::path& path, const Doubles& trace, const NamedMoves& moves, const NamedStyles& styles,
         const LookRows& looks, const ReachRows& reaches) {
        const Trace controls = to_trace(trace);
        Asked asked = to_asked(moves, styles);
        add_rows(looks, reaches, asked);
        without_gil([&] { write_trace(path, controls, asked); });
      },
      py::arg("path"), py::arg("trace"), py::arg("moves") = NamedMoves(), py::arg("styles") = NamedStyles(),
      py::arg("looks") = LookRows(), py::arg("reaches") = ReachRows());
  m.def(
      "simulate_trace",
      [](const std::string& player, double seconds, std::uint64_t seed, const std::optional<ControlSpace>& space) {
        return to_rows(
            without_gil([&] { return simulate_trace(player, seconds, seed, space.value_or(ControlSpace())); }));
      },
      py::arg("player"), py::arg("seconds") = 60.0, py::arg("seed") = 1, py::arg("space") = py::none());
  m.attr("PLAYERS") = simulated_players();
  py::list gaits, directions;
  for (const Gait& gait : kGaits) gaits.append(gait.name);
  for (const char* name : kDirectionNames) directions.append(name);
  m.attr("GAITS") = gaits;
  m.attr("DIRECTIONS") = directions;
}

}  // namespace fragmotion::bindings
