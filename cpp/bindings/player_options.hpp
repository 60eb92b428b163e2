// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "runtime/player.hpp"

namespace fragmotion::bindings {

namespace py = pybind11;

/// As pybind11 holds characters.
using SharedCharacter = std::shared_ptr<Character>;

/// The stitching of that name; throws ValueError on another.
Stitching to_stitching(const std::string& name);

template <typename... T>
struct Types {};

/// A function of `First...`, a player's options one by one, and `Last...`, made of one that takes them as
/// PlayerOptions.
template <typename... First, typename... Last, typename Function>
auto with_options(Types<First...> /*before*/, Types<Last...> /*after*/, Function function) {
  return [function](First... first, std::uint64_t seed, double stitch, const std::string& policy,
                    const std::string& stitching, bool lock_feet, double root_adjustment, double responsiveness,
                    const std::map<std::string, double>& constants, Last... last) {
    const PlayerOptions options{seed,      stitch,          policy,         to_stitching(stitching),
                                lock_feet, root_adjustment, responsiveness, player_constants(constants)};
    return function(std::move(first)..., options, std::move(last)...);
  };
}

/// Calls `define` with the arguments of a player's options, in the order of `with_options`.
template <typename Define>
void for_option_arguments(const Define& define) {
  const PlayerOptions defaults;
  define(py::arg("seed") = defaults.seed, py::arg("stitch") = defaults.stitch, py::arg("policy") = defaults.policy,
         py::arg("stitching") = "inertialize", py::arg("lock_feet") = defaults.lock_feet,
         py::arg("root_adjustment") = defaults.root_adjustment, py::arg("responsiveness") = defaults.responsiveness,
         py::arg("constants") = std::map<std::string, double>{});
}

/// Defines a function of a character and a player's options, given as PlayerOptions or one by one.
template <typename Function>
void define_with_options(py::module_& m, const char* name, const Function& function) {
  m.def(name, function, py::arg("character").none(false), py::arg("options"));
  for_option_arguments([&](const auto&... options) {
    m.def(name, with_options(Types<SharedCharacter>{}, Types<>{}, function), py::arg("character").none(false),
          options...);
  });
}

}  // namespace fragmotion::bindings
