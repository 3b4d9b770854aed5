#include "live/live_loop.h"

#include <memory>
#include <utility>

#include "live/second_thread.h"
#include "online/blended_cubature.h"
#include "online/blended_quartic.h"
#include "online/blended_stars.h"
#include "online/blending_solver.h"
#include "online/cubature.h"
#include "online/inertial_minimizer.h"
#include "online/posing_solver.h"
#include "online/quartic.h"

namespace snapspace::live {

namespace {

using online::BlendedCubature;
using online::BlendedQuartic;
using online::BlendedStars;
using online::BlendingSolver;
using online::Cubature;
using online::PosingSolver;
using online::Quartic;

template <class Function, class Interface>
class FunctionOf : public Interface {
 public:
  explicit FunctionOf(Function function) : function_(std::move(function)) {}

  [[nodiscard]] int dimension() const override { return function_.dimension(); }
  double value_and_gradient(const double* q, double* gradient) override {
    return function_.value_and_gradient(q, gradient);
  }
  double derivatives(const double* q, double* gradient, double* hessian) override {
    return function_.derivatives(q, gradient, hessian);
  }

 protected:
  Function function_;
};

template <class Function, class Interface>
class TetsOf : public FunctionOf<Function, Interface> {
 public:
  using FunctionOf<Function, Interface>::FunctionOf;
  [[nodiscard]] int tets() const override { return this->function_.tets(); }
  void curvatures(const double* q, float* hessians) override {
    this->function_.curvatures(q, hessians);
  }
  void stresses(const double* q, float* stresses) override {
    this->function_.stresses(q, stresses);
  }
};

template <class Function>
class BlendedOf final : public TetsOf<Function, BlendedFunction> {
 public:
  using TetsOf<Function, BlendedFunction>::TetsOf;
  [[nodiscard]] int poses() const override { return this->function_.poses(); }
  void set_weights(const double* weights) override { this->function_.set_weights(weights); }
};

template <class Elastic>
int inputs_of(const PosingSolver<Elastic>& solver) {
  return solver.handles();
}
template <class Elastic>
int inputs_of(const BlendingSolver<Elastic>& solver) {
  return solver.poses();
}

template <class Elastic>
void set_inputs_of(PosingSolver<Elastic>& solver, const double* offsets) {
  solver.set_offsets(offsets);
}
template <class Elastic>
void set_inputs_of(BlendingSolver<Elastic>& solver, const double* weights) {
  solver.set_weights(weights);
}

template <class Solver>
class SolverOf final : public LiveSolver {
 public:
  template <class... Arguments>
  explicit SolverOf(Arguments&&... arguments) : solver_(std::forward<Arguments>(arguments)...) {}

  [[nodiscard]] int dimension() const override { return solver_.dimension(); }
  double value_and_gradient(const double* q, double* gradient) override {
    return solver_.value_and_gradient(q, gradient);
  }
  double derivatives(const double* q, double* gradient, double* hessian) override {
    return solver_.derivatives(q, gradient, hessian);
  }
  [[nodiscard]] bool valid() const override { return solver_.valid(); }
  [[nodiscard]] int capacity() const override { return solver_.capacity(); }
  void set_dimension(int dimension) override { solver_.set_dimension(dimension); }
  online::Report solve(double* q, online::Method method, const online::Termination& stop) override {
    return solver_.solve(q, method, stop);
  }
  online::StepReport step(double* q, double weight, const double* target, online::Method method,
                          const online::Termination& stop) override {
    return solver_.step(inertia(), weight, target, method, q, stop);
  }
  double softest() override { return solver_.softest(inertia()); }
  [[nodiscard]] int inputs() const override { return inputs_of(solver_); }
  void set_inputs(const double* inputs) override { set_inputs_of(solver_, inputs); }

 private:
  online::InertialMinimizer& inertia() {
    if (!inertia_) inertia_ = std::make_unique<online::InertialMinimizer>(solver_.capacity());
    return *inertia_;
  }

  Solver solver_;
  std::unique_ptr<online::InertialMinimizer> inertia_;
};

online::Storage storage(bool single) {
  return single ? online::Storage::single_precision : online::Storage::double_precision;
}

Cubature make_cubature(const CubatureArrays& arrays) {
  const RowArrays& rows = arrays.rows;
  return {rows.dimension, rows.tets, rows.rows, arrays.weights, arrays.material, rows.clusters};
}

BlendedCubature make_cubature(const CubatureArrays& arrays, const PoseArrays& poses) {
  const RowArrays& rows = arrays.rows;
  return {rows.dimension, rows.tets,       rows.rows,
          arrays.weights, arrays.material, {poses.poses, poses.corners, poses.tau},
          rows.clusters};
}

BlendedStars make_stars(const StarArrays& arrays) {
  return {arrays.dimension,
          {arrays.poses, arrays.stars, arrays.rows, arrays.weights, arrays.material, arrays.origins,
           arrays.forms}};
}

/// A cubature for a live solve, which shares large evaluations with a second thread.
template <class Elastic>
Elastic with_second_thread(Elastic elastic) {
  elastic.set_half_runner(SecondThread::instance());
  return elastic;
}

template <class Elastic>
SolverPointer posing(Elastic elastic, const HandleArrays& handles) {
  return std::make_unique<SolverOf<PosingSolver<Elastic>>>(std::move(elastic), handles.handles,
                                                           handles.K, handles.L, handles.S);
}

}  // namespace

std::size_t coefficient_count(int dimension) {
  return online::quartic_count(static_cast<std::size_t>(dimension) + 1);
}

FunctionPointer quartic(int dimension, const double* coefficients, bool single) {
  return std::make_unique<FunctionOf<Quartic, ReducedFunction>>(
      Quartic(dimension, coefficients, storage(single)));
}

TetPointer cubature(const CubatureArrays& arrays) {
  return std::make_unique<TetsOf<Cubature, TetFunction>>(make_cubature(arrays));
}

BlendedPointer blended_cubature(const CubatureArrays& arrays, const PoseArrays& poses) {
  return std::make_unique<BlendedOf<BlendedCubature>>(make_cubature(arrays, poses));
}

BlendedPointer blended_stars(const StarArrays& arrays) {
  return std::make_unique<BlendedOf<BlendedStars>>(make_stars(arrays));
}

SolverPointer posing_solver(int dimension, const double* coefficients, bool single,
                            const HandleArrays& handles) {
  return posing(Quartic(dimension, coefficients, storage(single)), handles);
}

SolverPointer posing_solver(const CubatureArrays& arrays, const HandleArrays& handles) {
  return posing(with_second_thread(make_cubature(arrays)), handles);
}

SolverPointer blending_solver(int dimension, int poses, const double* coefficients, bool single) {
  return std::make_unique<SolverOf<BlendingSolver<BlendedQuartic>>>(
      BlendedQuartic(dimension, poses, coefficients, storage(single)));
}

SolverPointer blending_solver(const CubatureArrays& arrays, const PoseArrays& poses) {
  return std::make_unique<SolverOf<BlendingSolver<BlendedCubature>>>(
      with_second_thread(make_cubature(arrays, poses)));
}

SolverPointer blending_solver(const StarArrays& arrays) {
  return std::make_unique<SolverOf<BlendingSolver<BlendedStars>>>(
      with_second_thread(make_stars(arrays)));
}

}  // namespace snapspace::live
