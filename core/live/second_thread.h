#pragma once
#include <atomic>

#include "online/halves.h"

namespace snapspace::live {

/// A thread of the process that takes halves of live evaluations off the caller.
///
/// Between the evaluations of a solve it spins, since to wake a thread takes as long as an
/// evaluation; afterwards it sleeps. The caller never waits for it to wake: it runs the second half
/// itself if nobody has taken it by then. So a process that was forked, and has no such thread, or
/// a busy machine loses nothing.
class SecondThread final : public online::Halves {
 public:
  /// The only one; null if the machine has one processor. It lasts as long as the process.
  static SecondThread* instance();

  void run(Work work, void* context) override;

 private:
  SecondThread() = default;
  void start();
  [[noreturn]] void serve();
  bool take(int ticket);

  std::atomic_flag busy_;        // somebody uses it
  bool started_ = false;         // whether a thread was asked for; read by the user alone
  int ticket_ = 0;               // of the last offer; read by the user alone
  std::atomic<int> offered_{0};  // the ticket of a half that nobody has taken, or 0
  std::atomic<int> ended_{0};    // the last ticket that the thread has served
  Work work_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace snapspace::live
