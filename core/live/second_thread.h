#pragma once
#include <atomic>

#include "online/half_runner.h"

namespace snapspace::live {

/// A thread that runs one half of live evaluations for the caller.
/// Between the evaluations of a solve it spins, because waking a thread takes as long as an
/// evaluation; afterwards it sleeps. The caller never waits for it to wake: it runs the second half
/// itself if the thread has not taken it by then. So nothing is lost on a busy machine, or in a
/// forked process, which has no such thread.
class SecondThread final : public online::HalfRunner {
 public:
  /// The only instance; null if the machine has one processor. It lasts as long as the process.
  static SecondThread* instance();

  void run(Work work, void* context) override;

 private:
  SecondThread() = default;
  void start();
  [[noreturn]] void serve();
  bool take(int ticket);

  std::atomic_flag busy_;        // whether a caller uses it
  bool started_ = false;         // whether a thread was requested; read by the caller only
  int ticket_ = 0;               // ticket of the last offer; read by the caller only
  std::atomic<int> offered_{0};  // the ticket of a half that no thread has taken, or 0
  std::atomic<int> ended_{0};    // the last ticket that the thread has served
  Work work_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace snapspace::live
