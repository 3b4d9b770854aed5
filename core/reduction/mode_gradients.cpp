#include "reduction/mode_gradients.h"

#include <algorithm>
#include <vector>

#include "element/make_rest_element.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

/// Tets at a time: their rows stay in the second-level cache during the loop over modes (d = 120:
/// 276 kB).
constexpr int kChunk = 64;

void one_gradient(const RestTet& tet, const double* mode, std::size_t stride, float* to) {
  const double* u[4];
  for (int v = 0; v < 4; ++v) u[v] = mode + 3 * static_cast<std::size_t>(tet.vertices[v]);
  for (int a = 0; a < 3; ++a) {
    const double e1 = u[1][a] - u[0][a], e2 = u[2][a] - u[0][a], e3 = u[3][a] - u[0][a];
    for (int b = 0; b < 3; ++b)
      to[(3 * a + b) * stride] =
          static_cast<float>(e1 * tet.inverse_edges[0][b] + e2 * tet.inverse_edges[1][b] +
                             e3 * tet.inverse_edges[2][b]);
  }
}

}  // namespace

void mode_gradients(const double* vertices, int dimension, std::size_t size, const double* modes,
                    bool shell, int tets, const std::int32_t* corners, float* rows, int threads) {
  const auto d = static_cast<std::size_t>(dimension);
  parallel_for((tets + kChunk - 1) / kChunk, threads, [&](int chunk) {
    const int begin = chunk * kChunk, end = std::min(begin + kChunk, tets);
    std::vector<RestTet> rest;
    for (int t = begin; t < end; ++t)
      rest.push_back(make_rest_element(shell, vertices, corners + 4 * t));
    for (std::size_t i = 0; i < d; ++i)
      for (int t = begin; t < end; ++t)
        one_gradient(rest[t - begin], modes + i * size, d, rows + 9 * d * t + i);
  });
}

}  // namespace snapspace
