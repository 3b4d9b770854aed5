#pragma once
#include <cstddef>

#include "online/aligned_array.h"
#include "online/packed_layout.h"

namespace snapspace::online {

/// How coefficients are kept during a live solve. Single halves the memory that an evaluation
/// reads; all arithmetic is in double precision, so that the polynomial is another one, by 6e-8 of
/// every coefficient, but as smooth.
enum class Storage : int { double_precision = 0, single_precision = 1 };

/// A polynomial of degree four in d variables q, as one form of degree four in x = (1, q).
///
/// Coefficients of the monomials x_i x_j x_k x_l, i <= j <= k <= l, are given with l slowest and i
/// fastest. The polynomial restricted to the first d' < d variables is therefore a prefix of the
/// array. They are copied into PackedLayout, and every evaluation reads the copy once.
///
/// Value, gradient and Hessian come out of one pass, because for a form of degree four they are all
/// the Hessian times x: with H the Hessian by x, the gradient is H x / 3 and the value x^T H x
/// / 12. The pass makes, for each coefficient, three multiply-adds into sums that stay in the
/// caches:
///   forms_kl   = sum_ij c_ijkl x_i x_j
///   cubic_kij += c_ijkl x_l   and   cubic_lij += c_ijkl x_k
/// From them H follows at the cost of a form of degree three.
class Quartic {
 public:
  /// Whether a Hessian costs much more than a gradient.
  static constexpr bool kHessianIsDear = false;

  /// All coefficients are zero until they are set. Takes all its memory here.
  explicit Quartic(int dimension, Storage storage = Storage::double_precision);
  /// @param coefficients  quartic_count(dimension + 1) doubles
  Quartic(int dimension, const double* coefficients, Storage storage = Storage::double_precision);

  [[nodiscard]] int dimension() const { return dimension_; }
  /// The largest dimension: that of the constructor.
  [[nodiscard]] int capacity() const { return capacity_; }
  /// Restricts the polynomial to the first variables, 1 <= dimension <= capacity.
  void set_dimension(int dimension) { dimension_ = dimension; }

  /// Sets the coefficients to sum_k weights_k coefficients_k.
  /// @param coefficients  terms x quartic_count(capacity + 1)
  void combine(int terms, const double* weights, const double* coefficients);

  /// Value at q (d); `gradient` (d) is overwritten.
  double value_and_gradient(const double* q, double* gradient);

  /// Value at q (d); `gradient` (d) and the lower triangle of `hessian` (d x d) are overwritten.
  double derivatives(const double* q, double* gradient, double* hessian);

 private:
  template <class Stored>
  struct PairPass;
  template <class Stored>
  struct CubicPass;

  void set_variables(const double* q);
  template <int Rows, int Columns>
  void add_forms(int k, int l, const double* forms);
  void add_cubic();
  void form_gradient(double factor, double* gradient);
  [[nodiscard]] double form_value() const;
  void unpack_hessian(double* hessian) const;

  int capacity_, dimension_;
  Storage storage_;
  PackedLayout layout_;
  AlignedArray<double> coefficients_;  // one of the two is empty
  AlignedArray<float> singles_;
  AlignedArray<double> x_;      // (1, q), then zeros
  AlignedArray<double> pairs_;  // x_i x_j, j slowest, then zeros
  AlignedArray<double> forms_;  // by pairs
  AlignedArray<double> cubic_;  // by blocks
  std::size_t stride_;
  AlignedArray<double> rows_;  // gradients of the forms of cubic_
};

}  // namespace snapspace::online
