#include "live/second_thread.h"

#include <chrono>
#include <system_error>
#include <thread>

namespace snapspace::live {

namespace {

constexpr auto kSpin = std::chrono::microseconds(200);

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

/// Whether `holds` became true within kSpin.
template <class Condition>
bool spin_until(Condition holds) {
  const auto end = std::chrono::steady_clock::now() + kSpin;
  do {
    for (int i = 0; i < 32; ++i) {
      if (holds()) return true;
      pause();
    }
  } while (std::chrono::steady_clock::now() < end);
  return false;
}

}  // namespace

SecondThread* SecondThread::instance() {
  // Never destroyed, because its thread must not outlive it.
  static SecondThread* const thread =
      std::thread::hardware_concurrency() > 1 ? new SecondThread : nullptr;
  return thread;
}

void SecondThread::start() {
  started_ = true;
  try {
    std::thread([this] { serve(); }).detach();
  } catch (const std::system_error&) {
    // The system grants no thread, so the caller runs both halves.
  }
}

bool SecondThread::take(int ticket) {
  return offered_.compare_exchange_strong(ticket, 0, std::memory_order_acq_rel);
}

void SecondThread::run(Work work, void* context) {
  if (busy_.test_and_set(std::memory_order_acquire)) {
    work(context, 0);
    work(context, 1);
    return;
  }
  if (!started_) start();
  ticket_ = ticket_ % 1000000000 + 1;  // never 0
  work_ = work;
  context_ = context;
  offered_.store(ticket_, std::memory_order_release);
  offered_.notify_one();
  work(context, 0);
  if (take(ticket_)) {
    work(context, 1);
  } else {
    const auto ended = [this] { return ended_.load(std::memory_order_acquire) == ticket_; };
    while (!spin_until(ended)) std::this_thread::yield();
  }
  busy_.clear(std::memory_order_release);
}

void SecondThread::serve() {
  for (;;) {
    int ticket = 0;
    const auto offered = [&] {
      ticket = offered_.load(std::memory_order_acquire);
      return ticket != 0;
    };
    if (!spin_until(offered)) {
      offered_.wait(0, std::memory_order_acquire);
      continue;
    }
    if (!take(ticket)) continue;
    work_(context_, 1);
    ended_.store(ticket, std::memory_order_release);
  }
}

}  // namespace snapspace::live
