"""`snapspace validate`: measures how far a model is from the full problem."""

from __future__ import annotations

from pathlib import Path

import click
import numpy as np

from ..extras import need_extra
from ..mesh.input_path import writable_path
from ..reduction import InterpolationModel, PosingModel
from ..snapshots import SAMPLES_SUFFIX, Snapshots, load_snapshots, save_snapshots
from ..validation import ErrorCurve, ErrorSplit, Validation, error_curve, needs_advice
from ..validation import validate as compare
from .advice import Advice, advice, split_of_some
from .console import notice, print_json, print_next
from .error_plot import save_error_plot
from .loading import leading_of, load_leading
from .options import FILE, SAMPLE_COUNT, SEED_NUMBER, json_option, leading_option, threads_option
from .outliers import notice_outliers
from .progress import sample_progress, spinner
from .units import two_digits
from .validation_tables import print_curve, print_split, print_validation

SAMPLES, SEED = 30, 1

Model = PosingModel | InterpolationModel


@click.command(short_help="Measure the error of a model.")
@click.argument("model_file", type=FILE, metavar="M.snapspace")
@click.option(
    "--samples",
    type=SAMPLE_COUNT,
    help=f"Number of unseen parameters to compare at [default: {SAMPLES}].",
)
@click.option(
    "--seed",
    type=SEED_NUMBER,
    help=f"Seed of the unseen parameters, which no build ever draws [default: {SEED}].",
)
@click.option(
    "--reference",
    type=FILE,
    metavar="R.samples",
    help="Known full solutions to use instead of new ones, written by --save-reference.",
)
@click.option(
    "--save-reference",
    type=FILE,
    metavar="R.samples",
    help="Keep the full solutions for the next validation of this problem.",
)
@click.option(
    "--split",
    "with_split",
    is_flag=True,
    help="Split the errors of the first five samples into subspace, stiffness and cubature.",
)
@click.option(
    "--plot",
    type=FILE,
    metavar="FILE.png",
    help="Plot of the error against the dimension and against milliseconds, with the same full "
    "solutions for all dimensions.",
)
@leading_option
@threads_option
@json_option
def validate(
    model_file: Path,
    samples: int | None,
    seed: int | None,
    reference: Path | None,
    save_reference: Path | None,
    with_split: bool,
    plot: Path | None,
    dimension: int | None,
    threads: int | None,
    as_json: bool,
) -> None:
    """Compare a model with tightly converged full solutions at parameters that it has not seen.

    \b
    Errors are relative, in the mass norm: |reduced - full| / |full - rest|. The projection error is
    the smallest that the subspace allows. The time of a frame is that of a solve from rest and of
    all vertices. If the median error is more than three times that of the projections, advice for
    a better model is printed.

    \b
    Examples:
      snapspace validate dragon.snapspace --samples 30 --seed 1
      snapspace validate dragon.snapspace --save-reference dragon.samples --plot error.png
      snapspace validate dragon60.snapspace --reference dragon.samples --split
      snapspace validate dragon.snapspace --dimension 20 --json > error20.json
    """
    if plot is not None:
        writable_path(plot, known=[".png"])
        need_extra("pictures", who="--plot")
    if save_reference is not None:
        writable_path(save_reference, known=[SAMPLES_SUFFIX])
    _check_source(reference, samples, seed)
    whole = load_leading(model_file, None)
    model = leading_of(whole, model_file, dimension)
    asked = SAMPLES if samples is None else samples
    validation = _validated(model, reference, samples=asked, seed=seed, threads=threads)
    known = len(validation.reference) if reference is not None else asked
    print_validation(validation, model.dimension, asked=known)
    notice_outliers(model, validation)
    if save_reference is not None:
        save_snapshots(validation.reference, save_reference)
        notice(f"{save_reference}: {len(validation.reference)} full solutions")
    curve = _curve(model, validation.reference, plot)
    fewer = model.dimension < whole.dimension
    split, found = _split(
        model, validation, model_file, asked=with_split, fewer=fewer, threads=threads
    )
    if as_json:
        print_json(
            {
                **validation.as_json(model.dimension),
                "split": split.as_json() if split is not None and with_split else None,
                "curve": None if curve is None else curve.as_json(),
                "next": None if found is None else found.as_json(),
            }
        )


def _check_source(reference: Path | None, samples: int | None, seed: int | None) -> None:
    given = [
        name for name, value in (("--samples", samples), ("--seed", seed)) if value is not None
    ]
    if reference is not None and given:
        raise ValueError(
            f"the parameters come from --reference, so {given[0]} has no effect; leave one of "
            "them out"
        )


def _validated(
    model: Model, reference: Path | None, *, samples: int, seed: int | None, threads: int | None
) -> Validation:
    if reference is not None:
        return compare(model, reference=load_snapshots(reference, model.problem))
    with sample_progress("full solutions", total=samples) as progress:
        found = compare(model, samples=samples, seed=seed, threads=threads, progress=progress)
    if found.lower_minima:
        notice(
            f"notice: {found.lower_minima} of {len(found.error)} full solutions were not the "
            "lowest minimum; frames led to lower ones, which are used instead"
        )
    return found


def _curve(model: Model, reference: Snapshots, plot: Path | None) -> ErrorCurve | None:
    if plot is None:
        return None
    with spinner("errors of smaller dimensions"):
        curve = error_curve(model, reference=reference)
    print_curve(curve)
    notice(f"{save_error_plot(plot, curve)}: error against dimension and milliseconds")
    return curve


def _split(
    model: Model,
    validation: Validation,
    file: Path,
    *,
    asked: bool,
    fewer: bool,
    threads: int | None,
) -> tuple[ErrorSplit | None, Advice | None]:
    """The parts of the error, if requested or needed for advice, and the advice.

    `fewer`: whether the model has fewer modes than its file.
    """
    error, least = (float(np.median(e)) for e in (validation.error, validation.projection_error))
    needed = needs_advice(error, least)
    if not (asked or needed):
        return None, None
    split = split_of_some(model, validation, threads=threads)
    if asked and split is not None:
        print_split(split)
    if not needed or split is None:
        return split, None
    notice(f"notice: the median error is {two_digits(error / least)} times that of the projections")
    if fewer:
        notice("the file has more modes; give a larger --dimension, or leave it out")
        return split, None
    found = advice(model, validation, split, file)
    found.print_notices()
    if found.suggestions:
        print_next(found.suggestions)
    return split, found
