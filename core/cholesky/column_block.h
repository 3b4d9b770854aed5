#pragma once

namespace snapspace {

/// Columns that a solve keeps in registers while it goes through the rows below them: as many as
/// there is room for, with x, y and z of a pack each.
#if defined(__AVX512F__) || defined(__aarch64__)
inline constexpr int kColumnBlock = 8;
#else
inline constexpr int kColumnBlock = 4;
#endif

}  // namespace snapspace
