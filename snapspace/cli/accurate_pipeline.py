"""From poses to a model file, with samples and dimension chosen by the error of unseen blends."""

from __future__ import annotations

import time
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import click
import numpy as np

from ..accurate import AccurateBlends, accurate_blends, usual_most_samples
from ..greedy import finished_samples
from ..mesh import EmbeddedSurface
from ..problem import InterpolationProblem
from ..snapshots import Checkpoint, SolverOptions, run_key, solver_key
from .console import notice
from .pipeline import Built, stage, telling_what_is_kept
from .progress import spinner
from .recipe import made_by

#: Options that decide samples or subspace: with one of them nothing is chosen by error.
DECIDING = (
    "samples",
    "dimension",
    "energy_fraction",
    "sampling",
    "target_error",
    "no_scramble",
    "solver",
    "lumped",
    "include_unconverged",
)


def decided_by_hand(options: Sequence[str] = DECIDING) -> bool:
    """Whether the user of the running command gave one of the options."""
    source = click.get_current_context().get_parameter_source
    return any(source(name) is click.core.ParameterSource.COMMANDLINE for name in options)


@dataclass(frozen=True, kw_only=True)
class AccurateRecipe:
    """What to do with poses.

    target_error, seed : as for `accurate_blends`
    solver : SolverOptions
    threads : None for all
    """

    target_error: float
    seed: int
    solver: SolverOptions
    threads: int | None

    def key(self, problem: InterpolationProblem) -> str:
        """Hash of what the samples depend on: which models give starts follows from the target."""
        choice = {"seed": self.seed, "accurate": [usual_most_samples(problem), self.target_error]}
        none = np.zeros((0, problem.parameter_count))
        return run_key(problem, none, {**solver_key(self.solver, problem), **choice})


def build_accurate_model(
    problem: InterpolationProblem,
    recipe: AccurateRecipe,
    output: Path,
    *,
    source: dict[str, Any],
    surface: EmbeddedSurface | None = None,
    begin: float | None = None,
    executor: Executor | None = None,
) -> Built:
    """As `build_model`, with a line for each model that was tried."""
    begin = time.perf_counter() if begin is None else begin
    checkpoint = Checkpoint.beside(output, recipe.key(problem))
    seconds: dict[str, float] = {}

    found = finished_samples(checkpoint)
    most = usual_most_samples(problem)
    with telling_what_is_kept(lambda: (finished_samples(checkpoint), most)):
        if found:
            notice(f"resuming: {found} samples were finished before")
        with stage(seconds, "mean shape"), spinner("mean shape"):
            problem.solve_mean_shape(threads=recipe.threads)
        with stage(seconds, "samples and models"), spinner("samples and models"):
            built = accurate_blends(
                problem,
                target_error=recipe.target_error,
                seed=recipe.seed,
                options=recipe.solver,
                threads=recipe.threads,
                checkpoint=checkpoint,
                executor=executor,
                surface=surface,
                tell=notice,
            )
        _tell_outcome(built)
        record = {
            **source,
            **made_by(recipe.solver, built.snapshots),
            "accurate": built.as_json(),
            "seconds": dict(seconds),
        }
        model = replace(built.model, provenance={**built.model.provenance, **record})
        model.save(output)
    checkpoint.remove()
    seconds["total"] = time.perf_counter() - begin
    return Built(model, built.snapshots, output, seconds)


def _tell_outcome(built: AccurateBlends) -> None:
    if built.reached:
        return
    notice(
        f"notice: unseen blends are {100 * built.step.error:.2g} % off in the mean, more than the "
        f"{100 * built.target:.2g} % of --accuracy; these poses need more than "
        f"{len(built.snapshots)} samples or {built.model.dimension} dimensions: give --samples and "
        "--dimension, or leave out poses that differ most"
    )
