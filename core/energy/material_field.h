#pragma once
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "material/tet_material.h"
#include "mesh/star_hats.h"

namespace snapspace {

/// The material of a mesh, which owns its moduli: one row for all tets, or one per tet.
class MaterialField {
 public:
  /// @param moduli  rows x material_moduli(kind)
  /// @throws std::invalid_argument  if no density has this name, or the sizes do not fit
  /// @param hats  of the stars of an as-rigid-as-possible surface
  MaterialField(const char* name, std::vector<double> moduli, int rows, StarHats hats = {})
      : kind_(material_index(name)),
        rows_(rows),
        moduli_(std::move(moduli)),
        hats_(std::move(hats)) {
    if (kind_ < 0) throw std::invalid_argument("unknown material '" + std::string(name) + "'");
    if (rows < 1 || moduli_.size() != static_cast<std::size_t>(rows) * material_moduli(kind_))
      throw std::invalid_argument("moduli must be (1 or tets, " +
                                  std::to_string(material_moduli(kind_)) + ")");
  }

  [[nodiscard]] TetMaterial view() const { return {kind_, rows_, moduli_.data()}; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] const StarHats& hats() const { return hats_; }
  [[nodiscard]] const char* name() const { return material_name(kind_); }
  [[nodiscard]] bool fits(std::size_t tets) const {
    return rows_ == 1 || static_cast<std::size_t>(rows_) == tets;
  }

  /// The material of the same mesh in another order: entry i is that of tet order[i], and vertex i
  /// is vertices[i].
  /// @throws std::invalid_argument  if the material has moduli for a different number of tets
  [[nodiscard]] MaterialField reordered(const std::vector<std::int32_t>& order,
                                        const std::vector<std::int32_t>& vertices) const {
    if (!fits(order.size()))
      throw std::invalid_argument("the material has moduli for a different number of tets");
    MaterialField result = *this;
    result.hats_ = hats_.renumbered(vertices);
    if (rows_ == 1) return result;
    const int count = material_moduli(kind_);
    for (std::size_t i = 0; i < order.size(); ++i)
      for (int k = 0; k < count; ++k)
        result.moduli_[i * count + k] = moduli_[static_cast<std::size_t>(order[i]) * count + k];
    return result;
  }

 private:
  int kind_, rows_;
  std::vector<double> moduli_;
  StarHats hats_;
};

}  // namespace snapspace
