#pragma once
#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings/arrays.h"
#include "bindings/released_gil.h"
#include "live/live_loop.h"

namespace snapspace {

inline const double* checked_coordinates(int dimension, const VectorIn& q) {
  require(q.size() == static_cast<std::size_t>(dimension), "q must have one entry per dimension");
  return q.data();
}

/// Value, gradient and full Hessian.
inline auto derivatives(live::ReducedFunction& function, const VectorIn& q) {
  const auto d = static_cast<std::size_t>(function.dimension());
  const double* at = checked_coordinates(function.dimension(), q);
  DoublesOut gradient = new_array<double>({d}), hessian = new_array<double>({d, d});
  double* H = hessian.data();
  const double value = [&] {
    const ReleasedGil released;  // Hessians of many tets take milliseconds
    return function.derivatives(at, gradient.data(), H);
  }();
  for (std::size_t i = 0; i < d; ++i)
    for (std::size_t j = 0; j < i; ++j) H[j * d + i] = H[i * d + j];
  return std::make_tuple(value, gradient, hessian);
}

inline auto value_and_gradient(live::ReducedFunction& function, const VectorIn& q) {
  const double* at = checked_coordinates(function.dimension(), q);
  DoublesOut gradient = new_array<double>({q.size()});
  const double value = function.value_and_gradient(at, gradient.data());
  return std::make_pair(value, gradient);
}

/// A function of the core. For Python its kinds differ only in their names.
struct ReducedFunction {
  live::FunctionPointer function;
};
struct Quartic : ReducedFunction {};
struct TetFunction : ReducedFunction {
  live::TetFunction* sum;  // the same function
};
struct Cubature : TetFunction {};
struct BlendedFunction : TetFunction {
  live::BlendedFunction* blend;  // the same function

  explicit BlendedFunction(live::BlendedPointer blended) : blend(blended.get()) {
    sum = blend;
    function = std::move(blended);
  }
};
struct BlendedCubature : BlendedFunction {
  using BlendedFunction::BlendedFunction;
};
struct BlendedStars : BlendedFunction {
  using BlendedFunction::BlendedFunction;
};

/// A live solver with its current coordinates, as many as its capacity.
struct LiveLoop {
  live::SolverPointer solver;
  std::vector<double> q;

  /// @throws std::invalid_argument  with this message if the solver is not valid
  LiveLoop(live::SolverPointer valid_solver, const char* message)
      : solver(std::move(valid_solver)) {
    require(solver->valid(), message);
    q.assign(static_cast<std::size_t>(solver->capacity()), 0.0);
  }
};

/// A loop with a quartic, or with a cubature, which takes offsets in the same way.
struct PosingLoop : LiveLoop {
  using LiveLoop::LiveLoop;
};
struct CubatureLoop : PosingLoop {
  using PosingLoop::PosingLoop;
};
/// A loop with quartics, or with a cubature, which takes weights in the same way.
struct BlendingLoop : LiveLoop {
  using LiveLoop::LiveLoop;
};
struct BlendedCubatureLoop : BlendingLoop {
  using BlendingLoop::BlendingLoop;
};
struct BlendedStarsLoop : BlendingLoop {
  using BlendingLoop::BlendingLoop;
};

/// The arrays of the handles of a posing problem; K gives the dimension.
inline live::HandleArrays handle_arrays(const MatrixIn& K, const TensorIn& L, const TensorIn& S,
                                        const char* message) {
  const std::size_t d = K.shape(0);
  require(K.shape(1) == d && L.shape(1) == d && L.shape(2) == 12 && S.shape(0) == L.shape(0) &&
              S.shape(1) == 4 && S.shape(2) == 4,
          message);
  return {static_cast<int>(L.shape(0)), K.data(), L.data(), S.data()};
}

}  // namespace snapspace
