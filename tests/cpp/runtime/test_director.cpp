// SPDX-License-Identifier: MIT
// What a player decides to play.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "runtime/player.hpp"
#include "small_character.hpp"
#include "steering.hpp"

namespace fragmotion {
namespace {

// Follows the control as it is.
PlayerOptions at_once() {
  PlayerOptions options;
  options.responsiveness = 1;
  return options;
}

// Four acts, a class and a fragment of half a second each. The table gives at once what is asked for, but from standing
// only a jump or forward; between forward and what else moves comes standing.
struct Acts {
  enum : int { stand, forward, back, jump };  // classes are numbered by the takes' order
  std::shared_ptr<Character> character =
      std::make_shared<Character>(tiny_character({tiny_clip(0), tiny_clip(1.5), tiny_clip(-1.5), tiny_clip(0, 0.5)}));

  Acts() {
    for (int point = 0; point < kPaperPoints; ++point) {
      const Control control = character->space.point(point);
      const int asked = control.jump > 0 ? jump : control.y > 0 ? forward : control.y < 0 ? back : stand;
      for (int from = 0; from < 4; ++from) {
        character->policies[0].next[from * kPaperPoints + point] = from == stand && asked == back ? stand : asked;
      }
    }
    std::fill(character->bridges.begin(), character->bridges.end(), -1);
    character->bridges[forward * 4 + back] = character->bridges[forward * 4 + jump] = stand;
  }
};

const Control kBack{0, -1.5, 0, 0};
const Control kTap{0, 1.5, 0, 1};

// The classes that play, one after another, while each control is held for its time, shown 100 times a second.
std::vector<int> acts_of(Player& player, const std::vector<std::pair<Control, double>>& held) {
  std::vector<int> acts;
  for (const auto& [control, seconds] : held) {
    for (int i = 0; i < std::lround(100 * seconds); ++i) {
      player.step(control, 0.01);
      if (acts.empty() || acts.back() != player.playing_class()) acts.push_back(player.playing_class());
    }
  }
  return acts;
}

TEST(Player, WalksWhereLessThanHalfAWalkIsAskedFor) {
  Player player(Acts().character, at_once());
  EXPECT_EQ(acts_of(player, {{{0, 0.4, 0, 0}, 1.2}}), (std::vector<int>{Acts::forward}));
  player.reset();
  EXPECT_EQ(acts_of(player, {{{0, 0.2, 0, 0}, 1.2}}), (std::vector<int>{Acts::stand}));
}

TEST(Player, StandsBetweenActsThatDoNotFitAndThenDoesWhatWasAskedFor) {
  Player player(Acts().character, at_once());
  EXPECT_EQ(acts_of(player, {{kForward, 0.7}, {kBack, 1.5}}),
            (std::vector<int>{Acts::forward, Acts::stand, Acts::back}));
}

// The jump was done when it was pressed for, and what is asked for since then is the same.
TEST(Player, PlaysFragmentsToTheirEndsWhileAJumpIsHeld) {
  Player player(Acts().character, at_once());
  settle(player, kTap, 4);
  int entered = player.entered();
  double left = player.seconds_left();
  for (int f = 0; f < std::lround(3 / kStep); ++f, left = player.seconds_left()) {
    player.step(kTap, kStep);
    const bool begins = std::exchange(entered, player.entered()) != player.entered();
    EXPECT_TRUE(!begins || left < 2 * kStep) << left << " s were left";
  }
}

TEST(Player, AsksAgainAfterStandingWhereTheControlHasChanged) {
  Player player(Acts().character, at_once());
  EXPECT_EQ(acts_of(player, {{kForward, 0.7}, {kBack, 0.3}, {kForward, 1.5}}),
            (std::vector<int>{Acts::forward, Acts::stand, Acts::forward}));
}

TEST(Player, LosesNoJumpHoweverShortlyItIsPressed) {
  for (double wait = 0.5; wait < 2; wait += 0.03) {
    Player walking(Acts().character, at_once()), bridging(Acts().character, at_once());
    const std::vector<int> one = acts_of(walking, {{kForward, wait}, {kTap, 0.01}, {kForward, 2}}),
                           two = acts_of(bridging, {{kForward, 0.7}, {kBack, wait - 0.5}, {kTap, 0.01}, {kBack, 3}});
    EXPECT_EQ(std::count(one.begin(), one.end(), Acts::jump), 1) << wait;
    EXPECT_EQ(std::count(two.begin(), two.end(), Acts::jump), 1) << wait;
  }
}

TEST(Player, JumpsOnceInAStepOfAnyLength) {
  const auto place = [](int steps) {
    Player player(Acts().character, at_once());
    player.step(kTap, 0.2);   // takes off,
    player.step({}, 0.1);     // lets go,
    player.step(kTap, 0.01);  // and presses again in the air
    for (int i = 0; i < steps; ++i) player.step({}, 1.83 / steps);
    return player.root_position();
  };
  const Vector3 expected = place(183);
  for (const int steps : {1, 2, 7}) EXPECT_LT((place(steps) - expected).norm(), 0.02) << steps;
}

// With the limbs raised forward, rad.
Clip raised(Clip clip, double angle) {
  const Quaternion turn{Eigen::AngleAxisd(angle, Vector3::UnitX())};
  for (int f = 0; f < clip.frames; ++f) {
    for (const int limb : {2, 3}) {
      double* rotation = &clip.rotations[std::size_t{4} * (4 * f + limb)];
      store_quaternion(turn * load_quaternion(rotation), rotation);
    }
  }
  return clip;
}

// Two steps follow each other, and the hop that the table tells for each begins as the other one is posed.
TEST(Player, HopsAsAfterOneMoreStepWhereThatFitsBetter) {
  const Clip step = tiny_clip(1.5), hop = tiny_clip(1.5, 0.5);
  auto character = std::make_shared<Character>(tiny_character({step, raised(step, 1.5), hop, raised(hop, 1.5)}));
  for (std::size_t f = 0; f < character->pool.fragments.size(); ++f) {
    const int act = character->pool.fragments[f].clip;
    character->classes.labels[f] = act;
    character->classes.representatives[act] = static_cast<int>(f);
  }
  for (int point = 0; point < kPaperPoints; ++point) {
    const int first = character->space.point(point).jumps() ? 2 : 0;
    for (int from = 0; from < 4; ++from)
      character->policies[0].next[from * kPaperPoints + point] = first + 1 - from % 2;
  }
  std::fill(character->bridges.begin(), character->bridges.end(), -1);
  for (double wait = 1; wait < 2; wait += 0.1) {
    Player player(character, at_once());
    EXPECT_EQ(acts_of(player, {{kForward, wait}, {kTap, 0.2}}), (std::vector<int>{0, 2})) << wait;
  }
}

// The act that is drawn for a control where a class has two, whose fragments visibly do this.
int drawn_act(int of_class, const Control& its_own, int other, const Control& others, const Control& control) {
  const Acts acts;
  PackedPool& pool = acts.character->pool;
  const auto act_of = [&](int fragment) { return pool.fragments[fragment].clip; };
  for (std::size_t f = 0; f < pool.fragments.size(); ++f) {
    const int act = act_of(static_cast<int>(f));
    if (act == other) acts.character->classes.labels[f] = of_class, pool.fragments[f].evident = others;
    if (act == of_class) pool.fragments[f].evident = its_own;
  }
  Player player(acts.character, at_once());
  player.step(control, 0.3);
  return act_of(player.playing_fragment());
}

TEST(Player, DrawsWhatHopsAsIsWantedHoweverWellAnotherMemberGoes) {
  const Control hop{0, 0, 0, 1}, walk{0, 1.2, 0, 0}, run{0, 3.3, 0, 0}, leap{0, 3.3, 0, 1};
  EXPECT_EQ(drawn_act(Acts::jump, hop, Acts::forward, run, leap), Acts::jump);
  EXPECT_EQ(drawn_act(Acts::forward, walk, Acts::jump, leap, run), Acts::forward);
}

TEST(Player, DrawsALightRunForABouncyOne) {
  const Control bouncy{0, 3.3, 0, 0.7}, light{0, 3.3, 0, 0.2}, run{0, 3.3, 0, 0};
  EXPECT_EQ(drawn_act(Acts::forward, bouncy, Acts::back, light, run), Acts::back);
}

TEST(Player, PlaysAForcedClassToItsEndAndThenWhatThePolicySays) {
  for (double wait = 0.05; wait < 1; wait += 0.07) {
    Player player(Acts().character, at_once());
    acts_of(player, {{kForward, wait}});
    player.force(Acts::back);
    EXPECT_EQ(acts_of(player, {{kForward, 0.16}}).back(), Acts::back) << wait;
    const std::vector<int> acts = acts_of(player, {{{}, 0.3}, {kForward, 0.3}, {kForward, 1}});
    EXPECT_EQ(acts, (std::vector<int>{Acts::back, Acts::forward})) << wait;  // not left early for the standing
  }
}

TEST(Player, ForcesAnyMemberOfAClass) {
  const auto c = gait_character();
  const auto members = c->classes.members();
  const auto most = std::max_element(members.begin(), members.end(),
                                     [](const auto& a, const auto& b) { return a.size() < b.size(); });
  std::vector<int> drawn;
  Player player(c);
  for (std::size_t i = 0; i < 30 * most->size(); ++i) {
    player.force(static_cast<int>(most - members.begin()));
    player.step({}, 0.2);
    drawn.push_back(player.playing_fragment());
  }
  for (const int fragment : *most) EXPECT_TRUE(std::count(drawn.begin(), drawn.end(), fragment)) << fragment;
}

TEST(Player, ForcesNothingAfterAResetAndNoClassThatDoesNotExist) {
  Player player(Acts().character, at_once());
  player.force(Acts::jump);
  player.reset();
  EXPECT_EQ(acts_of(player, {{{}, 1}}), (std::vector<int>{Acts::stand}));
  EXPECT_THROW(player.force(-1), std::invalid_argument);
  EXPECT_THROW(player.force(4), std::invalid_argument);
}

// The share of fragments that are of the take that played, under a stick that is moved every two seconds.
double share_that_stays(const TransitionWeights& weights) {
  const std::shared_ptr<const Character> character = gait_character();
  const std::vector<Fragment>& fragments = character->pool.fragments;
  PlayerOptions options;
  options.constants.transition = weights;
  Player player(character, options);
  int before = player.playing_fragment(), entered = player.entered(), stays = 0;
  for (int f = 0; f < std::lround(120 / kStep); ++f) {
    const double angle = std::floor(f * kStep / 2);
    player.step({1.2 * std::sin(angle), 1.2 * std::cos(angle), 0, 0}, kStep);
    if (player.entered() == entered) continue;
    ++entered;
    stays += fragments[player.playing_fragment()].clip == fragments[before].clip ? 1 : 0;
    before = player.playing_fragment();
  }
  return static_cast<double>(stays) / player.entered();
}

TEST(Player, StaysInATakeTheMoreTheMoreItCostsToLeaveIt) {
  TransitionWeights fickle, loyal;
  fickle.manner = 0;
  loyal.manner = 100;
  EXPECT_GT(share_that_stays({}), 0.1);
  EXPECT_GT(share_that_stays(loyal), share_that_stays(fickle));
}

}  // namespace
}  // namespace fragmotion
