// SPDX-License-Identifier: MIT
#include "evaluate/performance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/max_accumulate.hpp"
#include "base/ranges.hpp"
#include "base/rounding.hpp"
#include "base/transposed.hpp"
#include "control/command_limit.hpp"
#include "fragments/able_trace.hpp"

namespace fragmotion {
namespace {

constexpr double kSpeedWindow = 0.5;  // s over which speeds are measured
constexpr double kSpan = 2;           // s over which the root drifts

// The slope a frame of the least-squares line through frames first .. last of a path.
Vector3 slope(const std::vector<double>& path, int first, int last) {
  const double middle = 0.5 * (first + last);
  Vector3 sum = Vector3::Zero();
  double square = 0;
  for (int f = first; f <= last; ++f) {
    sum += (f - middle) * load_vector(&path[std::size_t{3} * f]);
    square += (f - middle) * (f - middle);
  }
  return sum / square;
}

// The character in the style that a frame shows.
const Character& in_style(const Character& character, const Performance& p, int frame) {
  return character.in_style(p.styles.empty() ? 0 : p.styles[frame]);
}

// What a control becomes within a limit, which goes on.
Control advanced(CommandLimit& limit, const Control& control, double heading, double seconds) {
  const Control able = limit.after(control, heading, seconds);
  limit.advance(control, heading, seconds);
  return able;
}

// Where a trace that is followed exactly, within a limit, leads from the origin: the character frame of each frame.
std::vector<CharacterFrame> exact_path(const Performance& p, const Trace& trace, const Character& character,
                                       CommandLimit limit, bool as_able) {
  std::vector<CharacterFrame> path(1);
  for (int f = 1; f < p.frames; ++f) {
    CharacterFrame next = path.back();
    const Character& styled = in_style(character, p, f);
    const Control& asked = trace[control_at(f, p.rate, trace.size())];
    limit.set_turn_rate(styled.space.turn_rate());
    const Control control = advanced(limit, as_able ? styled.admitted(asked) : asked, next.heading, 1 / p.rate);
    const double angle = control.turn * styled.space.turn_rate() / p.rate;
    next.position += Eigen::Rotation2Dd(next.heading + angle / 2) * Vector2{control.x, control.y} / p.rate;
    next.heading += angle;
    path.push_back(next);
  }
  return path;
}

struct Drift {
  double place = 0;    // m/s
  double heading = 0;  // rad
};

Drift drift(const Performance& p, const std::vector<CharacterFrame>& exact) {
  if (p.frames < 2) return {};
  const int span = std::clamp(static_cast<int>(std::lround(kSpan * p.rate)), 1, p.frames - 1), spans = p.frames - span;
  const auto place = [&](int f) { return Vector2{p.path[std::size_t{3} * f], p.path[std::size_t{3} * f + 1]}; };
  const auto off = [&](int f) { return p.path[std::size_t{3} * f + 2] - exact[f].heading; };
  Drift sum;
  for (int f = 0; f < spans; ++f) {
    const Vector2 asked = Eigen::Rotation2Dd(off(f)) * (exact[f + span].position - exact[f].position);
    sum.place += (place(f + span) - place(f) - asked).norm();
    sum.heading += std::abs(off(f + span) - off(f));
  }
  return {sum.place / spans * p.rate / span, sum.heading / spans};
}

// Dynamic programming over frames, from the last to the first (Eq. 1 with classes that last).
class Hindsight {
 public:
  Hindsight(const Character& c, const std::vector<int>& controls, double rate, double shortest)
      : n_(c.classes.count),
        frames_(static_cast<int>(controls.size())),
        shortest_(n_, static_cast<int>(shortest * rate + kRounding)),
        longest_(n_, 0),
        smoothness_(transposed(c.quality.smoothness, n_, n_)),
        match_(static_cast<std::size_t>(frames_ + 1) * n_, 0),
        value_(match_.size(), 0) {
    for (std::size_t f = 0; f < c.pool.fragments.size(); ++f) {
      const int label = c.classes.labels[f];
      const double frames = c.pool.seconds(c.pool.fragments[f]) * rate;
      shortest_[label] = std::clamp(static_cast<int>(frames + kRounding), 1, std::max(1, shortest_[label]));
      longest_[label] = std::max(longest_[label], static_cast<int>(std::ceil(frames - kRounding)));
    }
    for (int f = 0; f < frames_; ++f) {
      for (int q = 0; q < n_; ++q) {
        match_[at(f + 1, q)] =
            match_[at(f, q)] + c.quality.match[static_cast<std::size_t>(q) * c.quality.controls + controls[f]];
      }
    }
  }

  double best() {
    for (int f = frames_ - 1; f >= 0; --f) {
      for (int to = 0; to < n_; ++to) best_of_class(f, to);
    }
    return *std::max_element(value_.begin(), value_.begin() + n_) / frames_;
  }

 private:
  std::size_t at(int row, int column) const { return static_cast<std::size_t>(row) * n_ + column; }

