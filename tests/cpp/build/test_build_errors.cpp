// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "build/build.hpp"
#include "mocap_files.hpp"
#include "small_build.hpp"
#include "small_character.hpp"
#include "small_skeleton.hpp"

namespace fragmotion {
namespace {

TEST(Build, RefusesWhatItCannotBuildFrom) {
  const std::vector<Clip> takes = some_takes();
  const auto error = [&](const std::vector<Clip>& clips, const std::vector<Trace>& traces,
                         const BuildOptions& options) {
    return error_of([&] { build(humanoid(), clips, traces, options); });
  };
  const auto expect = [](const std::string& error, const std::string& part) {
    EXPECT_NE(error.find(part), std::string::npos) << error;
  };
  expect(error({}, some_traces(), few_classes()), "no takes");
  expect(error(takes, {}, few_classes()), "no trace");
  expect(error(takes, {{}}, few_classes()), "two controls");
  expect(error(takes, {Trace(1)}, few_classes()), "two controls");
  expect(error(takes, some_traces(), few_classes("wise")), "\"wise\"");
  BuildOptions options = few_classes();
  options.classes = 0;
  expect(error(takes, some_traces(), options), "classes");
  options = few_classes();
  options.cut.shortest = 2;
  expect(error(takes, some_traces(), options), "\"stand\"");
  Gait blink;
  blink.seconds = 0.05;
  expect(error({gait_clip(blink)}, some_traces(), few_classes()), "too short");
}

TEST(Build, RefusesClipsOfAnotherSkeletonNamingThem) {
  const Skeleton other = small_skeleton();
  Clip stranger = make_clip(other, random_clip(other, 60, 1));
  stranger.name = "stranger";
  std::vector<Clip> clips = some_takes();
  clips.push_back(stranger);
  const std::string error = error_of([&] { build(humanoid(), clips, some_traces(), few_classes()); });
  EXPECT_NE(error.find("stranger"), std::string::npos) << error;
}

TEST(Build, RefusesClipsThatAreNotFiniteNamingThem) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (auto values : {&Clip::root_positions, &Clip::rotations, &Clip::headings}) {
      std::vector<Clip> clips = some_takes();
      (clips[1].*values)[5] = bad;
      clips[1].name = "broken";
      const std::string error = error_of([&] { build(humanoid(), clips, some_traces(), few_classes()); });
      EXPECT_NE(error.find("'broken'"), std::string::npos) << error;
    }
  }
}

TEST(Build, RefusesOptionsOutOfTheirRangesBeforeItBegins) {
  const auto error = [](const std::function<void(BuildOptions&)>& spoil) {
    BuildOptions options = few_classes();
    spoil(options);
    const Progress none = [](double, const std::string& stage) {
      ADD_FAILURE() << stage;
      return false;
    };
    return error_of([&] { build(humanoid(), some_takes(), some_traces(), options, none); });
  };
  for (const double bad : {-0.1, 0.0, 0.01, 11.0, 1e8, 1e308, std::nan(""), double(INFINITY), -double(INFINITY)}) {
    EXPECT_NE(error([=](BuildOptions& o) { o.cut.shortest = bad; }).find("shortest fragment"), std::string::npos)
        << bad;
    EXPECT_NE(error([=](BuildOptions& o) { o.cut.longest = bad; }).find("longest fragment"), std::string::npos) << bad;
  }
  for (const int bad : {-1, 0, 10001, 0x7fffffff}) {
    EXPECT_NE(error([=](BuildOptions& o) { o.classes = bad; }).find("classes must be 1 to 10000"), std::string::npos);
  }
  EXPECT_NE(error([](BuildOptions& o) { o.restarts = 10001; }).find("restarts must be"), std::string::npos);
}

TEST(Build, RefusesWhatCouldNotBeSavedNamingTheClipAndTheLimit) {
  const auto error = [](const std::function<void(Clip&)>& spoil) {
    std::vector<Clip> takes = some_takes();
    takes[1].name = "far";
    spoil(takes[1]);
    return error_of([&] { build(humanoid(), takes, some_traces(), few_classes()); });
  };
  const std::string fast = error([](Clip& c) { c.rate = 1e9; });
  EXPECT_NE(fast.find("'far'"), std::string::npos) << fast;
  EXPECT_NE(fast.find("to 10000"), std::string::npos) << fast;
  const std::string far = error([](Clip& c) { c.root_positions[30] = 1e12; });
  EXPECT_NE(far.find("'far'"), std::string::npos) << far;
  EXPECT_NE(far.find("1000 km"), std::string::npos) << far;
  Skeleton flat = humanoid(1e-5);
  EXPECT_NE(error_of([&] { build(flat, some_takes(), some_traces(), few_classes()); }).find("1 mm"), std::string::npos);
}

TEST(Build, RefusesTracesThatAreNotFiniteNamingTheControl) {
  Trace trace(5);
  trace[3].turn = std::numeric_limits<double>::quiet_NaN();
  const std::string error = error_of([&] { build(humanoid(), some_takes(), {Trace(5), trace}, few_classes()); });
  EXPECT_NE(error.find("control 3 of trace 1"), std::string::npos) << error;
}

}  // namespace
}  // namespace fragmotion
