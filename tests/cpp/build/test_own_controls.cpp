// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "build/exclude_classes.hpp"
#include "character/policy_file.hpp"
#include "evaluate/change_pushes.hpp"
#include "evaluate/explain.hpp"
#include "evaluate/performance.hpp"
#include "evaluate/response.hpp"
#include "fragments/coverage.hpp"
#include "policy/optimal.hpp"
#include "policy_payload.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

constexpr ControlLayout kLayouts[] = {
    {1, 4, false, false}, {2, 8, true, false}, {3, 8, true, true}, {4, 16, true, true}};

Character built(const ControlLayout& layout, const std::vector<std::string>& policies = {"anticipate"}) {
  const std::vector<Clip> all = gait_takes();
  BuildOptions options;
  options.classes = 15;
  options.controls.layout = layout;
  options.policies = policies;
  return build(humanoid(), {all[0], all[1], all[9], all[10]}, {simulate_trace("explorer", 20, 1, ControlSpace())},
               options);
}

TEST(OwnControls, AreWhatEverythingAsksFor) {
  for (const ControlLayout& layout : kLayouts) {
    SCOPED_TRACE(std::to_string(layout.speeds) + " x " + std::to_string(layout.directions));
    const auto c = std::make_shared<const Character>(built(layout, policy_names()));
    EXPECT_TRUE(c->space.layout() == layout);
    const auto controls = static_cast<std::size_t>(layout.size());
    EXPECT_EQ(c->quality.match.size(), 15 * controls);
    EXPECT_EQ(coverage(c->pool.fragments, c->space).distances.size(), controls);
    EXPECT_EQ(c->control_model.size(), controls * controls);
    const std::vector<int> trace = snap(c->space, simulate_trace("runner", 20, 5, c->space));
    for (const Policy& policy : c->policies) {
      EXPECT_EQ(policy.next.size(), 15 * controls) << policy.name;
      const double percent = percent_of_optimal(c->quality, policy, trace);
      EXPECT_TRUE(percent > 0 && percent <= 100 + 1e-9) << policy.name << " " << percent;
    }
    EXPECT_EQ(Explainer{c}(3, layout.size() - 1).size(), 15U);
    EXPECT_THROW(Explainer{c}(3, layout.size()), std::invalid_argument);
    const int most = c->policy()(0, layout.size() - 1);
    const Character left = without_classes(*c, {most});
    EXPECT_EQ(std::count(left.policy().next.begin(), left.policy().next.end(), most), 0);
  }
}

TEST(OwnControls, ComeBackFromAFile) {
  for (const ControlLayout& layout : kLayouts) {
    const Character c = built(layout);
    const std::string bytes = to_bytes(c);
    const Character again = from_bytes(bytes);
    EXPECT_TRUE(again.space.layout() == layout);
    EXPECT_EQ(again.space.speeds(), c.space.speeds());
    EXPECT_EQ(again.quality.controls, layout.size());
    EXPECT_EQ(again.quality.match, c.quality.match);
    EXPECT_EQ(to_bytes(again), bytes);
    EXPECT_NE(bytes.find("controls"), std::string::npos);
  }
}

TEST(OwnControls, AddNothingToAFileOfThePapers) {
  const std::string bytes = to_bytes(built({}));
  EXPECT_EQ(bytes.find("controls"), std::string::npos);
  EXPECT_EQ(from_bytes(bytes).space.size(), kPaperPoints);
}

// A file in which a number of the section is another one.
std::string forged(const std::string& bytes, std::size_t after_name, char value) {
  std::string payload = payload_of(bytes);
  payload[payload.find("controls") + 8 + after_name] = value;
  return file_around(payload);
}

TEST(OwnControls, AreRefusedWhereAFileForgesThem) {
  const std::string bytes = to_bytes(built({1, 4, true, true}));
  EXPECT_EQ(from_bytes(forged(bytes, 0, 1)).space.size(), 30) << "as it was";
  const std::size_t directions = 8 + 8, turn = directions + 1;
  for (const auto& [at, value] : {std::pair<std::size_t, char>{0, 0},
                                  {0, 2},
                                  {0, 120},
                                  {3, 1},
                                  {directions, 5},
                                  {directions, 8},
                                  {directions, -1},
                                  {turn, 0},
                                  {turn + 1, 0}}) {
    EXPECT_THROW(from_bytes(forged(bytes, at, value)), std::invalid_argument) << at << " " << int{value};
  }
}

std::vector<double> played(const std::shared_ptr<const Character>& c, const Trace& trace) {
  Player player(c);
  std::vector<double> poses;
  for (const Control& control : trace) {
    player.step(control, 1 / kTraceRate);
    for (int b = 0; b < 3; ++b) poses.push_back(player.root_position()[b]);
  }
  return poses;
}

TEST(OwnControls, GiveNoTurnAndNoJumpWhereThereIsNone) {
  const auto c = std::make_shared<const Character>(built({2, 8, false, false}));
  const Trace plain = simulate_trace("twitcher", 20, 3, c->space);
  Trace wild = plain;
  for (Control& control : wild) control.turn = 1, control.jump = 1;
  EXPECT_EQ(played(c, plain), played(c, wild));
}

TEST(OwnControls, ReplayWhatWasRecordedWithOthers) {
  const Trace recorded = simulate_trace("explorer", 20, 3, ControlSpace());
  for (const ControlLayout& layout : kLayouts) {
    const auto c = std::make_shared<const Character>(built(layout));
    const Performance p = perform(Player(c), recorded, 30);
    EXPECT_GT(p.quality, 0);
    EXPECT_TRUE(std::isfinite(p.velocity_error));
    EXPECT_EQ(played(c, recorded), played(c, recorded));
  }
}

TEST(OwnControls, AreTheChangesThatAreTimed) {
  const auto c = std::make_shared<const Character>(built({1, 4, false, false}));
  EXPECT_EQ(response_times(c).size(), 5U * 4);
  EXPECT_GT(change_pushes(c)[static_cast<std::size_t>(Change::start)].p99, 0);
}

TEST(OwnControls, AreSaidToBeHeldOrNot) {
  const Character c = built({4, 16, true, true});
  EXPECT_LT(c.report.at("speeds_held"), 4);
  EXPECT_LT(c.report.at("directions_held"), 16);
  EXPECT_EQ(c.report.at("turn_held"), 1);
}

}  // namespace
}  // namespace fragmotion
