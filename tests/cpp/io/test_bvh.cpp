// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>

#include "io/bvh.hpp"
#include "mocap_files.hpp"

namespace fragmotion {
namespace {

constexpr double kBvhTolerance = 1e-12;

/// An arm of two joints and a leg; the tests below break it line by line.
const char* const kSmall =
    "HIERARCHY\n"                                                                 // 1
    "ROOT Hips\n"                                                                 // 2
    "{\n"                                                                         // 3
    "  OFFSET 0 0 0\n"                                                            // 4
    "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"  // 5
    "  JOINT Arm\n"                                                               // 6
    "  {\n"                                                                       // 7
    "    OFFSET 10 20 30\n"                                                       // 8
    "    CHANNELS 3 Zrotation Xrotation Yrotation\n"                              // 9
    "    End Site\n"                                                              // 10
    "    {\n"                                                                     // 11
    "      OFFSET 0 5 0\n"                                                        // 12
    "    }\n"                                                                     // 13
    "  }\n"                                                                       // 14
    "}\n"                                                                         // 15
    "MOTION\n"                                                                    // 16
    "Frames: 2\n"                                                                 // 17
    "Frame Time: 0.0333333\n"                                                     // 18
    "100 200 300 90 0 0 0 0 0\n"                                                  // 19
    "0 0 0 90 90 0 0 0 90\n";                                                     // 20

Take read_text(const std::string& text, double unit = 0.01) {
  const TemporaryFolder folder;
  return read_bvh(folder.write("small.bvh", text), unit);
}

Vector3 world_position(const Take& take, int frame, const std::string& bone) {
  std::vector<double> positions, rotations;
  world_transforms(take, positions, rotations);
  return load_vector(
      &positions[(static_cast<std::size_t>(frame) * take.skeleton.size() + take.skeleton.find(bone)) * 3]);
}

Vector3 turned(const Take& take, int frame, const std::string& bone, const Vector3& v) {
  const std::size_t at = static_cast<std::size_t>(frame) * take.skeleton.size() + take.skeleton.find(bone);
  return load_quaternion(&take.rotations[at * 4]) * v;
}

void expect_near(const Vector3& actual, const Vector3& expected) {
  EXPECT_LT((actual - expected).norm(), kBvhTolerance)
      << "actual " << actual.transpose() << ", expected " << expected.transpose();
}

TEST(Bvh, TurnsTheYUpWorldUpright) {
  const Take take = read_text(kSmall);
  EXPECT_EQ(take.name, "small");
  EXPECT_EQ(take.frames, 2);
  EXPECT_EQ(take.skeleton.names, (std::vector<std::string>{"Hips", "Arm"}));
  expect_near(take.skeleton.offsets[1], {0.1, -0.3, 0.2});
  expect_near(take.skeleton.tips[0], {0.1, -0.3, 0.2});
  expect_near(take.skeleton.tips[1], {0, 0, 0.05});
  EXPECT_EQ(take.skeleton.rest_rotations[1].w(), 1);
}

TEST(Bvh, PlacesJointsAsComputedByHand) {
  const Take take = read_text(kSmall);
  expect_near(world_position(take, 0, "Hips"), {1, -3, 2});
  // 90 degrees about the file's z takes (10, 20, 30) to (-20, 10, 30), in the z-up world (-20, -30, 10).
  expect_near(world_position(take, 0, "Arm"), {0.8, -3.3, 2.1});
  // Rz(90) Rx(90): (10, 20, 30) -> (10, -30, 20) -> (30, 10, 20).
  expect_near(world_position(take, 1, "Arm"), {0.3, -0.2, 0.1});
}

TEST(Bvh, AppliesChannelsInTheOrderListed) {
  const Take first_z = read_text(kSmall);
  const Take first_x = read_text(replaced(kSmall, "Zposition Zrotation Xrotation", "Zposition Xrotation Zrotation"));
  // The file's y axis: Rz(90) Rx(90) y = Rz(90) z = z, and Rx(90) Rz(90) y = Rx(90) (-x) = -x.
  expect_near(turned(first_z, 1, "Hips", {0, 0, 1}), {0, -1, 0});
  expect_near(turned(first_x, 1, "Hips", {0, 0, 1}), {-1, 0, 0});
}

TEST(Bvh, PositionChannelsReplaceTheOffset) {
  const std::string text = replaced(kSmall, "3 Zrotation Xrotation Yrotation", "3 Yposition Xrotation Yrotation");
  const Take take = read_text(replaced(text, "0 0 0 90 90 0 0 0 90", "0 0 0 0 0 0 7 0 90"));
  // Only the channels given: x and z stay those of the OFFSET.
  expect_near(load_vector(&take.translations[(2 + 1) * 3]), {0.1, -0.3, 0.07});
  expect_near(take.skeleton.offsets[1], {0.1, -0.3, 0.2});
}

TEST(Bvh, UnitIsTheLengthOfAFileUnit) { expect_near(read_text(kSmall, 1).skeleton.offsets[1], {10, -30, 20}); }

TEST(Bvh, RejectsAUnitThatIsNoLength) {
  for (const double unit : {0.0, -1.0, 1e308, 1e-308, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_NE(error_of([&] { read_text(kSmall, unit); }), "no error") << unit;
  }
}

TEST(Bvh, TipOfAnEndWithoutLengthGoesOnFromTheParent) {
  const Take take = read_text(replaced(kSmall, "OFFSET 0 5 0", "OFFSET 0 0 0"));
  expect_near(take.skeleton.tips[1], 0.3 * take.skeleton.offsets[1]);
}

TEST(Bvh, TipIsTheMeanOfTheChildren) {
  const std::string leg = "  JOINT Leg\n{ OFFSET 0 -40 0\nCHANNELS 0\n}\n}\nMOTION";
  const Take take = read_text(replaced(kSmall, "}\nMOTION", leg));
  expect_near(take.skeleton.tips[0], {0.05, -0.15, -0.1});
  expect_near(take.skeleton.tips[2], {0, 0, -0.12});
}

TEST(Bvh, ReadsWindowsLinesByteOrderMarksAndNamesWithBlanks) {
  std::string text = replaced(kSmall, "JOINT Arm\n  {", "JOINT Bip01 L Arm {");
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  const Take take = read_text("\xEF\xBB\xBF" + text);
  EXPECT_EQ(take.skeleton.names[1], "Bip01 L Arm");
  EXPECT_EQ(take.frames, 2);
}

std::string as_utf16(const std::string& ascii, bool high_first) {
  std::string bytes;
  for (const char letter : ascii) bytes += high_first ? std::string{'\0', letter} : std::string{letter, '\0'};
  return bytes;
}

TEST(Bvh, ReadsUtf16WithAndWithoutAnOrderMark) {
  const Take plain = read_text(kSmall);
  for (const bool high_first : {true, false}) {
    const std::string text = as_utf16(kSmall, high_first);
    for (const std::string& mark : {std::string(), std::string(high_first ? "\xFE\xFF" : "\xFF\xFE")}) {
      const Take take = read_text(mark + text);
      EXPECT_EQ(take.skeleton.names, plain.skeleton.names);
      EXPECT_EQ(take.translations, plain.translations);
    }
  }
}

TEST(Bvh, ReadsDecimalsAfterAComma) {
  const Take plain = read_text(replaced(kSmall, "100 200", "100.5 200"));
  const Take take = read_text(replaced(replaced(kSmall, "100 200", "100,5 200"), "0.0333333", "0,0333333"));
  EXPECT_EQ(take.translations, plain.translations);
  EXPECT_EQ(take.rate, plain.rate);
}

TEST(Bvh, ReadsLinesThatEndAsOnOldMacs) {
  std::string text = kSmall;
  std::replace(text.begin(), text.end(), '\n', '\r');
  EXPECT_EQ(read_text(text).translations, read_text(kSmall).translations);
}

TEST(Bvh, TellsThatAFileWasCutOff) {
  const std::string small = kSmall;
  EXPECT_EQ(error_of([&] { read_text(small.substr(0, small.rfind(" 0 0 0 90"))); }),
            "small.bvh:20: frame 2 holds 5 values, 9 expected: the file was cut off in it");
  EXPECT_EQ(error_of([&] { read_text(replaced(small, "Frames: 2", "Frames: 3")); }),
            "small.bvh:20: the file ends after 2 frames, 3 expected: it was cut off, or 'Frames:' tells too many");
}

TEST(Bvh, NamesAnArchive) {
  EXPECT_EQ(error_of([] { read_text("\x1F\x8B\x08zipped"); }),
            "small.bvh: no text but a gzip archive: unpack it, and take what is inside");
}

TEST(Bvh, SnapsTheRateToTheOneMeant) {
  const std::pair<const char*, double> rates[] = {
      {"0.0333333", 30}, {".0083333", 120},        {"0.008333", 120},         {"0.04", 25},         {"0.0416667", 24},
      {"0.016667", 60},  {"0.033367", 30 / 1.001}, {"0.0417083", 24 / 1.001}, {"0.011", 1 / 0.011}, {"0.01", 100}};
  for (const auto& [frame_time, rate] : rates) {
    EXPECT_DOUBLE_EQ(read_text(replaced(kSmall, "0.0333333", frame_time)).rate, rate) << frame_time;
  }
}

struct BrokenBvh {
  const char* what;
  std::string text;
  const char* error;
};

std::vector<BrokenBvh> broken_hierarchies() {
  const std::string small = kSmall;
  return {
      {"empty file", "", "1: 'HIERARCHY' expected, found the end of the file"},
      {"another format", "Kaydara FBX", "1: 'HIERARCHY' expected, found 'Kaydara'"},
      {"truncated in a joint", small.substr(0, small.find("    End")), "9: the file ends inside joint 'Arm'"},
      {"truncated in a number", small.substr(0, small.find(" 20 30")),
       "8: a number of the OFFSET expected, found the end"},
      {"brace missing", replaced(small, "  }\n}\n", "  }\n"), "15: OFFSET, CHANNELS, JOINT, End Site or '}' expected"},
      {"brace too many", replaced(small, "}\nMOTION", "}\n}\nMOTION"), "16: 'MOTION' expected, found '}'"},
      {"no motion", small.substr(0, small.find("MOTION")), "15: 'MOTION' expected, found the end of the file"},
      {"no name", replaced(small, "ROOT Hips", "ROOT"), "2: a joint's name expected"},
      {"more names than channels", replaced(small, "CHANNELS 6", "CHANNELS 5"),
       "5: joint 'Hips' announces 5 channels and names 6"},
      {"fewer names than channels", replaced(small, "3 Zrotation", "3"),
       "9: joint 'Arm' announces 3 channels and names 2"},
      {"huge channel count", replaced(small, "CHANNELS 6", "CHANNELS 99999999999"),
       "5: a number of channels from 0 to 6"},
      {"no channel count", replaced(small, "CHANNELS 6", "CHANNELS"), "5: a number of channels from 0 to 6"},
      {"channels twice", replaced(small, "OFFSET 10 20 30", "CHANNELS 0"), "9: joint 'Arm' has CHANNELS twice"},
      {"unknown channel", replaced(small, "Xposition", "Wposition"), "5: unknown channel 'Wposition'"},
      {"no channels", replaced(small, "    CHANNELS 3 Zrotation Xrotation Yrotation\n", ""),
       "13: joint 'Arm' has no CHANNELS"},
      {"no offset", replaced(small, "    OFFSET 10 20 30\n", ""), "13: joint 'Arm' has no OFFSET"},
      {"offset of two numbers", replaced(small, "10 20 30", "10 20"),
       "8: a number of the OFFSET expected, found the end of the line"},
      {"offset of four numbers", replaced(small, "10 20 30", "10 20 30 40"),
       "8: OFFSET, CHANNELS, JOINT, End Site or '}' expected, found '40'"},
      {"offset beyond all", replaced(small, "10 20 30", "10 -1e300 30"),
       "8: a number of the OFFSET from -1e12 to 1e12 expected, found '-1e300'"},
      {"offset that is no number", replaced(small, "10 20 30", "10 2O 30"),
       "8: a number of the OFFSET expected, found '2O'"},
      {"two roots", replaced(small, "MOTION", "ROOT Other"), "16: more than one ROOT"},
      {"duplicate joint", replaced(small, "JOINT Arm", "JOINT Hips"), "6: joint 'Hips' appears twice"},
  };
}

std::vector<BrokenBvh> broken_frames() {
  const std::string small = kSmall;
  return {
      {"too few values", replaced(small, "90 90 0 0 0 90", "90 90"), "20: frame 2 holds 5 values, 9 expected"},
      {"too many values", replaced(small, "300 90", "300 1 90"), "19: frame 1 holds more values, 9 expected"},
      {"not a number", replaced(small, "100 200", "100 nan"), "19: a number expected, found 'nan'"},
      {"infinite", replaced(small, "100 200", "-inf 200"), "19: a number expected, found '-inf'"},
      {"beyond a double", replaced(small, "100 200", "1e999 200"), "19: a number expected, found '1e999'"},
      {"farther than anything", replaced(small, "100 200", "100 1e13"),
       "19: a number from -1e12 to 1e12 expected, found '1e13'"},
      {"a word", replaced(small, "100 200", "100 two"), "19: a number expected, found 'two'"},
      {"a list", replaced(small, "100 200", "100,5,200"), "19: a number expected, found '100,5,200'"},
      {"a comma and a point", replaced(small, "100 200", "1,000.5 200"), "19: a number expected, found '1,000.5'"},
      {"fewer frames", replaced(small, "Frames: 2", "Frames: 3"), "20: the file ends after 2 frames, 3 expected"},
      {"far fewer frames", replaced(small, "Frames: 2", "Frames: 999999999999"),
       "20: the file ends after 2 frames, 999999999999 expected"},
      {"frame count beyond integers", replaced(small, "Frames: 2", "Frames: 99999999999999999999"),
       "17: a number of frames from 1 on"},
      {"more frames", replaced(small, "Frames: 2", "Frames: 1"), "20: more frames than the 1 expected"},
      {"no frames", replaced(small, "Frames: 2", "Frames: 0"), "17: a number of frames from 1 on expected, found '0'"},
      {"negative frames", replaced(small, "Frames: 2", "Frames: -2"), "17: a number of frames from 1 on"},
      {"no frame count", replaced(small, "Frames: 2", "Frames:"), "17: a number of frames from 1 on"},
      {"frame time 0", replaced(small, "0.0333333", "0"), "18: a frame time above 0 expected"},
      {"frame time below 0", replaced(small, "0.0333333", "-0.03"), "18: a frame time above 0 expected"},
      {"frame time NaN", replaced(small, "0.0333333", "NaN"), "18: a frame time in seconds expected, found 'NaN'"},
      {"frame time without a rate", replaced(small, "0.0333333", "1e-320"), "18: a frame time from 0.0001 to 1000"},
      {"faster than any camera", replaced(small, "0.0333333", "0.00009"), "18: a frame time from 0.0001 to 1000"},
      {"a frame of an hour", replaced(small, "0.0333333", "3600"), "18: a frame time from 0.0001 to 1000"},
      {"no frame time", replaced(small, "Frame Time: 0.0333333\n", ""), "18: 'Frame' expected, found '100'"},
  };
}

void expect_errors(const std::vector<BrokenBvh>& cases) {
  for (const BrokenBvh& broken : cases) {
    const std::string error = error_of([&] { read_text(broken.text); });
    EXPECT_EQ(error.find(std::string("small.bvh:") + broken.error), 0u) << broken.what << ": " << error;
  }
}

TEST(Bvh, NamesFileLineAndCauseOfABrokenHierarchy) { expect_errors(broken_hierarchies()); }

TEST(Bvh, NamesFileLineAndCauseOfABrokenMotion) { expect_errors(broken_frames()); }

TEST(Bvh, NamesAFileThatCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_of([&] { read_bvh(folder.path() / "none.bvh"); }), "none.bvh: cannot be read");
  std::filesystem::create_directory(folder.path() / "folder.bvh");
  EXPECT_EQ(error_of([&] { read_bvh(folder.path() / "folder.bvh"); }),
            "folder.bvh: cannot be read, as it is no regular file");
  EXPECT_EQ(error_of([] { read_bvh("/dev/zero"); }), "zero: cannot be read, as it is no regular file");
}

TEST(Bvh, EveryTruncationIsAnErrorAndNoCrash) {
  const std::string small = kSmall;
  const std::size_t last_number = small.rfind("90");
  for (std::size_t length = 0; length <= last_number; ++length) {
    EXPECT_NE(error_of([&] { read_text(small.substr(0, length)); }), "no error") << length;
  }
}

/// A chain of joints, of which the first has one channel and the others have `channels`.
std::string chain_text(int joints, const std::string& channels, const std::string& motion) {
  std::string text = "HIERARCHY\n", ends;
  for (int i = 0; i < joints; ++i) {
    text += (i == 0 ? "ROOT j" : "JOINT j") + std::to_string(i) + " {\nOFFSET 0 1 0\nCHANNELS ";
    text += (i == 0 ? "1 Xrotation" : channels) + "\n";
    ends += "}\n";
  }
  return text + ends + "MOTION\n" + motion;
}

TEST(Bvh, ReadsDeepHierarchiesUpToALimitWithoutRecursion) {
  std::string motion = "Frames: 1\nFrame Time: 0.01\n";
  for (int i = 0; i < 4096; ++i) motion += "0 ";
  EXPECT_EQ(read_text(chain_text(4096, "1 Xrotation", motion)).skeleton.size(), 4096);
  EXPECT_EQ(error_of([&] { read_text(chain_text(4097, "1 Xrotation", motion)); }),
            "small.bvh:" + std::to_string(2 + 3 * 4096) + ": more than 4096 bones");
}

TEST(Bvh, TakesMemoryInProportionToTheFile) {
  for (const int joints : {1, 100, 1000, 4000}) {
    for (const int frames : {1, 100, 500, 10000, 60000}) {
      std::string motion = "Frames: " + std::to_string(frames) + "\nFrame Time: 0.01\n";
      for (int f = 0; f < frames; ++f) motion += "0\n";
      const std::string text = chain_text(joints, "0", motion);
      const double poses = 1.0 * joints * frames;
      if (poses <= 500000) {
        const Take take = read_text(text);
        EXPECT_EQ(take.frames, frames);
        EXPECT_LE(8 * (take.translations.capacity() + take.rotations.capacity()), 50000000 + 20 * text.size());
      } else {
        const std::string error = error_of([&] { read_text(text); });
        EXPECT_NE(error.find(std::to_string(frames) + " frames of " + std::to_string(joints) + " bones in a file of " +
                             std::to_string(text.size()) + " bytes, which may hold at most"),
                  std::string::npos)
            << error;
      }
    }
  }
}

TEST(Bvh, ReadsNamesUpToALimit) {
  EXPECT_EQ(read_text(replaced(kSmall, "Arm", std::string(255, 'a'))).skeleton.names[1].size(), 255u);
  EXPECT_EQ(error_of([] { read_text(replaced(kSmall, "Arm", std::string(200000, 'a'))); }),
            "small.bvh:6: name '" + std::string(40, 'a') + "'... has 200000 bytes, at most 255 are allowed");
}

TEST(Bvh, RefusesAFileLargerThanAnyTake) {
  const TemporaryFolder folder;
  const auto path = folder.write("large.bvh", kSmall);
  std::filesystem::resize_file(path, 2000000001);
  EXPECT_EQ(error_of([&] { read_bvh(path); }), "large.bvh: cannot be read, as it is larger than 2 GB");
}

TEST(Bvh, ReadsAllTakesOfBandaiNamco) {
  const auto files = files_in(shared_mocap() / "bandai-namco", ".bvh");
  if (files.empty()) GTEST_SKIP() << "no motion capture beside the project";
  const auto start = std::chrono::steady_clock::now();
  std::vector<Take> takes;
  for (const auto& file : files) takes.push_back(read_bvh(file));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  int frames = 0;
  double lowest = 10, highest = 0;
  for (const Take& take : takes) {
    frames += take.frames;
    lowest = std::min(lowest, stature(take.skeleton));
    highest = std::max(highest, stature(take.skeleton));
    EXPECT_EQ(take.rate, 30) << take.name;
    EXPECT_EQ(take.skeleton.size(), 22) << take.name;
  }
  std::cout << takes.size() << " takes, " << frames << " frames, " << seconds.count() << " s; stature " << lowest
            << " to " << highest << " m\n";
  RecordProperty("seconds", std::to_string(seconds.count()));
  EXPECT_EQ(takes.size(), 159u);
  EXPECT_GT(lowest, 1.4);
  EXPECT_LT(highest, 2.0);
}

TEST(Bvh, BandaiNamcoStandsUprightOnTheGround) {
  const auto files = files_in(shared_mocap() / "bandai-namco", ".bvh");
  if (files.empty()) GTEST_SKIP() << "no motion capture beside the project";
  for (const auto& file : files) {
    const Take take = read_bvh(file);
    for (const int frame : {0, take.frames / 2, take.frames - 1}) {
      const double head = world_position(take, frame, "Head").z();
      const double hips = world_position(take, frame, "Hips").z();
      const double toes =
          std::min(world_position(take, frame, "Toes_L").z(), world_position(take, frame, "Toes_R").z());
      EXPECT_GT(head, hips + 0.3) << take.name << " frame " << frame;
      EXPECT_GT(hips, 0.5) << take.name << " frame " << frame;
      EXPECT_NEAR(toes, 0.05, 0.2) << take.name << " frame " << frame;
    }
  }
}

}  // namespace
}  // namespace fragmotion
