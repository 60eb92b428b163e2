// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "base/take_limits.hpp"
#include "direct/follow_path.hpp"
#include "direct/keep_clear.hpp"
#include "direct/painted_area.hpp"
#include "direct/steering.hpp"
#include "player_options.hpp"

namespace fragmotion::bindings {
namespace {

using OnePlayer = OneCallAtATime<Player>;
using OneFollower = OneCallAtATime<PathFollower>;

// x, y and heading, as Player.frame.
using Frame = std::tuple<double, double, double>;

CharacterFrame to_frame(const Frame& frame) {
  const auto& [x, y, heading] = frame;
  return {Vector2{x, y}, heading};
}

// The ground under points [N,2] or [N,3].
std::vector<Vector2> to_ground(const Doubles& points) {
  if (points.ndim() != 2 || (points.shape(1) != 2 && points.shape(1) != 3)) {
    throw std::invalid_argument("the points of a path must be [N,2] or [N,3]");
  }
  const std::vector<double> values = to_vector(points, "the points of a path", -kFarthestBody, kFarthestBody);
  const std::size_t width = static_cast<std::size_t>(points.shape(1));
  std::vector<Vector2> ground;
  for (std::size_t i = 0; i + width <= values.size(); i += width) ground.emplace_back(values[i], values[i + 1]);
  return ground;
}

Path make_path(const Doubles& points, bool closed, const std::optional<Doubles>& speeds) {
  const std::vector<Vector2> ground = to_ground(points);
  if (speeds) check_shape(*speeds, "speeds", {static_cast<py::ssize_t>(ground.size())});
  return Path(ground, closed, speeds ? to_vector(*speeds) : std::vector<double>());
}

py::array_t<double> places(const Path& path, const Doubles& ways) {
  check_shape(ways, "ways", {-1});
  std::vector<double> rows;
  for (const double way : to_vector(ways, "ways", -kFarthestBody, kFarthestBody)) {
    const Vector2 place = path.place(way);
    rows.insert(rows.end(), {place.x(), place.y()});
  }
  return to_array(std::move(rows), {ways.shape(0), 2});
}

// One of an enumeration's values by its name.
template <typename Value>
Value named(const std::string& what, const std::string& name,
            const std::vector<std::pair<std::string, Value>>& values) {
  std::string known;
  for (const auto& [each, value] : values) {
    if (each == name) return value;
    known += (known.empty() ? "" : ", ") + each;
  }
  throw std::invalid_argument("there is no " + what + " \"" + name + "\"; there are " + known);
}

FollowOptions to_options(double speed, double arrive, const std::string& facing, double heading, const Doubles& place,
                         const std::string& end) {
  check_shape(place, "place", {2});
  const std::vector<double> towards = to_vector(place);
  FollowOptions options;
  options.speed = speed;
  options.arrive = arrive;
  options.facing = named<PathFacing>(
      "facing", facing, {{"along", PathFacing::along}, {"heading", PathFacing::heading}, {"place", PathFacing::place}});
  options.heading = heading;
  options.place = {towards[0], towards[1]};
  options.end =
      named<PathEnd>("end", end, {{"stand", PathEnd::stand}, {"loop", PathEnd::loop}, {"go_on", PathEnd::go_on}});
  return options;
}

// Calls `define` with what a function's arguments speed ... end are called and are unless given.
template <typename Define>
void for_follow_arguments(const Define& define) {
  const FollowOptions unless;
  define(py::arg("speed") = unless.speed, py::arg("arrive") = unless.arrive, py::arg("facing") = "along",
         py::arg("heading") = unless.heading, py::arg("place") = py::make_tuple(0.0, 0.0), py::arg("end") = "stand");
}

py::array_t<double> row_of(const Control& c) { return to_array(std::vector<double>{c.x, c.y, c.turn, c.jump}, {4}); }

py::array_t<double> trace_of(const PathWalk& walk) {
  std::vector<double> rows;
  for (const Control& c : walk.trace) rows.insert(rows.end(), {c.x, c.y, c.turn, c.jump});
  return to_array(std::move(rows), {static_cast<py::ssize_t>(walk.trace.size()), 4});
}

void bind_path(py::module_& m) {
  py::class_<Path>(m, "Path", py::module_local())
      .def(py::init(&make_path), py::arg("points"), py::arg("closed") = false, py::arg("speeds") = py::none())
      .def_property_readonly("length", &Path::length)
      .def_property_readonly("is_closed", &Path::is_closed)
      .def("places", &places, py::arg("ways"))
      .def_property_readonly("start", [](const Path& path) {
        const CharacterFrame start = start_of(path);
        return py::make_tuple(start.position.x(), start.position.y(), start.heading);
      });
}

void bind_follower(py::module_& m) {
  py::class_<OneFollower> follower(m, "PathFollower", py::module_local());
  for_follow_arguments([&](const auto&... options) {
    follower.def(py::init([](const ControlSpace& space, const Path& path, double speed, double arrive,
                             const std::string& facing, double heading, const Doubles& place, const std::string& end) {
                   return std::make_unique<OneFollower>("PathFollower", space, path,
                                                        to_options(speed, arrive, facing, heading, place, end));
                 }),
                 py::arg("space"), py::arg("path"), options...);
  });
  follower.def("reset", [](OneFollower& follower) { OneFollower::Call(follower)->reset(); })
      .def(
          "steer",
          [](OneFollower& follower, const Frame& frame, double seconds) {
            return row_of(OneFollower::Call(follower)->steer(to_frame(frame), seconds));
          },
          py::arg("frame"), py::arg("seconds"))
      .def_property_readonly("way", [](OneFollower& follower) { return OneFollower::Call(follower)->way(); })
      .def_property_readonly("stands", [](OneFollower& follower) { return OneFollower::Call(follower)->stands(); })
      .def_property_readonly("seconds_left",
                             [](OneFollower& follower) { return OneFollower::Call(follower)->seconds_left(); });
}

void bind_walk(py::module_& m) {
  py::class_<PathWalk>(m, "PathWalk", py::module_local())
      .def_property_readonly("trace", &trace_of)
      .def_readonly("mean_distance", &PathWalk::mean_distance)
      .def_readonly("greatest_distance", &PathWalk::greatest_distance)
      .def_readonly("arrival_distance", &PathWalk::arrival_distance)
      .def_readonly("arrived", &PathWalk::arrived)
      .def_readonly("seconds", &PathWalk::seconds)
      .def_readonly("planned_seconds", &PathWalk::planned_seconds)
      .def_readonly("asked_speed", &PathWalk::asked_speed);
  for_follow_arguments([&](const auto&... options) {
    m.def(
        "follow_path",
        [](OnePlayer& one, const Path& path, const std::optional<Frame>& start, double speed, double arrive,
           const std::string& facing, double heading, const Doubles& place, const std::string& end, double rate,
           double seconds, const py::object& progress) {
          const CharacterFrame from = start ? to_frame(*start) : start_of(path);
          const FollowOptions wanted = to_options(speed, arrive, facing, heading, place, end);
          const OnePlayer::Call player(one);
          return without_gil(progress, [&](const Progress& told) {
            return follow_path(*player, from, path, wanted, rate, seconds, told);
          });
        },
        py::arg("player"), py::arg("path"), py::arg("start") = py::none(), options..., py::arg("rate") = 60.0,
        py::arg("seconds") = 600.0, py::arg("progress") = py::none());
  });
}

// What a member of a crowd would do alone: a path, a trace [T,4], or goals [G,2].
void set_wish(const py::object& wish, CrowdMember& member) {
  if (py::isinstance<Path>(wish)) {
    member.path = wish.cast<Path>();
    return;
  }
  const auto rows = wish.cast<Doubles>();
  if (rows.ndim() == 2 && rows.shape(1) == 4) {
    member.wanted = to_trace(rows);
  } else {
    member.goals = to_ground(rows);
  }
}

py::list traces_of_crowd(const std::vector<Trace>& traces) {
  py::list found;
  for (const Trace& trace : traces) {
    std::vector<double> rows;
    for (const Control& c : trace) rows.insert(rows.end(), {c.x, c.y, c.turn, c.jump});
    found.append(to_array(std::move(rows), {static_cast<py::ssize_t>(trace.size()), 4}));
  }
  return found;
}

py::list keep_crowd_clear(const py::list& players, const py::list& wishes, const Doubles& worlds,
                          const FollowOptions& follow, CrowdOptions options, const std::vector<Doubles>& obstacles,
                          const std::vector<Doubles>& passers_by, const py::object& progress) {
  const py::ssize_t count = static_cast<py::ssize_t>(players.size());
  if (wishes.size() != players.size()) throw std::invalid_argument("there must be a wish for each player");
  check_shape(worlds, "worlds", {count, 4});
  const std::vector<double> rows = to_vector(worlds, "worlds", -kFarthestBody, kFarthestBody);
  for (const Doubles& outline : obstacles) options.obstacles.push_back(to_ground(outline));
  for (const Doubles& places : passers_by) options.passers_by.push_back(to_ground(places));
  std::vector<std::unique_ptr<OnePlayer::Call>> calls;
  std::vector<CrowdMember> members;
  for (std::size_t i = 0; i < players.size(); ++i) {
    calls.push_back(std::make_unique<OnePlayer::Call>(players[i].cast<OnePlayer&>()));
    CrowdMember& member = members.emplace_back();
    member.player = &**calls.back();
    member.origin = {Vector2{rows[4 * i], rows[4 * i + 1]}, rows[4 * i + 2]};
    member.scale = rows[4 * i + 3];
    member.options = follow;
    set_wish(wishes[i], member);
  }
  return traces_of_crowd(
      without_gil(progress, [&](const Progress& told) { return keep_clear(members, options, told); }));
}

void bind_keep_clear(py::module_& m) {
  for_follow_arguments([&](const auto&... follow) {
    m.def(
        "keep_clear",
        [](const py::list& players, const py::list& wishes, const Doubles& worlds, double speed, double arrive,
           const std::string& facing, double heading, const Doubles& place, const std::string& end,
           const std::vector<Doubles>& obstacles, double radius, double seconds, double rate,
           const py::object& progress, const PaintedArea* area, const std::vector<Doubles>& passers_by) {
          return keep_crowd_clear(players, wishes, worlds, to_options(speed, arrive, facing, heading, place, end),
                                  {radius, seconds, rate, {}, area == nullptr ? nullptr : &area->edge(), {}}, obstacles,
                                  passers_by, progress);
        },
        py::arg("players"), py::arg("wishes"), py::arg("worlds"), follow..., py::arg("obstacles") = py::list(),
        py::arg("radius") = CrowdOptions().radius, py::arg("seconds") = 60.0, py::arg("rate") = 60.0,
        py::arg("progress") = py::none(), py::arg("area") = py::none(), py::arg("passers_by") = py::list());
  });
}

PaintedArea make_area(const Doubles& corners, const Doubles& paint) {
  check_shape(corners, "corners", {-1, 3, 3});
  check_shape(paint, "paint", {corners.shape(0), 3});
  const std::vector<double> places = to_vector(corners, "corners", -kFarthestBody, kFarthestBody),
                            shares = to_vector(paint);
  std::vector<PaintedTriangle> triangles(static_cast<std::size_t>(corners.shape(0)));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      triangles[t].corners[corner] = Eigen::Map<const Vector3>(&places[9 * t + 3 * corner]);
      triangles[t].paint[corner] = shares[3 * t + corner];
    }
  }
  return PaintedArea(std::move(triangles));
}

