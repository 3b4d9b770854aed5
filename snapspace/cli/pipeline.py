"""From a problem to a model file, with progress, a checkpoint and a record of how it was made."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..mesh import EmbeddedSurface, TetMesh
from ..problem import InterpolationProblem, PosingProblem
from ..reduction import InterpolationModel, PosingModel, reduce
from ..snapshots import Checkpoint, Snapshots
from ..stopping import ctrl_c_as_itself
from ..subspace import AffineSubspace, snapshot_pca
from ..validation import Validation
from .console import notice
from .energy import EnergyChoice
from .first_frame import check_first_frame
from .memory import peak_memory_bytes
from .mesh_info import cell_count
from .progress import sample_progress, spinner
from .recipe import Recipe, provenance
from .unseen import judged, unseen_record, with_estimates


@dataclass(frozen=True)
class Built:
    """A model, the snapshots it comes from, its file, and seconds by stage.

    validation : its errors at unseen parameters; None if no full solution converged there
    """

    model: PosingModel | InterpolationModel
    snapshots: Snapshots
    path: Path
    seconds: dict[str, float]
    validation: Validation | None

    def as_json(self) -> dict[str, Any]:
        """The numbers with the keys of `snapspace build --json`."""
        problem, reports = self.model.problem, self.snapshots.reports
        return {
            "vertices": len(problem.mesh.vertices),
            **cell_count(problem.mesh),
            "parameters": problem.parameter_count,
            "samples": len(self.snapshots),
            "dimension": self.model.dimension,
            "energy_fraction": self.model.subspace.energy_fraction,
            "seconds": self.seconds,
            "snapshots": {
                "converged": int(self.snapshots.converged.sum()),
                "iterations_mean": float(np.mean([report.iterations for report in reports])),
                "inverted_tets_max": max(report.inverted_tets for report in reports)
                if isinstance(problem.mesh, TetMesh)
                else None,
            },
            "unseen": self.model.provenance.get("unseen"),
            "model_bytes": self.path.stat().st_size,
            "peak_memory_bytes": peak_memory_bytes(),
        }


def build_model(
    problem: PosingProblem | InterpolationProblem,
    recipe: Recipe,
    output: Path,
    *,
    source: dict[str, Any],
    surface: EmbeddedSurface | None = None,
    begin: float | None = None,
    executor: Executor | None = None,
) -> Built:
    """Solves the samples, makes the reduced model, measures its errors and writes its file.

    Finished samples are stored in a folder beside `output` until the file is written; the same call
    resumes from them.

    Parameters
    ----------
    problem, recipe : what to build
    output : Path
        The model file; the caller checks it first, since the work takes long.
    source : dict
        Names of the files that the problem comes from, for the record.
    surface : EmbeddedSurface, optional
        The user's surface, embedded in the tets.
    begin : float, optional
        `time.perf_counter()` when the work began, for the total. Default: now.
    executor : Executor, optional
        An executor whose workers solve the samples. Default: this machine's threads.

    Raises
    ------
    ValueError
        If the material does not allow the energy, the basis cannot be made, or the first frame of
        the model is not finite; the samples are kept then.
    KeyboardInterrupt
        On Ctrl-C, with a line that says how many samples are kept.
    """
    begin = time.perf_counter() if begin is None else begin
    choice = EnergyChoice(energy=recipe.energy, tets=recipe.tets, dimension=recipe.dimension)
    choice.check(problem, recipe.samples.count)
    checkpoint = Checkpoint.beside(output, recipe.samples.key(problem, recipe.solver))
    seconds: dict[str, float] = {}
    with report_kept_samples(lambda: (recipe.samples.finished(checkpoint), recipe.samples.count)):
        if isinstance(problem, InterpolationProblem):
            with stage(seconds, "mean shape"), spinner("mean shape"):
                problem.solve_mean_shape(threads=recipe.threads)
        with stage(seconds, "snapshots"):
            snapshots = _solved(problem, recipe, checkpoint, executor)
        with stage(seconds, "basis"), spinner("basis"):
            subspace = _subspace(snapshots, recipe)
        with stage(seconds, "reduction"), spinner("reduced energy"):
            model = reduce(
                problem,
                subspace,
                energy=recipe.energy,
                snapshots=snapshots,
                include_unconverged=recipe.include_unconverged,
                tets=recipe.tets,
                surface=surface,
                threads=recipe.threads,
            )
        with stage(seconds, "unseen samples"):
            validation = judged(model, None, threads=recipe.threads)
            model = with_estimates(model, validation)
        record = {**source, **provenance(recipe, snapshots), "seconds": dict(seconds)}
        if validation is not None:
            record["unseen"] = unseen_record(model, validation, snapshots)
        model = replace(model, provenance={**model.provenance, **record})
        check_first_frame(model)
        model.save(output)
    checkpoint.remove()
    seconds["total"] = time.perf_counter() - begin
    return Built(model, snapshots, output, seconds, validation)


@contextmanager
def report_kept_samples(finished: Callable[[], tuple[int, int]]) -> Iterator[None]:
    """On Ctrl-C in this block, says how many samples are kept and how many there are."""
    try:
        with ctrl_c_as_itself():
            yield
    except KeyboardInterrupt:
        raise KeyboardInterrupt(_resume_line(*finished())) from None


def _solved(
    problem: PosingProblem | InterpolationProblem,
    recipe: Recipe,
    checkpoint: Checkpoint,
    executor: Executor | None,
) -> Snapshots:
    total, found = recipe.samples.count, recipe.samples.finished(checkpoint)
    if found:
        notice(f"resuming: {found} of {total} samples were finished before")
    for folder in checkpoint.folder.parent.iterdir():
        other_run = folder.name.startswith(checkpoint.folder.name.rpartition("-")[0] + "-")
        if other_run and folder != checkpoint.folder:
            notice(f"notice: {folder} holds samples of other options; delete it if not needed")
    with sample_progress("snapshots", done=found, total=total, training=True) as progress:
        return recipe.samples.solve(
            problem,
            recipe.solver,
            threads=recipe.threads,
            progress=progress,
            checkpoint=checkpoint,
            executor=executor,
        )


def _subspace(snapshots: Snapshots, recipe: Recipe) -> AffineSubspace:
    try:
        return snapshot_pca(
            snapshots,
            dimension=recipe.dimension,
            energy_fraction=recipe.energy_fraction,
            lumped=recipe.lumped,
            include_unconverged=recipe.include_unconverged,
        )
    except ValueError as error:
        hint = ""
        if not recipe.include_unconverged and not snapshots.converged.all():
            hint = " or with --include-unconverged"
        raise ValueError(
            f"{error} ({snapshots.summary()}; they are kept, so the same command with another "
            f"--dimension{hint} takes seconds)"
        ) from None


@contextmanager
def stage(seconds: dict[str, float], name: str) -> Iterator[None]:
    """Records how many seconds the block took."""
    begin = time.perf_counter()
    yield
    seconds[name] = time.perf_counter() - begin


def _resume_line(kept: int, total: int) -> str:
    if not kept:
        return f"none of {total} samples is finished yet"
    return f"{kept} of {total} samples are kept; the same command resumes from there"
