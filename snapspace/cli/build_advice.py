"""build_advice: advice for a model that was just built and is not good."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..accurate import plan_of
from ..mesh import TetMesh, tet_volumes
from ..problem import InterpolationProblem, PosingProblem, is_quartic
from ..snapshots import Snapshots
from ..validation import Validation
from .advice import advice, split_of_some
from .console import notice
from .mesh_info import SLIVER
from .outliers import notice_outliers
from .pipeline import Built
from .units import in_percent

#: Number of samples in which inverted tets are counted.
LOOKED_AT = 8
#: Reduced solutions are reported if they have more inverted tets by this share of those of the full
#: ones.
_MORE = 0.1

Suggestions = list[tuple[str, list[str | Path]]]


def build_advice(built: Built, *, folders: Sequence[Path], threads: int | None) -> Suggestions:
    """Prints notices about errors of unseen samples and about inverted tets, with the cure.

    Parameters
    ----------
    built : Built
        The model and how it was built.
    folders : sequence of Path
        Folders of the files that it was made from.
    threads : int, optional
        Number of threads, None for all.

    Returns
    -------
    list
        Commands for `print_next`; empty if all is well, or no command is known.
    """
    if built.validation is None:
        return []
    _notice_inverted_samples(built)
    _notice_inverted_frames(built.validation)
    if isinstance(built.model.problem, PosingProblem):
        notice_outliers(built.model, built.validation)
    if "accurate" in built.model.provenance:  # the error is reported already
        return []
    return _error_advice(built, built.validation, folders, threads)


def _error_advice(
    built: Built, validation: Validation, folders: Sequence[Path], threads: int | None
) -> Suggestions:
    """Advice if the error is above the default of `--target-error`."""
    plan = plan_of(built.model.problem)
    error = plan.typical(validation.error)
    if error <= plan.target:
        return []
    notice(
        f"notice: unseen {plan.unseen_name} are {in_percent(error)} off in the "
        f"{plan.typical_name}, more than the {in_percent(plan.target)} of default builds"
    )
    split = split_of_some(built.model, validation, threads=threads)
    if split is None:
        return []
    found = advice(built.model, validation, split, built.path, folders=folders)
    found.print_notices()
    return found.suggestions


def _notice_inverted_samples(built: Built) -> None:
    """A notice if most full solutions have inverted tets, which no model can repair."""
    inverted = [report.inverted_tets for report in built.snapshots.reports]
    if np.median(inverted) == 0:
        return
    problem = built.model.problem
    if isinstance(problem, InterpolationProblem):
        cure = "leave out the poses that differ most, or repair those with inverted tets"
    elif _are_slivers(problem, built.snapshots):
        cure = (
            f"most of these are among those with a dihedral angle below {SLIVER} degrees, which "
            "`snapspace check` counts: make a mesh without them"
        )
    else:
        cure = "make the box of motions smaller"
        if is_quartic(problem):
            cure += ", or use the material stable-neo-hookean, which resists inversion"
    notice(
        f"notice: {sum(count > 0 for count in inverted)} of {len(inverted)} samples have inverted "
        f"tets, at most {max(inverted)} of {len(problem.mesh.cells)}; {cure}"
    )


def _are_slivers(problem: PosingProblem, snapshots: Snapshots) -> bool:
    """Whether most inverted tets of a few samples are slivers, which small motions invert."""
    mesh = problem.mesh
    if not isinstance(mesh, TetMesh):
        return False
    some = [k for k, report in enumerate(snapshots.reports) if report.inverted_tets][:LOOKED_AT]
    shapes = [(problem.base + snapshots.displacements[k]).reshape(-1, 3) for k in some]
    inverted = np.sum([tet_volumes(shape, mesh.tets) <= 0 for shape in shapes], axis=0)
    slivers = mesh.dihedral_angles.min(axis=1) < SLIVER
    return bool(inverted[slivers].sum() > inverted[~slivers].sum())


def _notice_inverted_frames(validation: Validation) -> None:
    """A notice if most reduced solutions have more inverted tets than the full ones."""
    full = np.array([report.inverted_tets for report in validation.reference.reports])
    added = validation.inverted_tets - full
    if np.median(added) < max(1.0, _MORE * np.median(full)):
        return
    notice(
        f"notice: reduced solutions of unseen samples have {np.median(added):.0f} more inverted "
        f"tets than the full ones in the median, at most {added.max()}; build a more accurate model"
    )
