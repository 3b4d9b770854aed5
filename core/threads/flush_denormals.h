#pragma once
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace snapspace {

/// During its lifetime, this thread treats denormal numbers as zero.
/// Displacements decay away from moving handles, in single precision down to denormal numbers. Each
/// of them costs x86 processors a hundred times a normal number: a local edit of a dog, whose body
/// is held, takes three times as long in all. Other processors are not slowed down by them.
class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | kFlushToZero | kDenormalsAreZero); }
  ~FlushDenormals() { _mm_setcsr(saved_); }

 private:
  static constexpr unsigned kFlushToZero = 0x8000;
  static constexpr unsigned kDenormalsAreZero = 0x0040;
  unsigned saved_;
#else
  FlushDenormals() = default;
  ~FlushDenormals() {}
#endif

 public:
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;
};

}  // namespace snapspace
