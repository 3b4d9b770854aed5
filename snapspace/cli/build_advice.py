"""What to do where a model that was just built is not good."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..accurate import plan_of
from ..problem import InterpolationProblem
from ..validation import Validation
from .advice import advice, split_of_some
from .console import notice
from .pipeline import Built

Suggestions = list[tuple[str, list[str | Path]]]


def tell_what_to_do(built: Built, *, folders: Sequence[Path], threads: int | None) -> Suggestions:
    """Notices where errors of unseen samples or inverted tets are bad, with the cure.

    Parameters
    ----------
    built : Built
    folders : of the files that it was made of
    threads : None for all

    Returns
    -------
    list
        Commands for `print_next`; none where all is well, or no command is known.
    """
    if built.validation is None:
        return []
    _tell_inverted_samples(built)
    _tell_inverted_frames(built.validation)
    if "accurate" in built.model.provenance:  # which has told its error
        return []
    return _tell_error(built, built.validation, folders, threads)


def _tell_error(
    built: Built, validation: Validation, folders: Sequence[Path], threads: int | None
) -> Suggestions:
    """Where the error is above what `--target-error` aims at without any option."""
    plan = plan_of(built.model.problem)
    error = plan.typical(validation.error)
    if error <= plan.target:
        return []
    notice(
        f"notice: unseen {plan.unseen_name} are {100 * error:.2g} % off in the "
        f"{plan.typical_name}, more than the {100 * plan.target:.2g} % of default builds"
    )
    split = split_of_some(built.model, validation, threads=threads)
    if split is None:
        return []
    found = advice(built.model, validation, split, built.path, folders=folders)
    found.tell()
    return found.suggestions


def _tell_inverted_samples(built: Built) -> None:
    """Where most of the full solutions themselves have inverted tets: no model mends that."""
    inverted = [report.inverted_tets for report in built.snapshots.reports]
    if np.median(inverted) == 0:
        return
    problem = built.model.problem
    if isinstance(problem, InterpolationProblem):
        cure = "leave out poses that differ most, or mend those whose own tets are inverted"
    else:
        cure = "make the box of motions smaller, or the handles larger"
        if problem.material.exact_degree == 4:
            cure += ", or take the material stable-neo-hookean, which resists inversion"
    notice(
        f"notice: {sum(count > 0 for count in inverted)} of {len(inverted)} samples have inverted "
        f"tets, at most {max(inverted)} of {len(problem.mesh.tets)}; {cure}"
    )


def _tell_inverted_frames(validation: Validation) -> None:
    """Where most of the reduced solutions have more inverted tets than the full ones."""
    full = np.array([report.inverted_tets for report in validation.reference.reports])
    added = validation.inverted_tets - full
    if np.median(added) <= 0:
        return
    notice(
        f"notice: reduced solutions of unseen samples have {np.median(added):.0f} inverted tets "
        f"more than the full ones in the median, at most {added.max()}: build a more accurate model"
    )
