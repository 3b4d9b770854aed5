#include "snapshots/sample_system.h"

#include "snapshots/lane_objective.h"

namespace snapspace {

double SampleSystem::value_and_gradient(const double* input, const double* u,
                                        double* gradient) const {
  const auto single = objective();
  SweepVisitor idle;
  single->load(0, input);
  return single->value_and_gradient(u, gradient, idle);
}

}  // namespace snapspace
