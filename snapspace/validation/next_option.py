"""next_option: what to build next for a smaller error."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

from ..problem import InterpolationProblem, PosingProblem
from ..reduction import (
    Energy,
    ReducedModel,
    default_blended_tets,
    default_tets,
    training_tolerance,
)
from ..sampling import Method
from .error_split import ErrorSplit, Part

#: An error of more than so many projection errors is worth an advice: motions of default models
#: have three to seven, blends two to fourteen.
FACTOR = 3.0
#: Growth of tets and of samples, and of the dimension.
MORE, LARGER = 2.0, 1.5
#: Up to so many modes an exact energy stays exact.
MOST_EXACT = 60


@dataclass(frozen=True)
class NextOption:
    """The part of a model's error that is largest, and what to build next for it.

    part : "subspace", "stiffness" or "cubature", see `ErrorSplit`
    samples, dimension : those of the model where only its tets are too few, else larger ones
    tets : of a cubature; None for an exact energy, and for the default of `reduce`
    energy : of `reduce`, "auto" where that says the same
    tolerance : of the samples, where their problem's own is not tight enough for a cubature
    method : of `sample`
    """

    part: Part
    samples: int
    dimension: int
    tets: int | None
    energy: Energy = "auto"
    tolerance: float | None = None
    method: Method = "sobol"

    @property
    def reason(self) -> str:
        """What the largest part means, for people."""
        return {
            "subspace": "the subspace does not hold the shapes",
            "stiffness": "the subspace is too stiff: it cannot relax as the full mesh does",
            "cubature": "the tets of the cubature are too few",
        }[self.part]

    @property
    def python(self) -> str:
        """The calls that build it, for a problem and a model at hand."""
        method = "" if self.method == "sobol" else f', method="{self.method}"'
        tight = "" if self.tolerance is None else _tight(self.tolerance)
        energy = "" if self.energy == "auto" else f', energy="{self.energy}"'
        tets = "" if self.tets is None else f", tets={self.tets}"
        return (
            f"parameters = sample(problem.domain, {self.samples}{method}); "
            f"snapshots = solve_snapshots(problem, parameters{tight}); "
            f"model = reduce(problem, snapshot_pca(snapshots, dimension={self.dimension}), "
            f"snapshots=snapshots{energy}{tets})"
        )


def next_option(model: ReducedModel, split: ErrorSplit) -> NextOption:
    """The option that the largest part of the error asks for.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    split : ErrorSplit of this model

    Returns
    -------
    NextOption
        For the cubature, twice as many tets, at least as many as `reduce` takes by default, with
        the same samples and dimension. Otherwise a dimension larger by half, from twice as many
        samples, and at least two for each mode: a larger subspace of the same samples would fit
        these alone.
    """
    problem, cubature = model.problem, model.cubature
    tets = None if cubature is None else len(cubature.tets)
    part, solved = split.largest, max(_solved(model), model.dimension)
    method: Method = "sobol"
    usual = default_tets(model.dimension)
    if isinstance(problem, InterpolationProblem):
        # of two poses `blends` would add no more than the middle
        method = "blends" if problem.parameter_count > 2 else "sobol"
        usual = default_blended_tets(model.dimension)
    if part == "cubature" and tets is not None and tets < len(problem.mesh.tets):
        wanted = min(max(ceil(MORE * tets), usual), len(problem.mesh.tets))
        tolerance = _tolerance(model, model.dimension, "cubature")
        return NextOption(part, solved, model.dimension, wanted, "cubature", tolerance, method)
    dimension = ceil(LARGER * model.dimension)
    samples = max(ceil(MORE * solved), 2 * dimension)
    energy: Energy = "exact" if tets is None and dimension <= MOST_EXACT else "auto"
    tolerance = _tolerance(model, dimension, energy)
    return NextOption(part, samples, dimension, None, energy, tolerance, method)


def needs_advice(error: float, projection: float) -> bool:
    """Whether a median error is more than three times that of the projections."""
    return bool(error > FACTOR * projection)


def _tight(tolerance: float) -> str:
    return f", options=SolverOptions(tolerance={tolerance:g})"


def _tolerance(model: ReducedModel, dimension: int, energy: Energy) -> float | None:
    """Of the samples for a cubature, where the usual ones are for an exact energy."""
    problem = model.problem
    assert isinstance(problem, PosingProblem | InterpolationProblem)
    if problem.material.exact_degree != 4:
        return None
    return training_tolerance(problem, dimension, energy)


def _solved(model: ReducedModel) -> int:
    """Samples that were solved for the model: those known beforehand do not count."""
    known = len(model.problem.poses) if isinstance(model.problem, InterpolationProblem) else 0
    return max(len(model.training_parameters) - known, 0)
