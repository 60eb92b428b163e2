// SPDX-License-Identifier: MIT
#include "base/write_file.hpp"

#include <cerrno>
#include <random>
#include <stdexcept>
#include <system_error>

#ifdef _WIN32
#include <fstream>
#else
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace fragmotion {
namespace {

std::error_code system_error() {
  return errno != 0 ? std::error_code(errno, std::generic_category()) : std::make_error_code(std::errc::io_error);
}

#ifdef _WIN32

struct NewFile {};

std::error_code write_new(const std::filesystem::path& path, const std::string& bytes,
                          const std::filesystem::file_status& /*old*/, NewFile& /*held*/) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  return file ? std::error_code() : system_error();
}

void settle_folder(const std::filesystem::path& /*folder*/) {}

// Fails where a process has it open.
void remove_unheld(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::symlink_status(path, ignored).type() != std::filesystem::file_type::regular) return;
  std::filesystem::remove(path, ignored);
}

#else

// Open and locked, so that no other process takes it for one that was left over.
struct NewFile {
  int file;

  explicit NewFile(int opened = -1) : file(opened) {}
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile() {
    if (file >= 0) close(file);
  }
};

std::error_code write_all(int file, const std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t written = write(file, bytes.data() + at, bytes.size() - at);
    if (written < 0 && errno != EINTR) return system_error();
    if (written > 0) at += static_cast<std::size_t>(written);
  }
  return fsync(file) == 0 ? std::error_code() : system_error();
}

// Writes a file that must not be there yet, onto the disk, for nobody else to read than the old one was. A file system
// that knows no locks keeps what is left over.
std::error_code write_new(const std::filesystem::path& path, const std::string& bytes,
                          const std::filesystem::file_status& old, NewFile& held) {
  const bool replaces = old.type() == std::filesystem::file_type::regular;
  held.file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, replaces ? 0600 : 0666);
  if (held.file < 0) return system_error();
  flock(held.file, LOCK_EX);
  const auto mode = static_cast<mode_t>(old.permissions() & std::filesystem::perms::all);
  return replaces && fchmod(held.file, mode) != 0 ? system_error() : write_all(held.file, bytes);
}

// An empty one may be another's that is not locked yet.
void remove_unheld(const std::filesystem::path& path) {
  const NewFile held(open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (held.file < 0 || flock(held.file, LOCK_EX | LOCK_NB) != 0 || fstat(held.file, &status) != 0) return;
  if (S_ISREG(status.st_mode) && status.st_size > 0) unlink(path.c_str());
}

// Brings the names in a folder onto the disk. Not every file system can; the file is whole all the same.
void settle_folder(const std::filesystem::path& folder) {
  const int opened = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return;
  fsync(opened);
  close(opened);
}

#endif

// What stands where the file is to be and is not to be replaced, or nullptr.
const char* in_the_way(std::filesystem::file_type type) {
  switch (type) {
    case std::filesystem::file_type::none:
    case std::filesystem::file_type::not_found:
    case std::filesystem::file_type::regular:
      return nullptr;
    case std::filesystem::file_type::symlink:
      return "it is a symbolic link: name the file that it leads to";
    case std::filesystem::file_type::directory:
      return "it is a directory";
    default:
      return "it is no regular file";
  }
}

constexpr char kBegin[] = ".fragmotion-", kDigits[] = "0123456789abcdef", kEnd[] = ".part";
constexpr std::size_t kRandomDigits = 16;

std::filesystem::path new_name() {
  std::random_device random;
  std::string name = kBegin;
  for (std::size_t i = 0; i < kRandomDigits; ++i) name += kDigits[random() % 16];
  return name + kEnd;
}

bool is_new_name(const std::string& name) {
  const std::size_t begin = sizeof kBegin - 1, end = begin + kRandomDigits;
  return name.compare(0, begin, kBegin) == 0 && name.size() > end && name.substr(end) == kEnd &&
         name.find_first_not_of(kDigits, begin) == end;
}

// Removes what programs that were killed as they wrote left in a folder.
void remove_left_over(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::directory_iterator file(folder, error);
  for (; !error && file != std::filesystem::directory_iterator(); file.increment(error)) {
    if (is_new_name(file->path().filename().u8string())) remove_unheld(file->path());
  }
}

// Writes the bytes to a new file and puts it in the place of the old one.
std::error_code replace(const std::filesystem::path& path, const std::string& bytes,
                        const std::filesystem::file_status& old) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".", fresh = folder / new_name();
  NewFile held;
  std::error_code error = write_new(fresh, bytes, old, held), ignored;
  if (error == std::errc::file_exists) return error;
  if (!error) std::filesystem::rename(fresh, path, error);
  if (error) std::filesystem::remove(fresh, ignored);
  if (!error) settle_folder(folder);
  if (!error) remove_left_over(folder);
  return error;
}

}  // namespace

void write_file(const std::filesystem::path& path, const std::string& bytes) {
  const auto fail = [&](const std::string& cause) {
    throw std::invalid_argument("cannot write " + path.u8string() + ": " + cause);
  };
  std::error_code ignored;
  const std::filesystem::file_status old = std::filesystem::symlink_status(path, ignored);
  if (const char* cause = in_the_way(old.type())) fail(cause);
  if (const std::error_code error = replace(path, bytes, old)) fail(error.message());
}

}  // namespace fragmotion
