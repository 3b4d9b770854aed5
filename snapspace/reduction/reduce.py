"""reduce: makes a model of a problem and a subspace."""

from __future__ import annotations

import json
from typing import Any, overload

from ..arguments import require_count, require_type
from ..cubature import BlendedSum, Cubature, train_blended_cubature, train_cubature
from ..mesh import EmbeddedSurface
from ..problem import InterpolationProblem, PosingProblem, is_quartic
from ..snapshots import Snapshots, check_snapshots_of
from ..subspace import AffineSubspace
from ..subspace.orthonormality import check_orthonormal
from ..thread_count import checked_threads
from .check_attached import check_attached
from .check_stiffness import check_stiffness_from
from .energy_choice import Energy, chosen_energy, fewest_snapshots
from .full_energy import FullBlends, FullEnergy, full_blends, full_energy
from .handle_quadric import handle_quadric
from .interpolation_model import InterpolationModel
from .posing_model import PosingModel
from .quartic import PoseQuartics, Quartic, pose_quartics, reduced_quartic
from .quartic_cost import warn_of_long_quartics
from .shown_surface import surface_in
from .training_samples import training_samples


@overload
def reduce(
    problem: PosingProblem,
    subspace: AffineSubspace,
    *,
    energy: Energy = "auto",
    snapshots: Snapshots | None = None,
    include_unconverged: bool = False,
    tets: int | None = None,
    stiffness_from: PosingModel | None = None,
    seed: int = 0,
    surface: EmbeddedSurface | None = None,
    threads: int | None = None,
    provenance: dict[str, Any] | None = None,
) -> PosingModel: ...
@overload
def reduce(
    problem: InterpolationProblem,
    subspace: AffineSubspace,
    *,
    energy: Energy = "auto",
    snapshots: Snapshots | None = None,
    include_unconverged: bool = False,
    tets: int | None = None,
    seed: int = 0,
    surface: EmbeddedSurface | None = None,
    threads: int | None = None,
    provenance: dict[str, Any] | None = None,
) -> InterpolationModel: ...
@overload
def reduce(
    problem: PosingProblem | InterpolationProblem,
    subspace: AffineSubspace,
    *,
    energy: Energy = "auto",
    snapshots: Snapshots | None = None,
    include_unconverged: bool = False,
    tets: int | None = None,
    stiffness_from: PosingModel | None = None,
    seed: int = 0,
    surface: EmbeddedSurface | None = None,
    threads: int | None = None,
    provenance: dict[str, Any] | None = None,
) -> PosingModel | InterpolationModel: ...
def reduce(
    problem: PosingProblem | InterpolationProblem,
    subspace: AffineSubspace,
    *,
    energy: Energy = "auto",
    snapshots: Snapshots | None = None,
    include_unconverged: bool = False,
    tets: int | None = None,
    stiffness_from: PosingModel | None = None,
    seed: int = 0,
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
    energy : "auto", "exact", "cubature" or "full", default "auto"
        exact: for St.Venant-Kirchhoff the reduced energy is a polynomial of degree four; its
        d^4 / 24 coefficients are computed from all tets. cubature: the energies of a few tets with
        positive weights, for all materials, trained on the snapshots; handles stay exact.
        full: the energy of all tets, at the cost of the mesh, for subspaces of hundreds of
        dimensions; such models are for experiments, and are not saved or shown in pages.
        auto: exact if the material allows it and d is at most 48, otherwise a cubature. At d = 48
        an evaluation of the quartic costs d^4 / 8 multiply-adds, twice the 18 r d of a cubature
        with the default r; exactness is worth that.
    snapshots : Snapshots, optional
        Snapshots of the problem. The model records their parameters and coordinates. A cubature
        needs at least ten that are not at rest, or two for blending. Its accuracy depends on their
        forces: settled snapshots are far from equilibrium, see `SolverOptions`.
    include_unconverged : bool, default False
        Whether to use snapshots that did not converge; `snapshot_pca` has the same option.
    tets : int, optional
        The largest number r of tets that a cubature may choose, or all tets if there are fewer.
        Default: for posing 8 d, but at most the larger of 1000 and 6.5 d; for blending 15 d, but
        at most 1000. The elements of a shell are triangles and hinges, by default 12 d, but at most
        1500; or stars, by default 8 d. The sum over all stars is exact and needs no training: it is
        the default for blends if 8 d is at least half of the stars.
    stiffness_from : PosingModel, optional
        For posing: a model of the same mesh with a cubature, in any subspace, such as a smaller
        one. Its tets estimate the stiffness that a new cubature is fitted with. Default: those of a
        rough fit, which takes a third of the time of a cubature.
    seed : int, default 0
        Seeds the random combinations of forces that a cubature is trained on.
    surface : EmbeddedSurface, optional
        The surface that pages and files show. Default: the boundary of the tets.
    threads : int, optional
        Default: all. The result does not depend on it.
    provenance : dict, optional
        Recorded in the model; must be valid JSON. The record of a cubature is added to it, with its
        errors on one snapshot in ten, which are held out, see `CubatureErrors`.

    Returns
    -------
    PosingModel or InterpolationModel
        With an exact energy its objective equals F at tau + U q for all q, and all affine motions
        of the handles or all weights of the poses. The same arguments give bitwise the same model.
        Its basis is the subspace's, rounded to single precision as in a file, so that saving loses
        nothing.

    Raises
    ------
    ValueError
        If the subspace belongs to another mesh, is not attached to the problem's tau or has a basis
        that is not M-orthonormal; if the surface belongs to another mesh; if the material does not
        allow the energy; if the snapshots are of another problem, or too few of them converged for
        a cubature; if `tets` is given without a cubature or is not between 1 and the number of tets
        of the mesh; if `stiffness_from` is given for blends or without a cubature, or has none of
        the same elements; or if the provenance is not valid JSON.

    Warns
    -----
    LongWorkNotice
        If an exact energy takes more than a minute, see `exact_seconds`.
    """
    checked_threads(threads, "reduce")
    require_count("reduce", "seed", seed, at_least=0)
    tets = None if tets is None else require_count("reduce", "tets", tets)
    record = _record(provenance)
    check_attached(problem, subspace, who="reduce")
    check_orthonormal(subspace, who="reduce")
    shown = surface_in(problem.mesh, surface, who="reduce")
    kind = chosen_energy(problem, subspace.dimension, energy)
    if kind != "cubature" and tets is not None:
        raise ValueError(f"reduce: tets is for energy='cubature'; '{kind}' takes all tets")
    if stiffness_from is not None:
        check_stiffness_from(problem, kind, stiffness_from)
    if kind == "exact":
        warn_of_long_quartics(problem, subspace.dimension)
    if snapshots is not None:
        check_snapshots_of(problem, snapshots, "reduce", "snapshots")
    used = snapshots
    if snapshots is not None and not include_unconverged and not snapshots.usable.all():
        used = snapshots.select(snapshots.usable)
    _check_snapshots(problem, subspace, energy, used, 0 if snapshots is None else len(snapshots))
    if kind != "full":  # full models are not saved to files
        subspace = subspace.in_single_precision()
    parameters, coordinates = training_samples(problem, subspace, used)
    if isinstance(problem, InterpolationProblem):
        blends: PoseQuartics | BlendedSum | FullBlends
        if kind == "exact":
            blends = pose_quartics(problem, subspace, threads=threads)
        elif kind == "full":
            blends = full_blends(problem, subspace, threads=threads)
        else:
            blends, record["cubature"] = train_blended_cubature(
                problem, subspace, coordinates, parameters, tets=tets, seed=seed, threads=threads
            )
        return InterpolationModel(
            problem=problem,
            subspace=subspace,
            blends=blends,
            surface=shown,
            training_parameters=parameters,
            training_coordinates=coordinates,
            provenance=record,
        )
    handles = handle_quadric(problem, subspace)
    elastic: Quartic | Cubature | FullEnergy
    if kind == "exact":
        elastic = reduced_quartic(problem.energy, subspace, threads=threads)
    elif kind == "full":
        elastic = full_energy(problem, subspace, threads=threads)
    else:
        elastic, record["cubature"] = train_cubature(
            problem,
            subspace,
            coordinates,
            2.0 * handles.K,
            tets=tets,
            stiffness_from=None if stiffness_from is None else stiffness_from.cubature,
            seed=seed,
            threads=threads,
        )
    return PosingModel(
        problem=problem,
        subspace=subspace,
        elastic=elastic,
        handles=handles,
        surface=shown,
        training_parameters=parameters,
        training_coordinates=coordinates,
        provenance=record,
    )


def _record(provenance: dict[str, Any] | None) -> dict[str, Any]:
    """A copy of the record; ValueError now unless a file can store it."""
    require_type("reduce", "provenance", provenance, dict | None, "give a dict, or None")
    record = dict(provenance or {})
    try:
        json.dumps({**record, "cubature": {}}, sort_keys=True)
    except (TypeError, ValueError) as error:
        raise ValueError(
            f"reduce: provenance must be valid JSON with strings as keys ({error}); give numbers "
            "of Python, such as float(x), strings, lists and dicts"
        ) from None
    return record


def _check_snapshots(
    problem: PosingProblem | InterpolationProblem,
    subspace: AffineSubspace,
    energy: Energy,
    used: Snapshots | None,
    given: int,
) -> None:
    """ValueError if too few of the given snapshots are used to train a cubature."""
    count = 0 if used is None else len(used)
    fewest = fewest_snapshots(problem, subspace.dimension, energy)
    if count >= fewest:
        return
    cure = f"give snapshots=solve_snapshots(...) with {fewest} samples or more"
    found = f"there are {count}"
    if given > count:
        found = f"only {count} of {given} converged"
        cure = "allow more iterations, choose a smaller domain, or pass include_unconverged=True"
    if is_quartic(problem):
        cure += ", or energy='exact'"
    raise ValueError(
        f"reduce: the energy of {problem.material.title} in {subspace.dimension} dimensions is a "
        f"cubature, which is trained on snapshots, but {found}; {cure}"
    )
