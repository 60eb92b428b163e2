// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>

namespace fragmotion {

/// What the test program has asked `new` for: how often, how much at most at once, and how much in all.
extern std::atomic<std::size_t> allocations, largest_allocation, allocated_bytes;

}  // namespace fragmotion
