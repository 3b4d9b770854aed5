"""cached_snapshots: full solutions that several programs share."""

from __future__ import annotations

import hashlib
from dataclasses import asdict
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace.validation.unseen import reference_options, unseen_parameters

FloatArray = NDArray[np.float64]

#: Where solutions are kept; `make clean` removes it.
FOLDER = Path(__file__).parents[1] / "build" / "paper"


def cached_snapshots(
    problem: ss.PosingProblem | ss.InterpolationProblem,
    parameters: FloatArray,
    options: ss.SolverOptions | None = None,
) -> ss.Snapshots:
    """`solve_snapshots`, kept by problem, parameters and options; solved once for all programs."""
    asked = options or ss.SolverOptions()
    key = hashlib.sha256(parameters.tobytes())
    key.update(f"{problem.fingerprint} {sorted(asdict(asked).items())} {ss.__version__}".encode())
    path = FOLDER / f"{key.hexdigest()[:24]}.samples"
    if path.is_file():
        return ss.load_snapshots(path, problem)
    solved = ss.solve_snapshots(problem, parameters, options=asked)
    FOLDER.mkdir(parents=True, exist_ok=True)
    ss.save_snapshots(solved, path)
    return solved


def training(problem: ss.PosingProblem | ss.InterpolationProblem, count: int) -> ss.Snapshots:
    """Full solutions at the first Sobol points of the domain, for subspaces."""
    return cached_snapshots(problem, ss.sample(problem.domain, count, method="sobol"))


def unseen(problem: ss.PosingProblem | ss.InterpolationProblem, count: int) -> ss.Snapshots:
    """Tight full solutions at parameters that no subspace was made of; those that converged."""
    parameters = unseen_parameters(problem.domain, count, seed=1)
    solved = cached_snapshots(problem, parameters, reference_options(problem))
    return solved.select(solved.converged)
