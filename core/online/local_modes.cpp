#include "online/local_modes.h"

#include "online/number_words.h"
#include "simd/number_pairs.h"

namespace snapspace::online {

LocalModes::LocalModes(int dimension, int rank, const float* modes)
    : pairs_((dimension + 1) / 2), twins_((rank + 2 * kWidth - 1) / (2 * kWidth)) {
  const NumberWords word(modes, static_cast<std::size_t>(rank) * dimension);
  words_.assign(static_cast<std::size_t>(twins_) * pairs_ * 2, Pack(word(0.0, 0.0)));
  for (int i = 0; i < rank; ++i)
    for (int pair = 0; pair < pairs_; ++pair) {
      const float* entry = modes + static_cast<std::size_t>(i) * dimension + 2 * pair;
      const int pack = i / kWidth;
      words_[(static_cast<std::size_t>(pack / 2) * pairs_ + pair) * 2 + pack % 2].set(
          i % kWidth, word(entry[0], 2 * pair + 1 < dimension ? entry[1] : 0.0f));
    }
}

void LocalModes::multiply(int pairs, const double* q, Pack* y) const {
  for (int twin = 0; twin < twins_; ++twin, y += 2) {
    // Four sums, which do not wait for each other.
    Pack a0(0.0), a1(0.0), b0(0.0), b1(0.0);
    const Pack* word = words_.data() + static_cast<std::size_t>(twin) * pairs_ * 2;
    for (int pair = 0; pair < pairs; ++pair, word += 2) {
      const Pack first(q[2 * pair]), second(q[2 * pair + 1]);
      a0 += word[0] * first;
      a1 += word[1] * first;
      b0 += second_numbers(word[0]) * second;
      b1 += second_numbers(word[1]) * second;
    }
    y[0] = a0 + b0;
    y[1] = a1 + b1;
  }
}

void LocalModes::add_transposed(int pairs, const Pack* f, Pack* sums) const {
  for (int twin = 0; twin < twins_; ++twin, f += 2) {
    const Pack f0 = f[0], f1 = f[1];
    const Pack* word = words_.data() + static_cast<std::size_t>(twin) * pairs_ * 2;
    for (int pair = 0; pair < pairs; ++pair, word += 2) {
      sums[2 * pair] += word[0] * f0 + word[1] * f1;
      sums[2 * pair + 1] += second_numbers(word[0]) * f0 + second_numbers(word[1]) * f1;
    }
  }
}

void LocalModes::unpack(int rank, int dimension, double* modes) const {
  for (int i = 0; i < rank; ++i)
    for (int j = 0; j < dimension; ++j) {
      const int pack = i / kWidth;
      const Pack word =
          words_[(static_cast<std::size_t>(pack / 2) * pairs_ + j / 2) * 2 + pack % 2];
      *modes++ = (j % 2 == 0 ? word : second_numbers(word))[i % kWidth];
    }
}

}  // namespace snapspace::online
