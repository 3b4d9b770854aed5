"""From a problem to a model file, with samples and dimension chosen by a target error."""

from __future__ import annotations

import hashlib
import shlex
import time
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ..accurate import AccurateModel, accurate_model, usual_most_samples
from ..greedy import finished_samples
from ..mesh import EmbeddedSurface
from ..problem import InterpolationProblem, PosingProblem
from ..reduction import PosingModel
from ..snapshots import Checkpoint, SolverOptions, run_key, solver_key
from .console import notice
from .first_frame import check_first_frame
from .pipeline import Built, build_model, report_kept_samples, stage
from .progress import spinner
from .recipe import Recipe, made_by
from .units import in_percent
from .unseen import judged, unseen_record


@dataclass(frozen=True, kw_only=True)
class AccurateRecipe:
    """How to build a model with a target error.

    target_error, budget, seed, start : as for `accurate_model`
    solver : options of the solver
    threads : number of threads, None for all
    """

    target_error: float
    budget: float | None = None
    seed: int
    start: PosingModel | None = None
    solver: SolverOptions
    threads: int | None

    def key(self, problem: PosingProblem | InterpolationProblem) -> str:
        """Hash of everything that the samples depend on; their starts follow from the target."""
        choice: dict[str, Any] = {
            "seed": self.seed,
            "accurate": [usual_most_samples(problem), self.target_error],
        }
        if self.start is not None:
            shapes = self.start.training_coordinates.tobytes()
            choice["start"] = hashlib.sha256(shapes).hexdigest()
        none = np.zeros((0, problem.parameter_count))
        return run_key(problem, none, {**solver_key(self.solver, problem), **choice})


def chosen_build(
    problem: PosingProblem | InterpolationProblem,
    recipe: Recipe,
    *,
    by_hand: bool,
    target_error: float,
    budget: float | None = None,
    seed: int,
    start: PosingModel | None = None,
    solver: SolverOptions,
) -> partial[Built]:
    """`build_model` if the user gave samples or subspace, otherwise `build_accurate_model`."""
    if by_hand:
        return partial(build_model, problem, recipe)
    accurate = AccurateRecipe(
        target_error=target_error,
        budget=budget,
        seed=seed,
        start=start,
        solver=solver,
        threads=recipe.threads,
    )
    return partial(build_accurate_model, problem, accurate)


def build_accurate_model(
    problem: PosingProblem | InterpolationProblem,
    recipe: AccurateRecipe,
    output: Path,
    *,
    source: dict[str, Any],
    surface: EmbeddedSurface | None = None,
    begin: float | None = None,
    executor: Executor | None = None,
) -> Built:
    """As `build_model`, for a target error, with a line for each model that was tried."""
    begin = time.perf_counter() if begin is None else begin
    checkpoint = Checkpoint.beside(output, recipe.key(problem))
    seconds: dict[str, float] = {}

    found = finished_samples(checkpoint)
    most = usual_most_samples(problem)
    with report_kept_samples(lambda: (finished_samples(checkpoint), most)):
        if found:
            notice(f"resuming: {found} samples were finished before")
        if isinstance(problem, InterpolationProblem):
            with stage(seconds, "mean shape"), spinner("mean shape"):
                problem.solve_mean_shape(threads=recipe.threads)
        with stage(seconds, "samples and models"), spinner("samples and models"):
            built = accurate_model(
                problem,
                target_error=recipe.target_error,
                budget=recipe.budget,
                seed=recipe.seed,
                options=recipe.solver,
                threads=recipe.threads,
                checkpoint=checkpoint,
                executor=executor,
                start=recipe.start,
                surface=surface,
                tell=notice,
            )
        _notice_missed_target(built, recipe.budget, output)
        _notice_unjudged(built)
        unseen = built.held_out & built.snapshots.converged
        known = built.snapshots.select(unseen) if unseen.any() else None
        validation = judged(built.model, known, threads=recipe.threads)
        record: dict[str, Any] = {
            **source,
            **made_by(recipe.solver, built.snapshots),
            "seconds": dict(seconds),
        }
        if validation is not None:
            record["unseen"] = unseen_record(built.model, validation, built.snapshots)
        model = replace(built.model, provenance={**built.model.provenance, **record})
        check_first_frame(model)
        model.save(output)
    checkpoint.remove()
    seconds["total"] = time.perf_counter() - begin
    return Built(model, built.snapshots, output, seconds, validation)


def _notice_unjudged(built: AccurateModel[Any]) -> None:
    """A notice if full solutions did not converge, so that the errors do not include them."""
    missing = int((built.held_out & ~built.snapshots.converged).sum())
    if missing:
        notice(
            f"notice: the errors leave out {missing} of {int(built.held_out.sum())} unseen "
            f"{built.step.unseen}, whose full solutions did not converge; others may be worse: "
            "make the box smaller or the thin parts thicker"
        )


def _notice_missed_target(built: AccurateModel[Any], budget: float | None, output: Path) -> None:
    if built.reached:
        return
    step = built.step
    cure = "make the box smaller"
    if step.unseen == "blends":
        cure = "leave out the poses that differ most"
    split = shlex.join(["snapspace", "validate", str(output), "--split"])
    more = f"`{split}` says what a better model needs"
    if budget is not None and len(built.snapshots) < built.most_samples:
        more = "raise --budget"
    notice(
        f"notice: unseen {step.unseen} are {in_percent(step.error)} off in the {step.typical}, "
        f"more than the {in_percent(built.target)} of --target-error, with {len(built.snapshots)} "
        f"samples and {built.model.dimension} dimensions; {more}, or {cure}"
    )
