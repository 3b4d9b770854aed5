"""How far a reduced model is from the full problem, on parameters that it has not seen."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .mesh import mass_norms
from .reduction import ReducedModel
from .sampling import Domain
from .session import FrameReport
from .snapshots import Progress, Snapshots, SolverOptions, solve_snapshots

FloatArray = NDArray[np.float64]

#: The reference is solved until twice the predicted decrease is below this share of F, or a
#: hundredth of the tolerance that snapshots have. On the Dragon its shapes are then within 1e-4 of
#: the limit, relative to the displacement.
REFERENCE_TOLERANCE = 1e-10


@dataclass(frozen=True)
class Validation:
    """Errors and costs on unseen parameters, (k,) for the k samples whose full solve converged.

    error : |x_red - x_full|_M / |x_full - tau|_M of the reduced solve from tau, the rest or mean
    shape; of interpolations after rigid registration
    projection_error : the same for the M-projection of x_full into the subspace: the least possible
    energy_ratio : objective of the reduced solution over that of the full one
    iterations : of the session
    solve_ms, frame_ms : milliseconds of the solve, and of the solve and all vertices
    reference : the full solutions
    """

    error: FloatArray
    projection_error: FloatArray
    energy_ratio: FloatArray
    iterations: NDArray[np.int64]
    solve_ms: FloatArray
    frame_ms: FloatArray
    reference: Snapshots

    def as_json(self, dimension: int) -> dict[str, Any]:
        """The figures with the keys of `snapspace validate --json`."""
        return {
            "samples": len(self.error),
            "dimension": dimension,
            "error": _statistics(self.error),
            "projection_error": _statistics(self.projection_error),
            "energy_ratio": _statistics(self.energy_ratio),
            "iterations": _statistics(self.iterations),
            "solve_ms": {
                "median": float(np.median(self.solve_ms)),
                "max": float(self.solve_ms.max()),
            },
            "frame_ms": {
                "median": float(np.median(self.frame_ms)),
                "max": float(self.frame_ms.max()),
            },
        }


def unseen_parameters(domain: Domain, count: int, *, seed: int) -> FloatArray:
    """Uniform random parameters (count, p) from a stream that `sample` never draws from."""
    if count < 1:
        raise ValueError(f"validate: the number of samples is {count}, but must be at least 1")
    stream = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(1,)))
    return domain.from_unit(stream.random((count, domain.dimension)))


def validate(
    model: ReducedModel,
    *,
    samples: int = 30,
    seed: int = 1,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Validation:
    """Compares reduced solutions with tightly converged full ones at unseen parameters.

    Parameters
    ----------
    model : ReducedModel
    samples : int, default 30
    seed : int, default 1
        The parameters come from a stream that `sample` never draws from.
    threads, progress : as for `solve_snapshots`

    Returns
    -------
    Validation

    Raises
    ------
    ValueError
        If no full solution converged.
    """
    parameters = unseen_parameters(model.problem.domain, samples, seed=seed)
    tolerance = min(REFERENCE_TOLERANCE, 0.01 * model.problem.solving.tolerance)
    options = SolverOptions(tolerance=tolerance, max_iterations=5000)
    solved = solve_snapshots(
        model.problem, parameters, options=options, threads=threads, progress=progress
    )
    reference = solved.select(solved.converged)
    if len(reference) == 0:
        raise ValueError(
            "validate: no full solution converged, so there is nothing to compare with"
        )

    errors, frames = _compared(model, reference)
    full_values = np.array([report.value for report in reference.reports])
    return Validation(
        error=errors[:, 0],
        projection_error=errors[:, 1],
        energy_ratio=np.array([report.value for report, _ in frames]) / full_values,
        iterations=np.array([report.iterations for report, _ in frames]),
        solve_ms=np.array([1e3 * report.seconds for report, _ in frames]),
        frame_ms=np.array([milliseconds for _, milliseconds in frames]),
        reference=reference,
    )


def unseen_errors(model: ReducedModel, reference: Snapshots) -> FloatArray:
    """Errors (k,) of reduced solves from tau against full solutions, as `Validation.error`.

    Raises
    ------
    ValueError
        If the reference is of another problem.
    """
    reference.check_known(model.problem, "unseen_errors")
    errors: FloatArray = _compared(model, reference)[0][:, 0]
    return errors


def _compared(
    model: ReducedModel, reference: Snapshots
) -> tuple[FloatArray, list[tuple[FrameReport, float]]]:
    """Errors (k, 2), see `_errors`, and reports with the milliseconds of frames."""
    session = model.session()
    solutions, frames = [], []
    for w in reference.parameters:
        session.reset()
        begin = time.perf_counter()
        report = session.set_parameters(w)
        _ = session.vertices
        frames.append((report, 1e3 * (time.perf_counter() - begin)))
        solutions.append(session.q.copy())
    return _errors(model, reference, np.array(solutions)), frames


def _errors(model: ReducedModel, reference: Snapshots, solutions: FloatArray) -> FloatArray:
    """Errors of reduced solutions (k, d) and of projections, (k, 2); one shape at a time."""
    problem, subspace = model.problem, model.subspace
    rows = reference.displacements.shifted(problem.base - subspace.tau)
    projections = subspace.row_coordinates(rows)
    errors = np.empty((len(rows), 2))
    for target, row, solution, projection in zip(errors, rows, solutions, projections, strict=True):
        full = subspace.tau + row
        reduced = problem.aligned(subspace.shape(solution), full)
        projected = subspace.shape(projection)
        misses = np.column_stack([reduced - full, projected - full, row])
        norms = mass_norms(subspace.mass, misses)
        target[:] = norms[:2] / norms[2]
    return errors


def _statistics(values: NDArray[Any]) -> dict[str, float]:
    return {
        "mean": float(np.mean(values)),
        "median": float(np.median(values)),
        "std": float(np.std(values)),
        "max": float(np.max(values)),
    }
