"""validate: compares a reduced model with full solutions at unseen parameters."""

from __future__ import annotations

import numpy as np

from ..reduction import ReducedModel, check_model
from ..snapshots import Progress, Snapshots
from .frame_errors import compared, projection_errors
from .given_reference import check_reference
from .lower_minima import with_lower_minima
from .unseen import solved_reference
from .validation import Validation

#: Default number of full solutions, and default seed of their parameters.
SAMPLES, SEED = 30, 1


def validate(
    model: ReducedModel,
    *,
    samples: int | None = None,
    seed: int | None = None,
    reference: Snapshots | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Validation:
    """Compares reduced solutions with tightly converged full ones at unseen parameters.

    Parameters
    ----------
    model : ReducedModel
    samples : int, default 30
        Number of full solutions.
    seed : int, default 1
        Seed of the parameters, which come from a stream that `sample` never uses.
    reference : Snapshots, optional
        Known full solutions of the same problem, such as `Validation.reference` or those of
        `load_snapshots`. They replace new ones. The errors are only as accurate as these solutions.
    threads, progress : as for `solve_snapshots`

    Returns
    -------
    Validation
        Passing `Validation.reference` again gives the same figures, except milliseconds. New
        solutions are the lowest that are found, see `with_lower_minima`.

    Raises
    ------
    ValueError
        For something other than a model; for samples or a seed that are not whole numbers; if no
        full solution converged; for samples or seed together with a reference; for a reference of
        another problem, without samples, with a sample that did not converge, or with one at a
        training parameter of the model.
    """
    reference, lower = given_or_solved(
        model, reference, samples=samples, seed=seed, threads=threads, progress=progress
    )
    errors, frames, inverted = compared(model, reference)
    full_values = np.array([report.value for report in reference.reports])
    return Validation(
        error=errors,
        projection_error=projection_errors(model, reference),
        energy_ratio=np.array([report.value for report, _ in frames]) / full_values,
        iterations=np.array([report.iterations for report, _ in frames]),
        solve_ms=np.array([1e3 * report.seconds for report, _ in frames]),
        frame_ms=np.array([milliseconds for _, milliseconds in frames]),
        inverted_tets=inverted,
        reference=reference,
        lower_minima=lower,
    )


def given_or_solved(
    model: ReducedModel,
    reference: Snapshots | None,
    *,
    samples: int | None,
    seed: int | None,
    threads: int | None,
    progress: Progress | None,
) -> tuple[Snapshots, int]:
    """The given reference after checks, or else a new one; arguments are as for `validate`.

    Also returns how many of its solutions are lower minima to which frames led.
    """
    check_model(model, "validate")
    if reference is None:
        solved = solved_reference(
            model.problem,
            samples=SAMPLES if samples is None else samples,
            seed=SEED if seed is None else seed,
            threads=threads,
            progress=progress,
        )
        return with_lower_minima(model, solved, threads=threads)
    if samples is not None or seed is not None:
        raise ValueError(
            "validate: the parameters come from the reference, so samples and seed have no effect; "
            "leave out either them or the reference"
        )
    check_reference(model, reference)
    return reference, 0
