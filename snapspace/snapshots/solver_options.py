"""SolverOptions: how samples are solved."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Literal

import numpy as np

from .. import _core as core
from ..arguments import is_finite, is_number, is_whole, wrong_type
from ..problem import Problem, Projection

Solver = Literal["fast", "newton"]
Precision = Literal["single", "double"]
SOLVERS: tuple[Solver, ...] = ("fast", "newton")
PROJECTIONS: tuple[Projection, ...] = ("stretches", "clamp", "absolute")
PRECISIONS: tuple[Precision, ...] = ("single", "double")

#: Single precision is as good as double down to this tolerance: 64 samples of the Dragon, stable
#: neo-Hookean, end at the same median distance of 6e-4 from tight solutions, after as many
#: evaluations and in 0.7 of the time.
SINGLE_TOLERANCE = 1e-6
#: Below this, single precision takes more evaluations than double, and may not converge. On soft
#: bodies that happens at 1e-5: see `needs_another_try`.
SINGLE_LIMIT = 1e-7
#: With `settling`, samples whose energy converges earlier, for instance those at rest, stop at this
#: tolerance.
SETTLED_TOLERANCE = 1e-6
#: In single precision the energies of tets must be far from the ends of the range, 1e-38 and 1e38.
SINGLE_ENERGIES = 1e-22, 1e22

#: Largest value of the core's integers.
MOST_ITERATIONS = 2**31 - 1


@dataclass(frozen=True, kw_only=True)
class SolverOptions:
    """How samples are solved.

    Parameters
    ----------
    solver : "fast" or "newton", default "fast"
        L-BFGS, preconditioned by a scalar factor that all samples share, or the paper's Newton
        method (sec. 4.2).
    tolerance : float, optional
        Converged when twice the decrease that the solver's model predicts is below tolerance * F,
        and for "fast" the mean decrease of the last 8 iterations is as well. Default: the
        problem's, see `SolverTraits`; if the problem has a `settling`, that test decides instead.
    settling : float, optional
        "fast" only: also converged when 8 search directions as long as the last 4 (steps to the
        minimum of the solver's model) would together be shorter than this share of the sample's
        displacement, in the norm of the lumped masses. A subspace needs shapes, not energies: on a
        fine mesh the energy keeps decreasing while only wrinkles of the surface move. Default: the
        problem's, see `SolverTraits`, or a fifth of it without soft modes, where steps are too
        short. If a tolerance is given, the default is 0, which disables the test.
    soft_modes : bool, default True
        "fast" only: L-BFGS is seeded with the lowest modes of a posing problem, in addition to the
        scalar factor. Without them it takes half as many steps again, and soft parts converge late.
    max_iterations : int, default 5000
        Limit per sample; a sample that needs more has the status max_iterations. Most take fewer
        than 200, but long thin bodies such as springs, and tails with tets of varying size, take
        thousands.
    projection : "stretches", "clamp" or "absolute", optional
        Newton only: how the Hessian of a tet becomes positive semi-definite. stretches: it is
        evaluated at singular values raised to `clamp` (paper, sec. 4.2), the default for
        St.Venant-Kirchhoff. clamp, the default for all others: negative eigenvalues become zero
        (Teran, Sifakis, Irving, Fedkiw 2005). absolute: they change their sign (Chen et al. 2024).
    clamp : float, default 0.65
        Newton with the projection stretches only: smallest singular value; the paper uses 0.5 to
        0.8.
    precision : "single" or "double", optional
        "fast" only: precision of shapes and gradients while solving; objectives and inner products
        are always summed in double precision. Default: single if settling decides and for
        tolerances of 1e-6 and more, which takes half the time and changes shapes by less than the
        errors that these tests leave. Double if the mesh's units are so small or large that
        energies would leave the range of single precision. A sample that rounding stops before it
        converges, as on soft bodies, continues in double precision.
    block : int, optional
        Number of samples that are solved together. They start from the samples of earlier blocks,
        see `Schedule`: larger blocks keep more cores busy, smaller ones give better starts. Default
        16 for "fast", 2 for "newton".

    Raises
    ------
    ValueError
        For an unknown solver, projection or precision, or a number of another type or out of range.
    """

    solver: Solver = "fast"
    tolerance: float | None = None
    settling: float | None = None
    soft_modes: bool = True
    max_iterations: int = 5000
    projection: Projection | None = None
    clamp: float = 0.65
    precision: Precision | None = None
    block: int | None = None

    def __post_init__(self) -> None:
        if self.solver not in SOLVERS:
            raise ValueError(
                f"SolverOptions: unknown solver '{self.solver}'; known are {', '.join(SOLVERS)}"
            )
        for name in ("tolerance", "settling", "clamp"):
            optional = name != "clamp" and getattr(self, name) is None
            if not optional and not is_number(getattr(self, name)):
                raise wrong_type("SolverOptions", name, getattr(self, name), "give a number")
        for name in ("max_iterations", "block"):
            optional = name == "block" and getattr(self, name) is None
            if not optional and not is_whole(getattr(self, name)):
                raise wrong_type("SolverOptions", name, getattr(self, name), "give a whole number")
        if self.tolerance is not None and not (is_finite(self.tolerance) and self.tolerance > 0):
            raise ValueError(
                f"SolverOptions: tolerance is {self.tolerance}, but it must be positive"
            )
        if self.tolerance is not None and self.tolerance >= 1:
            raise ValueError(
                f"SolverOptions: tolerance is {self.tolerance}, but it must be below 1: it is "
                "a share of the objective, and every start would count as converged"
            )
        if self.settling is not None and not (is_finite(self.settling) and self.settling >= 0):
            raise ValueError(
                f"SolverOptions: settling is {self.settling}, but it must be zero or positive"
            )
        if self.max_iterations < 1:
            raise ValueError(
                f"SolverOptions: max_iterations is {self.max_iterations}, but must be at least 1"
            )
        if self.max_iterations > MOST_ITERATIONS:
            raise ValueError(
                f"SolverOptions: max_iterations is {self.max_iterations}, but must be at "
                f"most {MOST_ITERATIONS}"
            )
        if self.projection not in (None, *PROJECTIONS):
            raise ValueError(
                f"SolverOptions: unknown projection '{self.projection}'; known are "
                f"{', '.join(PROJECTIONS)}"
            )
        if not 0 < self.clamp <= 1:
            raise ValueError(f"SolverOptions: clamp is {self.clamp}, but it must be in (0, 1]")
        if self.precision not in (None, *PRECISIONS):
            raise ValueError(
                f"SolverOptions: unknown precision '{self.precision}'; known are "
                f"{', '.join(PRECISIONS)}"
            )
        if self.block is not None and self.block < 1:
            raise ValueError(f"SolverOptions: block is {self.block}, but must be at least 1")

    def resolved(self, problem: Problem) -> ResolvedOptions:
        """The options for a problem, with all defaults resolved."""
        settling = self._settling(problem)
        usual = SETTLED_TOLERANCE if settling > 0 else problem.solving.tolerance
        tolerance = usual if self.tolerance is None else float(self.tolerance)
        single = self.precision == "single"
        if self.precision is None:
            resolves = settling > 0 or tolerance >= SINGLE_TOLERANCE
            single = resolves and _in_range(problem)
        if single and tolerance < SINGLE_LIMIT:
            raise ValueError(
                f"SolverOptions: precision single resolves tolerances down to "
                f"{SINGLE_LIMIT:.0e}, not {tolerance:g}; use double"
            )
        return ResolvedOptions(
            solver=self.solver,
            tolerance=tolerance,
            settling=settling,
            soft_modes=self.soft_modes and self.solver == "fast",
            max_iterations=self.max_iterations,
            projection=self.projection or problem.solving.projection,
            clamp=self.clamp,
            single=single and self.solver == "fast",
            block=self.block or (16 if self.solver == "fast" else 2),
        )

    def _settling(self, problem: Problem) -> float:
        if self.solver == "newton":
            return 0.0
        if self.settling is not None:
            return float(self.settling)
        if self.tolerance is not None:
            return 0.0
        return problem.solving.settling * (1.0 if self.soft_modes else 0.2)


@dataclass(frozen=True, kw_only=True)
class ResolvedOptions:
    """All options on which the solutions of samples depend.

    The fields are as in `SolverOptions`; `single` says whether shapes are in single precision.
    """

    solver: Solver
    tolerance: float
    settling: float
    soft_modes: bool
    max_iterations: int
    projection: Projection
    clamp: float
    single: bool
    block: int

    def modes_of(self, problem: Problem) -> core.SoftModes | None:
        """The soft modes that seed the solutions of a problem, if any."""
        return problem.solving.soft_modes() if self.soft_modes else None

    def as_key(self) -> dict[str, Any]:
        """The options by name, for the record and for the key of a run."""
        return asdict(self)


def _in_range(problem: Problem) -> bool:
    """Whether the energies of average tets at a strain of one fit into single precision."""
    mesh = problem.mesh
    energies = problem.material.stiffness * (mesh.diagonal**3 / len(mesh.elements))
    return bool(SINGLE_ENERGIES[0] < np.min(energies) and np.max(energies) < SINGLE_ENERGIES[1])
