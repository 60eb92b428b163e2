// SPDX-License-Identifier: MIT
#include "api/calls.hpp"

#include <algorithm>
#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <utility>
#include <vector>

namespace fragmotion {
namespace {

constexpr std::size_t kLongestError = 512;

struct Words {
  const char* call = "fragmotion";
  char text[kLongestError] = "";
};

Words& words() {
  static thread_local Words words;
  return words;
}

#ifdef NDEBUG
std::atomic<bool> checks_handles{false};
#else
std::atomic<bool> checks_handles{true};
#endif

// All that is alive, by address. A lock of its own, since the library of a game asks for no threads.
class Alive {
 public:
  static Alive& list() {
    static Alive list;
    return list;
  }

  void add(const void* handle, Kind kind) {
    const Lock lock(busy_);
    handles_.insert(find(handle), {handle, kind});
  }
  void remove(const void* handle) noexcept {
    const Lock lock(busy_);
    const auto found = find(handle);
    if (found != handles_.end() && found->first == handle) handles_.erase(found);
  }
  bool holds(const void* handle, Kind kind) {
    const Lock lock(busy_);
    const auto found = find(handle);
    return found != handles_.end() && found->first == handle && found->second == kind;
  }

 private:
  using Handle = std::pair<const void*, Kind>;

  struct Lock {
    explicit Lock(std::atomic_flag& flag) : busy(flag) {
      while (busy.test_and_set(std::memory_order_acquire)) {
      }
    }
    ~Lock() { busy.clear(std::memory_order_release); }
    std::atomic_flag& busy;
  };

  std::vector<Handle>::iterator find(const void* handle) {
    return std::lower_bound(handles_.begin(), handles_.end(), handle,
                            [](const Handle& a, const void* b) { return std::less<>()(a.first, b); });
  }

  std::atomic_flag busy_ = ATOMIC_FLAG_INIT;
  std::vector<Handle> handles_;
};

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::character:
      return "character";
    case Kind::rig:
      return "rig";
    case Kind::player:
      return "player";
    default:
      return "crowd";
  }
}

}  // namespace

void begin_call(const char* name) noexcept { words().call = name; }

// NOLINTNEXTLINE(modernize-avoid-variadic-functions): as printf, so that the compiler checks the words
FragmotionResult fail(FragmotionResult result, const char* format, ...) noexcept {
  char* text = words().text;
  const auto begun = static_cast<std::size_t>(std::snprintf(text, kLongestError, "%s: ", words().call));
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text + begun, kLongestError - begun, format, arguments);
  va_end(arguments);
  return result;
}

void list_alive(const void* handle, Kind kind) { Alive::list().add(handle, kind); }

void unlist_alive(const void* handle) noexcept { Alive::list().remove(handle); }

void demand_alive(const void* handle, Kind kind) {
  demand(handle != nullptr, FRAGMOTION_ERROR_ARGUMENT, "the %s is null", name_of(kind));
  if (!checks_handles.load(std::memory_order_relaxed)) return;
  demand(Alive::list().holds(handle, kind), FRAGMOTION_ERROR_HANDLE,
         "the %s was released before, or is none that was made by this library", name_of(kind));
}

}  // namespace fragmotion

const char* fragmotion_version(void) noexcept { return FRAGMOTION_VERSION_STRING; }

const char* fragmotion_last_error(void) noexcept { return fragmotion::words().text; }

const char* fragmotion_result_text(FragmotionResult result) noexcept {
  switch (result) {
    case FRAGMOTION_OK:
      return "all right";
    case FRAGMOTION_ERROR_ARGUMENT:
      return "wrong argument";
    case FRAGMOTION_ERROR_SIZE:
      return "unknown size of a struct";
    case FRAGMOTION_ERROR_CAPACITY:
      return "not room enough";
    case FRAGMOTION_ERROR_HANDLE:
      return "released handle";
    case FRAGMOTION_ERROR_REFUSED:
      return "refused bytes";
    case FRAGMOTION_ERROR_NEWER_VERSION:
      return "newer version";
    case FRAGMOTION_ERROR_OLDER_VERSION:
      return "older version";
    case FRAGMOTION_ERROR_MEMORY:
      return "no memory left";
    case FRAGMOTION_ERROR_INTERNAL:
      return "internal error";
    default:
      return "unknown result";
  }
}

void fragmotion_check_handles(std::int32_t on) noexcept { fragmotion::checks_handles = on != 0; }