  // What playing `to` from frame `f` on is worth after each class.
  void best_of_class(int f, int to) {
    double* value = &value_[at(f, 0)];
    const double* smoothness = &smoothness_[at(to, 0)];
    const int last = std::min(frames_, f + longest_[to]);
    for (int end = std::min(frames_, f + shortest_[to]); end <= last; ++end) {
      max_accumulate(value, smoothness, n_, match_[at(end, to)] - match_[at(f, to)], value_[at(end, to)]);
    }
  }

  int n_, frames_;
  std::vector<int> shortest_, longest_;  // [classes] frames that a class may play
  std::vector<double> smoothness_;       // [to, from]
  std::vector<double> match_;            // [frames + 1, classes] summed from the first frame
  std::vector<double> value_;            // [frames + 1, classes] of what follows a class that ends at a frame
};

// Starts and releases moves, and changes styles, looks and what hands reach for, as a trace is played.
class Pressing {
 public:
  Pressing(const Player& player, const std::vector<MovePress>& presses, const std::vector<StyleChange>& styles,
           const std::vector<LookChange>& looks, const std::vector<ReachChange>& reaches, std::size_t controls)
      : looks_(looks), reaches_(reaches) {
    for (const ReachChange& change : reaches) {
      check(change.control, controls, "a hand");
      events_.push_back({change.control, static_cast<int>(&change - reaches.data()), Event::reach});
    }
    for (const LookChange& look : looks) {
      check(look.control, controls, "a look");
      events_.push_back({look.control, static_cast<int>(&look - looks.data()), Event::look});
    }
    for (const StyleChange& change : styles) {
      check(change, player.character().style_count(), controls);
      events_.push_back({change.control, change.style, Event::change_style});
    }
    for (const MovePress& press : presses) {
      check(press, player.character().moves.size(), controls);
      events_.push_back({press.control, press.move, Event::start});
      events_.push_back({static_cast<long long>(press.control) + press.held, press.move, Event::release});
    }
    const auto earlier = [](const Event& a, const Event& b) { return a.control < b.control; };
    std::stable_sort(events_.begin(), events_.end(), earlier);
  }

  // All that happens up to this control.
  void until(std::size_t control, Player& player) {
    for (; next_ < events_.size() && events_[next_].control <= static_cast<long long>(control); ++next_) {
      const auto& [at, number, kind] = events_[next_];
      if (kind == Event::reach) player.reach(reaches_[number].hand, reaches_[number].aim);
      if (kind == Event::look) player.look(looks_[number].look, looks_[number].place);
      if (kind == Event::change_style) player.change_style(number);
      if (kind == Event::start) player.start_move(number);
      if (kind == Event::release) player.release_move(number);
    }
  }

 private:
  struct Event {
    enum Kind { reach, look, change_style, start, release };
    long long control;
    int number;
    Kind kind;
  };

  static void check(const StyleChange& change, int styles, std::size_t controls) {
    if (change.style < 0 || change.style >= styles) {
      throw std::invalid_argument("style " + std::to_string(change.style) + " does not exist; the character has " +
                                  std::to_string(styles));
    }
    check(change.control, controls, "a style");
  }

  static void check(int control, std::size_t controls, const std::string& what) {
    if (control >= 0 && control < static_cast<long long>(controls)) return;
    throw std::invalid_argument(what + " is asked for before control " + std::to_string(control) + " of a trace of " +
                                std::to_string(controls));
  }

  static void check(const MovePress& press, std::size_t moves, std::size_t controls) {
    if (press.move < 0 || press.move >= static_cast<long long>(moves)) {
      throw std::invalid_argument("move " + std::to_string(press.move) + " does not exist; the character has " +
                                  std::to_string(moves));
    }
    if (press.control < 0 || press.control >= static_cast<long long>(controls) || press.held < 0) {
      throw std::invalid_argument("a move is asked for before control " + std::to_string(press.control) +
                                  " of a trace of " + std::to_string(controls) + ", for " + std::to_string(press.held) +
                                  " controls");
    }
  }

