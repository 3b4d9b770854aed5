#include "online/quartic.h"

#include <algorithm>

#include "online/quartic_passes.h"
#include "online/symmetric_form.h"
#include "simd/vectors.h"

namespace snapspace::online {

Quartic::Quartic(int dimension, Storage storage)
    : capacity_(dimension),
      dimension_(dimension),
      storage_(storage),
      layout_(dimension + 1),
      coefficients_(storage == Storage::double_precision ? layout_.size(dimension + 1) : 0),
      singles_(storage == Storage::single_precision ? layout_.size(dimension + 1) : 0),
      x_(PackedLayout::padded(dimension + 1)),
      pairs_(PackedLayout::block_size(dimension)),
      forms_(PackedLayout::block_size(dimension) + kPack),
      cubic_(layout_.row(dimension + 1) + kPack),
      stride_(PackedLayout::padded(dimension + 1)),
      rows_(stride_ * (dimension + 1)) {}

Quartic::Quartic(int dimension, const double* coefficients, Storage storage)
    : Quartic(dimension, storage) {
  const double one = 1.0;
  combine(1, &one, coefficients);
}

void Quartic::combine(int terms, const double* weights, const double* coefficients) {
  const std::size_t total = quartic_count(capacity_ + 1);
  double* sums = cubic_.data();
  for (int l = 0; l <= capacity_; ++l)
    for (int k = 0; k <= l; ++k) {
      const std::size_t size = pair_count(k + 1);
      std::fill_n(sums, size, 0.0);
      for (int t = 0; t < terms; ++t)
        add_scaled(weights[t], coefficients + t * total, sums, static_cast<int>(size));
      if (storage_ == Storage::double_precision)
        std::copy_n(sums, size, &coefficients_[layout_.block(k, l)]);
      else
        std::copy_n(sums, size, &singles_[layout_.block(k, l)]);
      coefficients += size;
    }
}

void Quartic::set_variables(const double* q) {
  const int n = dimension_ + 1;
  std::fill_n(x_.data() + n, PackedLayout::padded(n) - n, 0.0);
  x_[0] = 1.0;
  std::copy_n(q, dimension_, x_.data() + 1);
  double* pair = pairs_.data();
  for (int j = 0; j < n; ++j)
    for (int i = 0; i <= j; ++i) *pair++ = x_[i] * x_[j];
  std::fill(pair, pairs_.data() + PackedLayout::block_size(n - 1), 0.0);
  std::fill_n(forms_.data(), PackedLayout::block_size(n - 1), 0.0);
}

/// forms_kl and, in cubic_, the sum over k and l of x_k x_l times block (k, l).
template <class Stored>
struct Quartic::PairPass {
  Quartic& self;
  const Stored* coefficients;

  void columns(int, int) {}

  template <int Rows, int Columns>
  void tile(int k, int l, Range range) {
    const Stored* blocks[Columns];
    double forms[Rows * Columns];
    for (int c = 0; c < Columns; ++c) blocks[c] = coefficients + self.layout_.block(k, l + c);
    contract_pairs<Rows, Columns>(blocks, PackedLayout::block_size(k), range, self.pairs_.data(),
                                  &self.x_[k], &self.x_[l], self.cubic_.data(), forms);
    self.add_forms<Rows, Columns>(k, l, forms);
  }

  void corner(int a) {
    tile<1, 2>(a, a, {0, PackedLayout::block_size(a)});
    tile<1, 1>(a + 1, a + 1, {0, PackedLayout::block_size(a)});
  }

  void diagonal(int l) { tile<1, 1>(l, l, {0, PackedLayout::block_size(l)}); }
};

/// forms_kl and, in block a of cubic_, the sum over l of x_l times block (a, l) and over k of x_k
/// times block (k, a).
template <class Stored>
struct Quartic::CubicPass {
  Quartic& self;
  const Stored* coefficients;

  /// Zeros where sums begin: just before they do, so that they are in the first-level cache.
  void columns(int l, int count) {
    std::fill_n(cubic(l), self.layout_.row(l + count) - self.layout_.row(l), 0.0);
  }

  template <int Rows, int Columns>
  void tile(int k, int l, Range range) {
    const Stored* blocks[Columns];
    double* cubic_l[Columns];
    double forms[Rows * Columns];
    for (int c = 0; c < Columns; ++c) {
      blocks[c] = coefficients + self.layout_.block(k, l + c);
      cubic_l[c] = cubic(l + c);
    }
    contract_cubic<Rows, Columns>(blocks, PackedLayout::block_size(k), range, self.pairs_.data(),
                                  &self.x_[k], &self.x_[l], cubic(k), cubic_l, forms);
    self.add_forms<Rows, Columns>(k, l, forms);
  }

