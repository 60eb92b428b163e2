// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "base/ranges.hpp"
#include "evaluate/performance.hpp"
#include "player_options.hpp"
#include "runtime/step_on_threads.hpp"

namespace fragmotion::bindings {
namespace {

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

// Rows of whole numbers [N,columns]; none of None.
template <std::size_t columns>
std::vector<std::array<int, columns>> to_rows(const py::object& given, const std::string& name) {
  std::vector<std::array<int, columns>> rows;
  if (given.is_none()) return rows;
  const auto array = given.cast<Doubles>();
  check_shape(array, name, {-1, columns});
  const std::vector<double> values = to_vector(array, name, -kFarthestPlace, kFarthestPlace);
  for (std::size_t i = 0; i < values.size(); i += columns) {
    std::array<int, columns>& row = rows.emplace_back();
    for (std::size_t j = 0; j < columns; ++j) {
      if (values[i + j] != std::floor(values[i + j])) throw std::invalid_argument(name + " must be whole numbers");
      row[j] = static_cast<int>(values[i + j]);
    }
  }
  return rows;
}

// Moves asked for in a trace, from [M,3].
std::vector<MovePress> to_presses(const py::object& moves) {
  std::vector<MovePress> presses;
  for (const auto& [control, move, held] : to_rows<3>(moves, "moves")) presses.push_back({control, move, held});
  return presses;
}

// Changes of style asked for in a trace, from [S,2].
std::vector<StyleChange> to_changes(const py::object& styles) {
  std::vector<StyleChange> changes;
  for (const auto& [control, style] : to_rows<2>(styles, "styles")) changes.push_back({control, style});
  return changes;
}

Look to_look(double number) {
  for (const Look look : {Look::as_captured, Look::ahead, Look::at}) {
    if (number == static_cast<int>(look)) return look;
  }
  throw std::invalid_argument("a look must be 0 (as captured), 1 (ahead) or 2 (at a place)");
}

// Where to look, from [L,5].
std::vector<LookChange> to_looks(const py::object& given) {
  std::vector<LookChange> looks;
  if (given.is_none()) return looks;
  const auto array = given.cast<Doubles>();
  check_shape(array, "looks", {-1, 5});
  const std::vector<double> values = to_vector(array, "looks", -kFarthestPlace, kFarthestPlace);
  for (std::size_t i = 0; i < values.size(); i += 5) {
    if (values[i] != std::floor(values[i])) throw std::invalid_argument("controls of looks must be whole numbers");
    looks.push_back({static_cast<int>(values[i]), to_look(values[i + 1]), load_vector(&values[i + 2])});
  }
  return looks;
}

// What hands hold or reach for, from [R,7].
std::vector<ReachChange> to_reaches(const py::object& given) {
  std::vector<ReachChange> reaches;
  if (given.is_none()) return reaches;
  const auto array = given.cast<Doubles>();
  check_shape(array, "reaches", {-1, 7});
  const std::vector<double> values = to_vector(array, "reaches", -kFarthestPlace, kFarthestPlace);
  for (std::size_t i = 0; i < values.size(); i += 7) {
    for (const std::size_t whole : {i, i + 1, i + 3}) {
      if (values[whole] != std::floor(values[whole]))
        throw std::invalid_argument("controls, hands and spaces of reaches must be whole numbers");
    }
    const HandAim aim{load_vector(&values[i + 4]), values[i + 2], values[i + 3] != 0};
    reaches.push_back({static_cast<int>(values[i]), static_cast<int>(values[i + 1]), aim});
  }
  return reaches;
}

template <typename T>
py::tuple to_pair(const std::array<T, 2>& values) {
  return py::make_tuple(values[0], values[1]);
}

void bind_crowd(py::module_& m) {
  py::class_<OneCrowd> crowd(m, "Crowd", py::module_local());
  const auto make = [](SharedCharacter character, int count, const PlayerOptions& options, int threads) {
    return std::make_unique<OneCrowd>("Crowd", std::move(character), count, options, thread_count(threads));
  };
  crowd.def(py::init(make), py::arg("character").none(false), py::arg("count"), py::arg("options"),
            py::arg("threads") = 0);
  for_option_arguments([&](const auto&... options) {
    crowd.def(py::init(with_options(Types<SharedCharacter, int>{}, Types<int>{}, make)),
              py::arg("character").none(false), py::arg("count"), options..., py::arg("threads") = 0);
  });
  crowd.def("__len__", [](OneCrowd& crowd) { return OneCrowd::Call(crowd)->size(); })
      .def("step_many", &step_many, py::arg("controls"), py::arg("seconds"), py::arg("roots") = py::none(),
           py::arg("rotations") = py::none())
      .def(
          "reset",
          [](OneCrowd& crowd, int player, double x, double y, double heading, int style) {
            OneCrowd::Call(crowd)->reset(player, {Vector2{x, y}, heading}, style);
          },
          py::arg("player"), py::arg("x") = 0.0, py::arg("y") = 0.0, py::arg("heading") = 0.0, py::arg("style") = 0)
      .def(
          "change_style",
          [](OneCrowd& crowd, int player, int style) { OneCrowd::Call(crowd)->change_style(player, style); },
          py::arg("player"), py::arg("style"))
      .def(
          "force",
          [](OneCrowd& crowd, int player, int next_class) { OneCrowd::Call(crowd)->force(player, next_class); },
          py::arg("player"), py::arg("next_class"))
      .def(
          "start_move", [](OneCrowd& crowd, int player, int move) { OneCrowd::Call(crowd)->start_move(player, move); },
          py::arg("player"), py::arg("move"))
      .def(
          "release_move",
          [](OneCrowd& crowd, int player, int move) { OneCrowd::Call(crowd)->release_move(player, move); },
          py::arg("player"), py::arg("move"))
      .def_property_readonly("character_frames", &frames_of)
      .def_property_readonly("playing", &playing_of);
}

std::vector<std::string> passed_markers(OnePlayer& player) {
  std::vector<std::string> names;
  for (const PassedMarkers& passed : OnePlayer::Call(player)->passed_markers()) {
    for (const Marker* marker : passed) names.push_back(marker->name);
  }
  return names;
}

py::array_t<double> standing_feet(OnePlayer& player) {
  std::vector<double> places;
  for (const std::optional<Vector3>& foot : OnePlayer::Call(player)->standing_feet()) {
    if (foot) places.insert(places.end(), foot->begin(), foot->end());
  }
  const auto count = static_cast<py::ssize_t>(places.size()) / 3;
  return to_array(std::move(places), {count, 3});
}

// What Python says of the ground, asked for from threads that may not hold the interpreter's lock.
Ground to_ground(const py::object& asked) {
  if (asked.is_none()) return {};
  if (!PyCallable_Check(asked.ptr())) throw py::type_error("the ground must be a function of x, y and z, or None");
  const auto held = std::make_shared<py::object>(asked);
  return [held](const Vector3& from) -> std::optional<GroundPoint> {
    const GilHold hold;
    const py::object found = GilHold::call(*held, from.x(), from.y(), from.z());
    if (found.is_none()) return std::nullopt;
    try {
      const auto values = py::cast<std::array<double, 4>>(found);
      return GroundPoint{values[0], {values[1], values[2], values[3]}};
    } catch (const py::cast_error&) {
      throw py::type_error("the ground must be told as height and normal, four numbers, or as None");
    }
  };
}

void bind_player(py::module_& m) {
  py::class_<OnePlayer> player(m, "Player", py::module_local());
  const auto make = [](SharedCharacter character, const PlayerOptions& options) {
    return std::make_unique<OnePlayer>("Player", std::move(character), options);
  };
  player.def(py::init(make), py::arg("character").none(false), py::arg("options"));
  for_option_arguments([&](const auto&... options) {
    player.def(py::init(with_options(Types<SharedCharacter>{}, Types<>{}, make)), py::arg("character").none(false),
               options...);
  });
  player
      .def(
          "reset",
          [](OnePlayer& player, double x, double y, double heading, int style) {
            OnePlayer::Call(player)->reset({Vector2{x, y}, heading}, style);
          },
          py::arg("x") = 0.0, py::arg("y") = 0.0, py::arg("heading") = 0.0, py::arg("style") = 0)
      .def(
          "change_style", [](OnePlayer& player, int style) { OnePlayer::Call(player)->change_style(style); },
          py::arg("style"))
      .def_property_readonly("playing_style",
                             [](OnePlayer& player) { return OnePlayer::Call(player)->playing_style(); })
      .def_property_readonly("waiting_style",
                             [](OnePlayer& player) { return OnePlayer::Call(player)->waiting_style(); })
      .def(
          "force", [](OnePlayer& player, int next_class) { OnePlayer::Call(player)->force(next_class); },
          py::arg("next_class"))
      .def(
          "start_move", [](OnePlayer& player, int move) { OnePlayer::Call(player)->start_move(move); }, py::arg("move"))
      .def(
          "release_move", [](OnePlayer& player, int move) { OnePlayer::Call(player)->release_move(move); },
          py::arg("move"))
      .def_property_readonly("playing_moves",
                             [](OnePlayer& player) { return to_pair(OnePlayer::Call(player)->playing_moves()); })
      .def_property_readonly("waiting_moves",
                             [](OnePlayer& player) { return to_pair(OnePlayer::Call(player)->waiting_moves()); })
      .def_property_readonly("passed_markers", &passed_markers)
      .def(
          "look",
          [](OnePlayer& player, int look, double x, double y, double z) {
            OnePlayer::Call(player)->look(to_look(look), {x, y, z});
          },
          py::arg("look"), py::arg("x") = 0.0, py::arg("y") = 0.0, py::arg("z") = 0.0)
      .def(
          "reach",
          [](OnePlayer& player, int hand, double weight, bool carried, double x, double y, double z) {
            OnePlayer::Call(player)->reach(hand, {{x, y, z}, weight, carried});
          },
          py::arg("hand"), py::arg("weight"), py::arg("carried") = false, py::arg("x") = 0.0, py::arg("y") = 0.0,
          py::arg("z") = 0.0)
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
      .def_property_readonly("entered", [](OnePlayer& player) { return OnePlayer::Call(player)->entered(); })
      .def_property_readonly("seconds_left", [](OnePlayer& player) { return OnePlayer::Call(player)->seconds_left(); })
      .def_property_readonly("standing_feet", &standing_feet)
      .def(
          "stand_on",
          [](OnePlayer& player, const py::object& ground) { OnePlayer::Call(player)->stand_on(to_ground(ground)); },
          py::arg("ground"))
      .def_property_readonly("ground_level", [](OnePlayer& player) { return OnePlayer::Call(player)->ground_level(); })
      .def_property_readonly("ground_missed",
                             [](OnePlayer& player) { return OnePlayer::Call(player)->ground_missed(); })
      .def(
          "quality",
          [](OnePlayer& one, const Doubles& control) {
            const OnePlayer::Call player(one);
            return player->quality(player->styled_character().space.nearest(to_control(control)));
          },
          py::arg("control"))
      .def(
          "run",
          [](OnePlayer& one, const Doubles& trace, double rate, const py::object& progress, const py::object& moves,
             const py::object& styles, const py::object& looks, const py::object& reaches) {
            const Trace controls = to_trace(trace);
            const std::vector<MovePress> presses = to_presses(moves);
            const std::vector<StyleChange> changes = to_changes(styles);
            const std::vector<LookChange> looked = to_looks(looks);
            const std::vector<ReachChange> reached = to_reaches(reaches);
            const OnePlayer::Call player(one);
            return without_gil(progress, [&](const Progress& told) {
              return perform(*player, controls, rate, told, presses, changes, looked, reached);
            });
          },
          py::arg("trace"), py::arg("rate"), py::arg("progress") = py::none(), py::arg("moves") = py::none(),
          py::arg("styles") = py::none(), py::arg("looks") = py::none(), py::arg("reaches") = py::none());
}

}  // namespace

void bind_player_options(py::module_& m) {
  py::class_<PlayerOptions> bound(m, "PlayerOptions", py::module_local());
  for_option_arguments([&](const auto&... arguments) {
    bound.def(py::init(with_options(Types<>{}, Types<>{}, [](const PlayerOptions& given) { return given; })),
              arguments...);
  });
  bound.def_readwrite("seed", &PlayerOptions::seed)
      .def_readwrite("stitch", &PlayerOptions::stitch)
      .def_readwrite("policy", &PlayerOptions::policy)
      .def_property(
          "stitching",
          [](const PlayerOptions& o) { return o.stitching == Stitching::crossfade ? "crossfade" : "inertialize"; },
          [](PlayerOptions& o, const std::string& name) { o.stitching = to_stitching(name); })
      .def_readwrite("lock_feet", &PlayerOptions::lock_feet)
      .def_readwrite("root_adjustment", &PlayerOptions::root_adjustment)
      .def_readwrite("responsiveness", &PlayerOptions::responsiveness)
      .def_property(
          "constants",
          [](PlayerOptions& o) {
            std::map<std::string, double> values;
            for_each_constant(o.constants, [&](const char* name, double value) { values[name] = value; });
            return values;
          },
          [](PlayerOptions& o, const std::map<std::string, double>& values) {
            o.constants = player_constants(values);
          });
}

Stitching to_stitching(const std::string& name) {
  if (name != "inertialize" && name != "crossfade") {
    throw std::invalid_argument("there is no stitching \"" + name + "\"; there are inertialize and crossfade");
  }
  return name == "crossfade" ? Stitching::crossfade : Stitching::inertialize;
}

void bind_runtime(py::module_& m) {
  bind_player(m);
  bind_crowd(m);
}

}  // namespace fragmotion::bindings