  const std::vector<LookChange>& looks_;
  const std::vector<ReachChange>& reaches_;
  std::vector<Event> events_;
  std::size_t next_ = 0;
};

void check_shown(const Character& character, const Trace& trace, const Clip& clip, std::size_t entered) {
  const int bones = character.pool.skeleton.size(), frames = frame_count(trace.size(), clip.rate);
  if (clip.rotations.size() != std::size_t{4} * bones * clip.frames) {
    throw std::invalid_argument("the clip has not the character's " + std::to_string(bones) + " bones");
  }
  if (clip.frames != frames || entered != static_cast<std::size_t>(frames)) {
    throw std::invalid_argument("a trace of " + std::to_string(trace.size()) + " controls makes " +
                                std::to_string(frames) + " frames at this rate, the clip has " +
                                std::to_string(clip.frames) + " and what was entered " + std::to_string(entered));
  }
}

}  // namespace

Performance perform(Player& player, const Trace& trace, double rate, const Progress& progress,
                    const std::vector<MovePress>& moves, const std::vector<StyleChange>& styles,
                    const std::vector<LookChange>& looks, const std::vector<ReachChange>& reaches) {
  if (trace.empty()) throw std::invalid_argument("the trace has no controls");
  Pressing pressing(player, moves, styles, looks, reaches, trace.size());
  const int entered = player.entered();
  Performance p;
  p.rate = rate;
  p.frames = frame_count(trace.size(), rate);
  for (int f = 0; f < p.frames; ++f) {
    if (f % 256 == 0) report(progress, static_cast<double>(f) / p.frames, "Playing");
    const std::size_t at = control_at(f, rate, trace.size());
    const Control& control = trace[at];
    if (f > 0) {
      pressing.until(at, player);
      player.step(control, 1 / rate);
    }
    const CharacterFrame now = player.frame();
    const Vector3& root = player.root_position();
    p.root_positions.insert(p.root_positions.end(), root.data(), root.data() + 3);
    p.rotations.insert(p.rotations.end(), player.rotations().begin(), player.rotations().end());
    p.path.insert(p.path.end(), {now.position.x(), now.position.y(), now.heading});
    p.styles.push_back(player.playing_style());
    p.classes.push_back(player.playing_class());
    p.fragments.push_back(player.playing_fragment());
    const auto [whole_body, upper_body] = player.playing_moves();
    p.moves.insert(p.moves.end(), {whole_body, upper_body});
    p.entered.push_back(player.entered() - entered);
    if (f > 0) p.quality += player.quality(player.styled_character().space.nearest(control)) / (p.frames - 1);
  }
  judge(p, player.character(), trace);
  return p;
}

void judge(Performance& p, const Character& character, const Trace& trace) {
  const int half = std::max(1, static_cast<int>(std::lround(kSpeedWindow / 2 * p.rate)));
  const double weight = 1.0 / (p.frames - 1);
  const CommandLimit unlimited(std::numeric_limits<double>::infinity(), character.space.turn_rate());
  const CommandLimit body(kBodyAcceleration / character.space.scale(), character.space.turn_rate());
  CommandLimit limit = body;
  limit.reset(p.path[2]);
  p.velocity_error = p.velocity_error_limited = p.turn_error = p.jump_error = p.commanded_speed = 0;
  for (int f = 1; f < p.frames; ++f) {
    const Control& control = trace[control_at(f, p.rate, trace.size())];
    const Vector3 speed = slope(p.path, std::max(0, f - half), std::min(p.frames - 1, f + half)) * p.rate;
    const Vector2 velocity = Eigen::Rotation2Dd(-p.path[std::size_t{3} * f + 2]) * speed.head<2>();
    const Character& styled = in_style(character, p, f);
    const bool jumps = !p.fragments.empty() && styled.pool.fragments[p.fragments[f]].evident.jumps();
    p.velocity_error += weight * (velocity - Vector2{control.x, control.y}).norm();
    limit.set_turn_rate(styled.space.turn_rate());
    const Control able = advanced(limit, styled.admitted(control), p.path[std::size_t{3} * f + 2], 1 / p.rate);
    p.velocity_error_limited += weight * (velocity - Vector2{able.x, able.y}).norm();
    p.turn_error += weight * std::abs(speed.z() - control.turn * styled.space.turn_rate());
    p.jump_error += jumps != control.jumps() ? weight : 0;
    p.commanded_speed += weight * control.speed();
  }
  const Drift whole = drift(p, exact_path(p, trace, character, unlimited, false));
  const Drift limited = drift(p, exact_path(p, trace, character, body, true));
  p.drift = whole.place;
  p.drift_heading = whole.heading;
  p.drift_limited = limited.place;
  p.drift_heading_limited = limited.heading;
}

Performance judge_clip(const Character& character, const Trace& trace, const Clip& clip, std::vector<int> entered) {
  if (trace.empty()) throw std::invalid_argument("the trace has no controls");
  check_shown(character, trace, clip, entered.size());
  Performance p;
  p.rate = clip.rate;
  p.frames = clip.frames;
  p.root_positions = clip.root_positions;
  p.rotations = clip.rotations;
  for (int f = 0; f < clip.frames; ++f) {
    const double* root = &clip.root_positions[std::size_t{3} * f];
    p.path.insert(p.path.end(), {root[0], root[1], clip.headings[f]});
  }
  p.entered = std::move(entered);
  judge(p, character, trace);
  p.jump_error = 0;
  return p;
}

double optimal_performance(const Character& character, const Trace& trace, double rate, double shortest) {
  if (trace.empty()) throw std::invalid_argument("the trace has no controls");
  if (!(shortest >= 0 && shortest <= kLongestCall)) {
    throw std::invalid_argument("the shortest time that a class plays must be 0 s to an hour");
  }
  const int frames = frame_count(trace.size(), rate) - 1;
  if (frames < 1) throw std::invalid_argument("the trace is shorter than a frame at this rate");
  const std::vector<int> snapped = snap(character.space, able_trace(character.speeds, trace));
  std::vector<int> controls;
  for (int f = 1; f <= frames; ++f) controls.push_back(snapped[control_at(f, rate, snapped.size())]);
  return Hindsight(character, controls, rate, shortest).best();
}

}  // namespace fragmotion
