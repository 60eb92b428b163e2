// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace fragmotion {

/// More threads than this are never started.
constexpr int kMostThreads = 256;

/// The number of threads to use: `requested`, or the machine's where it is 0; at most kMostThreads.
inline int thread_count(int requested) {
  const int threads = requested > 0 ? requested : static_cast<int>(std::thread::hardware_concurrency());
  return std::clamp(threads, 1, kMostThreads);
}

/// Throws the first of these errors, if there is any.
inline void rethrow_first(const std::vector<std::exception_ptr>& errors) {
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

/// Calls body(begin, end) on `threads` consecutive parts of 0 .. count - 1, the first part on the calling thread.
/// `body` must give the same result however the range is cut. Parts for which no thread can be started run on the
/// calling thread too. An exception of a part is thrown again here, the lowest part's first.
template <typename Body>
void parallel_for(int count, int threads, const Body& body) {
  threads = std::max(1, std::min({threads, count, kMostThreads}));
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
  workers.reserve(threads);
  int started = 1;
  try {
    for (; started < threads; ++started) workers.emplace_back(run, started);
  } catch (const std::exception&) {  // the system has no thread left
  }
  run(0);
  for (int part = started; part < threads; ++part) run(part);
  for (std::thread& worker : workers) worker.join();
  rethrow_first(errors);
}

/// make(i) of each i in 0 .. count - 1, in order. Each of the threads makes the next one that none has begun, so that
/// those may last as they will. An exception is thrown again here, the lowest i's first.
template <typename Make>
auto parallel_map(int count, int threads, const Make& make) {
  std::vector<decltype(make(0))> made(std::max(0, count));
  std::vector<std::exception_ptr> errors(made.size());
  std::atomic<int> next{0};
  threads = std::clamp(threads, 1, std::max(1, count));
  parallel_for(threads, threads, [&](int, int) {
    for (int i = next++; i < count; i = next++) {
      try {
        made[i] = make(i);
      } catch (...) {
        errors[i] = std::current_exception();
      }
    }
  });
  rethrow_first(errors);
  return made;
}

}  // namespace fragmotion
