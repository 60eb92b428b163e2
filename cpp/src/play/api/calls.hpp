// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include "fragmotion/fragmotion.h"

namespace fragmotion {

/// What a call of the C API fails with.
struct CallError : std::exception {
  explicit CallError(FragmotionResult result) : result(result) {}
  FragmotionResult result;
};

/// Keeps what is wrong for fragmotion_last_error(), as printf. Allocates nothing.
#ifdef __GNUC__
__attribute__((format(printf, 2, 3)))
#endif
FragmotionResult
fail(FragmotionResult result, const char* format, ...) noexcept;

/// Throws CallError where something is wrong.
inline void demand(bool holds, FragmotionResult result, const char* text) {
  if (!holds) throw CallError{fail(result, "%s", text)};
}
template <typename... Words>
void demand(bool holds, FragmotionResult result, const char* format, const Words&... words) {
  if (!holds) throw CallError{fail(result, format, words...)};
}

template <typename T>
void demand_given(const T* pointer, const char* what) {
  demand(pointer != nullptr, FRAGMOTION_ERROR_ARGUMENT, "%s is null", what);
}
inline void demand_range(const char* what, double value, double least, double most) {
  demand(value >= least && value <= most, FRAGMOTION_ERROR_ARGUMENT, "%s must be %g to %g, not %g", what, least, most,
         value);
}
inline void demand_index(const char* what, int index, int count) {
  demand(index >= 0 && index < count, FRAGMOTION_ERROR_ARGUMENT, "%s %d does not exist; there are %d", what, index,
         count);
}

/// A struct of the caller's whose first member is its size.
template <typename Struct>
void demand_struct(const Struct* given, const char* what) {
  demand_given(given, what);
  demand(
      given->size == sizeof(Struct), FRAGMOTION_ERROR_SIZE,
      "the size of %s is %u, and this library knows %u: make it with the function of its name, and with the header of "
      "this library",
      what, static_cast<unsigned>(given->size), static_cast<unsigned>(sizeof(Struct)));
}

/// Does what a call does, named for its errors; nothing is thrown out of it.
template <typename Body>
FragmotionResult call(const char* name, const Body& body) noexcept;

/// Lists and unlists what is alive, and throws CallError where a handle is null or, if that is looked for, not alive.
enum class Kind : std::uint32_t { character = 0x63465261, rig = 0x72465261, player = 0x70465261, crowd = 0x77465261 };
void list_alive(const void* handle, Kind kind);
void unlist_alive(const void* handle) noexcept;
void demand_alive(const void* handle, Kind kind);

// What an error says it is of: the call under way in this thread.
void begin_call(const char* name) noexcept;

template <typename Body>
FragmotionResult call(const char* name, const Body& body) noexcept {
  begin_call(name);
  try {
    body();
    return FRAGMOTION_OK;
  } catch (const CallError& error) {
    return error.result;
  } catch (const std::invalid_argument& error) {
    return fail(FRAGMOTION_ERROR_ARGUMENT, "%s", error.what());
  } catch (const std::bad_alloc&) {
    return fail(FRAGMOTION_ERROR_MEMORY, "the system has no memory left for it");
  } catch (const std::length_error&) {
    return fail(FRAGMOTION_ERROR_MEMORY, "it would take more memory than there can be");
  } catch (const std::exception& error) {
    return fail(FRAGMOTION_ERROR_INTERNAL, "%s", error.what());
  } catch (...) {
    return fail(FRAGMOTION_ERROR_INTERNAL, "unknown");
  }
}

}  // namespace fragmotion
