#pragma once
#include <vector>

#include "element/rest_tet.h"

namespace snapspace::online {

/// The gradient of the energy of a surface that is as rigid as possible, see VertexStars, from its
/// triangles. A vertex has the rotation R nearest to the mean S of F T^T over its triangles, with
/// their tangent frames T, and a triangle has the stress of the sum over its corners of F - R T. So
/// it is right where the triangles around all neighbours are given too.
class StarGradient {
 public:
  /// @param kind  the density ShellArap
  StarGradient(int kind, int vertices) : kind_(kind), means_(vertices), turns_(vertices) {}

  /// Adds `weight` times the gradient by `displacement` (3 per vertex).
  /// @param numbers  rows of ShellArap
  void add(const RestTet* triangles, int count, const double* numbers, const double* displacement,
           double weight, double* gradient);

 private:
  struct Mean {
    double S[3][3], weight;
  };
  struct Turn {
    double W[3][3];  // R - I
  };
  void find_turns();

  int kind_;
  std::vector<Mean> means_;
  std::vector<Turn> turns_;
};

}  // namespace snapspace::online
