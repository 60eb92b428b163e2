// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace fragmotion {

/// The motion capture that lies beside the project and is no part of it (README.md); tests skip where it is missing.
inline std::filesystem::path shared_mocap() {
#ifdef FRAGMOTION_SHARED_MOCAP
  return FRAGMOTION_SHARED_MOCAP;
#else
  return std::filesystem::path(__FILE__).parent_path() / ".." / ".." / ".." / "shared" / "mocap";
#endif
}

inline std::vector<std::filesystem::path> files_in(const std::filesystem::path& directory, const std::string& ending) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(directory)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() == ending) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// A folder of its own for each test, removed with what it holds.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(testing::TempDir()) /
            (std::string("fragmotion_") + test->test_suite_name() + "_" + test->name());
    std::filesystem::create_directories(path_);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The text of the std::invalid_argument that `read` throws, or "no error".
template <typename Read>
std::string error_of(const Read& read) {
  try {
    read();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the test's text does not hold '" + from + "'");
  return text.replace(at, from.size(), to);
}

}  // namespace fragmotion
