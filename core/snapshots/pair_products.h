#pragma once
#include <algorithm>
#include <array>
#include <cmath>

namespace snapspace {

/// The memory of L-BFGS: how much it keeps of the path to a point. Long solves need more.
struct LbfgsMemory {
  int pairs;    ///< pairs of steps and gradient changes; each adds to the cost of an evaluation
  bool scaled;  ///< whether the newest pair scales the seed (Nocedal & Wright 2006, eq. 7.20)
};

/// Memories for problems with short solves and with long ones; see PosingSystem and
/// InterpolationSystem.
inline constexpr LbfgsMemory kShortMemory{.pairs = 1, .scaled = true};
inline constexpr LbfgsMemory kLongMemory{.pairs = 4, .scaled = false};

/// The L-BFGS recursion of one sample, on inner products alone (as in Chen, Wang, Zhou 2014).
/// The seed is a fixed inverse A^-1, or seed * A^-1 if it is scaled. Let z = A^-1 g for the
/// gradient at each point, and p_k = A^-1 y_k, the difference of two z, for each step s_k. Then
/// everything that the two loops (Nocedal & Wright 2006, alg. 7.4) compute lies in the span of z,
/// s_k and p_k:
///   direction = -seed z + sum_k (image[k] p_k + step[k] s_k).
/// Hence only z and s_k are stored, and one pass gives all new products. Pairs and vectors are
/// numbered from the newest.
template <LbfgsMemory memory>
class PairProducts {
 public:
  static constexpr int kPairs = memory.pairs;

  /// Inner products of the gradient at a trial.
  struct Trial {
    double direction;       // with the direction that led there
    double images[kPairs];  // with the z of the step's first point, and of those before
    std::array<double, kPairs - 1> steps;  // with s_k
    double own_image;                      // with the z of the trial
  };

  double seed = 1.0;          ///< coefficients of the direction
  double step[kPairs] = {};   ///< the same
  double image[kPairs] = {};  ///< the same

  void forget() { *this = {}; }

  /// Starts at the first point, or at the first after `forget`: no step led to it.
  void start(const Trial& trial) { gradient_image_ = trial.own_image; }

  /// Moves the sample by `length` times its direction; a new pair replaces the oldest one.
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
    const double slope_change = trial.direction - slope_;
    steps_[0][0] = length * slope_change;
    images_[0][0] = trial.own_image - 2.0 * trial.images[0] + gradient_image_;
    gradient_steps_[0] = length * trial.direction;
    gradient_images_[0] = trial.own_image - trial.images[0];
    gradient_image_ = trial.own_image;
    // Pairs of negative or vanishing curvature would make the inverse indefinite.
    const bool usable = slope_change > kFlat * std::abs(slope_) && images_[0][0] > 0.0;
    curvature_[0] = usable ? 1.0 / steps_[0][0] : 0.0;
  }

  /// Sets the coefficients of the next direction; returns gradient . direction.
  double choose_direction() {
    double first[kPairs];
    for (int k = 0; k < kPairs; ++k) {
      double product = gradient_steps_[k];
      for (int newer = 0; newer < k; ++newer) product -= first[newer] * steps_[k][newer];
      first[k] = curvature_[k] * product;
    }
    seed = 1.0;
    if (memory.scaled && curvature_[0] > 0.0)
      seed = std::clamp(steps_[0][0] / images_[0][0], kMinSeed, 1.0);
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
  /// Smaller relative changes of the slope count as rounding.
  static constexpr double kFlat = 1e-6;
  /// Keeps a few stiff tets from making the whole shape crawl. With 0.02 the Dragon's samples take
  /// 2 % more evaluations, with 0.15 an eighth more.
  static constexpr double kMinSeed = 0.05;

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
