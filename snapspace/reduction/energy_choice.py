"""The choice of a problem's reduced energy: exact, a cubature, or that of the full mesh."""

from __future__ import annotations

from typing import Literal

from ..cubature import FEWEST_BLENDS, FEWEST_SNAPSHOTS, default_tets
from ..mesh import ShellMesh
from ..problem import InterpolationProblem, PosingProblem, is_quartic

Energy = Literal["auto", "exact", "cubature", "full"]
#: The energies that model files and pages can hold, and all energies.
STORED_ENERGIES: tuple[Energy, ...] = ("auto", "exact", "cubature")
ENERGIES: tuple[Energy, ...] = (*STORED_ENERGIES, "full")

#: How much more than a cubature an exact quartic may cost. It needs no tight snapshots and has no
#: error. On the Dragon, d = 40, a warm solve takes 0.17 ms with it and 0.10 ms with 320 tets.
EXACTNESS = 2.0


def chosen_energy(
    problem: PosingProblem | InterpolationProblem, dimension: int, energy: Energy = "auto"
) -> Literal["exact", "cubature", "full"]:
    """The kind of energy that `reduce` makes; see `reduce`.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
    dimension : int
        The dimension of the subspace.
    energy : "auto", "exact", "cubature" or "full"
        The user's choice.

    Raises
    ------
    ValueError
        For an unknown choice, or an exact energy of a material whose density is not a quartic.
    """
    if energy not in ENERGIES:
        raise ValueError(
            f"reduce: unknown energy '{energy}'; known are {', '.join(map(str, ENERGIES))}"
        )
    quartic = is_quartic(problem)
    if energy == "exact" and not quartic:
        body = problem.material.title
        if isinstance(problem.mesh, ShellMesh):
            body = f"a shell of {body}"
        raise ValueError(
            f"reduce: the energy of {body} is not a polynomial of degree four, so it has no exact "
            "form; use energy='cubature', or tets of the material StVK"
        )
    if energy != "auto":
        return energy
    # poses are blended in few dimensions, and their quartics need no training
    blends = isinstance(problem, InterpolationProblem)
    return "exact" if quartic and (blends or _quartic_pays(dimension)) else "cubature"


def fewest_snapshots(
    problem: PosingProblem | InterpolationProblem, dimension: int, energy: Energy = "auto"
) -> int:
    """The smallest number of snapshots that `reduce` accepts for training a cubature.

    Ten for posing. Two for blending, since blends are few and lie between known poses.
    """
    if chosen_energy(problem, dimension, energy) != "cubature":
        return 0
    return FEWEST_BLENDS if isinstance(problem, InterpolationProblem) else FEWEST_SNAPSHOTS


def training_tolerance(
    problem: PosingProblem | InterpolationProblem, dimension: int, energy: Energy = "auto"
) -> float | None:
    """The tolerance of snapshots that the energy needs; None for the problem's own.

    See `posing_traits` for the reasons.
    """
    if chosen_energy(problem, dimension, energy) != "cubature":
        return None
    return problem.solving.tolerance


def _quartic_pays(dimension: int) -> bool:
    """Whether a quartic is worth its cost in multiply-adds per evaluation: up to d = 48.

    With the Hessian, a quartic takes three for each of its d^4 / 24 coefficients. A cubature takes
    18 for each tet and mode.
    """
    quartic = 3.0 * dimension**4 / 24.0
    return quartic <= EXACTNESS * 18.0 * default_tets(dimension) * dimension
