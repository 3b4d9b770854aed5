#pragma once
#include <cstddef>
#include <vector>

#include "online/aligned_array.h"
#include "online/half_runner.h"
#include "online/packed_layout.h"
#include "online/quartic_tiles.h"
#include "online/symmetric_form.h"

namespace snapspace::online {

/// How coefficients are stored during a live solve. Single precision halves the memory that an
/// evaluation reads. All arithmetic is in double precision, so the polynomial changes, by 6e-8 of
/// each coefficient, but is as smooth.
enum class Storage : int { double_precision = 0, single_precision = 1 };

/// A polynomial of degree four in d variables q, as one form of degree four in x = (1, q).
///
/// Coefficients of the monomials x_i x_j x_k x_l, i <= j <= k <= l, are given with l slowest and i
/// fastest. The polynomial restricted to the first d' < d variables is therefore a prefix of the
/// array. They are copied into PackedLayout, and every evaluation reads the copy once.
/// One pass gives value, gradient and Hessian, because for a form of degree four all follow from
/// the Hessian H with respect to x: the gradient is H x / 3 and the value x . gradient / 4. For
/// each coefficient the pass does three multiply-adds into sums that stay in registers and the
/// first-level cache:
///   forms_kl   = sum_ij c_ijkl x_i x_j
///   cubic_kij += c_ijkl x_l   and   cubic_lij += c_ijkl x_k
/// H follows from these at the cost of a form of degree three.
class Quartic {
 public:
  /// Whether a Hessian costs much more than a gradient.
  static constexpr bool kHessianIsExpensive = false;
  /// None: an evaluation takes one thread.
  [[nodiscard]] static HalfRunner* half_runner() { return nullptr; }

  /// All coefficients are zero until they are set. Allocates all memory.
  explicit Quartic(int dimension, Storage storage = Storage::double_precision);
  /// @param coefficients  quartic_count(dimension + 1) doubles
  Quartic(int dimension, const double* coefficients, Storage storage = Storage::double_precision);

  [[nodiscard]] int dimension() const { return dimension_; }
  /// The largest dimension: that of the constructor.
  [[nodiscard]] int capacity() const { return capacity_; }
  /// Restricts the polynomial to the first variables, 1 <= dimension <= capacity.
  void set_dimension(int dimension) { dimension_ = dimension; }

  /// Sets the coefficients to sum_k weights_k coefficients_k, one term or more.
  /// @param coefficients  terms x quartic_count(capacity + 1)
  void combine(int terms, const double* weights, const double* coefficients);

  /// Value at q (d); `gradient` (d) is overwritten.
  double value_and_gradient(const double* q, double* gradient);

  /// Value at q (d); `gradient` (d) and the lower triangle of `hessian` (d x d) are overwritten.
  double derivatives(const double* q, double* gradient, double* hessian);

 private:
  /// Location of the rows first ... of a tile.
  struct Tile {
    int first;
    PairPacks packs;
    std::size_t place;
  };
  struct Listing;
  template <class Stored>
  struct PairPass;
  template <class Stored>
  struct CubicPass;

  template <class Stored>
  void write_block(int k, int l, const double* block, Stored* to);
  template <template <class> class Pass>
  void read_coefficients();
  void set_variables(const double* q);
  void add_sums(int g, int h, const TileSums& sums);
  void add_cubic();
  void add_weights();
  void add_linear(double factor);
  double form_gradient(double factor, double* gradient);
  /// Row l of the form. Missing variables come before it; only zeros are added to them.
  double* row(int l) { return forms_.data() + (l + kTile) * stride_; }

  int capacity_, dimension_;
  Storage storage_;
  PackedLayout layout_;
  std::vector<std::vector<Tile>> tiles_;  // for each pair of groups
  AlignedArray<double> coefficients_;     // one of the two is empty
  AlignedArray<float> singles_;
  AlignedArray<double> linear_;  // coefficients of x_0^3 x_l
  AlignedArray<double> x_;       // (1, q), then zeros
  AlignedArray<double> tile_x_;  // in groups, without x_0; zeros for missing variables
  FormVariables<kPack> variables_;
  AlignedArray<double> pairs_;    // x_i x_j, j slowest, then zeros
  AlignedArray<double> weights_;  // sums of coefficients for each pair
  AlignedArray<double> cubic_;    // for each variable, a quadratic form in the pairs
  std::size_t stride_;
  AlignedArray<double> forms_;     // rows l of a quadratic form in x
  AlignedArray<double> gradient_;  // of that form
};

}  // namespace snapspace::online
