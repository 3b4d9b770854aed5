#pragma once
#include <Eigen/SparseCore>
#include <cmath>
#include <cstdint>
#include <vector>

namespace snapspace {

/// Springs from points of a surface, which lie inside tets, to their targets: the energy is
/// stiffness * sum_i area_i |(W u)_i - target_i|^2, in displacements. Row i of W has the weights of
/// point i.
class SurfaceSprings {
 public:
  /// @param corners  count x 4 vertices   @param weights  count x 4, rows sum to one
  /// @param areas    one per point        @param places   internal index of the caller's vertices
  SurfaceSprings(const std::int32_t* corners, const double* weights, const double* areas, int count,
                 const std::vector<std::int32_t>& places)
      : areas_(areas, areas + count) {
    begin_.reserve(count + 1);
    begin_.push_back(0);
    for (int i = 0; i < count; ++i) {
      // A point at a vertex has only one entry.
      for (int j = 4 * i; j < 4 * i + 4; ++j)
        if (weights[j] != 0.0) entries_.push_back({places[corners[j]], weights[j]});
      begin_.push_back(static_cast<std::int32_t>(entries_.size()));
    }
  }

  [[nodiscard]] int size() const { return static_cast<int>(areas_.size()); }

  /// Energy at u; adds its gradient to `gradient`.
  double value_and_gradient(double stiffness, const double* targets, const double* u,
                            double* gradient) const {
    double value = 0.0;
    for (int i = 0; i < size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const double offset = coordinate(i, c, u) - targets[3 * i + c];
        const double force = stiffness * areas_[i] * offset;
        value += force * offset;
        spread(i, c, 2.0 * force, gradient);
      }
    return value;
  }

  /// Adds the Hessian times v to `product`.
  void add_product(double stiffness, const double* v, double* product) const {
    for (int i = 0; i < size(); ++i)
      for (int c = 0; c < 3; ++c)
        spread(i, c, 2.0 * stiffness * areas_[i] * coordinate(i, c, v), product);
  }

  /// The Hessian, n x n: it is the same for x, y and z.
  [[nodiscard]] Eigen::SparseMatrix<double> scalar_hessian(double stiffness, int n) const {
    std::vector<Eigen::Triplet<double>> triplets;
    for (int i = 0; i < size(); ++i)
      for (std::int32_t j = begin_[i]; j < begin_[i + 1]; ++j)
        for (std::int32_t k = begin_[i]; k < begin_[i + 1]; ++k)
          triplets.emplace_back(
              entries_[j].vertex, entries_[k].vertex,
              2.0 * stiffness * areas_[i] * entries_[j].weight * entries_[k].weight);
    Eigen::SparseMatrix<double> H(n, n);
    H.setFromTriplets(triplets.begin(), triplets.end());
    return H;
  }

  /// Root of the area-weighted mean of the squared distances between points and targets.
  [[nodiscard]] double deviation(const double* targets, const double* u) const {
    double sum = 0.0, area = 0.0;
    for (int i = 0; i < size(); ++i) {
      area += areas_[i];
      for (int c = 0; c < 3; ++c) {
        const double offset = coordinate(i, c, u) - targets[3 * i + c];
        sum += areas_[i] * offset * offset;
      }
    }
    return std::sqrt(sum / area);
  }

 private:
  struct Entry {
    std::int32_t vertex;
    double weight;
  };

  [[nodiscard]] double coordinate(int i, int c, const double* u) const {
    double sum = 0.0;
    for (std::int32_t k = begin_[i]; k < begin_[i + 1]; ++k)
      sum += entries_[k].weight * u[3 * entries_[k].vertex + c];
    return sum;
  }

  void spread(int i, int c, double force, double* gradient) const {
    for (std::int32_t k = begin_[i]; k < begin_[i + 1]; ++k)
      gradient[3 * entries_[k].vertex + c] += entries_[k].weight * force;
  }

  std::vector<double> areas_;
  std::vector<std::int32_t> begin_;  // entries of point i are [begin_[i], begin_[i + 1])
  std::vector<Entry> entries_;
};

}  // namespace snapspace
