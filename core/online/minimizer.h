#pragma once
/// What every reduced minimiser says and takes.

namespace snapspace::online {

enum class Status : int {
  converged = 0,
  max_iterations = 1,
  line_search_failed = 2,
  not_finite = 3,
};

struct Report {
  Status status;
  int iterations;
  int evaluations;
  double value;
  double gradient_norm;
};

/// The three tests of Gill, Murray & Wright (1981; paper, sec. 6.2) with tolerance eps, all of
/// which must hold:
///   F_{k-1} - F_k     < eps (1 + |F_k|)
///   |q_{k-1} - q_k|   < sqrt(eps) (1 + |q_k|)
///   |grad F_k|        < cbrt(eps) (1 + |F_k|)
/// The "1 +" presumes a problem scaled to unit size, so values are measured in units of value_scale
/// and coordinates in units of coordinate_scale.
struct Termination {
  double tolerance = 1e-7;
  double value_scale = 1.0;
  double coordinate_scale = 1.0;
  int max_iterations = 200;
};

}  // namespace snapspace::online
