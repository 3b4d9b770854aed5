"""calibrate: makes a model that can estimate how far its frames are from full solutions."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from .arguments import require_count
from .certificate import (
    ErrorEstimator,
    ResidualSample,
    grown,
    growth_exponent,
    residual_sample,
    rest_size,
    scalar_diagonal,
)
from .mesh import mass_norm
from .reduction import (
    InterpolationModel,
    PosingModel,
    check_model,
    solved_coordinates,
    solved_sessions,
)
from .sampling import Domain
from .session.certify import movement
from .snapshots import Progress, Snapshots, solve_snapshots
from .validation import check_reference, reference_options

FloatArray = NDArray[np.float64]
Model = TypeVar("Model", bound=PosingModel | InterpolationModel)

#: Default number of full solutions.
SAMPLES = 50
#: Number of frames whose residuals choose the sampled vertices. They need no full solution.
TYPICAL_FRAMES = 32
#: Tolerance of these frames. Their residuals are forces that the subspace cannot balance.
TYPICAL_TOLERANCE = 1e-4
#: Distances and indicators below this share of the largest one are rounding errors.
ROUNDING = 1e-12


def calibrate(
    model: Model,
    *,
    samples: int | None = None,
    seed: int | None = None,
    reference: Snapshots | None = None,
    thorough: bool = True,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Model:
    """Returns the model with an `ErrorEstimator`, so that its sessions can give certificates.

    Solves the full and the reduced problem at new parameters, and stores the ratios of the true
    distances to two indicators that a session can compute: the residual at a few vertices, and how
    far a polish moves the shape. Default builds do this with their held-out samples, for quick
    certificates.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
        The model to calibrate.
    samples : int, default 50
        Number of full solutions, each two to four times as expensive as a snapshot. A confidence c
        needs at least c / (1 - c) of them: nine for 90 %, 99 for 99 %. With few solutions the
        bounds are wide.
    seed : int, default 0
        Seed of the parameters. Their random stream differs from those of `sample` and `validate`.
    reference : Snapshots, optional
        Known full solutions instead of new ones, as for `validate`.
    thorough : bool, default True
        Whether to measure how far a polish moves the shape: ten full iterations for each solution.
        Without it there are no thorough certificates.
    threads, progress : as for `solve_snapshots`

    Returns
    -------
    PosingModel or InterpolationModel
        A new model, which shares everything else with `model`.

    Raises
    ------
    ValueError
        For fewer than two samples, if fewer than two full solutions converged, for samples or a
        seed together with a reference, or for a reference that `validate` would refuse.
    KeyboardInterrupt
        On Ctrl-C.

    Notes
    -----
    The bounds hold for parameters drawn like the samples, uniformly from the domain, and for frames
    that start at the rest or mean shape. Another dimension of the model needs a new calibration.
    """
    check_model(model, "calibrate")
    seed = None if seed is None else require_count("calibrate", "seed", seed, at_least=0)
    full = _full(model, reference, samples=samples, seed=seed, threads=threads, progress=progress)
    typical = _parameters(model.problem.domain, TYPICAL_FRAMES, seed=seed or 0, stream=3)
    chosen = _sample(model, typical, threads=threads)
    mass = float(model.subspace.mass.sum())
    coordinates, measured = _measured(model, chosen, full, math.sqrt(mass), thorough=thorough)
    distances, residuals, movements = measured
    sizes = np.linalg.norm(coordinates, axis=1) / math.sqrt(mass)
    exponent = growth_exponent(residuals, distances, sizes)
    indicators = grown(residuals, np.maximum(sizes, rest_size(coordinates, mass)), exponent)
    estimator = ErrorEstimator(
        mass=mass,
        sample=chosen,
        coordinates=coordinates,
        residual_ratios=_ratios(distances, indicators),
        movement_ratios=_ratios(distances, movements) if thorough else None,
        exponent=exponent,
    )
    return replace(model, error_estimator=estimator)


def _full(
    model: Model,
    reference: Snapshots | None,
    *,
    samples: int | None,
    seed: int | None,
    threads: int | None,
    progress: Progress | None,
) -> Snapshots:
    """The full solutions to compare with, given or new."""
    if reference is not None:
        if samples is not None or seed is not None:
            raise ValueError(
                "calibrate: the parameters come from the reference, so samples and seed have no "
                "effect; leave them or the reference out"
            )
        check_reference(model, reference, who="calibrate")
        if len(reference) < 2:
            raise ValueError(
                "calibrate: the reference has one full solution, but at least two are needed; "
                "give one with more samples"
            )
        return reference
    count = SAMPLES if samples is None else samples
    count = require_count("calibrate", "samples", count, at_least=2)
    problem = model.problem
    # as tight as in `validate`: at 1e-7 the errors of a creature's frames come out 5 % too small
    solved = solve_snapshots(
        problem,
        _parameters(problem.domain, count, seed=seed or 0, stream=2),
        options=reference_options(problem),
        threads=threads,
        progress=progress,
    )
    full = solved.select(solved.converged)
    if len(full) < 2:
        raise ValueError(
            f"calibrate: {len(full)} of {count} full solutions converged, but at least two are "
            "needed; choose a smaller domain"
        )
    return full


def _parameters(domain: Domain, count: int, *, seed: int, stream: int) -> FloatArray:
    """Uniform random parameters (count, p); `sample` and `validate` use other streams."""
    random = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(stream,)))
    return domain.from_unit(random.random((count, domain.dimension)))


def _sample(
    model: PosingModel | InterpolationModel, parameters: FloatArray, *, threads: int | None
) -> ResidualSample:
    problem = model.problem
    coordinates = solved_coordinates(model, parameters, tolerance=TYPICAL_TOLERANCE)
    frames = model.subspace.shapes(coordinates) - problem.base
    sizes = (coordinates**2).sum(axis=1)
    inputs = problem.inputs(parameters)
    _, gradients = problem.system.evaluate(frames, inputs, threads=threads or 0)
    squares = (gradients.reshape(len(parameters), -1, 3) ** 2).sum(axis=2)
    moved = sizes > 0
    expected: FloatArray = (squares[moved] / sizes[moved, None]).sum(axis=0)
    return residual_sample(expected, scalar_diagonal(problem))


def _measured(
    model: PosingModel | InterpolationModel,
    chosen: ResidualSample,
    full: Snapshots,
    root_mass: float,
    *,
    thorough: bool,
) -> tuple[FloatArray, FloatArray]:
    """Coordinates (k, d) of frames; true distances and the two indicators, (3, k)."""
    problem = model.problem
    coordinates, measured = np.empty((len(full), model.dimension)), np.empty((3, len(full)))
    frames = zip(solved_sessions(model, full.parameters), full.displacements, strict=True)
    for column, (session, displacement) in enumerate(frames):
        solution = problem.base + displacement
        frame = problem.aligned(model.subspace.shape(session.q), solution)
        distance = mass_norm(model.subspace.mass, frame - solution) / root_mass
        coordinates[column] = session.q
        moved = movement(session) if thorough else math.nan
        measured[:, column] = distance, session.residual(chosen), moved
    return coordinates, measured


def _ratios(distances: FloatArray, indicators: FloatArray) -> FloatArray:
    """True distances over indicators; both are raised to at least the size of rounding errors."""
    tiny = np.finfo(np.float64).tiny
    above, below = (np.maximum(a, max(ROUNDING * a.max(), tiny)) for a in (distances, indicators))
    ratios: FloatArray = above / below
    return ratios
