#pragma once

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

}  // namespace snapspace::online
