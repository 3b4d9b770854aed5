"""cached_snapshots: full solutions that several programs share."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace.disk import atomic_file
from snapspace.validation.unseen import reference_options, unseen_parameters

from .timing import timed

FloatArray = NDArray[np.float64]
Given = TypeVar("Given", bound=ss.PosingProblem | ss.InterpolationProblem)

#: Where solutions are kept; `make clean` removes it.
FOLDER = Path(__file__).parents[1] / "build" / "paper"


def cached_snapshots(
    problem: ss.PosingProblem | ss.InterpolationProblem,
    parameters: FloatArray,
    options: ss.SolverOptions | None = None,
) -> ss.Snapshots:
    """`solve_snapshots`, kept by problem, parameters and options; solved once for all programs."""
    path = _path(problem, parameters, options)
    if path.is_file():
        return ss.load_snapshots(path, problem)
    solved = ss.solve_snapshots(problem, parameters, options=options)
    _save(solved, path)
    return solved


def timed_training(
    problem: ss.PosingProblem | ss.InterpolationProblem, count: int
) -> tuple[ss.Snapshots, float]:
    """`training` solved anew, and the seconds it took; both are kept for other programs.

    The seconds include what is made once for a problem, such as the mean shape of poses.
    """
    parameters = ss.sample(problem.domain, count, method="sobol")
    solved, seconds = timed(lambda: ss.solve_snapshots(problem, parameters))
    path = _path(problem, parameters, None)
    _save(solved, path)
    with atomic_file(path.with_suffix(".seconds")) as temporary:
        temporary.write_text(f"{seconds}\n")
    return solved, seconds


def training_with_seconds(
    problem: ss.PosingProblem | ss.InterpolationProblem, count: int
) -> tuple[ss.Snapshots, float]:
    """`training`, and the seconds that it took when `timed_training` solved it last."""
    path = _path(problem, ss.sample(problem.domain, count, method="sobol"), None)
    record = path.with_suffix(".seconds")
    if not (path.is_file() and record.is_file()):
        return timed_training(problem, count)
    return ss.load_snapshots(path, problem), float(record.read_text())


def training(problem: ss.PosingProblem | ss.InterpolationProblem, count: int) -> ss.Snapshots:
    """Full solutions at the first Sobol points of the domain, for subspaces."""
    return cached_snapshots(problem, ss.sample(problem.domain, count, method="sobol"))


def unseen(problem: ss.PosingProblem | ss.InterpolationProblem, count: int) -> ss.Snapshots:
    """Tight full solutions at parameters that no subspace was made of; those that converged."""
    parameters = unseen_parameters(problem.domain, count, seed=1)
    solved = cached_snapshots(problem, parameters, reference_options(problem))
    return solved.select(solved.converged)


def cached_subspace(
    name: str,
    problem: Given,
    dimension: int,
    build: Callable[[Given, int], ss.AffineSubspace],
) -> ss.AffineSubspace:
    """build(problem, dimension), kept by name, problem and dimension, which must determine it."""
    key = hashlib.sha256(f"{name} {dimension} {problem.fingerprint} {ss.__version__}".encode())
    path = FOLDER / f"{key.hexdigest()[:24]}.npy"
    if path.is_file():
        return ss.affine_subspace(np.load(path), problem, nested=False)
    built = build(problem, dimension)
    FOLDER.mkdir(parents=True, exist_ok=True)
    with atomic_file(path) as temporary, temporary.open("wb") as file:
        np.save(file, built.basis)
    return built


def _path(
    problem: ss.PosingProblem | ss.InterpolationProblem,
    parameters: FloatArray,
    options: ss.SolverOptions | None,
) -> Path:
    asked = sorted(asdict(options or ss.SolverOptions()).items())
    key = hashlib.sha256(parameters.tobytes())
    key.update(f"{problem.fingerprint} {asked} {ss.__version__}".encode())
    return FOLDER / f"{key.hexdigest()[:24]}.samples"


def _save(snapshots: ss.Snapshots, path: Path) -> None:
    FOLDER.mkdir(parents=True, exist_ok=True)
    ss.save_snapshots(snapshots, path)
