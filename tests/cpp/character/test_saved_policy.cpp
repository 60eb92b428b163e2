// SPDX-License-Identifier: MIT
// Policy files on a disk.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <thread>

#ifndef _WIN32
#include <sys/stat.h>
#endif

#include "mocap_files.hpp"
#include "policy_payload.hpp"

namespace fragmotion {
namespace {

TEST(PolicyFile, IsSavedAndLoaded) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.policy";
  save_policy(path, tiny_character());
  save_policy(path, from_bytes(tiny_file()));  // over the first
  EXPECT_TRUE(to_bytes(load_policy(path)) == tiny_file());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "leaves a temporary file";
}

TEST(PolicyFile, NamesThePathThatCannotBeReadOrWritten) {
  const TemporaryFolder folder;
  const auto missing = folder.path() / "no folder" / "a.policy";
  EXPECT_EQ(error_of([&] { save_policy(missing, from_bytes(tiny_file())); }),
            "cannot write " + missing.u8string() + ": No such file or directory");
  EXPECT_NE(error_of([&] { save_policy(folder.path(), from_bytes(tiny_file())); }).find("directory"),
            std::string::npos);
  EXPECT_NE(error_of([&] { load_policy(missing); }).find("a.policy"), std::string::npos);
  EXPECT_NE(error_of([&] { load_policy(folder.path()); }), "no error");
  EXPECT_NE(error_of([&] { load_policy(folder.write("empty.policy", "")); }).find("empty.policy"), std::string::npos);
}

#ifndef _WIN32

mode_t mode_of(const std::filesystem::path& path) {
  struct stat status {};
  EXPECT_EQ(stat(path.c_str(), &status), 0);
  return status.st_mode & 07777;
}

TEST(PolicyFile, KeepsThePermissionsOfTheFileThatItReplaces) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.policy";
  const mode_t mask = umask(0);
  umask(027);
  save_policy(path, tiny_character());
  EXPECT_EQ(mode_of(path), 0640U);
  chmod(path.c_str(), 0604);
  save_policy(path, tiny_character());
  EXPECT_EQ(mode_of(path), 0604U);
  umask(mask);
}

TEST(PolicyFile, NeverWritesThroughASymbolicLink) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.policy", target = folder.write("precious", "text");
  for (const auto& to : {target, folder.path() / "missing"}) {
    std::filesystem::remove(path);
    std::filesystem::create_symlink(to, path);
    EXPECT_NE(error_of([&] { save_policy(path, tiny_character()); }).find("symbolic link"), std::string::npos);
    EXPECT_TRUE(std::filesystem::is_symlink(path));
  }
  EXPECT_EQ(std::filesystem::file_size(target), 4U);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "missing"));
  const auto real = folder.path() / "real.policy";
  save_policy(real, tiny_character());
  std::filesystem::remove(path);
  std::filesystem::create_symlink(real, path);
  EXPECT_TRUE(to_bytes(load_policy(path)) == tiny_file()) << "a link is read";
}

TEST(PolicyFile, NeitherReadsNorReplacesWhatIsNoRegularFile) {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe.policy";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::filesystem::path& path : {pipe, std::filesystem::path("/dev/zero")}) {
    EXPECT_NE(error_of([&] { load_policy(path); }).find("no regular file"), std::string::npos) << path;
    EXPECT_NE(error_of([&] { save_policy(path, tiny_character()); }).find("no regular file"), std::string::npos)
        << path;
  }
}

#endif

TEST(PolicyFile, IsWholeWhoeverWritesAtTheSameTime) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.policy";
  const Character small = tiny_character(), large = tiny_character({tiny_clip(0), tiny_clip(1.5), tiny_clip(2)});
  const std::string sizes[] = {to_bytes(small), to_bytes(large)};
  save_policy(path, small);
  std::atomic<int> writing{2}, failed{0};
  const auto write = [&](const Character& character) {
    for (int n = 0; n < 150; ++n) failed += error_of([&] { save_policy(path, character); }) == "no error" ? 0 : 1;
    --writing;
  };
  std::thread one(write, std::cref(small)), other(write, std::cref(large));
  int torn = 0, reads = 0;
  for (; writing > 0 || reads < 100; ++reads) {
    std::string bytes;
    const std::string error = error_of([&] { bytes = to_bytes(load_policy(path)); });
    torn += error == "no error" && (bytes == sizes[0] || bytes == sizes[1]) ? 0 : 1;
  }
  one.join();
  other.join();
  EXPECT_EQ(torn, 0) << "of " << reads;
  EXPECT_EQ(failed, 0);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "leaves a temporary file";
}

}  // namespace
}  // namespace fragmotion
