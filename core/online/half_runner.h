#pragma once
#include <cstddef>

namespace snapspace::online {

/// Runs the two halves of some work, perhaps on two threads.
/// The division does not depend on the threads, and each half writes its own results: they are the
/// same with and without a second thread.
class HalfRunner {
 public:
  using Work = void (*)(void* context, int half);

  /// Calls work(context, 0) and work(context, 1), and returns when both have ended.
  virtual void run(Work work, void* context) = 0;

 protected:
  HalfRunner() = default;
  HalfRunner(const HalfRunner&) = default;
  HalfRunner& operator=(const HalfRunner&) = default;
  ~HalfRunner() = default;
};

/// Work that reads at least this many words is worth two threads: about 8 microseconds on one.
constexpr std::size_t kMinSharedWords = std::size_t{1} << 15;

/// Calls work(0) and work(1), one after the other if `runner` is null.
template <class Callable>
void run_halves(HalfRunner* runner, Callable work) {
  if (runner) {
    runner->run([](void* context, int half) { (*static_cast<Callable*>(context))(half); }, &work);
  } else {
    work(0);
    work(1);
  }
}

/// The same for work that reads this many words; if they are few, one half runs after the other.
template <class Callable>
void run_halves(HalfRunner* runner, std::size_t words, Callable work) {
  run_halves(words < kMinSharedWords ? nullptr : runner, work);
}

}  // namespace snapspace::online
