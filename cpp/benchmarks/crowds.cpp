// SPDX-License-Identifier: MIT
// A crowd near the camera, and one by its level of detail, as a game has it.
#include "crowds.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/rates.hpp"
#include "character/policy_file.hpp"
#include "control/simulated_players.hpp"
#include "fragmotion/fragmotion.hpp"
#include "runtime/step_on_threads.hpp"

namespace fragmotion::benchmarks {
namespace {

constexpr int kFramesPerControl = 6, kNearPlayers = 10000, kManyPlayers = 50000;
constexpr double kTrace = 60;               // s of it
constexpr std::size_t kSetOff = 60;         // frames until they go
constexpr int kMeasured = 24;               // frames, in which each has stepped as often as it does
constexpr double kNear = 20, kMiddle = 60;  // m from the camera: the limits of levels, with one player a square metre
constexpr int kCompared = 100, kSteps = 640, kHalfSecond = 32;  // players, and frames: all, and half a second

struct Level {
  int step_interval;
  bool hold_feet;
};

Level level_at(double distance) {
  if (distance < kNear) return {1, true};
  return {distance < kMiddle ? 2 : 4, false};
}

void require(bool holds) {
  if (!holds) throw std::runtime_error(game::last_error());
}

// What all players of a crowd do, each at a time of its own: as many ways as there are controls.
class Ways {
 public:
  explicit Ways(const ControlSpace& space) : trace_(simulate_trace("explorer", kTrace, 1, space)) {}

  const Control& operator()(std::size_t frame, std::size_t player) const {
    return trace_[(frame / kFramesPerControl + 7 * player) % trace_.size()];
  }

 private:
  Trace trace_;
};

// All step in all frames, with feet locked.
void measure_crowd(benchmark::State& state, const std::shared_ptr<const Character>& character, int threads) {
  const Ways ways(character->space);
  Crowd crowd(character, kNearPlayers, {}, threads);
  std::vector<Control> controls(kNearPlayers);
  std::vector<double> roots(std::size_t{3} * kNearPlayers), rotations(std::size_t{4} * kNearPlayers * crowd.bones());
  std::size_t frame = 0;
  const auto steer = [&] {
    for (int i = 0; i < kNearPlayers; ++i) controls[i] = ways(frame, i);
    ++frame;
  };
  const auto step = [&] { step_on_threads(crowd, controls.data(), kGameStep, roots.data(), rotations.data()); };
  while (frame < kSetOff) steer(), step();
  for (auto _ : state) {
    state.PauseTiming();
    steer();
    state.ResumeTiming();
    step();
    benchmark::DoNotOptimize(rotations.data());
  }
}

game::Character loaded(const Character& built) {
  const std::string bytes = to_bytes(built);
  FragmotionLoadOptions options = fragmotion_load_options();
  options.axes = FRAGMOTION_AXES_BLENDER;
  game::Character character = game::Character::load(bytes.data(), bytes.size(), options);
  require(static_cast<bool>(character));
  return character;
}

void set_level(game::PlayerRef player, const Level& level) {
  FragmotionPlayerOptions options = player.options();
  options.step_interval = static_cast<std::uint32_t>(level.step_interval);
  options.hold_feet = level.hold_feet ? 1 : 0;
  require(player.set_options(options));
}

void steer(const Ways& ways, std::size_t frame, std::vector<FragmotionInput>& inputs) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Control& control = ways(frame, i);
    inputs[i].move[0] = static_cast<float>(control.x);
    inputs[i].move[1] = static_cast<float>(control.y);
    inputs[i].turn = static_cast<float>(control.turn);
    inputs[i].jump = control.jumps() ? 1 : 0;
  }
}

