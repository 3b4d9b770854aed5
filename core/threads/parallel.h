#pragma once
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace snapspace {

/// The wanted number of threads, or as many as the machine has if that is 0.
inline int thread_count(int wanted) {
  return wanted > 0 ? wanted : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

/// Calls work(item) for every item in [0, count) on up to `threads` threads (0: as many as the
/// machine has).
/// Items are handed out in order to the next free thread; an item must not depend on the thread
/// that runs it. The first exception of an item is rethrown here after all threads have ended.
template <class Work>
void parallel_for(int count, int threads, Work&& work) {
  threads = std::min(thread_count(threads), count);
  std::atomic<int> next{0};
  std::exception_ptr error;
  std::mutex error_mutex;
  const auto run = [&] {
    try {
      for (int item = next++; item < count; item = next++) work(item);
    } catch (...) {
      const std::lock_guard lock(error_mutex);
      if (!error) error = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> pool;
  pool.reserve(std::max(0, threads - 1));
  try {
    for (int t = 1; t < threads; ++t) pool.emplace_back(run);
  } catch (const std::system_error&) {
    // The system grants no more threads, so the existing ones do the work. Leaving with an
    // exception would destroy running threads, which ends the process.
  }
  run();
  for (std::thread& thread : pool) thread.join();
  if (error) std::rethrow_exception(error);
}

}  // namespace snapspace
