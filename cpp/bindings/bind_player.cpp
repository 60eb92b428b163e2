// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "fragmotion/evaluate/motion_metrics.hpp"
#include "fragmotion/evaluate/response.hpp"
#include "fragmotion/runtime/step_on_threads.hpp"

namespace fragmotion::bindings {
namespace {

using SharedCharacter = std::shared_ptr<Character>;

using OnePlayer = OneCallAtATime<Player>;
using OneCrowd = OneCallAtATime<Crowd>;

py::tuple step(OnePlayer& one, const Doubles& control, double seconds) {
  const OnePlayer::Call player(one);
  player->step(to_control(control), seconds);
  const Vector3& root = player->root_position();
  const auto bones = static_cast<py::ssize_t>(player->rotations().size()) / 4;
  return py::make_tuple(to_array(std::vector<double>{root.x(), root.y(), root.z()}, {3}),
                        to_array(player->rotations(), {bones, 4}));
}

template <typename T>
auto viewed(std::vector<T> Performance::*member, std::vector<py::ssize_t> rest) {
  return [=](const py::object& self) {
    const auto& p = self.cast<const Performance&>();
    std::vector<py::ssize_t> shape{p.frames};
    shape.insert(shape.end(), rest.begin(), rest.end());
    return view(p.*member, shape, self);
  };
}

void bind_performance(py::module_& m) {
  py::class_<Performance>(m, "Performance", py::module_local())
      .def_readonly("rate", &Performance::rate)
      .def_property_readonly("root_positions", viewed(&Performance::root_positions, {3}))
      .def_property_readonly("rotations",
                             [](const py::object& self) {
                               const auto& p = self.cast<const Performance&>();
                               const auto bones = static_cast<py::ssize_t>(p.rotations.size()) / p.frames / 4;
                               return view(p.rotations, {p.frames, bones, 4}, self);
                             })
      .def_property_readonly("frames", viewed(&Performance::path, {3}))
      .def_property_readonly("classes", viewed(&Performance::classes, {}))
      .def_property_readonly("fragments", viewed(&Performance::fragments, {}))
      .def_property_readonly("entered", viewed(&Performance::entered, {}))
      .def_readonly("quality", &Performance::quality)
      .def_readonly("velocity_error", &Performance::velocity_error)
      .def_readonly("turn_error", &Performance::turn_error)
      .def_readonly("jump_error", &Performance::jump_error)
      .def_readonly("commanded_speed", &Performance::commanded_speed)
      .def_readonly("drift", &Performance::drift);
}

Stitching to_stitching(const std::string& name) {
  if (name != "inertialize" && name != "crossfade") {
    throw std::invalid_argument("there is no stitching \"" + name + "\"; there are inertialize and crossfade");
  }
  return name == "crossfade" ? Stitching::crossfade : Stitching::inertialize;
}

template <typename... T>
struct Types {};

// A function of `First...`, a player's options one by one, and `Last...`, made of one that takes them as PlayerOptions.
template <typename... First, typename... Last, typename Function>
auto with_options(Types<First...> /*before*/, Types<Last...> /*after*/, Function function) {
  return [function](First... first, std::uint64_t seed, double stitch, const std::string& policy,
                    const std::string& stitching, bool lock_feet, double root_adjustment, double responsiveness,
                    Last... last) {
    const PlayerOptions options{seed,      stitch,          policy,        to_stitching(stitching),
                                lock_feet, root_adjustment, responsiveness};
    return function(std::move(first)..., options, std::move(last)...);
  };
}

// Calls `define` with the arguments of a player's options, in the order of `with_options`.
template <typename Define>
void for_option_arguments(const Define& define) {
  const PlayerOptions defaults;
  define(py::arg("seed") = defaults.seed, py::arg("stitch") = defaults.stitch, py::arg("policy") = defaults.policy,
         py::arg("stitching") = "inertialize", py::arg("lock_feet") = defaults.lock_feet,
         py::arg("root_adjustment") = defaults.root_adjustment, py::arg("responsiveness") = defaults.responsiveness);
}

// An array to write to: a new one, or the caller's, which must be just so.
py::array_t<double> target(const py::object& given, const std::string& name, const std::vector<py::ssize_t>& shape) {
  if (given.is_none()) return py::array_t<double>(shape);
  const bool fits = py::isinstance<py::array_t<double, py::array::c_style>>(given);
  constexpr int kUsable = py::detail::npy_api::NPY_ARRAY_ALIGNED_ | py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  if (!fits || (given.cast<py::array>().flags() & kUsable) != kUsable) {
    throw std::invalid_argument(name + " must be a writable, aligned array of float64 in C order");
  }
  auto array = given.cast<py::array_t<double>>();
  check_shape(array, name, shape);
  return array;
}

py::tuple step_many(OneCrowd& one, const Doubles& controls, double seconds, const py::object& roots,
                    const py::object& rotations) {
  const OneCrowd::Call crowd(one);
  const py::ssize_t count = crowd->size();
  check_shape(controls, "controls", {count, 4});
  const Trace wanted = to_trace(controls);
  py::array_t<double> to_roots = target(roots, "roots", {count, 3}),
                      to_rotations = target(rotations, "rotations", {count, crowd->bones(), 4});
  double *first_root = to_roots.mutable_data(), *first_rotation = to_rotations.mutable_data();
  without_gil([&] { step_on_threads(*crowd, wanted.data(), seconds, first_root, first_rotation); });
  return py::make_tuple(to_roots, to_rotations);
}

py::array_t<double> frames_of(OneCrowd& one) {
  const OneCrowd::Call crowd(one);
  std::vector<double> frames;
  for (int i = 0; i < crowd->size(); ++i) {
    const CharacterFrame frame = (*crowd)[i].frame();
    frames.insert(frames.end(), {frame.position.x(), frame.position.y(), frame.heading});
  }
  return to_array(std::move(frames), {crowd->size(), 3});
}

py::array_t<int> playing_of(OneCrowd& one) {
  const OneCrowd::Call crowd(one);
  std::vector<int> playing;
  for (int i = 0; i < crowd->size(); ++i) {
    playing.insert(playing.end(), {(*crowd)[i].playing_class(), (*crowd)[i].playing_fragment()});
  }
  return to_array(std::move(playing), {crowd->size(), 2});
}

void bind_crowd(py::module_& m) {
  py::class_<OneCrowd> crowd(m, "Crowd", py::module_local());
  for_option_arguments([&](const auto&... options) {
    crowd.def(py::init(with_options(Types<SharedCharacter, int>{}, Types<int>{},
                                    [](SharedCharacter character, int count, const PlayerOptions& given, int threads) {
                                      return std::make_unique<OneCrowd>("Crowd", std::move(character), count, given,
                                                                        thread_count(threads));
                                    })),
              py::arg("character").none(false), py::arg("count"), options..., py::arg("threads") = 0);
  });
  crowd.def("__len__", [](OneCrowd& crowd) { return OneCrowd::Call(crowd)->size(); })
      .def("step_many", &step_many, py::arg("controls"), py::arg("seconds"), py::arg("roots") = py::none(),
           py::arg("rotations") = py::none())
      .def(
          "reset",
          [](OneCrowd& crowd, int player, double x, double y, double heading) {
            OneCrowd::Call(crowd)->reset(player, {Vector2{x, y}, heading});
          },
          py::arg("player"), py::arg("x") = 0.0, py::arg("y") = 0.0, py::arg("heading") = 0.0)
      .def(
          "force",
          [](OneCrowd& crowd, int player, int next_class) { OneCrowd::Call(crowd)->force(player, next_class); },
          py::arg("player"), py::arg("next_class"))
      .def_property_readonly("frames", &frames_of)
      .def_property_readonly("playing", &playing_of);
}

void bind_measures(py::module_& m) {
  py::class_<Steps>(m, "Steps", py::module_local())
      .def_readonly("p99", &Steps::p99)
      .def_readonly("p999", &Steps::p999)
      .def_readonly("worst", &Steps::worst);
  py::class_<Excess>(m, "Excess", py::module_local())
      .def_readonly("share", &Excess::share)
      .def_readonly("worst", &Excess::worst);
  py::class_<MotionMeasures>(m, "MotionMeasures", py::module_local())
      .def_readonly("foot_skate", &MotionMeasures::foot_skate)
      .def_readonly("sliding_share", &MotionMeasures::sliding_share)
      .def_readonly("penetration", &MotionMeasures::penetration)
      .def_readonly("positions", &MotionMeasures::positions)
      .def_readonly("velocities", &MotionMeasures::velocities)
      .def_readonly("accelerations", &MotionMeasures::accelerations)
      .def_readonly("turns", &MotionMeasures::turns);
  py::class_<MotionYardstick>(m, "MotionYardstick", py::module_local())
      .def(py::init([](const Character& character) { return MotionYardstick(character); }), py::arg("character"),
           py::call_guard<GilRelease>())
      .def_property_readonly("takes", &MotionYardstick::takes)
      .def("of", &MotionYardstick::of, py::arg("performance"), py::call_guard<GilRelease>());
}

void bind_yardsticks(py::module_& m) {
  m.def(
      "optimal_performance",
      [](const Character& character, const Doubles& trace, double rate, double shortest) {
        const Trace controls = to_trace(trace);
        return without_gil([&] { return optimal_performance(character, controls, rate, shortest); });
      },
      py::arg("character"), py::arg("trace"), py::arg("rate"), py::arg("shortest") = kSoonest);
  for_option_arguments([&](const auto&... options) {
    m.def("response_times",
          with_options(Types<SharedCharacter>{}, Types<>{},
                       [](const SharedCharacter& character, const PlayerOptions& given) {
                         std::vector<double> times = without_gil([&] { return response_times(character, given); });
                         const auto count = static_cast<py::ssize_t>(times.size());
                         return to_array(std::move(times), {count});
                       }),
          py::arg("character").none(false), options...);
  });
}

}  // namespace

void bind_player(py::module_& m) {
  bind_performance(m);
  bind_measures(m);
  bind_yardsticks(m);
  bind_crowd(m);
  py::class_<OnePlayer> player(m, "Player", py::module_local());
  for_option_arguments([&](const auto&... options) {
    player.def(py::init(with_options(Types<SharedCharacter>{}, Types<>{},
                                     [](SharedCharacter character, const PlayerOptions& given) {
                                       return std::make_unique<OnePlayer>("Player", std::move(character), given);
                                     })),
               py::arg("character").none(false), options...);
  });
  player
      .def(
          "reset",
          [](OnePlayer& player, double x, double y, double heading) {
            OnePlayer::Call(player)->reset({Vector2{x, y}, heading});
          },
          py::arg("x") = 0.0, py::arg("y") = 0.0, py::arg("heading") = 0.0)
      .def(
          "force", [](OnePlayer& player, int next_class) { OnePlayer::Call(player)->force(next_class); },
          py::arg("next_class"))
      .def("step", &step, py::arg("control"), py::arg("seconds"))
      .def_property_readonly("frame",
                             [](OnePlayer& player) {
                               const CharacterFrame frame = OnePlayer::Call(player)->frame();
                               return py::make_tuple(frame.position.x(), frame.position.y(), frame.heading);
                             })
      .def_property_readonly("playing",
                             [](OnePlayer& one) {
                               const OnePlayer::Call player(one);
                               return py::make_tuple(player->playing_class(), player->playing_fragment());
                             })
      .def(
          "run",
          [](OnePlayer& one, const Doubles& trace, double rate, const py::object& progress) {
            const Trace controls = to_trace(trace);
            const OnePlayer::Call player(one);
            return without_gil(progress, [&](const Progress& told) { return perform(*player, controls, rate, told); });
          },
          py::arg("trace"), py::arg("rate"), py::arg("progress") = py::none());
}

}  // namespace fragmotion::bindings