  void corner(int a) {
    const Stored* blocks[2] = {coefficients + self.layout_.block(a, a),
                               coefficients + self.layout_.block(a, a + 1)};
    double forms[4];
    contract_corner(blocks, PackedLayout::block_size(a), self.pairs_.data(), &self.x_[a], cubic(a),
                    forms);
    self.add_forms<1, 2>(a, a, forms);
    self.add_forms<1, 1>(a + 1, a + 1, forms + 2);
  }

  void diagonal(int l) {
    const Stored* block = coefficients + self.layout_.block(l, l);
    const double two = 2.0;  // as row and as column
    double form;
    contract_pairs<1, 1>(&block, 0, {0, PackedLayout::block_size(l)}, self.pairs_.data(),
                         &self.x_[l], &two, cubic(l), &form);
    self.add_forms<1, 1>(l, l, &form);
  }

  double* cubic(int k) { return self.cubic_.data() + self.layout_.row(k); }
};

template <int Rows, int Columns>
void Quartic::add_forms(int k, int l, const double* forms) {
  for (int c = 0; c < Columns; ++c)
    for (int r = 0; r < Rows; ++r) forms_[pair_count(l + c) + k + r] += forms[c * Rows + r];
}

double Quartic::value_and_gradient(const double* q, double* gradient) {
  set_variables(q);
  const std::size_t size = PackedLayout::block_size(dimension_);
  std::fill_n(cubic_.data(), size, 0.0);
  if (storage_ == Storage::double_precision)
    visit_blocks(dimension_ + 1, PairPass<double>{*this, coefficients_.data()});
  else
    visit_blocks(dimension_ + 1, PairPass<float>{*this, singles_.data()});
  const double value = form_value();
  for (std::size_t p = 0; p < size; p += kPack)
    store(&forms_[p], load<kPack>(&forms_[p]) + load<kPack>(&cubic_[p]));
  form_gradient(1.0, gradient);
  return value;
}

double Quartic::derivatives(const double* q, double* gradient, double* hessian) {
  set_variables(q);
  if (storage_ == Storage::double_precision)
    visit_blocks(dimension_ + 1, CubicPass<double>{*this, coefficients_.data()});
  else
    visit_blocks(dimension_ + 1, CubicPass<float>{*this, singles_.data()});
  const double value = form_value();
  add_cubic();
  form_gradient(1.0 / 3.0, gradient);
  unpack_hessian(hessian);
  return value;
}

/// Adds to the forms what cubic_ means for the Hessian: for block a and its form c_ij x_i x_j, the
/// form's gradient to (a, i), and x_a / 2 times the block itself.
void Quartic::add_cubic() {
  const int n = dimension_ + 1;
  const auto block = [&](int a) { return cubic_.data() + layout_.row(a); };
  form_gradients<kPack>(block, 0, n, x_.data(), stride_, rows_.data());
  for (int a = 0; a < n; ++a)
    for (int i = 0; i <= a; ++i) forms_[pair_count(a) + i] += rows_[a * stride_ + i];
  const Numbers half(0.5);
  int a = 0;
  for (; a + 1 < n; a += 2) {
    const std::size_t size = PackedLayout::padded(pair_count(a + 1));
    const Numbers x = half * Numbers(x_[a]), y = half * Numbers(x_[a + 1]);
    const double *first = block(a), *second = block(a + 1);
    std::size_t p = 0;
    for (; p < size; p += kPack)
      store(&forms_[p],
            load<kPack>(&forms_[p]) + x * load<kPack>(first + p) + y * load<kPack>(second + p));
    for (; p < PackedLayout::padded(pair_count(a + 2)); p += kPack)
      store(&forms_[p], load<kPack>(&forms_[p]) + y * load<kPack>(second + p));
  }
  for (std::size_t p = 0; a < n && p < PackedLayout::padded(pair_count(n)); p += kPack)
    store(&forms_[p], load<kPack>(&forms_[p]) + half * Numbers(x_[a]) * load<kPack>(block(a) + p));
}

/// gradient = factor * that of the form, by q.
void Quartic::form_gradient(double factor, double* gradient) {
  const int n = dimension_ + 1;
  const auto form = [&](int) { return forms_.data(); };
  form_gradients<kPack>(form, n - 1, n, x_.data(), stride_, rows_.data());
  for (int i = 1; i < n; ++i) gradient[i - 1] = factor * rows_[(n - 1) * stride_ + i];
}

double Quartic::form_value() const {
  Numbers sum(0.0);
  for (std::size_t p = 0; p < PackedLayout::block_size(dimension_); p += kPack)
    sum += load<kPack>(&forms_[p]) * load<kPack>(&pairs_[p]);
  double value;
  lane_sums<1>(&sum, &value);
  return value;
}

void Quartic::unpack_hessian(double* hessian) const {
  const int d = dimension_;
  const double* row = forms_.data() + 1;
  for (int a = 0; a < d; ++a) {
    ++row;  // behind the derivative by the constant
    for (int i = 0; i < a; ++i) hessian[a * d + i] = row[i];
    hessian[a * d + a] = 2.0 * row[a];
    row += a + 1;
  }
}

}  // namespace snapspace::online
