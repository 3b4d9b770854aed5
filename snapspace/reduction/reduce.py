"""reduce: a problem and a subspace become a model."""

from __future__ import annotations

from typing import Any, overload

from ..mesh import EmbeddedSurface
from ..problem import InterpolationProblem, PosingProblem
from ..snapshots import Snapshots
from ..subspace import AffineSubspace
from .handle_quadric import handle_quadric
from .interpolation_model import InterpolationModel
from .posing_model import PosingModel
from .quartic import pose_quartics, reduced_quartic
from .shown_surface import surface_in
from .training import check_attached, training


@overload
def reduce(
    problem: PosingProblem,
    subspace: AffineSubspace,
    *,
    snapshots: Snapshots | None = None,
    surface: EmbeddedSurface | None = None,
    threads: int | None = None,
    provenance: dict[str, Any] | None = None,
) -> PosingModel: ...
@overload
def reduce(
    problem: InterpolationProblem,
    subspace: AffineSubspace,
    *,
    snapshots: Snapshots | None = None,
    surface: EmbeddedSurface | None = None,
    threads: int | None = None,
    provenance: dict[str, Any] | None = None,
) -> InterpolationModel: ...
def reduce(
    problem: PosingProblem | InterpolationProblem,
    subspace: AffineSubspace,
    *,
    snapshots: Snapshots | None = None,
    surface: EmbeddedSurface | None = None,
    threads: int | None = None,
    provenance: dict[str, Any] | None = None,
) -> PosingModel | InterpolationModel:
    """Restricts a problem to a subspace (paper, sec. 6.1).

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
    subspace : AffineSubspace
        Attached to the problem's tau.
    snapshots : Snapshots, optional
        Recorded in the model by parameters and coordinates.
    surface : EmbeddedSurface, optional
        That pages and files show. Default: that of the tets.
    threads : int, optional
        Default: all. The result does not depend on it.
    provenance : dict, optional
        Recorded in the model; must be valid JSON.

    Returns
    -------
    PosingModel or InterpolationModel
        Exact: its objective equals F at tau + U q for all q, and all affine motions of the handles
        or all weights of the poses.

    Raises
    ------
    ValueError
        If the subspace is of another mesh or not attached to the problem's tau, or the surface is
        of another mesh.
    """
    check_attached(problem, subspace, who="reduce")
    shown = surface_in(problem.mesh, surface, who="reduce")
    parameters, coordinates = training(problem, subspace, snapshots)
    if isinstance(problem, PosingProblem):
        return PosingModel(
            problem=problem,
            subspace=subspace,
            elastic=reduced_quartic(problem.energy, subspace, threads=threads),
            handles=handle_quadric(problem, subspace),
            surface=shown,
            training_parameters=parameters,
            training_coordinates=coordinates,
            provenance=provenance or {},
        )
    return InterpolationModel(
        problem=problem,
        subspace=subspace,
        coefficients=pose_quartics(problem, subspace, threads=threads),
        surface=shown,
        training_parameters=parameters,
        training_coordinates=coordinates,
        provenance=provenance or {},
    )
