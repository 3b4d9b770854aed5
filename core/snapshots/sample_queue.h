#pragma once
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "snapshots/solve_report.h"

namespace snapspace {

/// A sample's input and the start of its solve, in the caller's numbering.
struct Sample {
  int id = -1;
  std::vector<double> input;  ///< input_size() of the system
  std::vector<double> start;  ///< 3n, a displacement
};

struct Solution {
  int id = -1;
  SolveReport report;
  std::vector<double> shape;  ///< 3n, a displacement
};

/// Passes samples to the threads that solve them, and solutions back. Any thread may call any
/// function.
class SampleQueue {
 public:
  void put(Sample sample) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(sample));
    ++open_;
    changed_.notify_all();
  }

  /// No more samples will come: solvers end when none is left.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

  /// Sets how many solvers share the samples.
  void share(int solvers) {
    const std::lock_guard lock(mutex_);
    solvers_ = solvers;
  }

  /// The next sample for a solver that works on `held` samples; nullopt if it holds its share of
  /// all open samples, or if none is waiting. A solver that holds none waits for one, and gets
  /// nullopt only when no work is left.
  std::optional<Sample> take(int held, const SolveControl& control) {
    std::unique_lock lock(mutex_);
    if (held == 0)
      while (waiting_.empty() && !closed_ && !control.cancelled)
        changed_.wait_for(lock, std::chrono::milliseconds(20));
    const int share = (open_ + solvers_ - 1) / solvers_;
    if (waiting_.empty() || control.cancelled || (held > 0 && held >= share)) return std::nullopt;
    Sample sample = std::move(waiting_.front());
    waiting_.pop_front();
    return sample;
  }

  /// Whether solvers have taken all samples and no more will come.
  [[nodiscard]] bool exhausted() {
    const std::lock_guard lock(mutex_);
    return closed_ && waiting_.empty();
  }

  /// Reports how many evaluations a sample has had so far.
  void report_evaluations(int id, int evaluations) {
    const std::lock_guard lock(mutex_);
    running_[id] = evaluations;
  }

  /// Samples that are being solved, with their evaluations so far.
  std::vector<std::pair<int, int>> running() {
    const std::lock_guard lock(mutex_);
    return {running_.begin(), running_.end()};
  }

  void finish(Solution solution) {
    const std::lock_guard lock(mutex_);
    running_.erase(solution.id);
    finished_.push_back(std::move(solution));
    --open_;
    changed_.notify_all();
  }

  /// Solutions since the last call; waits up to `seconds` for at least one.
  std::vector<Solution> collect(double seconds) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                      [&] { return !finished_.empty(); });
    return std::exchange(finished_, {});
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Sample> waiting_;
  std::vector<Solution> finished_;
  std::map<int, int> running_;
  int open_ = 0;  // waiting or with a solver
  int solvers_ = 1;
  bool closed_ = false;
};

}  // namespace snapspace
