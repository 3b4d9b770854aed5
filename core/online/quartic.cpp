#include "online/quartic.h"

#include <algorithm>

#include "simd/vectors.h"

namespace snapspace::online {

/// Lists the tiles of each pair of groups.
struct Quartic::Listing {
  std::vector<std::vector<Tile>>& tiles;

  template <int First>
  void diagonal(int g, PairPacks packs, std::size_t place) {
    tiles[pair_count(g) + g].push_back({First, packs, place});
  }
  template <int First>
  void tile(int g, int h, PairPacks packs, std::size_t place) {
    tiles[pair_count(h) + g].push_back({First, packs, place});
  }
};

Quartic::Quartic(int dimension, Storage storage)
    : capacity_(dimension),
      dimension_(dimension),
      storage_(storage),
      layout_(dimension + 1),
      tiles_(pair_count(layout_.groups())),
      coefficients_(storage == Storage::double_precision ? layout_.size() : 0),
      singles_(storage == Storage::single_precision ? layout_.size() : 0),
      linear_(dimension + 1),
      x_(dimension + 1),
      tile_x_(layout_.groups() * kTile),
      variables_(dimension + 1),
      pairs_(layout_.pairs() + kPack),
      weights_(layout_.pairs() + kPack),
      cubic_(layout_.form(layout_.groups()) + kPack),
      stride_(PackedLayout::padded(dimension + 1)),
      forms_(stride_ * (dimension + 1 + kTile)),
      gradient_(stride_) {
  layout_.visit(layout_.groups(), Listing{tiles_});
}

Quartic::Quartic(int dimension, const double* coefficients, Storage storage)
    : Quartic(dimension, storage) {
  const double one = 1.0;
  combine(1, &one, coefficients);
}

/// Writes the coefficients of (k, l), given by `block` with zeros after it, where passes read them.
template <class Stored>
void Quartic::write_block(int k, int l, const double* block, Stored* to) {
  const int g = layout_.place(k) / kTile, h = layout_.place(l) / kTile;
  const int row = layout_.place(k) % kTile, column = layout_.place(l) % kTile;
  for (const Tile& tile : tiles_[pair_count(h) + g]) {
    const int r = row - tile.first, c = g == h ? column - tile.first : column;
    if (r < 0) continue;
    const int rows = kTile - tile.first;
    const std::size_t blocks = g == h ? pair_count(rows) : rows * kTile;
    Stored* at = to + tile.place + (g == h ? pair_count(c) + r : c * rows + r) * kPack;
    for (int p = tile.packs.begin; p < tile.packs.end; ++p, at += blocks * kPack)
      std::copy_n(block + p * kPack, kPack, at);
  }
}

void Quartic::combine(int terms, const double* weights, const double* coefficients) {
  const int n = capacity_ + 1;
  const std::size_t total = quartic_count(n);
  double* sums = cubic_.data();
  for (int l = 0; l < n; ++l)
    for (int k = 0; k <= l; ++k) {
      const std::size_t size = pair_count(k + 1);
      for (std::size_t i = 0; i < size; ++i) sums[i] = weights[0] * coefficients[i];
      if (k > 0) std::fill(sums + size, sums + layout_.form_size(layout_.place(k) / kTile), 0.0);
      for (int t = 1; t < terms; ++t)
        add_scaled(weights[t], coefficients + t * total, sums, static_cast<int>(size));
      coefficients += size;
      if (k == 0)
        linear_[l] = storage_ == Storage::double_precision ? sums[0] : static_cast<float>(sums[0]);
      else if (storage_ == Storage::double_precision)
        write_block(k, l, sums, coefficients_.data());
      else
        write_block(k, l, sums, singles_.data());
    }
  std::fill_n(sums, layout_.form(layout_.groups()), 0.0);  // evaluations do not write all of it
}

void Quartic::set_variables(const double* q) {
  const int n = dimension_ + 1;
  x_[0] = 1.0;
  std::fill(std::copy_n(q, dimension_, x_.data() + 1), x_.data() + capacity_ + 1, 0.0);
  std::copy_n(x_.data() + 1, capacity_, &tile_x_[layout_.place(1)]);
  variables_.set(x_.data(), layout_.variable(layout_.groups_of(n)));
  double* pair = pairs_.data();
  for (int j = 0; j < n; ++j)
    for (int i = 0; i <= j; ++i) *pair++ = x_[i] * x_[j];
  std::fill(pair, pairs_.data() + layout_.pairs(), 0.0);
  std::fill_n(weights_.data(), layout_.pairs(), 0.0);
  std::fill_n(forms_.data(), stride_ * (n + kTile), 0.0);
}

[[gnu::always_inline]] inline void Quartic::add_sums(int g, int h, const TileSums& sums) {
  const int k = layout_.variable(g), l = layout_.variable(h);
  double forms[kTile * kTile];
  lane_sums<kTile * kTile>(sums.forms, forms);
  for (int c = 0; c < kTile; ++c) {
    double* to = row(l + c) + k;
    store(to, load<kTile>(to) + load<kTile>(forms + c * kTile));
  }
}

/// Computes the forms, and the weights: the sum over k and l of x_k x_l times the coefficients of
/// (k, l).
template <class Stored>
struct Quartic::PairPass {
  Quartic& self;
  const Stored* coefficients;

