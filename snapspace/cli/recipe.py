"""Recipe: how to build a model of a problem, and its record in the model."""

from __future__ import annotations

import platform
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy

from .. import __version__, _core
from ..reduction import Energy
from ..snapshots import Snapshots, SolverOptions, solver_key
from .samples import Samples


@dataclass(frozen=True, kw_only=True)
class Recipe:
    """How to build a model of a problem.

    samples : the samples, given or chosen
    sampling : how they were chosen, for the record
    solver : options of the solver
    dimension, energy_fraction : one of them; see `snapshot_pca`
    energy : as for `reduce`
    tets : number of tets of the cubature, None for its default
    lumped, include_unconverged : as for `snapshot_pca`
    threads : number of threads, None for all
    known : number of solutions that are known without solving: the poses of an interpolation
    """

    samples: Samples
    sampling: dict[str, Any]
    solver: SolverOptions
    dimension: int | None
    energy_fraction: float | None = None
    lumped: bool = False
    include_unconverged: bool = False
    threads: int | None = None
    known: int = 0
    energy: Energy = "auto"
    tets: int | None = None

    def __post_init__(self) -> None:
        if (self.dimension is None) == (self.energy_fraction is None):
            raise ValueError("give either --dimension or --energy-fraction")
        if self.dimension is not None:
            check_dimension(self.dimension, self.samples.count, known=self.known)
        if self.energy_fraction is not None and not 0 < self.energy_fraction <= 1:
            raise ValueError(f"energy fraction is {self.energy_fraction}, but must be in (0, 1]")


def check_dimension(dimension: int, samples: int, *, known: int = 0) -> None:
    """Raises ValueError if there are fewer samples and known solutions than modes."""
    if dimension > samples + known:
        poses = f" and {known} poses" if known else ""
        raise ValueError(
            f"dimension {dimension} needs at least as many samples, but there are {samples}{poses}"
            "; raise --samples or lower --dimension"
        )


def provenance(recipe: Recipe, snapshots: Snapshots) -> dict[str, Any]:
    """How the model was made; no names of machines or people."""
    return {
        **made_by(recipe.solver, snapshots),
        "sampling": recipe.sampling,
        "basis": {
            "dimension": recipe.dimension,
            "energy_fraction": recipe.energy_fraction,
            "lumped": recipe.lumped,
            "include_unconverged": recipe.include_unconverged,
        },
    }


def made_by(solver: SolverOptions, snapshots: Snapshots) -> dict[str, Any]:
    """Versions, the solver's options, and how the solves ended."""
    return {
        "versions": {
            "snapspace": __version__,
            "python": platform.python_version(),
            "numpy": np.__version__,
            "scipy": scipy.__version__,
            "core": _core.level,
        },
        "solver": solver_key(solver, snapshots.problem),
        "snapshots": {
            "solved": len(snapshots),
            "converged": int(snapshots.converged.sum()),
            "summary": snapshots.summary(),
        },
    }
