#pragma once

namespace snapspace::online {

/// Runs work that is cut in two, perhaps on two threads.
///
/// The cut does not depend on who runs it, and each half writes what is its own: the result is the
/// same with and without a second thread.
class Halves {
 public:
  using Work = void (*)(void* context, int half);

  /// Calls work(context, 0) and work(context, 1), and returns when both have ended.
  virtual void run(Work work, void* context) = 0;

 protected:
  Halves() = default;
  Halves(const Halves&) = default;
  Halves& operator=(const Halves&) = default;
  ~Halves() = default;
};

/// Calls work(0) and work(1); one after the other if `halves` is null.
template <class Callable>
void run_halves(Halves* halves, Callable work) {
  if (halves) {
    halves->run([](void* context, int half) { (*static_cast<Callable*>(context))(half); }, &work);
  } else {
    work(0);
    work(1);
  }
}

}  // namespace snapspace::online
