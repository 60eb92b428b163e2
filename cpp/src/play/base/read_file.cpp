// SPDX-License-Identifier: MIT
#include "base/read_file.hpp"

#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace fragmotion {
namespace {

constexpr std::streamoff kLargestFile = 2000000000;  // bytes: some ten hours of 60 joints at 60 frames a second

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& cause) {
    throw std::invalid_argument(path.filename().u8string() + ": cannot be read" + cause);
  };
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (exists(status) && !is_regular_file(status)) fail(", as it is no regular file");
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream.is_open() ? static_cast<std::streamoff>(stream.tellg()) : -1;
  if (size < 0) fail("");
  if (size > kLargestFile) fail(", as it is larger than " + std::to_string(kLargestFile / 1000000000) + " GB");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.seekg(0);
  stream.read(bytes.data(), size);
  if (stream.gcount() != size) fail("");
  return bytes;
}

}  // namespace fragmotion