py::array_t<double> to_rows(const std::vector<Vector3>& places) {
  std::vector<double> rows;
  for (const Vector3& place : places) rows.insert(rows.end(), place.data(), place.data() + 3);
  return to_array(std::move(rows), {static_cast<py::ssize_t>(places.size()), 3});
}

void check_count(int count) {
  if (count < 0 || static_cast<std::size_t>(count) > kMostPathPoints)
    throw std::invalid_argument("the number of places must be 0 to 1000000");
}

void bind_area(py::module_& m) {
  py::class_<PaintedArea>(m, "PaintedArea", py::module_local())
      .def(py::init(&make_area), py::arg("corners"), py::arg("paint"))
      .def(
          "draw_apart",
          [](const PaintedArea& area, int count, double spacing, std::uint64_t seed, double room) {
            check_count(count);
            return to_rows(without_gil([&] {
              Random random(seed);
              return area.draw_apart(random, count, spacing, room);
            }));
          },
          py::arg("count"), py::arg("spacing"), py::arg("seed"), py::arg("room") = 0.0)
      .def(
          "draw_ways",
          [](const PaintedArea& area, const Doubles& starts, int count, std::uint64_t seed, double room) {
            check_count(count);
            check_shape(starts, "starts", {-1, 3});
            check_count(
                static_cast<int>(std::min<py::ssize_t>(starts.shape(0) * count, py::ssize_t{kMostPathPoints} + 1)));
            const std::vector<double> numbers = to_vector(starts, "starts", -kFarthestBody, kFarthestBody);
            std::vector<Vector3> places;
            for (std::size_t i = 0; i < numbers.size(); i += 3) places.emplace_back(&numbers[i]);
            return to_rows(without_gil([&] {
                     Random random(seed);
                     return area.draw_ways(random, places, count, room);
                   }))
                .reshape({starts.shape(0), static_cast<py::ssize_t>(count), py::ssize_t{3}});
          },
          py::arg("starts"), py::arg("count"), py::arg("seed"), py::arg("room") = 0.0);
}

