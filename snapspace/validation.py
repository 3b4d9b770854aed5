"""How far a reduced model is from the full problem, on parameters that it has not seen."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .mesh import mass_norms
from .reduction import ReducedModel
from .snapshots import Snapshots, SolverOptions, solve_snapshots
from .snapshots.solve import Progress

FloatArray = NDArray[np.float64]

#: The reference is solved until twice the predicted decrease is below this share of F, or a
#: hundredth of the tolerance that snapshots have. On the Dragon its shapes are then within 1e-4 of
#: the limit, relative to the displacement.
REFERENCE_TOLERANCE = 1e-9


@dataclass(frozen=True)
class Validation:
    """Errors and costs on unseen parameters, (k,) for the k samples whose full solve converged.

    error : |x_red - x_full|_M / |x_full - tau|_M of the reduced solve from tau, the rest or mean
    shape; of interpolations after rigid registration
    projection_error : the same for the M-projection of x_full into the subspace: the least possible
    energy_ratio : objective of the reduced solution over that of the full one
    iterations : of BFGS
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


def unseen_parameters(model: ReducedModel, count: int, *, seed: int) -> FloatArray:
    """Uniform random parameters (count, p) from a stream that `sample` never draws from."""
    if count < 1:
        raise ValueError(f"validate: the number of samples is {count}, but must be at least 1")
    stream = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(1,)))
    domain = model.problem.domain
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
    parameters = unseen_parameters(model, samples, seed=seed)
    tolerance = min(REFERENCE_TOLERANCE, 0.01 * model.problem.snapshot_tolerance)
    options = SolverOptions(tolerance=tolerance, max_iterations=5000)
    solved = solve_snapshots(
        model.problem, parameters, options=options, threads=threads, progress=progress
    )
    reference = solved.select(solved.converged)
    if len(reference) == 0:
        raise ValueError(
            "validate: no full solution converged, so there is nothing to compare with"
        )

    subspace = model.subspace
    session = model.session()
    shapes, frames = [], []
    for w in reference.parameters:
        session.reset()
        begin = time.perf_counter()
        report = session.set_parameters(w)
        shapes.append(session.vertices.reshape(-1))
        frames.append((report, 1e3 * (time.perf_counter() - begin)))
    full = reference.shapes
    reduced = np.array(
        [model.problem.aligned(shape, onto) for shape, onto in zip(shapes, full.T, strict=True)]
    ).T
    projected = subspace.tau[:, None] + subspace.basis @ subspace.coordinates(full)
    size = mass_norms(subspace.mass, full - subspace.tau[:, None])
    full_values = np.array([report.value for report in reference.reports])
    return Validation(
        error=mass_norms(subspace.mass, reduced - full) / size,
        projection_error=mass_norms(subspace.mass, projected - full) / size,
        energy_ratio=np.array([report.value for report, _ in frames]) / full_values,
        iterations=np.array([report.iterations for report, _ in frames]),
        solve_ms=np.array([1e3 * report.seconds for report, _ in frames]),
        frame_ms=np.array([milliseconds for _, milliseconds in frames]),
        reference=reference,
    )


def _statistics(values: NDArray[Any]) -> dict[str, float]:
    return {
        "mean": float(np.mean(values)),
        "median": float(np.median(values)),
        "std": float(np.std(values)),
        "max": float(np.max(values)),
    }
