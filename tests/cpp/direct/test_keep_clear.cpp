// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "control/trace_frames.hpp"
#include "direct/keep_clear.hpp"
#include "evaluate/performance.hpp"
#include "small_character.hpp"

namespace fragmotion {
namespace {

constexpr double kCrowdRate = 30;

// Players that share a workspace, each with a seed of its own, from a place in a world of its own on.
struct Crowded {
  Player first{gait_character()};
  std::deque<Player> players;
  std::vector<CrowdMember> members;

  CrowdMember& add(const CharacterFrame& origin, double scale = 1) {
    players.push_back(first.branch());
    players.back().reseed(players.size());
    players.back().reset();
    CrowdMember& member = members.emplace_back();
    member.player = &players.back();
    member.origin = origin;
    member.scale = scale;
    return member;
  }

  // Where each is on each frame, as it plays its trace alone from the same start on.
  std::vector<std::vector<Vector2>> replay(const std::vector<Trace>& traces, int frames) {
    std::vector<std::vector<Vector2>> places;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const CrowdMember& member = members[i];
      member.player->reset();
      const Performance shown = perform(*member.player, traces[i], kCrowdRate);
      std::vector<Vector2>& own = places.emplace_back();
      for (int f = 0; f < frames; ++f) {
        const double* at = &shown.path[std::size_t{3} * std::min(f, shown.frames - 1)];
        own.push_back(member.origin.position +
                      member.scale * (Eigen::Rotation2Dd(member.origin.heading) * Vector2{at[0], at[1]}));
      }
    }
    return places;
  }
};

double nearest_of(const std::vector<std::vector<Vector2>>& places) {
  double nearest = 1e9;
  for (std::size_t f = 0; f < places.front().size(); ++f) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) nearest = std::min(nearest, (places[i][f] - places[k][f]).norm());
    }
  }
  return nearest;
}

// On a square of 28 m: half go to places on it, as in a crowd, half do what a simulated walker does.
Crowded two_hundred() {
  Crowded crowd;
  Random random(7);
  const auto drawn = [&] { return Vector2{28 * random.uniform() - 14, 28 * random.uniform() - 14}; };
  for (int i = 0; i < 200; ++i) {
    const CharacterFrame origin{{2.0 * (i % 15 - 7), 2.0 * (i / 15 - 6)}, 0.7 * i};
    CrowdMember& member = crowd.add(origin, i % 3 == 0 ? 1.08 : 1);
    if (i % 2 == 0) {
      member.wanted = simulate_trace("walker", 20, static_cast<std::uint64_t>(i), ControlSpace());
    } else {
      for (int k = 0; k < 5; ++k) {
        member.goals.emplace_back(Eigen::Rotation2Dd(-origin.heading) * (drawn() - origin.position) / member.scale);
      }
    }
  }
  return crowd;
}

TEST(KeepClear, KeepsTwoHundredOnASquareApart) {
  Crowded crowd = two_hundred();
  CrowdOptions options;
  options.seconds = 20;
  options.rate = kCrowdRate;
  const std::vector<Trace> traces = keep_clear(crowd.members, options);
  const int frames = frame_count(200, kCrowdRate);
  const double nearest = nearest_of(crowd.replay(traces, frames));
  std::vector<Trace> heedless;
  for (const CrowdMember& member : crowd.members) {
    heedless.push_back(member.wanted.empty() ? Trace(200) : member.wanted);
  }
  const double careless = nearest_of(crowd.replay(heedless, frames));
  std::printf("nearest %.2f m; heedless %.2f m\n", nearest, careless);
  EXPECT_LT(careless, 0.2);
  EXPECT_GT(nearest, 0.4);
}

