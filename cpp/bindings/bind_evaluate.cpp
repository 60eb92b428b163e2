// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "evaluate/abilities.hpp"
#include "evaluate/about_face.hpp"
#include "evaluate/change_pushes.hpp"
#include "evaluate/explain.hpp"
#include "evaluate/motion_metrics.hpp"
#include "evaluate/response.hpp"
#include "evaluate/speed_ripple.hpp"
#include "evaluate/suggest.hpp"
#include "fragments/entry_poses.hpp"
#include "player_options.hpp"

namespace fragmotion::bindings {
namespace {

constexpr const char* kChangeNames[kChanges] = {"start", "stop", "reverse", "turn", "gait"};

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
      .def_property_readonly("path", viewed(&Performance::path, {3}))
      .def_property_readonly("styles", viewed(&Performance::styles, {}))
      .def_property_readonly("classes", viewed(&Performance::classes, {}))
      .def_property_readonly("fragments", viewed(&Performance::fragments, {}))
      .def_property_readonly("moves", viewed(&Performance::moves, {2}))
      .def_property_readonly("entered", viewed(&Performance::entered, {}))
      .def_readonly("quality", &Performance::quality)
      .def_readonly("velocity_error", &Performance::velocity_error)
      .def_readonly("turn_error", &Performance::turn_error)
      .def_readonly("jump_error", &Performance::jump_error)
      .def_readonly("commanded_speed", &Performance::commanded_speed)
      .def_readonly("drift", &Performance::drift)
      .def_readonly("drift_heading", &Performance::drift_heading)
      .def_readonly("velocity_error_limited", &Performance::velocity_error_limited)
      .def_readonly("drift_limited", &Performance::drift_limited)
      .def_readonly("drift_heading_limited", &Performance::drift_heading_limited);
}

void bind_measures(py::module_& m) {
  py::class_<Steps>(m, "Steps", py::module_local())
      .def_readonly("p99", &Steps::p99)
      .def_readonly("p999", &Steps::p999)
      .def_readonly("worst", &Steps::worst);
  py::class_<Excess>(m, "Excess", py::module_local())
      .def_readonly("share", &Excess::share)
      .def_readonly("worst", &Excess::worst);
  py::class_<Spread>(m, "Spread", py::module_local())
      .def_readonly("p50", &Spread::p50)
      .def_readonly("p99", &Spread::p99)
      .def_readonly("p999", &Spread::p999)
      .def_readonly("worst", &Spread::worst);
  py::class_<Pushes, Spread>(m, "Pushes", py::module_local()).def_readonly("over_6", &Pushes::over_6);
  py::class_<ChangePushes, Pushes>(m, "ChangePushes", py::module_local())
      .def_readonly("dragged", &ChangePushes::dragged);
  py::class_<JumpMeans>(m, "JumpMeans", py::module_local())
      .def_readonly("count", &JumpMeans::count)
      .def_readonly("dip", &JumpMeans::dip)
      .def_readonly("landing_dip", &JumpMeans::landing_dip)
      .def_readonly("flight_ratio", &JumpMeans::flight_ratio);
  py::class_<Footfalls>(m, "Footfalls", py::module_local())
      .def_readonly("count", &Footfalls::count)
      .def_readonly("same_foot", &Footfalls::same_foot)
      .def_readonly("quick", &Footfalls::quick);
  py::class_<MotionMeasures>(m, "MotionMeasures", py::module_local())
      .def_readonly("foot_skate", &MotionMeasures::foot_skate)
      .def_readonly("sliding_share", &MotionMeasures::sliding_share)
      .def_readonly("foot_turn", &MotionMeasures::foot_turn)
      .def_readonly("penetration", &MotionMeasures::penetration)
      .def_readonly("positions", &MotionMeasures::positions)
      .def_readonly("velocities", &MotionMeasures::velocities)
      .def_readonly("accelerations", &MotionMeasures::accelerations)
      .def_readonly("center_of_mass", &MotionMeasures::center_of_mass)
      .def_readonly("hips", &MotionMeasures::hips)
      .def_readonly("yaw", &MotionMeasures::yaw)
      .def_readonly("jumps", &MotionMeasures::jumps)
      .def_readonly("footfalls", &MotionMeasures::footfalls)
      .def_readonly("dragged_share", &MotionMeasures::dragged_share)
      .def_readonly("turns", &MotionMeasures::turns);
  py::class_<MotionMetrics>(m, "MotionMetrics", py::module_local())
      .def(py::init([](const Character& character) { return MotionMetrics(character); }), py::arg("character"),
           py::call_guard<GilRelease>())
      .def_property_readonly("takes", &MotionMetrics::takes)
      .def("of", &MotionMetrics::of, py::arg("performance"), py::call_guard<GilRelease>());
}

using Trials = std::vector<double> (*)(const std::shared_ptr<const Character>&, const PlayerOptions&);

void define_trials(py::module_& m, const char* name, Trials trials) {
  define_with_options(m, name, [trials](const SharedCharacter& character, const PlayerOptions& options) {
    std::vector<double> times = without_gil([&] { return trials(character, options); });
    const auto count = static_cast<py::ssize_t>(times.size());
    return to_array(std::move(times), {count});
  });
}

void bind_yardsticks(py::module_& m) {
  m.def(
      "judge_clip",
      [](const Character& character, const Doubles& trace, const Clip& clip, std::vector<int> entered) {
        const Trace controls = to_trace(trace);
        return without_gil([&] { return judge_clip(character, controls, clip, std::move(entered)); });
      },
      py::arg("character"), py::arg("trace"), py::arg("clip"), py::arg("entered"));
  m.def(
      "optimal_performance",
      [](const Character& character, const Doubles& trace, double rate, double shortest) {
        const Trace controls = to_trace(trace);
        return without_gil([&] { return optimal_performance(character, controls, rate, shortest); });
      },
      py::arg("character"), py::arg("trace"), py::arg("rate"), py::arg("shortest") = kEntry);
  define_trials(m, "response_times", response_times);
  m.attr("NO_RESPONSE") = kNoResponse;
  define_trials(m, "about_face_times", about_face_times);
}

void bind_speeds(py::module_& m) {
  py::class_<SpeedRipple>(m, "SpeedRipple", py::module_local())
      .def_readonly("commanded", &SpeedRipple::commanded)
      .def_readonly("speed", &SpeedRipple::speed)
      .def_readonly("ripple", &SpeedRipple::ripple)
      .def_readonly("bob", &SpeedRipple::bob)
      .def_readonly("steps", &SpeedRipple::steps)
      .def_readonly("takes_speed", &SpeedRipple::takes_speed)
      .def_readonly("takes_ripple", &SpeedRipple::takes_ripple)
      .def_readonly("takes_bob", &SpeedRipple::takes_bob)
      .def_readonly("takes_steps", &SpeedRipple::takes_steps);
  define_with_options(m, "speed_ripples", [](const SharedCharacter& character, const PlayerOptions& options) {
    return without_gil([&] { return speed_ripples(character, options); });
  });
  define_with_options(m, "change_pushes", [](const SharedCharacter& character, const PlayerOptions& options) {
    const auto found = without_gil([&] { return change_pushes(character, options); });
    py::dict by_kind;
    for (std::size_t kind = 0; kind < found.size(); ++kind) by_kind[kChangeNames[kind]] = found[kind];
    return by_kind;
  });
}

void bind_suggestion(py::module_& m) {
  py::class_<ClassesTried>(m, "ClassesTried", py::module_local())
      .def_readonly("classes", &ClassesTried::classes)
      .def_readonly("quality", &ClassesTried::quality)
      .def_readonly("velocity_error", &ClassesTried::velocity_error);
  m.def(
      "suggest_classes",
      [](const Skeleton& skeleton, const std::vector<Clip>& clips, const std::vector<Doubles>& traces,
         const std::optional<BuildOptions>& options, const py::object& progress) {
        const std::vector<Trace> controls = to_traces(traces);
        Suggestion suggestion = without_gil(progress, [&](const Progress& told) {
          return suggest_classes(skeleton, clips, controls, options.value_or(BuildOptions{}), told);
        });
        return py::make_tuple(suggestion.classes, std::move(suggestion.tried));
      },
      py::arg("skeleton"), py::arg("clips"), py::arg("traces"), py::arg("options") = py::none(),
      py::arg("progress") = py::none());
}

void bind_abilities(py::module_& m) {
  m.def(
      "abilities",
      [](const std::shared_ptr<const Character>& character, int threads) {
        const std::vector<char> done = without_gil([&] { return abilities(character, threads); });
        return std::vector<bool>(done.begin(), done.end());
      },
      py::arg("character").none(false), py::arg("threads") = 0);
  m.def(
      "undone_controls",
      [](const ControlSpace& space, const std::vector<bool>& done) {
        if (static_cast<int>(done.size()) != space.size())
          throw std::invalid_argument("done has " + std::to_string(done.size()) +
                                      " values, expected one of each of the " + std::to_string(space.size()) +
                                      " controls");
        return undone_controls(space, {done.begin(), done.end()});
      },
      py::arg("space"), py::arg("done"));
}

void bind_explain(py::module_& m) {
  py::class_<Alternative>(m, "Alternative", py::module_local())
      .def_readonly("next", &Alternative::next)
      .def_readonly("smoothness", &Alternative::smoothness)
      .def_readonly("match", &Alternative::match)
      .def_readonly("future_value", &Alternative::future_value)
      .def_property_readonly("value", &Alternative::value)
      .def_readonly("fragments", &Alternative::fragments);
  py::class_<Explainer>(m, "Explainer", py::module_local())
      .def(py::init([](std::shared_ptr<Character> character, const std::string& policy) {
             return Explainer(std::move(character), policy);
           }),
           py::arg("character").none(false), py::arg("policy") = "", py::call_guard<GilRelease>())
      .def("__call__", &Explainer::operator(), py::arg("playing"), py::arg("control"));
}

}  // namespace

void bind_evaluate(py::module_& m) {
  bind_performance(m);
  bind_measures(m);
  bind_yardsticks(m);
  bind_speeds(m);
  bind_suggestion(m);
  bind_abilities(m);
  bind_explain(m);
}

}  // namespace fragmotion::bindings
