#pragma once

namespace snapspace {

/// Columns that a solve keeps in registers while it passes over the rows below them: as many as
/// fit, with a pack each for x, y and z.
#if defined(__AVX512F__) || defined(__aarch64__)
inline constexpr int kColumnBlock = 8;
#else
inline constexpr int kColumnBlock = 4;
#endif

}  // namespace snapspace
