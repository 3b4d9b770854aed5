#pragma once
#include <algorithm>
#include <cmath>
#include <numeric>

namespace snapspace {

/// The recursion of L-BFGS of one sample, on inner products alone (as in Chen, Wang, Zhou 2014).
///
/// The seed is a fixed inverse A^-1. With z = A^-1 g for the gradient, and p_k = A^-1 y_k beside
/// the step s_k for every change y_k of the gradient, all that the two loops (Nocedal & Wright
/// 2006, alg. 7.4) make lies in the span of z, s_k and p_k:
///   direction = -z + sum_k (image[k] p_k + step[k] s_k).
/// Which is why no y_k is kept, and one pass over the vectors gives all products that are new.
class PairProducts {
 public:
  /// On 32 samples of the Dragon 2 and 3 pairs need 121 and 126 evaluations, on a creature of
  /// 250,000 tets 111 and 116, and every pair adds to the cost of each.
  static constexpr int kPairs = 2;

  /// Of the gradient at a trial.
  struct Trial {
    double direction;       // with the direction that led there
    double steps[kPairs];   // with s_k
    double images[kPairs];  // with p_k
    double itself;          // z . g, with the z of the trial
  };

  double step[kPairs] = {};   ///< coefficients of the direction
  double image[kPairs] = {};  ///< the same

  PairProducts() { std::iota(newest_first_, newest_first_ + kPairs, 0); }

  void forget() { *this = {}; }

  /// The first point, or the first after `forget`: there is no step that led to it.
  void start(const Trial& trial) { gradient_image_ = trial.itself; }

  /// The sample moves by `length` times its direction; the pair of differences takes a slot.
  void move(const Trial& trial, double length, int slot) {
    double image_of_old = -trial.direction;  // z . new gradient, z = -direction + ...
    double change[kPairs];                   // y_j . direction
    for (int a = 0; a < kPairs; ++a) {
      const int j = newest_first_[a];
      image_of_old += image[j] * trial.images[j] + step[j] * trial.steps[j];
      change[j] = -gradient_images_[j];
      for (const int k : newest_first_)
        change[j] += image[k] * images_[k][j] + step[k] * steps_[k][j];
    }
    for (int j = 0; j < kPairs; ++j) {
      steps_[slot][j] = length * change[j];
      steps_[j][slot] = trial.steps[j] - gradient_steps_[j];
      images_[slot][j] = images_[j][slot] = trial.images[j] - gradient_images_[j];
      gradient_steps_[j] = trial.steps[j];
      gradient_images_[j] = trial.images[j];
    }
    const double bend = trial.direction - slope_;
    steps_[slot][slot] = length * bend;
    images_[slot][slot] = trial.itself - 2.0 * image_of_old + gradient_image_;
    gradient_steps_[slot] = length * trial.direction;
    gradient_images_[slot] = trial.itself - image_of_old;
    gradient_image_ = trial.itself;
    // Pairs of negative or vanishing curvature would make the inverse indefinite.
    const bool usable = bend > kFlat * std::abs(slope_) && images_[slot][slot] > 0.0;
    curvature_[slot] = usable ? 1.0 / steps_[slot][slot] : 0.0;
    int* place = std::find(newest_first_, newest_first_ + kPairs, slot);
    std::rotate(newest_first_, place, place + 1);
  }

  /// Sets the coefficients of the next direction; returns gradient . direction.
  double turn() {
    double first[kPairs], second[kPairs];
    for (int a = 0; a < kPairs; ++a) {
      const int k = newest_first_[a];
      double product = gradient_steps_[k];
      for (int newer = 0; newer < a; ++newer)
        product -= first[newest_first_[newer]] * steps_[k][newest_first_[newer]];
      first[k] = curvature_[k] * product;
    }
    for (int a = kPairs - 1; a >= 0; --a) {
      const int k = newest_first_[a];
      double product = gradient_images_[k];
      for (const int j : newest_first_) product -= first[j] * images_[k][j];
      for (int older = a + 1; older < kPairs; ++older)
        product += second[newest_first_[older]] * steps_[newest_first_[older]][k];
      second[k] = first[k] - curvature_[k] * product;
    }
    slope_ = -gradient_image_;
    for (const int k : newest_first_) {
      image[k] = first[k];
      step[k] = -second[k];
      slope_ += image[k] * gradient_images_[k] + step[k] * gradient_steps_[k];
    }
    return slope_;
  }

 private:
  /// Least change of the slope that is no rounding, as a share of it.
  static constexpr double kFlat = 1e-6;

  double curvature_[kPairs] = {};        // 1 / s_k . y_k, zero where there is no pair
  double steps_[kPairs][kPairs] = {};    // s_k . y_j
  double images_[kPairs][kPairs] = {};   // p_k . y_j
  double gradient_steps_[kPairs] = {};   // s_k . g
  double gradient_images_[kPairs] = {};  // p_k . g
  double gradient_image_ = 0.0;          // z . g
  double slope_ = 0.0;                   // g . direction
  int newest_first_[kPairs];             // slots; sums go in this order wherever the ring stands
};

}  // namespace snapspace
