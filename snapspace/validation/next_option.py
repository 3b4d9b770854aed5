"""next_option: advises what to build next for a smaller error."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

from ..arguments import require_type
from ..problem import InterpolationProblem, PosingProblem, is_quartic
from ..reduction import (
    Energy,
    ReducedModel,
    check_model,
    default_blended_tets,
    default_tets,
    element_count,
    has_hinges,
    has_stars,
    training_tolerance,
)
from ..sampling import Method
from .error_split import ErrorSplit, Part

#: Advice is given if the error is more than this many times the projection error. Default models
#: have factors of three to seven for motions, and of two to fourteen for blends.
FACTOR = 3.0
#: Growth factors of tets and samples, and of the dimension.
MORE, LARGER = 2.0, 1.5
#: Up to this many modes an exact energy stays exact.
MOST_EXACT = 60


@dataclass(frozen=True)
class NextOption:
    """The largest part of a model's error that a build can reduce, and what to build next for it.

    part : "subspace", "stiffness" or "cubature", see `ErrorSplit`
    samples, dimension : those of the model if only its tets are too few, otherwise larger ones
    tets : number of tets of a cubature; None for an exact energy, and for the default of `reduce`
    energy : option of `reduce`; "auto" if that gives the same energy
    tolerance : tolerance of the samples, if their problem's own is not tight enough for a cubature
    method : option of `sample`
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
        """The meaning of the largest part, in words."""
        return {
            "subspace": "the subspace cannot represent the shapes",
            "stiffness": "the subspace is too stiff: it cannot relax as the full mesh does",
            "cubature": "the tets of the cubature are too few",
        }[self.part]

    @property
    def python(self) -> str:
        """The calls that build it, for a given `problem` and `import snapspace as ss`."""
        tight = "" if self.tolerance is None else _options_argument(self.tolerance)
        energy = "" if self.energy == "auto" else f', energy="{self.energy}"'
        tets = "" if self.tets is None else f", tets={self.tets}"
        return (
            f'parameters = ss.sample(problem.domain, {self.samples}, method="{self.method}"); '
            f"snapshots = ss.solve_snapshots(problem, parameters{tight}); "
            f"model = ss.reduce(problem, ss.snapshot_pca(snapshots, dimension={self.dimension}), "
            f"snapshots=snapshots{energy}{tets})"
        )


def next_option(model: ReducedModel, split: ErrorSplit) -> NextOption:
    """The option that reduces the largest part of the error that a build can reduce.

    A build cannot move a frame to another minimum of the energy, see `ErrorSplit`.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    split : ErrorSplit of this model

    Returns
    -------
    NextOption
        For the cubature, twice as many tets, at least as many as `reduce` takes by default, with
        the same samples and dimension. Otherwise 1.5 times the dimension from twice as many
        samples, at least two per mode: a larger subspace of the same samples would fit only these.

    Raises
    ------
    ValueError
        For something other than a model and a split.
    """
    check_model(model, "next_option")
    require_type("next_option", "split", split, ErrorSplit, "give that of split_errors")
    problem, cubature = model.problem, model.cubature
    tets = None if cubature is None else len(cubature.tets)
    part, solved = split.largest_built, max(_solved_samples(model), model.dimension)
    method: Method = "sobol"
    usual = default_tets(model.dimension, shell=has_hinges(problem))
    if isinstance(problem, InterpolationProblem):
        # for two poses `blends` would only add the middle
        method = "blends" if problem.parameter_count > 2 else "sobol"
        usual = default_blended_tets(model.dimension, stars=has_stars(model.problem))
    available = element_count(problem)
    if part == "cubature" and tets is not None and tets < available:
        wanted = min(max(ceil(MORE * tets), usual), available)
        tolerance = _training_tolerance(model, model.dimension, "cubature")
        return NextOption(part, solved, model.dimension, wanted, "cubature", tolerance, method)
    dimension = ceil(LARGER * model.dimension)
    samples = max(ceil(MORE * solved), 2 * dimension)
    energy: Energy = "exact" if tets is None and dimension <= MOST_EXACT else "auto"
    tolerance = _training_tolerance(model, dimension, energy)
    return NextOption(part, samples, dimension, None, energy, tolerance, method)


def needs_advice(error: float, projection: float) -> bool:
    """Whether a median error is more than three times that of the projections."""
    return bool(error > FACTOR * projection)


def _options_argument(tolerance: float) -> str:
    return f", options=ss.SolverOptions(tolerance={tolerance:g})"


def _training_tolerance(model: ReducedModel, dimension: int, energy: Energy) -> float | None:
    """Tolerance of the samples for a cubature, if the usual one is meant for an exact energy."""
    problem = model.problem
    assert isinstance(problem, PosingProblem | InterpolationProblem)
    if not is_quartic(problem):
        return None
    return training_tolerance(problem, dimension, energy)


def _solved_samples(model: ReducedModel) -> int:
    """Number of samples solved for the model, without those known beforehand."""
    known = len(model.problem.poses) if isinstance(model.problem, InterpolationProblem) else 0
    return max(len(model.training_parameters) - known, 0)
