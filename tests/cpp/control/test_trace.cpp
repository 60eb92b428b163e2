// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

#include "allocations.hpp"
#include "base/random.hpp"
#include "control/simulated_players.hpp"
#include "control/trace.hpp"

namespace fragmotion {
namespace {

class TraceFile : public testing::Test {
 protected:
  void SetUp() override {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = std::filesystem::path(testing::TempDir()) / ("fragmotion_trace_" + test);
    std::filesystem::create_directories(folder_);
    path_ = folder_ / "walk.csv";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }

  std::string error() const {
    try {
      read_trace(path_);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path folder_, path_;
};

bool same(const Control& a, const Control& b) {
  return a.x == b.x && a.y == b.y && a.turn == b.turn && a.jump == b.jump;
}

std::string told(const Asked& asked) {
  std::string text;
  for (const Asked::Move& move : asked.moves)
    text += std::to_string(move.control) + " " + move.name + " " + std::to_string(move.held) + "; ";
  text += "| ";
  for (const Asked::Style& style : asked.styles) text += std::to_string(style.control) + " " + style.name + "; ";
  return text;
}

const std::string kHeader = "velocity_x,velocity_y,turn,jump\n";

TEST_F(TraceFile, ReadsBackWhatWasWritten) {
  Random random(1);
  Trace trace;
  for (int i = 0; i < 100; ++i)
    trace.push_back({random.uniform() / 3, -3e7 * random.uniform(), 2 * random.uniform() - 1, i % 2 * 1.0});
  write_trace(path_, trace);
  const Trace back = read_trace(path_);
  ASSERT_EQ(back.size(), trace.size());
  for (std::size_t i = 0; i < trace.size(); ++i) EXPECT_TRUE(same(back[i], trace[i])) << i;
}

TEST_F(TraceFile, WritesPlainShortNumbers) {
  write_trace(path_, {{0, 1.2, -1, 0}, {-0.85, 0.1, 1, 1}});
  std::ifstream stream(path_);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(text, kHeader + "0,1.2,-1,0\n-0.85,0.1,1,1\n");
}

std::string of_two_bytes(const std::string& ascii) {
  std::string text;
  for (const char letter : ascii) text += {letter, '\0'};
  return text;
}

TEST_F(TraceFile, ToleratesWhatEditorsDo) {
  for (const std::string& text : {
           kHeader + "0,1.5,0,0\n-1,0,1,1",
           kHeader + "0,1.5,0,0\n-1,0,1,1\n",
           kHeader + "0,1.5,0,0\n-1,0,1,1\n\n  \n",
           "\xEF\xBB\xBF" + kHeader + "0,1.5,0,0\n-1,0,1,1\n",
           std::string("velocity_x,velocity_y,turn,jump\r\n0,1.5,0,0\r\n-1,0,1,1\r\n"),
           std::string("velocity_x,velocity_y,turn,jump\r0,1.5,0,0\r-1,0,1,1\r"),
           "\xFF\xFE" + of_two_bytes(kHeader + "0,1.5,0,0\n-1,0,1,1\n"),
           std::string(" velocity_x, velocity_y ,turn,jump \n 0 ,\t1.50, +0,0.0\n-1.0, 0 ,1e0,1 \n"),
       }) {
    write(text);
    const Trace trace = read_trace(path_);
    ASSERT_EQ(trace.size(), 2u) << text;
    EXPECT_TRUE(same(trace[0], {0, 1.5, 0, 0})) << text;
    EXPECT_TRUE(same(trace[1], {-1, 0, 1, 1})) << text;
  }
}

TEST_F(TraceFile, RefusesMalformedFilesNamingTheLine) {
  const std::string row = "0,1,0,0\n";
  const struct {
    const char* label;
    std::string text, where, what;
  } cases[] = {
      {"empty", "", "walk.csv:1: ", "header"},
      {"no header", row + row, "walk.csv:1: ", "velocity_x,velocity_y,turn,jump"},
      {"other header", "x,y,turn,jump\n" + row + row, "walk.csv:1: ", "'x,y,turn,jump'"},
      {"two styles", "velocity_x,velocity_y,turn,jump,style,style\n", "walk.csv:1: ", "one each of 'style'"},
      {"longer header", "velocity_x,velocity_y,turn,jump,fire\n" + row + row, "walk.csv:1: ", "fire"},
      {"binary", std::string("\0\x01\xff\n\0", 5), "walk.csv:1: ", "header"},
      {"no rows", kHeader, "walk.csv:1: ", "0 rows"},
      {"one row", kHeader + row, "walk.csv:2: ", "1 rows"},
      {"three values", kHeader + row + "0,1,0\n", "walk.csv:3: ", "found 3"},
      {"five values", kHeader + row + row + "0,1,0,0,0\n", "walk.csv:4: ", "found 5"},
      {"trailing comma", kHeader + row + "0,1,0,0,\n", "walk.csv:3: ", "found 5"},
      {"blank line between", kHeader + row + "\n" + row, "walk.csv:3: ", "empty line"},
      {"word", kHeader + row + "0,fast,0,0\n", "walk.csv:3: ", "velocity_y is 'fast'"},
      {"nothing", kHeader + row + ",1,0,0\n", "walk.csv:3: ", "velocity_x is ''"},
      {"unit", kHeader + row + "0,1 m,0,0\n", "walk.csv:3: ", "velocity_y is '1 m'"},
      {"decimal comma", kHeader + row + "0;1,5;0;0\n", "walk.csv:3: ", "found 2"},
      {"not a number", kHeader + row + "nan,1,0,0\n", "walk.csv:3: ", "velocity_x is 'nan'"},
      {"infinite", kHeader + row + "0,inf,0,0\n", "walk.csv:3: ", "velocity_y"},
      {"overflow", kHeader + row + "0,1e999,0,0\n", "walk.csv:3: ", "velocity_y is '1e999'"},
      {"faster than light", kHeader + row + "0,2e9,0,0\n", "walk.csv:3: ", "velocity_y is over 1e9 m/s"},
      {"turn too far", kHeader + row + "0,1,6.5,0\n", "walk.csv:3: ", "turn is 6.5"},
      {"turn in degrees", kHeader + row + "0,1,-90,0\n", "walk.csv:3: ", "turn is -90"},
      {"negative jump", kHeader + row + "0,1,0,-1\n", "walk.csv:3: ", "jump is -1"},
      {"jump of two", kHeader + row + "0,1,0,2\n", "walk.csv:3: ", "jump is 2"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.label);
    write(c.text);
    EXPECT_EQ(error().rfind(c.where, 0), 0u) << error();
    EXPECT_NE(error().find(c.what), std::string::npos) << error();
  }
}

const std::string kFurther = "velocity_x,velocity_y,turn,jump,move,style\n";

TEST_F(TraceFile, ReadsMovesAndStylesInFurtherColumns) {
  write(
      "velocity_x,velocity_y,turn,jump,move,style,move\n"
      "0,1,0,0,,tired,\n"
      "0,1,0,0,wave,tired, kick \n"
      "0,1,0,0,wave,,kick\n"
      "0,1,0,0,\"a \"\"b\"\", c\",happy,\n"
      "0,1,0,0,wave,happy,wave\n");
  EXPECT_EQ(read_trace(path_).size(), 5u);
  EXPECT_EQ(told(read_asked(path_)), "1 wave 2; 1 kick 2; 3 a \"b\", c 1; 4 wave 1; 4 wave 1; | 0 tired; 3 happy; ");
}

TEST_F(TraceFile, ReadsBackMovesAndStylesAsTheyWereWritten) {
  const Trace trace(20, {0, 1, 0, 0});
  const Asked asked{{{0, "wave", 3}, {2, "kick, \"low\"", 5}, {3, "wave", 4}, {7, " sit\t", 13}, {7, "sit", 1}},
                    {{0, "tired"}, {4, "\"proud\""}, {19, "tired"}}};
  write_trace(path_, trace, asked);
  EXPECT_EQ(read_trace(path_).size(), trace.size());
  EXPECT_EQ(told(read_asked(path_)), told(asked));
}

TEST_F(TraceFile, ReadsBackLooksAndReachesAsTheyWereWritten) {
  Asked asked;
  asked.looks = {{0, 1, {0, 0, 0}}, {3, 2, {0.5, -3, 1.25}}, {7, 0, {0, 0, 0}}};
  asked.reaches = {
      {2, 0, 0.1, false, {1e-3, 2, 3}}, {2, 1, 1, true, {0.25, 0.5, 1.25}}, {5, 0, 0, false, {1e-3, 2, 3}}};
  write_trace(path_, Trace(9, {0, 1, 0, 0}), asked);
  const Asked read = read_asked(path_);
  ASSERT_EQ(read.looks.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read.looks[i].control, asked.looks[i].control);
    EXPECT_EQ(read.looks[i].look, asked.looks[i].look);
    EXPECT_EQ(read.looks[i].place, asked.looks[i].place);
  }
  ASSERT_EQ(read.reaches.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read.reaches[i].control, asked.reaches[i].control);
    EXPECT_EQ(read.reaches[i].hand, asked.reaches[i].hand);
    EXPECT_EQ(read.reaches[i].weight, asked.reaches[i].weight);
    EXPECT_EQ(read.reaches[i].carried, asked.reaches[i].carried);
    EXPECT_EQ(read.reaches[i].place, asked.reaches[i].place);
  }
}

TEST_F(TraceFile, RefusesMalformedLooksAndReachesNamingTheLine) {
  const std::string header = "velocity_x,velocity_y,turn,jump,look,left_hand\n", row = "0,1,0,0,ahead,free\n";
  for (const char* bad :
       {"0,1,0,0,up,\n", "0,1,0,0,at 1 2,\n", "0,1,0,0,at 1 2 x,\n", "0,1,0,0,ahead 1,\n", "0,1,0,0,,1 at 1 2\n",
        "0,1,0,0,,2 at 1 2 3\n", "0,1,0,0,,1 on 1 2 3\n", "0,1,0,0,,held\n", "0,1,0,0,at 1 2 1e10,\n"}) {
    write(header + row + bad + row);
    EXPECT_EQ(error().rfind("walk.csv:3: ", 0), 0u) << bad << error();
  }
  write("velocity_x,velocity_y,turn,jump,look,look\n" + row);
  EXPECT_NE(error().find("header"), std::string::npos);
}

TEST_F(TraceFile, HoldsAMoveToTheEndAtMost) {
  write_trace(path_, Trace(4, {0, 1, 0, 0}), {{{2, "wave", 1000000}}, {}});
  EXPECT_EQ(told(read_asked(path_)), "2 wave 2; | ");
}

TEST_F(TraceFile, TakesNamesThatAreNotUtf8ForLatin1) {
  write(kFurther + "0,1,0,0,gr\xFC\xDF,\n0,1,0,0,,\n");
  EXPECT_EQ(told(read_asked(path_)), "0 gr\u00FC\u00DF 1; | ");
}

TEST_F(TraceFile, RefusesMalformedMovesNamingTheLine) {
  const std::string row = "0,1,0,0,,\n";
  for (const char* bad : {"0,1,0,0,\"wave,\n", "0,1,0,0,\"wave\" on,\n", "0,1,0,0,wa\"v\"e,\n", "0,1,0,0,\"wave\n\",\n",
                          "0,1,0,0,wave\n", "0,1,0,0,wave,,\n"}) {
    write(kFurther + row + bad + row);
    EXPECT_EQ(error().rfind("walk.csv:3: ", 0), 0u) << bad << error();
  }
}

TEST_F(TraceFile, WritesNoMoveThatCannotBeReadBack) {
  const Trace trace(3, {0, 1, 0, 0});
  for (const Asked& asked : {Asked{{{3, "wave", 1}}, {}}, Asked{{{-1, "wave", 1}}, {}}, Asked{{{0, "", 1}}, {}},
                             Asked{{{0, "a\nb", 1}}, {}}, Asked{{}, {{3, "tired"}}}, Asked{{}, {{0, ""}}}}) {
    EXPECT_THROW(write_trace(path_, trace, asked), std::invalid_argument);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(TraceFile, TakesLittleMemoryForManyCommasAndEmptyLines) {
  for (const char mark : {',', '\n'}) {
    write(kHeader + "0,1,0,0\n" + std::string(1000000, mark) + "1");
    const std::size_t before = allocated_bytes;
    const std::string found = error();
    EXPECT_LT(allocated_bytes - before, 5000000u);
    EXPECT_EQ(found.rfind("walk.csv:3: expected 4 values", 0), 0u) << found;
  }
}

TEST_F(TraceFile, NamesAFileThatCannotBeRead) {
  EXPECT_EQ(error(), "walk.csv: cannot be read");
  EXPECT_THROW(read_trace(folder_), std::invalid_argument);
}

TEST_F(TraceFile, WritesNothingThatCannotBeReadBack) {
  EXPECT_THROW(write_trace(path_, {{0, 1, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(write_trace(path_, {{0, 1, 0, 0}, {0, NAN, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(write_trace(path_, {{0, 1, 7, 0}, {0, 1, 0, 0}}), std::invalid_argument);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(TraceFile, LeavesNothingBehindWhereItCannotWrite) {
  std::filesystem::create_directories(path_ / "occupied");
  EXPECT_THROW(write_trace(path_, {{0, 1, 0, 0}, {0, 1, 0, 0}}), std::invalid_argument);
  const std::filesystem::path missing = folder_ / "none" / "t.csv";
  try {
    write_trace(missing, {{0, 1, 0, 0}, {0, 1, 0, 0}});
    ADD_FAILURE() << "written";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(), "cannot write " + missing.u8string() + ": No such file or directory");
  }
  const auto entries = std::filesystem::directory_iterator(folder_);
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

// ---- Simulated players

/// What a minute or more of a trace is like.
struct Summary {
  double standing = 0, walking = 0, running = 0, forward = 0, left = 0, right = 0, jumping = 0;  // shares
  int changes = 0;
};

Summary summarize(const Trace& trace, const ControlSpace& space) {
  Summary summary;
  const double share = 1.0 / trace.size();
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const Control& control = trace[i];
    const double speed = std::hypot(control.x, control.y);
    (speed < 0.1                                ? summary.standing
     : speed < (space.walk() + space.run()) / 2 ? summary.walking
                                                : summary.running) += share;
    if (control.y > 0.1) summary.forward += share;
    if (control.turn > 0) summary.left += share;
    if (control.turn < 0) summary.right += share;
    summary.jumping += control.jump * share;
    summary.changes += i > 0 && !same(control, trace[i - 1]);
  }
  return summary;
}

class SimulatedPlayer : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, SimulatedPlayer, testing::ValuesIn(simulated_players()),
                         [](const auto& info) { return info.param; });

TEST_P(SimulatedPlayer, StaysOnThePointsOfTheSpace) {
  const ControlSpace space(1.1, 2.9);
  const Trace trace = simulate_trace(GetParam(), 60, 1, space);
  EXPECT_EQ(trace.size(), 600u);
  for (const Control& control : trace) EXPECT_TRUE(same(control, space.point(space.nearest(control))));
}

TEST_P(SimulatedPlayer, PlaysForADayAtMost) {
  const ControlSpace space;
  for (const double seconds : {86400.1, 1e6, 1e300, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(simulate_trace(GetParam(), seconds, 1, space), std::invalid_argument);
  }
}

TEST_P(SimulatedPlayer, RepeatsWithTheSeedOnly) {
  const ControlSpace space;
  const Trace one = simulate_trace(GetParam(), 30, 7, space), again = simulate_trace(GetParam(), 30, 7, space);
  const Trace other = simulate_trace(GetParam(), 30, 8, space);
  EXPECT_TRUE(std::equal(one.begin(), one.end(), again.begin(), same));
  EXPECT_FALSE(std::equal(one.begin(), one.end(), other.begin(), same));
}

TEST_P(SimulatedPlayer, HoldsControlsInsteadOfMakingNoise) {
  const ControlSpace space;
  const Summary summary = summarize(simulate_trace(GetParam(), 600, 2, space), space);
  EXPECT_LT(summary.changes, 0.45 * 6000);
  EXPECT_GT(summary.changes, 0.03 * 6000);
}

TEST_P(SimulatedPlayer, HoldsButtonsForAWhile) {
  const Trace trace = simulate_trace(GetParam(), 600, 3, ControlSpace());
  for (std::size_t begin = 0; begin < trace.size();) {
    std::size_t end = begin;
    while (end < trace.size() && trace[end].jump == trace[begin].jump) ++end;
    if (trace[begin].jump == 1 && end < trace.size()) {
      EXPECT_GE(end - begin, 3u);
    }
    begin = end;
  }
}

TEST_P(SimulatedPlayer, PushesForwardMostOfTheTimeItMoves) {
  const ControlSpace space;
  const Summary summary = summarize(simulate_trace(GetParam(), 600, 4, space), space);
  EXPECT_GT(summary.forward, 0.5 * (summary.walking + summary.running));
}

TEST(SimulateTrace, GivesEachPlayerItsHabits) {
  const ControlSpace space;
  std::map<std::string, Summary> all;
  for (const std::string& player : simulated_players())
    all[player] = summarize(simulate_trace(player, 1200, 5, space), space);
  ASSERT_EQ(all.size(), 8u);
  EXPECT_GT(all["walker"].walking, 0.6);
  EXPECT_GT(all["stroller"].standing, 0.25);
  EXPECT_LT(all["stroller"].running, 0.01);
  EXPECT_GT(all["runner"].running, 0.5);
  EXPECT_GT(all["sprinter"].running, 0.6);
  EXPECT_GT(all["circler"].left, 0.5);
  EXPECT_GT(all["circler"].left, 3 * all["circler"].right);
  for (const auto& [player, summary] : all) {
    EXPECT_LE(summary.changes, all["twitcher"].changes) << player;
    EXPECT_LE(summary.jumping, all["jumper"].jumping) << player;
  }
}

TEST(SimulateTrace, ChangesSpeedWithInertia) {
  const ControlSpace space;
  const Trace trace = simulate_trace("runner", 600, 6, space);
  int reversals = 0;
  for (std::size_t i = 1; i < trace.size(); ++i) reversals += trace[i].y * trace[i - 1].y < -5;
  EXPECT_EQ(reversals, 0);  // from running forward to running backward in a tenth of a second
}

TEST(SimulateTrace, IsTheSameOnEveryPlatform) {
  const ControlSpace space;
  std::uint64_t hash = 1469598103934665603ULL;  // FNV-1a over the points of all players
  for (const std::string& player : simulated_players()) {
    for (const Control& control : simulate_trace(player, 60, 1, space))
      hash = (hash ^ static_cast<std::uint64_t>(space.nearest(control))) * 1099511628211ULL;
  }
  EXPECT_EQ(hash, 1853347581245356913ULL);
}

TEST(SimulateTrace, RefusesUnknownPlayersAndLengths) {
  const ControlSpace space;
  try {
    simulate_trace("dancer", 60, 1, space);
    ADD_FAILURE() << "accepted";
  } catch (const std::invalid_argument& error) {
    for (const std::string& player : simulated_players())
      EXPECT_NE(std::string(error.what()).find(player), std::string::npos);
  }
  for (const double seconds : {0.0, 0.1, -5.0, 1e9, double(NAN), -double(INFINITY), double(INFINITY)})
    EXPECT_THROW(simulate_trace("walker", seconds, 1, space), std::invalid_argument) << seconds;
  EXPECT_EQ(simulate_trace("walker", 0.2, 1, space).size(), 2u);
}

TEST(Snap, FindsTheNearestPointOfEveryControl) {
  const ControlSpace space;
  const Trace trace = simulate_trace("twitcher", 5, 3, space);
  const std::vector<int> indices = snap(space, trace);
  ASSERT_EQ(indices.size(), trace.size());
  for (std::size_t i = 0; i < trace.size(); ++i) EXPECT_EQ(indices[i], space.nearest(trace[i]));
}

}  // namespace
}  // namespace fragmotion