  template <int First>
  void diagonal(int g, PairPacks packs, std::size_t place) {
    contract<First, true>(g, g, packs, place);
  }
  template <int First>
  void tile(int g, int h, PairPacks packs, std::size_t place) {
    contract<First, false>(g, h, packs, place);
  }

  template <int First, bool Diagonal>
  void contract(int g, int h, PairPacks packs, std::size_t place) {
    TileSums sums(&self.tile_x_[g * kTile], &self.tile_x_[h * kTile]);
    contract_pairs<First, Diagonal>(coefficients + place, packs, self.pairs_.data(),
                                    self.weights_.data(), sums);
    self.add_sums(g, h, sums);
  }
};

/// Computes the forms and, in cubic_, for each variable a the sum over l of x_l times the
/// coefficients of (a, l) and over k of x_k times those of (k, a).
template <class Stored>
struct Quartic::CubicPass {
  Quartic& self;
  const Stored* coefficients;

  template <int First>
  void diagonal(int g, PairPacks packs, std::size_t place) {
    const FormGroup k = group(g);
    TileSums sums(k.x, k.x);
    contract_diagonal<First>(coefficients + place, packs, self.pairs_.data(), k, sums);
    self.add_sums(g, g, sums);
  }

  template <int First>
  void tile(int g, int h, PairPacks packs, std::size_t place) {
    const FormGroup k = group(g), l = group(h);
    TileSums sums(k.x, l.x);
    contract_tile<First>(coefficients + place, packs, self.pairs_.data(), k, l, sums);
    self.add_sums(g, h, sums);
  }

  FormGroup group(int g) {
    return {&self.tile_x_[g * kTile], self.cubic_.data() + self.layout_.form(g),
            self.layout_.form_size(g)};
  }
};

template <template <class> class Pass>
void Quartic::read_coefficients() {
  const int groups = layout_.groups_of(dimension_ + 1);
  if (storage_ == Storage::double_precision)
    layout_.visit(groups, Pass<double>{*this, coefficients_.data()});
  else
    layout_.visit(groups, Pass<float>{*this, singles_.data()});
}

double Quartic::value_and_gradient(const double* q, double* gradient) {
  set_variables(q);
  read_coefficients<PairPass>();
  add_weights();
  add_linear(1.0);
  return form_gradient(1.0, gradient);
}

double Quartic::derivatives(const double* q, double* gradient, double* hessian) {
  set_variables(q);
  read_coefficients<CubicPass>();
  add_cubic();
  add_weights();
  add_linear(3.0);
  const double value = form_gradient(1.0 / 3.0, gradient);
  const int d = dimension_;
  for (int a = 0; a < d; ++a) {
    const double* from = row(a + 1) + 1;
    std::copy_n(from, a, hessian + a * d);
    hessian[a * d + a] = 2.0 * from[a];
  }
  return value;
}

/// Adds the contribution of cubic_ to the Hessian. For variable a and its form c_ij x_i x_j: adds
/// the form's gradient to the entries (a, i) of the forms, and x_a / 2 times the form to the
/// weights.
void Quartic::add_cubic() {
  const int groups = layout_.groups_of(dimension_ + 1);
  std::fill_n(&cubic_[layout_.form(groups)], kPack, 0.0);  // is read, and may not be finite
  for (int g = 0; g < groups; ++g) {
    const int a = layout_.variable(g);
    const std::size_t size = layout_.form_size(g);
    const double* forms = &cubic_[layout_.form(g)];
    for (int r = 0; r < kTile; r += 2) {
      double* const gradients[2] = {row(a + r), row(a + r + 1)};
      const auto form_row = [&](int f, int j) { return forms + (r + f) * size + pair_count(j); };
      add_form_gradients<2>(form_row, a + kTile - 1, variables_, gradients);
    }
    Numbers factors[kTile];
    for (int r = 0; r < kTile; ++r) factors[r] = Numbers(0.5) * Numbers(tile_x_[g * kTile + r]);
    for (std::size_t p = 0; p < size; p += kPack) {
      Numbers weight = load<kPack>(&weights_[p]);
      for (int r = 0; r < kTile; ++r) weight += factors[r] * load<kPack>(forms + r * size + p);
      store(&weights_[p], weight);
    }
  }
}

/// Adds the weights, which are packed, to the forms.
void Quartic::add_weights() {
  const double* from = weights_.data();
  for (int j = 0; j <= dimension_; from += ++j)
    for (int i = 0; i <= j; ++i) row(j)[i] += from[i];
}

/// Adds a form that has `factor` times the gradient of the linear part.
void Quartic::add_linear(double factor) {
  for (int l = 0; l <= dimension_; ++l) {
    row(l)[0] += factor * linear_[l];
    row(0)[0] += factor * linear_[l] * x_[l];
  }
}

/// gradient = factor * the gradient of the form with respect to q. Returns the value of the
/// polynomial with this gradient.
double Quartic::form_gradient(double factor, double* gradient) {
  const int n = dimension_ + 1;
  std::fill_n(gradient_.data(), stride_, 0.0);
  double* const gradients[1] = {gradient_.data()};
  add_form_gradients<1>([&](int, int j) { return row(j); }, dimension_, variables_, gradients);
  double value = 0.0;
  for (int i = 0; i < n; ++i) value += x_[i] * gradient_[i];
  for (int i = 1; i < n; ++i) gradient[i - 1] = factor * gradient_[i];
  return 0.25 * factor * value;
}

}  // namespace snapspace::online
