// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

namespace fragmotion {

/// The number of threads to use: `requested`, or the machine's where it is 0.
inline int thread_count(int requested) {
  return requested > 0 ? requested : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Calls body(begin, end) on `threads` consecutive parts of 0 .. count - 1. `body` must give the same result however
/// the range is cut. An exception of a part is thrown again here, the lowest part's first.
template <typename Body>
void parallel_for(int count, int threads, const Body& body) {
  threads = std::max(1, std::min(threads, count));
  std::vector<std::exception_ptr> errors(threads);
  const auto run = [&](int part) {
    try {
      body(static_cast<int>(static_cast<long long>(count) * part / threads),
           static_cast<int>(static_cast<long long>(count) * (part + 1) / threads));
    } catch (...) {
      errors[part] = std::current_exception();
    }
  };
  std::vector<std::thread> workers;
  for (int part = 1; part < threads; ++part) workers.emplace_back(run, part);
  run(0);
  for (std::thread& worker : workers) worker.join();
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace fragmotion
