#pragma once
#include <cstddef>
#include <vector>

#include "element/rest_tet.h"
#include "material/lame.h"
#include "reduction/vertex_modes.h"

namespace snapspace {

/// The six rows of A for a tet of St.Venant-Kirchhoff material: its strain, a quadratic function of
/// q, with coefficients for 1, the q_i, and the q_i q_j with i <= j, sorted by j. The squares of
/// the rows add up to the energy of the tet.
class StrainRows {
 public:
  StrainRows(const VertexModes& modes, int dimension);

  [[nodiscard]] int columns() const { return columns_; }

  /// Row s of the tet, s < 6: columns() numbers, valid until the next fill().
  const double* row(int s) const { return &rows_[s * stride_]; }
  void fill(const RestTet& tet, const Lame& lame);

 private:
  using Wide = Lanes<kWideLanes>;

  void fill_gradients(const RestTet& tet);
  void fill_strain(int a, int b, double* row) const;
  void scale(double volume, const Lame& lame);

  /// Entry (r, c) of the displacement gradients of all modes.
  [[nodiscard]] const Wide* gradient(int r, int c) const {
    return &gradients_[(3 * r + c) * packs_];
  }
  [[nodiscard]] double gradient(int r, int c, int mode) const {
    return reinterpret_cast<const double*>(gradient(r, c))[mode];
  }

  const VertexModes& modes_;
  int dimension_, packs_, columns_;
  std::size_t stride_;  // with space for a pack after the columns
  std::vector<Wide> gradients_;
  std::vector<double> rows_;
};

}  // namespace snapspace
