#pragma once
#include <nanobind/nanobind.h>

#include <chrono>
#include <thread>

namespace snapspace {

/// Releases Python's lock for as long as it lives, for work that does not touch Python.
///
/// If the interpreter ends meanwhile, as with a daemon thread that still computes, the thread waits
/// for the end of the process. Before Python 3.14 the lock would instead unwind the thread, and a
/// destructor that is left in this way ends the process by std::terminate: every program that quits
/// during a computation would abort. From 3.14 on Python itself waits.
class ReleasedGil {
 public:
  ReleasedGil() : state_(PyEval_SaveThread()) {}
  ReleasedGil(const ReleasedGil&) = delete;
  ReleasedGil& operator=(const ReleasedGil&) = delete;

  ~ReleasedGil() {
    try {
      PyEval_RestoreThread(state_);
    } catch (...) {  // not an exception: the C library's unwinding of a thread that exits
      for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
    }
  }

 private:
  PyThreadState* state_;
};

}  // namespace snapspace