TEST(KeepClear, ChangesNothingForOneThatIsAlone) {
  Crowded crowd;
  crowd.add({{3, 4}, 1}).wanted = simulate_trace("walker", 10, 5, ControlSpace());
  CrowdOptions options;
  options.rate = kCrowdRate;
  const Trace trace = keep_clear(crowd.members, options).front(), &wanted = crowd.members.front().wanted;
  ASSERT_EQ(trace.size(), wanted.size());
  for (std::size_t i = 0; i < trace.size(); ++i) {
    EXPECT_NEAR(trace[i].x, wanted[i].x, 1e-12);
    EXPECT_NEAR(trace[i].y, wanted[i].y, 1e-12);
    EXPECT_EQ(trace[i].turn, wanted[i].turn);
    EXPECT_EQ(trace[i].jump, wanted[i].jump);
  }
}

TEST(KeepClear, IsTheSameEveryTime) {
  const auto found = [] {
    Crowded crowd;
    for (int i = 0; i < 4; ++i) crowd.add({{1.0 * i, 0}, 1.0 * i}).goals = {{0, 4}, {3, 3}};
    CrowdOptions options;
    options.seconds = 6;
    return keep_clear(crowd.members, options);
  };
  const std::vector<Trace> one = found(), other = found();
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t k = 0; k < one[i].size(); ++k) {
      EXPECT_EQ(one[i][k].x, other[i][k].x);
      EXPECT_EQ(one[i][k].y, other[i][k].y);
    }
  }
}

TEST(KeepClear, GoesAroundWhoMakesWayForNobody) {
  Crowded crowd;
  crowd.add({}).goals = {{0, 8}};
  CrowdOptions options;
  options.seconds = 12;
  options.rate = kCrowdRate;
  const int frames = frame_count(120, kCrowdRate);
  std::vector<Vector2> comes;
  for (int control = 0; control <= 40; ++control) comes.emplace_back(0, 8 - 0.1 * control);  // and stays where it goes
  const auto seen = [&](int frame) { return comes[std::min<std::size_t>(frame / (kCrowdRate / kTraceRate), 40)]; };
  const auto nearest = [&](const std::vector<std::vector<Vector2>>& passers_by) {
    options.passers_by = passers_by;
    crowd.members.front().player->reset();
    const std::vector<Vector2> places = crowd.replay(keep_clear(crowd.members, options), frames).front();
    double found = 1e9;
    for (int f = 0; f < frames; ++f) found = std::min(found, (places[f] - seen(f)).norm());
    return found;
  };
  EXPECT_LT(nearest({}), 0.2);
  EXPECT_GT(nearest({comes}), 0.5);
  options.passers_by = {{}};
  EXPECT_THROW(keep_clear(crowd.members, options), std::invalid_argument);
}

TEST(KeepClear, GoesToItsGoalsAndAlongItsPath) {
  Crowded crowd;
  crowd.add({}).goals = {{0, 4}, {3, 4}};
  crowd.add({{20, 0}, 0}).path = Path({{0, 0}, {0, 3}, {3, 6}});
  CrowdOptions options;
  options.seconds = 20;
  options.rate = kCrowdRate;
  const auto places = crowd.replay(keep_clear(crowd.members, options), frame_count(200, kCrowdRate));
  double first = 1e9;
  for (const Vector2& place : places[0]) first = std::min(first, (place - Vector2{0, 4}).norm());
  EXPECT_LT(first, 0.3);
  EXPECT_LT((places[0].back() - Vector2{3, 4}).norm(), 0.3);
  EXPECT_LT((places[1].back() - Vector2{23, 6}).norm(), 0.3);
}

TEST(KeepClear, GoesAroundWhatStandsThereAndWhoStandsAtTheEndOfHisTrace) {
  Crowded crowd;
  crowd.add({}).goals = {{0.3, 8}};
  crowd.add({{0, 6}, 0}).wanted = Trace(10);
  CrowdOptions options;
  options.seconds = 25;
  options.rate = kCrowdRate;
  options.obstacles = {{{-0.5, 2.5}, {0.5, 2.5}, {0.5, 3.5}, {-0.5, 3.5}}};
  const auto places = crowd.replay(keep_clear(crowd.members, options), frame_count(250, kCrowdRate));
  EXPECT_GT(nearest_of(places), 0.5);
  double nearest = 1e9;
  for (const Vector2& place : places[0]) {
    const Vector2 off = (place - Vector2{0, 3}).cwiseAbs() - Vector2{0.5, 0.5};
    nearest = std::min(nearest, off.cwiseMax(0).norm() + std::min(off.maxCoeff(), 0.0));
  }
  EXPECT_GT(nearest, 0.3);
  EXPECT_LT((places[0].back() - Vector2{0.3, 8}).norm(), 0.3);
}

