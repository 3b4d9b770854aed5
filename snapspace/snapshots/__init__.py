"""Snapshots: full-space solutions at sampled parameters."""

from .checkpoint import Checkpoint, run_key
from .snapshots import SampleReport, Snapshots
from .solve import SOLVERS, Interrupted, SolverOptions, solve_snapshots, solver_key

__all__ = [
    "SOLVERS",
    "Checkpoint",
    "Interrupted",
    "SampleReport",
    "Snapshots",
    "SolverOptions",
    "run_key",
    "solve_snapshots",
    "solver_key",
]
