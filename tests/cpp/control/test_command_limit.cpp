// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.hpp"
#include "control/command_limit.hpp"

namespace fragmotion {
namespace {

constexpr double kTurnRate = 1.25;  // rad/s
constexpr double kLong = 100;       // s: enough for getting to any control

Vector2 velocity(const Control& control) { return {control.x, control.y}; }

TEST(CommandLimit, GetsToTheCommandWithTheAccelerationAndStaysThere) {
  CommandLimit limit(5, kTurnRate);
  limit.reset(0.7);
  const Control run{0, 3, -1, 1};
  for (int f = 1; f <= 90; ++f) {
    const Control now = limit.after(run, 0.7, 1.0 / 60);
    const Vector2 acceleration = limit.advance(run, 0.7, 1.0 / 60);
    EXPECT_NEAR(acceleration.y(), f <= 36 ? 5 : 0, 1e-9) << f;
    EXPECT_NEAR(acceleration.x(), kTurnRate * std::min(3.0, 5 * (f - 1) / 60.0), 1e-9) << "to the right, as it turns";
    EXPECT_NEAR(now.y, std::min(3.0, 5 * f / 60.0), 1e-9);
    EXPECT_NEAR(now.x, 0, 1e-9);
    EXPECT_NEAR((limit.velocity(0.7) - velocity(now)).norm(), 0, 1e-9);
    EXPECT_EQ(now.turn, -1);
    EXPECT_EQ(now.jump, 1);
  }
}

TEST(CommandLimit, NeverChangesTheVelocityInTheWorldFaster) {
  Random random(3);
  CommandLimit limit(5, kTurnRate);
  limit.reset(0);
  Vector2 before = Vector2::Zero();
  double heading = 0;
  for (int i = 0; i < 2000; ++i) {
    const Control control{6 * random.uniform() - 3, 6 * random.uniform() - 3, 0, 0};
    const double seconds = 0.1 * random.uniform();
    heading += random.uniform() - 0.5;
    const Vector2 now = Eigen::Rotation2Dd(heading) * velocity(limit.after(control, heading, seconds));
    limit.advance(control, heading, seconds);
    EXPECT_LE((now - before).norm(), 5 * seconds + 1e-9);
    before = now;
  }
}

TEST(CommandLimit, IsNotAcceleratedByHowABodySways) {
  CommandLimit limit(5, kTurnRate);
  const Control held{0.5, 1, 0, 0};
  limit.reset(0, velocity(held));
  for (int f = 1; f < 200; ++f) {
    const double heading = 0.1 * std::sin(0.1 * f);
    limit.face(heading);
    EXPECT_NEAR(limit.advance(held, heading, 1.0 / 60).norm(), 0, 1e-9) << f;
  }
}

TEST(CommandLimit, WithoutALimitIsTheCommand) {
  CommandLimit limit(std::numeric_limits<double>::infinity(), kTurnRate);
  limit.reset(0);
  const Control control{1, -2, 0.5, 0};
  for (const double seconds : {0.01, 10.0}) {
    const Control now = limit.after(control, 2, seconds);
    EXPECT_NEAR((velocity(now) - velocity(control)).norm(), 0, 1e-12) << seconds;
  }
}

TEST(CommandLimit, GoesRoundATurnAheadAndNoFasterThanTheAccelerationLeads) {
  for (const Control& asked :
       {Control{0, 3, 1, 1}, Control{3, -4, 1, 0}, Control{0, 9, -0.5, 0}, Control{8, 0, 3, 0}}) {
    CommandLimit limit(5, kTurnRate);
    const Control held = limit.after(asked, 0, kLong);
    const double turn = std::clamp(asked.turn, -1.0, 1.0);
    EXPECT_NEAR(held.speed(), std::min(asked.speed(), 5 / (std::abs(turn) * kTurnRate)), 1e-12);
    EXPECT_NEAR(held.x * asked.y, held.y * asked.x, 1e-12);
    EXPECT_EQ(held.turn, asked.turn);
    EXPECT_EQ(held.jump, asked.jump);
    limit.reset(0, velocity(held));
    for (int f = 1; f < 600; ++f) {
      const double heading = turn * kTurnRate * f / 60;
      limit.advance(held, heading, 1.0 / 60);
      EXPECT_NEAR((limit.velocity(heading) - velocity(held)).norm(), 0, 1e-9);
    }
  }
  const Control straight{0, 99, 0, 0};
  EXPECT_EQ(CommandLimit(5, kTurnRate).after(straight, 0, kLong).y, 99);
}

}  // namespace
}  // namespace fragmotion