// How far the one that is furthest out is outside of an area.
double furthest_out(const AreaEdge& area, const std::vector<std::vector<Vector2>>& places) {
  double out = 0;
  for (const std::vector<Vector2>& each : places) {
    for (const Vector2& place : each) out = std::max(out, -area.room(place));
  }
  return out;
}

// Two arms of 2 m that meet at a right angle, and what eight do there who are told to go elsewhere, too.
TEST(KeepClear, LeavesNoAreaAndComesBackToIt) {
  const AreaEdge area(
      {{{{0, 0}, {8, 0}, {8, 2}}}, {{{0, 0}, {8, 2}, {2, 2}}}, {{{0, 0}, {2, 2}, {2, 8}}}, {{{0, 0}, {2, 8}, {0, 8}}}});
  const auto played = [&](const AreaEdge* within) {
    Crowded crowd;
    for (int i = 0; i < 8; ++i) {
      const CharacterFrame origin{i % 2 == 0 ? Vector2{1, 1.0 + 0.8 * i} : Vector2{1.5 + 0.8 * i, 1}, 0.9 * i};
      CrowdMember& member = crowd.add(origin, i == 2 ? 1.1 : 1);
      if (i < 6) {
        for (const Vector2& goal : {Vector2{7, 0.6}, Vector2{1, 1}, Vector2{0.7, 7.4}, Vector2{9, 9}})
          member.goals.emplace_back(Eigen::Rotation2Dd(-origin.heading) * (goal - origin.position) / member.scale);
      } else {
        member.wanted = simulate_trace("walker", 20, static_cast<std::uint64_t>(i), ControlSpace());
      }
    }
    CrowdOptions options;
    options.seconds = 20;
    options.rate = kCrowdRate;
    options.area = within;
    return crowd.replay(keep_clear(crowd.members, options), frame_count(200, kCrowdRate));
  };
  const auto kept = played(&area);
  EXPECT_GT(furthest_out(area, played(nullptr)), 1);
  EXPECT_LT(furthest_out(area, kept), 0.05);
  EXPECT_GT(nearest_of(kept), 0.4);
  double way = 0;
  for (const Vector2& place : kept[0]) way = std::max(way, (place - Vector2{1, 1}).norm());
  EXPECT_GT(way, 5) << "it walks";
}

TEST(KeepClear, GoesBackToTheAreaThatItStandsBeside) {
  const AreaEdge area({{{{2, -3}, {8, -3}, {8, 3}}}, {{{2, -3}, {8, 3}, {2, 3}}}});
  Crowded crowd;
  crowd.add({{0, 0}, 1}).wanted = Trace(80);
  CrowdOptions options;
  options.rate = kCrowdRate;
  options.area = &area;
  EXPECT_GT(area.room(crowd.replay(keep_clear(crowd.members, options), frame_count(80, kCrowdRate))[0].back()), 0);
}

TEST(KeepClear, RefusesWhatIsNone) {
  Crowded crowd;
  crowd.add({}).goals = {{0, 4}};
  CrowdOptions options;
  options.radius = 0;
  EXPECT_THROW(keep_clear(crowd.members, options), std::invalid_argument);
  options = {};
  options.seconds = 4000;
  EXPECT_THROW(keep_clear(crowd.members, options), std::invalid_argument);
  crowd.members.front().scale = 0;
  EXPECT_THROW(keep_clear(crowd.members, {}), std::invalid_argument);
  crowd.members.front() = {};
  EXPECT_THROW(keep_clear(crowd.members, {}), std::invalid_argument);
}

}  // namespace
}  // namespace fragmotion
