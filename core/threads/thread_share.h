#pragma once
#include <algorithm>
#include <atomic>

namespace snapspace {

/// Threads that several workers share. When a worker ends, the others may use its threads.
class ThreadShare {
 public:
  ThreadShare(int threads, int workers) : threads_(threads), workers_(workers) {}

  /// How many threads each worker may use now, at least one.
  [[nodiscard]] int each() const { return std::max(1, threads_ / std::max(1, workers_.load())); }
  /// A worker ends.
  void leave() { --workers_; }

 private:
  const int threads_;
  std::atomic<int> workers_;
};

/// One thread for one worker.
inline const ThreadShare kOneThread(1, 1);

}  // namespace snapspace
