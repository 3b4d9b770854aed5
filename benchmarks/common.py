"""Shared functions of the benchmarks: the meshes' folder, solves, errors, tables, JSON."""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

import snapspace as ss
from snapspace import generators
from snapspace.material import material_class
from snapspace.mesh import mass_norms
from snapspace.validation import unseen_parameters


def meshes_folder() -> Path:
    """The folder of real meshes: SNAPSPACE_MESHES, or ../shared/meshes beside the checkout."""
    default = Path(__file__).parent.parent.parent / "shared" / "meshes"
    return Path(os.environ.get("SNAPSPACE_MESHES", default))


def read_problem(name: str) -> ss.PosingProblem:
    """A problem of the meshes' folder by name, or `creature:TETS`, which needs no folder."""
    if name.startswith("creature"):
        return creature_problem(int(name.partition(":")[2] or 25_000))
    path = meshes_folder() / "problems" / f"{name}.json"
    if not path.is_file():
        sys.exit(f"{path} is missing: set SNAPSPACE_MESHES, or use --problem creature:25000")
    return ss.read_problem(path)


def creature_problem(tets: int) -> ss.PosingProblem:
    """The generated creature, feet fixed, head moving, St.Venant-Kirchhoff as in the folder."""
    mesh = generators.creature(tets)
    parts = generators.creature_handles(mesh)
    handles = ss.Handles([parts["feet"], parts["head"]], names=["feet", "head"])
    domain = ss.HandleBox(translation=0.3, angle=np.pi / 4)
    return ss.PosingProblem(mesh, handles, domain=domain, material=ss.StVK())


def with_material(problem: ss.PosingProblem, kind: str) -> ss.PosingProblem:
    """The problem with another material, with all moduli 1."""
    return ss.PosingProblem(
        problem.mesh,
        problem.handles,
        domain=problem.domain,
        material=material_class(kind)(),
        stiffness=problem.stiffness,
    )


def progress(state: ss.SolveProgress) -> None:
    """Shows the number of finished samples on standard error."""
    if sys.stderr.isatty():
        print(f"\r{state.done}/{state.total} samples ", end="", file=sys.stderr, flush=True)


def solved(
    problem: ss.PosingProblem,
    parameters: np.ndarray,
    *,
    known: ss.Snapshots | None = None,
    **options: Any,
) -> ss.Snapshots:
    """Snapshots with options of the solver; progress, which costs time, on a terminal only."""
    shown = progress if sys.stderr.isatty() else None
    return ss.solve_snapshots(
        problem, parameters, options=ss.SolverOptions(**options), progress=shown, known=known
    )


def references(problem: ss.PosingProblem, count: int) -> ss.Snapshots:
    """Tight solutions at unseen parameters."""
    parameters = unseen_parameters(problem.domain, count, seed=1)
    return solved(problem, parameters, tolerance=1e-9, max_iterations=5000)


def projection_errors(subspace: ss.AffineSubspace, reference: ss.Snapshots) -> np.ndarray:
    """Relative M-norm errors of the projections of full solutions."""
    shapes = reference.shapes
    projected = subspace.tau + subspace.coordinates(shapes) @ subspace.basis.T
    size = mass_norms(subspace.mass, shapes - subspace.tau)
    errors: np.ndarray = mass_norms(subspace.mass, projected - shapes) / size
    return errors


def reduced_errors(model: ss.PosingModel, reference: ss.Snapshots) -> np.ndarray:
    """Relative M-norm errors of reduced solutions from rest."""
    shapes, _ = solutions(model, reference)
    truth = reference.displacements.array()
    errors: np.ndarray = mass_norms(model.subspace.mass, shapes - truth)
    return errors / mass_norms(model.subspace.mass, truth)


def solutions(
    model: ss.PosingModel, reference: ss.Snapshots, *, frames: int = 1
) -> tuple[np.ndarray, float]:
    """Displacements (k, 3n) of reduced solves from rest, and the median ms of their last frames.

    With several frames the handles move along a straight line.
    """
    session, shapes, seconds = model.session(), [], []
    for w in reference.parameters:
        session.reset()
        for frame in range(1, frames + 1):
            report = session.set_parameters(w * frame / frames)
        seconds.append(report.seconds)
        shapes.append(session.vertices.reshape(-1) - model.problem.base)
    return np.array(shapes), 1e3 * float(np.median(seconds))


def show(
    title: str, rows: Sequence[tuple[str, Any, str]], result: dict[str, Any], as_json: bool
) -> None:
    """Prints rows (figure, measured, goal) as a table, or `result` as one JSON object."""
    if as_json:
        print(json.dumps(result))
        return
    table = Table("figure", "measured", "goal", title=title)
    for figure, measured, goal in rows:
        table.add_row(
            figure, f"{measured:.4g}" if isinstance(measured, float) else str(measured), goal
        )
    Console().print(table)


def print_rows(rows: Sequence[dict[str, Any]], *, title: str, width: int) -> None:
    """Prints rows with the same keys as a table, numbers with two digits."""
    table = Table(*rows[0], title=title)
    for row in rows:
        table.add_row(*(f"{x:.2g}" if isinstance(x, float) else str(x) for x in row.values()))
    Console(width=width).print(table)


#: Frames of a path from one random point to the next.
PATH_FRAMES = 60


def along(corners: np.ndarray, *, frames: int) -> np.ndarray:
    """Parameters (frames, p) on straight lines from corner to corner.

    There are 60 frames from one to the next: like a hand that moves across the domain in a second.
    """
    at = np.arange(frames) / PATH_FRAMES
    below = at.astype(int)
    share = (at - below)[:, None]
    between: np.ndarray = (1 - share) * corners[below] + share * corners[below + 1]
    return between


def path(
    problem: ss.PosingProblem | ss.InterpolationProblem, *, frames: int, seed: int
) -> np.ndarray:
    """Parameters (frames, p) `along` random ones."""
    corners = ss.sample(problem.domain, frames // PATH_FRAMES + 2, seed=seed)
    return along(corners, frames=frames)


def drag(
    model: ss.PosingModel | ss.InterpolationModel, *, frames: int, seed: int, **options: Any
) -> tuple[np.ndarray, np.ndarray]:
    """Milliseconds of solves, and of solves with all vertices, on a `path` through the domain.

    Options are those of the session.
    """
    parameters = path(model.problem, frames=frames, seed=seed)
    session = model.session(**options)
    session.set_parameters(parameters[0])
    solve, frame = [], []
    for w in parameters:
        begin = time.perf_counter()
        report = session.set_parameters(w)
        _ = session.vertices
        frame.append(1e3 * (time.perf_counter() - begin))
        solve.append(1e3 * report.seconds)
    return np.array(solve), np.array(frame)


def best_of(repeats: int, work: Callable[[], Any]) -> float:
    """The shortest time of work(), in seconds."""
    seconds = []
    for _ in range(repeats):
        begin = time.perf_counter()
        work()
        seconds.append(time.perf_counter() - begin)
    return min(seconds)
