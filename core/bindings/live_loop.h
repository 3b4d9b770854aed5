#pragma once
#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings/arrays.h"
#include "online/minimizer.h"

namespace snapspace {

inline const double* checked(int dimension, const VectorIn& q) {
  require(q.size() == static_cast<std::size_t>(dimension), "q must have one entry per dimension");
  return q.data();
}

/// Value, gradient and full Hessian of anything that has derivatives().
template <class Function>
auto derivatives(Function& function, const VectorIn& q) {
  const auto d = static_cast<std::size_t>(function.dimension());
  const double* at = checked(function.dimension(), q);
  DoublesOut gradient = new_array<double>({d}), hessian = new_array<double>({d, d});
  double* H = hessian.data();
  const double value = function.derivatives(at, gradient.data(), H);
  for (std::size_t i = 0; i < d; ++i)
    for (std::size_t j = 0; j < i; ++j) H[j * d + i] = H[i * d + j];
  return std::make_tuple(value, gradient, hessian);
}

template <class Function>
auto value_and_gradient(Function& function, const VectorIn& q) {
  const double* at = checked(function.dimension(), q);
  DoublesOut gradient = new_array<double>({q.size()});
  const double value = function.value_and_gradient(at, gradient.data());
  return std::make_pair(value, gradient);
}

/// A live solver with its current coordinates, as many as the solver can take.
template <class Solver>
struct Loop {
  Solver solver;
  std::vector<double> q;
};

template <class Solver>
void require_valid(const Solver& solver, const char* message) {
  if (!solver.valid()) throw std::invalid_argument(message);
}

/// What the loops of all problems have in common.
template <class Solver>
void bind_loop(nb::class_<Loop<Solver>>& loop) {
  using Self = Loop<Solver>;
  loop.def_prop_rw(
          "q",
          [](const Self& self) {
            return copy_to_array(self.q.data(),
                                 {static_cast<std::size_t>(self.solver.dimension())});
          },
          [](Self& self, VectorIn q) {
            std::copy_n(checked(self.solver.dimension(), q), q.size(), self.q.data());
          },
          nb::for_getter(nb::rv_policy::automatic))
      .def_prop_rw(
          "dimension", [](const Self& self) { return self.solver.dimension(); },
          [](Self& self, int dimension) {
            require(1 <= dimension && dimension <= self.solver.capacity(),
                    "dimension must be between 1 and that of the model");
            const auto kept = std::min(dimension, self.solver.dimension());
            std::fill(self.q.begin() + kept, self.q.end(), 0.0);
            self.solver.set_dimension(dimension);
          })
      .def(
          "value_and_gradient",
          [](Self& self, VectorIn q) { return value_and_gradient(self.solver, q); }, nb::arg("q"))
      .def(
          "hessian",
          [](Self& self, VectorIn q) { return std::get<2>(derivatives(self.solver, q)); },
          nb::arg("q"))
      .def(
          "solve",
          [](Self& self, online::Method method, double tolerance, int max_iterations,
             int max_evaluations, double value_scale, double coordinate_scale) {
            return self.solver.solve(
                self.q.data(), method,
                {tolerance, value_scale, coordinate_scale, max_iterations, max_evaluations});
          },
          nb::kw_only(), nb::arg("method"), nb::arg("tolerance"), nb::arg("max_iterations"),
          nb::arg("max_evaluations"), nb::arg("value_scale"), nb::arg("coordinate_scale"));
}

/// For the loops of posing: the handles' offsets.
template <class Solver>
void bind_offsets(nb::class_<Loop<Solver>>& loop) {
  loop.def(
      "set_offsets",
      [](Loop<Solver>& self, TensorIn offsets) {
        require(offsets.shape(0) == static_cast<std::size_t>(self.solver.handles()) &&
                    offsets.shape(1) == 3 && offsets.shape(2) == 4,
                "offsets must be (handles, 3, 4)");
        self.solver.set_offsets(offsets.data());
      },
      nb::arg("offsets"));
}

/// For the loops of blending: the weights of the poses.
template <class Solver>
void bind_weights(nb::class_<Loop<Solver>>& loop) {
  loop.def(
      "set_weights",
      [](Loop<Solver>& self, VectorIn weights) {
        require(weights.size() == static_cast<std::size_t>(self.solver.poses()),
                "weights must have one entry per pose");
        self.solver.set_weights(weights.data());
      },
      nb::arg("weights"));
}

}  // namespace snapspace
