// SPDX-License-Identifier: MIT
#include "frames.hpp"

#include <benchmark/benchmark.h>

#include <cmath>

#include "base/random.hpp"
#include "base/rates.hpp"
#include "runtime/player.hpp"

namespace fragmotion::benchmarks {
namespace {

constexpr int kHeld = 600;                    // frames for which a stick is held: a walk, to any side
constexpr int kRestless = 20;                 // and for which a restless one is: any speed and turn
constexpr double kRise = 0.17, kTread = 0.3;  // m of the stairs of a house

// A stick that goes to another place every few frames.
class Stick {
 public:
  Stick(const ControlSpace& space, bool restless) : space_(space), restless_(restless) {}

  const Control& operator()() {
    if (frame_++ % (restless_ ? kRestless : kHeld) == 0) move();
    return control_;
  }

 private:
  void move() {
    const double angle = 2 * kPi * random_.uniform(),
                 speed = restless_ ? space_.run() * random_.uniform() : space_.walk();
    control_ = {speed * std::sin(angle), speed * std::cos(angle), restless_ ? 2 * random_.uniform() - 1 : 0, 0};
  }

  const ControlSpace& space_;
  bool restless_;
  Random random_{1};
  Control control_;
  int frame_ = 0;
};

// With the places and rotations of all bones.
void measure_frame(benchmark::State& state, const std::shared_ptr<const Character>& character, bool lock_feet,
                   bool restless) {
  PlayerOptions options;
  options.lock_feet = lock_feet;
  Player player(character, options);
  Stick stick(character->space, restless);
  const Kinematics kinematics(character->pool.skeleton);
  PosedBones posed(kinematics.bones());
  for (auto _ : state) {
    player.step(stick(), kGameStep);
    kinematics.world(player.root_position(), player.rotations().data(), posed.heads.data(), posed.rotations.data());
    benchmark::DoNotOptimize(posed.heads.data());
  }
}

void measure_stairs(benchmark::State& state, const std::shared_ptr<const Character>& character) {
  Player player(character);
  double asked = 0, most = 0;
  player.stand_on([&asked](const Vector3& from) {
    ++asked;
    return GroundPoint{kRise * std::floor(from.y() / kTread), Vector3::UnitZ()};
  });
  const Control ahead{0, character->space.walk(), 0, 0};
  for (auto _ : state) {
    const double before = asked;
    player.step(ahead, kGameStep);
    most = std::max(most, asked - before);
  }
  state.counters["asked"] = most;
}

}  // namespace

void register_frames(const std::string& name, const std::shared_ptr<const Character>& character) {
  for (const bool lock_feet : {false, true}) {
    for (const bool restless : {false, true}) {
      const std::string called =
          name + " frame, " + (lock_feet ? "locked" : "free") + (restless ? ", restless" : ", held");
      benchmark::RegisterBenchmark(called.c_str(), measure_frame, character, lock_feet, restless);
    }
  }
  benchmark::RegisterBenchmark((name + " on stairs").c_str(), measure_stairs, character);
}

}  // namespace fragmotion::benchmarks
