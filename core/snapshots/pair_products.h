#pragma once
#include <algorithm>
#include <array>
#include <cmath>

namespace snapspace {

/// What L-BFGS keeps of the way to a point, which depends on how long that way is.
struct LbfgsMemory {
  int pairs;    ///< of steps and changes of the gradient; each adds to the cost of an evaluation
  bool scaled;  ///< whether the newest pair scales the seed (Nocedal & Wright 2006, eq. 7.20)
};

/// For problems whose solves are short, and for others: see the systems.
inline constexpr LbfgsMemory kShortMemory{.pairs = 1, .scaled = true};
inline constexpr LbfgsMemory kLongMemory{.pairs = 2, .scaled = false};

/// The recursion of L-BFGS of one sample, on inner products alone (as in Chen, Wang, Zhou 2014).
///
/// The seed is a fixed inverse A^-1, or seed * A^-1 where it is scaled. With z = A^-1 g for the
/// gradient at every point, and p_k = A^-1 y_k, the difference of two z, beside the step s_k, all
/// that the two loops (Nocedal & Wright 2006, alg. 7.4) make lies in the span of z, s_k and p_k:
///   direction = -seed z + sum_k (image[k] p_k + step[k] s_k).
/// Hence only z and s_k are stored, and one pass gives all new products. Pairs and vectors are
/// numbered from the newest.
template <LbfgsMemory memory>
class PairProducts {
 public:
  static constexpr int kPairs = memory.pairs;

  /// Of the gradient at a trial.
  struct Trial {
    double direction;                      // with the direction that led there
    double images[kPairs];                 // with the z of the point where it began, and before
    std::array<double, kPairs - 1> steps;  // with s_k
    double itself;                         // with the z of the trial
  };

  double seed = 1.0;          ///< coefficients of the direction
  double step[kPairs] = {};   ///< the same
  double image[kPairs] = {};  ///< the same

  void forget() { *this = {}; }

  /// The first point, or the first after `forget`: there is no step that led to it.
  void start(const Trial& trial) { gradient_image_ = trial.itself; }

  /// The sample moves by `length` times its direction; the oldest pair makes room for a new one.
  void move(const Trial& trial, double length) {
    double change[kPairs];  // y_j . direction
    for (int j = 0; j < kPairs; ++j) {
      change[j] = -seed * gradient_images_[j];
      for (int k = 0; k < kPairs; ++k)
        change[j] += image[k] * images_[k][j] + step[k] * steps_[k][j];
    }
    age();
    for (int j = 1; j < kPairs; ++j) {
      const double gradient_image = trial.images[j - 1] - trial.images[j];
      steps_[0][j] = length * change[j - 1];
      steps_[j][0] = trial.steps[j - 1] - gradient_steps_[j];
      images_[0][j] = images_[j][0] = gradient_image - gradient_images_[j];
      gradient_steps_[j] = trial.steps[j - 1];
      gradient_images_[j] = gradient_image;
    }
    const double bend = trial.direction - slope_;
    steps_[0][0] = length * bend;
    images_[0][0] = trial.itself - 2.0 * trial.images[0] + gradient_image_;
    gradient_steps_[0] = length * trial.direction;
    gradient_images_[0] = trial.itself - trial.images[0];
    gradient_image_ = trial.itself;
    // Pairs of negative or vanishing curvature would make the inverse indefinite.
    const bool usable = bend > kFlat * std::abs(slope_) && images_[0][0] > 0.0;
    curvature_[0] = usable ? 1.0 / steps_[0][0] : 0.0;
  }

  /// Sets the coefficients of the next direction; returns gradient . direction.
  double turn() {
    double first[kPairs];
    for (int k = 0; k < kPairs; ++k) {
      double product = gradient_steps_[k];
      for (int newer = 0; newer < k; ++newer) product -= first[newer] * steps_[k][newer];
      first[k] = curvature_[k] * product;
    }
    seed = 1.0;
    if (memory.scaled && curvature_[0] > 0.0)
      seed = std::clamp(steps_[0][0] / images_[0][0], kLeastSeed, 1.0);
    double second[kPairs];
    for (int k = kPairs - 1; k >= 0; --k) {
      double product = gradient_images_[k];
      for (int j = 0; j < kPairs; ++j) product -= first[j] * images_[k][j];
      product *= seed;
      for (int older = k + 1; older < kPairs; ++older) product += second[older] * steps_[older][k];
      second[k] = first[k] - curvature_[k] * product;
    }
    slope_ = -seed * gradient_image_;
    for (int k = 0; k < kPairs; ++k) {
      image[k] = seed * first[k];
      step[k] = -second[k];
      slope_ += image[k] * gradient_images_[k] + step[k] * gradient_steps_[k];
    }
    return slope_;
  }

 private:
  /// Least change of the slope that is no rounding, as a share of it.
  static constexpr double kFlat = 1e-6;
  /// A few stiff tets must not make the whole shape crawl. With 0.02 the Dragon's samples take 2 %
  /// more evaluations, with 0.15 an eighth more.
  static constexpr double kLeastSeed = 0.05;

  /// Every pair becomes the next older one.
  void age() {
    for (int k = kPairs - 1; k > 0; --k) {
      curvature_[k] = curvature_[k - 1];
      gradient_steps_[k] = gradient_steps_[k - 1];
      gradient_images_[k] = gradient_images_[k - 1];
      for (int j = kPairs - 1; j > 0; --j) {
        steps_[k][j] = steps_[k - 1][j - 1];
        images_[k][j] = images_[k - 1][j - 1];
      }
    }
  }

  double curvature_[kPairs] = {};        // 1 / s_k . y_k, zero where there is no pair
  double steps_[kPairs][kPairs] = {};    // s_k . y_j
  double images_[kPairs][kPairs] = {};   // p_k . y_j
  double gradient_steps_[kPairs] = {};   // s_k . g
  double gradient_images_[kPairs] = {};  // p_k . g
  double gradient_image_ = 0.0;          // z . g
  double slope_ = 0.0;                   // g . direction
};

}  // namespace snapspace
