#include "bindings/arrays.h"
#include "bindings/released_gil.h"
#include "snapshots/evaluate.h"
#include "snapshots/solve.h"

namespace snapspace {

namespace {

struct Batch {
  DoublesOut shapes;
  std::vector<SolveReport> reports;
  long linear_iterations = 0;
};

/// Size of a sample's input, see LowRankSeed.
std::size_t input_size(const SampleSystem& system, const CoarseSpace* coarse) {
  const std::size_t d = coarse ? static_cast<std::size_t>(coarse->dimension()) : 0;
  return static_cast<std::size_t>(system.input_size()) + d * d;
}

Sample checked_sample(const SampleSystem& system, const CoarseSpace* coarse, int id, VectorIn input,
                      VectorIn start) {
  require(input.size() == input_size(system, coarse),
          "the input must be (input_size,), or with a coarse space (input_size + d * d,)");
  require(start.size() == static_cast<std::size_t>(system.size()), "the start must be (3n,)");
  return {
      id, {input.data(), input.data() + input.size()}, {start.data(), start.data() + start.size()}};
}

/// Solves rows of samples together, through a queue.
template <class Solve>
Batch solve_batch(const SampleSystem& system, const CoarseSpace* coarse, const MatrixIn& inputs,
                  const MatrixIn& starts, Solve solve) {
  require(inputs.shape(1) == input_size(system, coarse),
          "inputs must be (samples, input_size), or with a coarse space (samples, input_size + d * "
          "d)");
  require(starts.shape(0) == inputs.shape(0) &&
              starts.shape(1) == static_cast<std::size_t>(system.size()),
          "starts must be (samples, 3n)");
  const std::size_t count = inputs.shape(0), size = starts.shape(1), width = inputs.shape(1);
  Batch batch{new_array<double>({count, size}), std::vector<SolveReport>(count)};
  const ReleasedGil released;
  SampleQueue queue;
  for (std::size_t k = 0; k < count; ++k) {
    const double* input = inputs.data() + k * width;
    const double* start = starts.data() + k * size;
    queue.put({static_cast<int>(k), {input, input + width}, {start, start + size}});
  }
  queue.close();
  batch.linear_iterations = solve(queue, static_cast<int>(count));
  for (const Solution& solution : queue.collect(0.0)) {
    batch.reports[solution.id] = solution.report;
    std::copy(solution.shape.begin(), solution.shape.end(),
              batch.shapes.data() + solution.id * size);
  }
  return batch;
}

LowRankSeed checked_seed(const SampleSystem& system, const SoftModes* modes,
                         const CoarseSpace* coarse) {
  const auto size = static_cast<std::size_t>(system.size());
  require((!modes || modes->size() == size) && (!coarse || coarse->size() == size),
          "the modes belong to another system");
  require(!modes || !coarse, "a seed has soft modes or a coarse space, not both");
  return {modes, coarse};
}

using System = SampleSystem;

/// Binds what the systems of all problems share.
void bind_system(nb::module_& m) {
  nb::class_<System>(m, "SampleSystem",
                     "Data that all samples of a problem share, with the scalar factor.")
      .def_prop_ro(
          "inverse", [](const System& self) { return self.inverse.kind(); },
          "How the inverse of the scalar matrix is applied.")
      .def_prop_ro("inverse_products", [](const System& self) { return self.inverse.products(); })
      .def_prop_ro(
          "lowest_eigenvalue", [](const System& self) { return self.inverse.lowest_eigenvalue(); },
          "Lowest eigenvalue of cycle * scalar matrix if a cycle was made, even if unused.")
      .def_prop_ro("input_size", &System::input_size)
      .def_prop_ro(
          "patches",
          [](const System& self) { return self.patches() ? self.patches()->count() : 0; },
          "Number of patches whose rigid motions are in the seed; 0 for systems without them.")
      .def(
          "precondition",
          [](const System& self, VectorIn vector) {
            require(vector.size() == static_cast<std::size_t>(self.size()), "needs a (3n,) vector");
            DoublesOut result = new_array<double>({vector.size()});
            std::vector<double> shape(vector.size());
            self.numbering.to_internal(vector.data(), shape.data());
            Scratch scratch;
            self.inverse.apply(shape.data(), shape.data(), scratch);
            self.numbering.to_external(shape.data(), result.data());
            return result;
          },
          nb::arg("vector"),
          "The inverse of the scalar matrix, or its approximation, applied to x, y and z.")
      .def(
          "value_and_gradient",
          [](const System& self, VectorIn u, VectorIn inputs) {
            require(u.size() == static_cast<std::size_t>(self.size()) &&
                        inputs.size() == static_cast<std::size_t>(self.input_size()),
                    "needs a (3n,) vector and (input_size,) inputs");
            std::vector<double> shape(u.size()), gradient(u.size());
            self.numbering.to_internal(u.data(), shape.data());
            const double value =
                self.value_and_gradient(inputs.data(), shape.data(), gradient.data());
            DoublesOut result = new_array<double>({u.size()});
            self.numbering.to_external(gradient.data(), result.data());
            return std::make_pair(value, result);
          },
          nb::arg("u"), nb::arg("inputs"),
          "Objective at u (3n,) for inputs (input_size,), and its gradient.")
      .def(
          "evaluate",
          [](const System& self, MatrixIn shapes, MatrixIn inputs, int threads) {
            const std::size_t count = shapes.shape(0), size = shapes.shape(1);
            require(size == static_cast<std::size_t>(self.size()) && inputs.shape(0) == count &&
                        inputs.shape(1) == static_cast<std::size_t>(self.input_size()),
                    "needs (k, 3n) displacements and (k, input_size) inputs");
            DoublesOut values = new_array<double>({count}),
                       gradients = new_array<double>({count, size});
            {
              const ReleasedGil released;
              evaluate(self, static_cast<int>(count), inputs.data(), shapes.data(), values.data(),
                       gradients.data(), threads);
            }
            return std::make_pair(values, gradients);
          },
          nb::arg("shapes"), nb::arg("inputs"), nb::kw_only(), nb::arg("threads") = 0,
          "Objectives (k,) at displacements (k, 3n) for inputs (k, input_size), and their "
          "gradients (k, 3n). A pack computes several of them.")
      .def(
          "evaluate_in_pack",
          [](const System& self, MatrixIn shapes, MatrixIn inputs, int width, bool single) {
            const std::size_t count = shapes.shape(0), size = shapes.shape(1);
            require(size == static_cast<std::size_t>(self.size()) && inputs.shape(0) == count &&
                        inputs.shape(1) == static_cast<std::size_t>(self.input_size()) &&
                        count >= 1 && count <= static_cast<std::size_t>(width),
                    "needs (k, 3n) displacements and (k, input_size) inputs, 1 <= k <= width");
            DoublesOut values = new_array<double>({count}), products = new_array<double>({count}),
                       gradients = new_array<double>({count, size}),
                       images = new_array<double>({count, size});
            require(
                evaluate_in_pack(self, {width, single}, static_cast<int>(count), inputs.data(),
                                 shapes.data(),
                                 {values.data(), gradients.data(), products.data(), images.data()}),
                "needs a width of packs that this processor has");
            return std::make_tuple(values, gradients, products, images);
          },
          nb::arg("shapes"), nb::arg("inputs"), nb::kw_only(), nb::arg("width"), nb::arg("single"),
          "As `evaluate`, in one pack of this width: objectives (k,), gradients (k, 3n), products "
          "(k,) of gradients and images, and images (k, 3n): the inverse Hessian's seed times "
          "gradients.")
      .def(
          "put",
          [](const System& self, SampleQueue& queue, int id, VectorIn input, VectorIn start,
             const CoarseSpace* coarse) {
            queue.put(checked_sample(self, coarse, id, input, start));
          },
          nb::arg("queue"), nb::arg("id"), nb::arg("input"), nb::arg("start"), nb::kw_only(),
          nb::arg("coarse").none() = nb::none(),
          "Puts a sample into a queue: input as for solve_fast, start (3n,).")
      .def(
          "serve_fast",
          [](const System& self, SampleQueue& queue, int expected, double tolerance,
             int max_iterations, int threads, SolveControl& control, int lanes, bool single,
             double settling, const SoftModes* modes, const CoarseSpace* coarse) {
            const SolveOptions options{tolerance, settling, max_iterations, lanes, single, threads};
            const LowRankSeed seed = checked_seed(self, modes, coarse);
            const ReleasedGil released;
            solve_fast(self, seed, queue, expected, options, control);
          },
          nb::arg("queue"), nb::arg("expected"), nb::kw_only(), nb::arg("tolerance"),
          nb::arg("max_iterations"), nb::arg("threads"), nb::arg("control"), nb::arg("lanes") = 16,
          nb::arg("single") = false, nb::arg("settling") = 0.0,
          nb::arg("modes").none() = nb::none(), nb::arg("coarse").none() = nb::none(),
          "L-BFGS on the samples of a queue until it is closed and empty.")
      .def(
          "serve_newton",
          [](const System& self, SampleQueue& queue, int expected, double tolerance,
             int max_iterations, int threads, Projection projection, double threshold,
             SolveControl& control) {
            const ReleasedGil released;
            const SolveOptions options{
                .tolerance = tolerance, .max_iterations = max_iterations, .threads = threads};
            solve_newton(self, queue, expected, options, {projection, threshold}, control);
          },
          nb::arg("queue"), nb::arg("expected"), nb::kw_only(), nb::arg("tolerance"),
          nb::arg("max_iterations"), nb::arg("threads"), nb::arg("projection"),
          nb::arg("threshold"), nb::arg("control"),
          "Newton's method on the samples of a queue until it is closed and empty.")
      .def(
          "solve_fast",
          [](const System& self, MatrixIn inputs, MatrixIn starts, double tolerance,
             int max_iterations, int threads, SolveControl& control, int lanes, bool single,
             double settling, const SoftModes* modes, const CoarseSpace* coarse) {
            const SolveOptions options{tolerance, settling, max_iterations, lanes, single, threads};
            const LowRankSeed seed = checked_seed(self, modes, coarse);
            return solve_batch(self, coarse, inputs, starts, [&](SampleQueue& queue, int count) {
              solve_fast(self, seed, queue, count, options, control);
              return 0L;
            });
          },
          nb::arg("inputs"), nb::arg("starts"), nb::kw_only(), nb::arg("tolerance"),
          nb::arg("max_iterations"), nb::arg("threads"), nb::arg("control"), nb::arg("lanes") = 16,
          nb::arg("single") = false, nb::arg("settling") = 0.0,
          nb::arg("modes").none() = nb::none(), nb::arg("coarse").none() = nb::none(),
          "Solves by L-BFGS; inputs (samples, input_size), starts (samples, 3n). With a coarse "
          "space, inputs are (samples, input_size + d * d): an input ends with the inverse Hessian "
          "(d, d) of its sample on that space.")
      .def(
          "solve_newton",
          [](const System& self, MatrixIn inputs, MatrixIn starts, double tolerance,
             int max_iterations, int threads, Projection projection, double threshold,
             SolveControl& control) {
            const SolveOptions options{
                .tolerance = tolerance, .max_iterations = max_iterations, .threads = threads};
            return solve_batch(self, nullptr, inputs, starts, [&](SampleQueue& queue, int count) {
              return solve_newton(self, queue, count, options, {projection, threshold}, control);
            });
          },
          nb::arg("inputs"), nb::arg("starts"), nb::kw_only(), nb::arg("tolerance"),
          nb::arg("max_iterations"), nb::arg("threads"), nb::arg("projection"),
          nb::arg("threshold"), nb::arg("control"),
          "Solves by Newton's method; inputs (samples, input_size), starts (samples, 3n).");
}

}  // namespace

void bind_snapshots(nb::module_& m) {
  nb::enum_<SolveStatus>(m, "SolveStatus", "How a full-space solve ended.")
      .value("converged", SolveStatus::converged)
      .value("max_iterations", SolveStatus::max_iterations)
      .value("line_search_failed", SolveStatus::line_search_failed)
      .value("not_finite", SolveStatus::not_finite)
      .value("cancelled", SolveStatus::cancelled);

  nb::class_<SolveReport>(m, "SolveReport", "How the solve of one sample ended.")
      .def_ro("status", &SolveReport::status)
      .def_ro("iterations", &SolveReport::iterations)
      .def_ro("evaluations", &SolveReport::evaluations)
      .def_ro("value", &SolveReport::value, "Objective at the returned shape.")
      .def_ro("gradient_norm", &SolveReport::gradient_norm, "Euclidean norm of its gradient.")
      .def_ro("decrement", &SolveReport::decrement,
              "-g.d of the last direction d: twice the decrease that the quadratic model predicts.")
      .def_ro("seconds", &SolveReport::seconds, "Wall time from the start to the end of the solve.")
      .def_ro("inverted_tets", &SolveReport::inverted_tets);

  nb::class_<SolveControl>(m, "SolveControl",
                           "Shared with a running solve: cancels it, and counts finished samples.")
      .def(nb::init<>())
      .def("cancel", [](SolveControl& self) { self.cancelled = true; })
      .def_prop_ro("cancelled", [](const SolveControl& self) { return self.cancelled.load(); })
      .def_prop_ro("finished", [](const SolveControl& self) { return self.finished.load(); });

  nb::class_<Solution>(m, "Solution", "A solved sample.")
      .def_ro("id", &Solution::id)
      .def_ro("report", &Solution::report)
      .def_prop_ro(
          "shape",
          [](Solution& self) { return DoublesOut(self.shape.data(), {self.shape.size()}); },
          nb::rv_policy::reference_internal, "(3n,) displacement, in the memory of the solution.");

  nb::class_<SampleQueue>(m, "SampleQueue",
                          "Passes samples to the threads that solve them, and solutions back.")
      .def(nb::init<>())
      .def("close", &SampleQueue::close, "Declares that no more samples will come.")
      .def("running", &SampleQueue::running,
           "Samples that are being solved, with their evaluations so far.")
      .def(
          "collect",
          [](SampleQueue& self, nb::typed<nb::list, Solution> into, double seconds) {
            std::vector<Solution> finished;
            {
              const ReleasedGil released;
              finished = self.collect(seconds);
            }
            for (Solution& solution : finished) into.append(std::move(solution));
          },
          nb::arg("into"), nb::arg("seconds"),
          "Appends the solutions since the last call to a list; waits up to this many seconds for "
          "one. They are not returned, because a KeyboardInterrupt would lose a returned list.");

  nb::class_<Batch>(m, "Batch", "Solutions of one call.")
      .def_prop_ro(
          "shapes", [](const Batch& self) { return self.shapes; }, nb::rv_policy::automatic,
          "(samples, 3n) displacements from rest.")
      .def_ro("reports", &Batch::reports)
      .def_ro("linear_iterations", &Batch::linear_iterations,
              "Conjugate gradient iterations of all samples together (Newton only).");

  bind_system(m);
}

}  // namespace snapspace
