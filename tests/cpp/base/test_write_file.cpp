// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "base/write_file.hpp"

#ifndef _WIN32
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#endif

namespace fragmotion {
namespace {

namespace fs = std::filesystem;

// An empty folder of the running test's.
fs::path fresh_folder() {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::path folder = fs::path(testing::TempDir()) / ("fragmotion_write_file_" + test);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

void put(const fs::path& path) { std::ofstream(path, std::ios::binary) << "half a file"; }

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& file : fs::directory_iterator(folder)) names.insert(file.path().filename().u8string());
  return names;
}

using Names = std::set<std::string>;

TEST(WriteFile, RemovesWhatAKilledWriterLeft) {
  const fs::path folder = fresh_folder();
  put(folder / ".fragmotion-0123456789abcdef.part");
  write_file(folder / "a", "bytes");
  EXPECT_EQ(names_in(folder), Names{"a"});
}

TEST(WriteFile, LeavesFilesOfOtherNamesAndFolders) {
  const fs::path folder = fresh_folder();
  const Names others{".fragmotion-.part", ".fragmotion-0123456789abcdeX.part", ".fragmotion-0123456789abcdef",
                     "0123456789abcdef.part", ".fragmotion-0123456789abcdef0.part"};
  for (const std::string& name : others) put(folder / name);
  fs::create_directory(folder / ".fragmotion-00000000000000aa.part");
  write_file(folder / "a", "bytes");
  Names expected = others;
  expected.insert({"a", ".fragmotion-00000000000000aa.part"});
  EXPECT_EQ(names_in(folder), expected);
}

#ifndef _WIN32

TEST(WriteFile, LeavesWhatAnotherIsWriting) {
  const fs::path folder = fresh_folder(), written = folder / ".fragmotion-0123456789abcdef.part";
  put(written);
  const int file = open(written.c_str(), O_WRONLY | O_CLOEXEC);
  ASSERT_EQ(flock(file, LOCK_EX | LOCK_NB), 0);
  write_file(folder / "a", "bytes");
  EXPECT_TRUE(fs::exists(written));
  close(file);
  write_file(folder / "a", "bytes");
  EXPECT_FALSE(fs::exists(written));
}

TEST(WriteFile, FollowsNoLinkToWhatItRemoves) {
  const fs::path folder = fresh_folder(), link = folder / ".fragmotion-0123456789abcdef.part";
  put(folder / "kept");
  fs::create_symlink("kept", link);
  write_file(folder / "a", "bytes");
  EXPECT_EQ(names_in(folder), (Names{"a", "kept", link.filename().u8string()}));
}

#endif

}  // namespace
}  // namespace fragmotion