void measure_far_crowd(benchmark::State& state, const std::shared_ptr<const Character>& built) {
  const Ways ways(built->space);
  const game::Character character = loaded(*built);
  FragmotionPlayerOptions far = fragmotion_player_options();
  far.step_interval = 4;  // so that they take turns
  game::Crowd crowd(character, kManyPlayers, 1, far);
  for (int i = 0; i < kManyPlayers; ++i) set_level(crowd[i], level_at(std::sqrt(i / kPi)));
  std::vector<FragmotionInput> inputs(kManyPlayers, fragmotion_input());
  std::size_t frame = 0;
  const auto step = [&] { require(crowd.step(inputs.data(), kGameStep)); };
  for (; frame < kSetOff; ++frame) steer(ways, frame, inputs), step();
  for (auto _ : state) {
    state.PauseTiming();
    steer(ways, frame++, inputs);
    state.ResumeTiming();
    step();
  }
}

// What a player was asked to do and did since, m in its own frame, and where its feet stood then.
struct Followed {
  Vector2 asked = Vector2::Zero(), went = Vector2::Zero();
  std::array<std::optional<Vector2>, 2> feet{};
};

// How far off players go from what they are asked over half a second, and how fast the toes of feet slide that stand:
// m/s, the means.
void measure_far_error(benchmark::State& state, const std::shared_ptr<const Character>& built) {
  const Ways ways(built->space);
  const game::Character character = loaded(*built);
  const auto interval = static_cast<std::size_t>(state.range(0));
  game::Crowd crowd(character, kCompared);
  for (int i = 0; i < kCompared; ++i) set_level(crowd[i], {static_cast<int>(interval), interval == 1});
  const std::array<LegRoles, kMostLegs> legs = leg_roles(built->pool.skeleton.roles);
  std::vector<FragmotionTransform> pose(character.info().bones);
  std::vector<FragmotionInput> inputs(kCompared, fragmotion_input());
  std::vector<Followed> all(kCompared);
  double off = 0, compared = 0, slides = 0, stood = 0;
  const auto look_at_feet = [&](game::PlayerRef player, const FragmotionState& now, Followed& followed) {
    require(player.pose(FRAGMOTION_SPACE_WORLD, pose.data(), static_cast<int>(pose.size())));
    for (std::size_t side = 0; side < 2; ++side) {
      const LegRoles& leg = legs[side];
      const float* at = pose[leg.toe >= 0 ? leg.toe : leg.foot].position;
      const auto before = std::exchange(followed.feet[side], std::nullopt);
      if (now.foot_stands[side] == 0) continue;
      followed.feet[side] = Vector2{at[0], at[1]};
      if (before) slides += (*followed.feet[side] - *before).norm(), stood += static_cast<double>(interval) * kGameStep;
    }
  };
  for (auto _ : state) {
    for (std::size_t frame = 0; frame < kSteps; ++frame) {
      steer(ways, frame, inputs);
      require(crowd.step(inputs.data(), kGameStep));
      for (int i = 0; i < kCompared; ++i) {
        const FragmotionState now = crowd[i].state();
        all[i].asked += kGameStep * Vector2{inputs[i].move[0], inputs[i].move[1]};
        all[i].went += Vector2{now.motion[0], now.motion[1]};
        if ((frame + 1) % interval == 0) look_at_feet(crowd[i], now, all[i]);
        if ((frame + 1) % kHalfSecond != 0) continue;
        off += (std::exchange(all[i].asked, Vector2::Zero()) - std::exchange(all[i].went, Vector2::Zero())).norm();
        compared += kHalfSecond * kGameStep;
      }
    }
  }
  state.counters["off"] = off / compared;
  state.counters["slides"] = slides / stood;
}

}  // namespace

void register_crowds(const std::string& name, const std::shared_ptr<const Character>& character) {
  const auto add = [&](const std::string& what, auto... measured) {
    return benchmark::RegisterBenchmark((name + " " + what).c_str(), measured...)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  add("crowd step", measure_crowd, character, 1)->Iterations(kMeasured);
  add("crowd step, two threads", measure_crowd, character, 2)->Iterations(kMeasured);
  add("far crowd step", measure_far_crowd, character)->Iterations(kMeasured);
  add("far crowd's error", measure_far_error, character)->Arg(1)->Arg(2)->Arg(4)->Iterations(1);
}

}  // namespace fragmotion::benchmarks
