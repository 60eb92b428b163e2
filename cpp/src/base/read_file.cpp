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
  const std::string file = path.filename().u8string();
  std::error_code error;
  std::ifstream stream;
  if (std::filesystem::is_regular_file(path, error)) stream.open(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream.is_open() ? static_cast<std::streamoff>(stream.tellg()) : -1;
  if (size < 0) throw std::invalid_argument(file + ": cannot be read");
  if (size > kLargestFile) {
    throw std::invalid_argument(file + ": is larger than " + std::to_string(kLargestFile / 1000000000) +
                                " GB, which no take is: cannot be read");
  }
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.seekg(0);
  stream.read(bytes.data(), size);
  if (stream.gcount() != size) throw std::invalid_argument(file + ": cannot be read");
  return bytes;
}

}  // namespace fragmotion
