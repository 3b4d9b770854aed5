#pragma once
#include <algorithm>
#include <cmath>
/// Options and reports of the reduced minimisers.

namespace snapspace::online {

enum class Method : int { newton = 0, bfgs = 1 };

enum class Status : int {
  converged = 0,
  max_iterations = 1,
  line_search_failed = 2,
  not_finite = 3,
  max_evaluations = 4,
};

struct Report {
  Status status;
  int iterations;
  int evaluations;
  double value;
  double gradient_norm;
};

/// A step in time: how its solve ended, with the value of the objective alone, and that value at
/// the coordinates before the step.
struct StepReport {
  Report report;
  double before;
};

/// The three tests of Gill, Murray & Wright (1981; paper, sec. 6.2) with tolerance eps. All must
/// hold:
///   F_{k-1} - F_k     < eps (1 + |F_k|)
///   |q_{k-1} - q_k|   < sqrt(eps) (1 + |q_k|)
///   |grad F_k|        < cbrt(eps) (1 + |F_k|)
/// The "1 +" presumes a problem scaled to unit size, so values are measured in units of value_scale
/// and coordinates in units of coordinate_scale. The limits on iterations and evaluations end a
/// solve that does not converge.
struct Termination {
  double tolerance = 1e-7;
  double value_scale = 1.0;
  double coordinate_scale = 1.0;
  int max_iterations = 200;
  int max_evaluations = 500;
};

/// Whether all three tests hold for a step of the given length and decrease, near q of this length.
inline bool terminates(const Termination& stop, const Report& report, double decrease, double step,
                       double length) {
  const double value = 1.0 + std::abs(report.value) / stop.value_scale;
  const double slope_scale = stop.coordinate_scale / stop.value_scale;
  return decrease / stop.value_scale < stop.tolerance * value &&
         step / stop.coordinate_scale <
             std::sqrt(stop.tolerance) * (1.0 + length / stop.coordinate_scale) &&
         report.gradient_norm * slope_scale < std::cbrt(stop.tolerance) * value;
}

}  // namespace snapspace::online