void bind_steering(py::module_& m) {
  py::class_<Steering>(m, "Steering", py::module_local())
      .def(py::init([](const ControlSpace& space, bool walk_turns, bool run_turns) {
             return Steering(space, {walk_turns, run_turns});
           }),
           py::arg("space"), py::arg("walk_turns"), py::arg("run_turns"), py::keep_alive<1, 2>())
      .def(
          "control",
          [](Steering& steering, double right, double ahead, double turn, bool jump, double heading,
             std::optional<double> view) {
            const Control c = steering.control({right, ahead, turn, jump}, heading, view);
            return py::make_tuple(c.x, c.y, c.turn, c.jump);
          },
          py::arg("right"), py::arg("ahead"), py::arg("turn"), py::arg("jump"), py::arg("heading"), py::arg("view"));
  m.def("stick_speed", &stick_speed, py::arg("space"), py::arg("push"));
  m.def(
      "turns_well",
      [](const SharedCharacter& character, const std::string& policy, int style) {
        const TurnsWell turns = without_gil([&] { return turns_well(character, policy, style); });
        return py::make_tuple(turns.walking, turns.running);
      },
      py::arg("character").none(false), py::arg("policy") = "", py::arg("style") = 0);
}

}  // namespace

void bind_direct(py::module_& m) {
  bind_path(m);
  bind_follower(m);
  bind_walk(m);
  bind_keep_clear(m);
  bind_area(m);
  bind_steering(m);
}

}  // namespace fragmotion::bindings
