"""Snapshots: full-space solutions at sampled parameters."""

from .carry import carried
from .checkpoint import Checkpoint, CheckpointNotice, UnsavedSamplesError, run_key
from .run import Interrupted
from .snapshots import SampleReport, Snapshots
from .solve import solve_snapshots, solver_key
from .solve_progress import Progress, SolveProgress
from .solver_options import PRECISIONS, PROJECTIONS, SOLVERS, SolverOptions

__all__ = [
    "PRECISIONS",
    "PROJECTIONS",
    "SOLVERS",
    "Checkpoint",
    "CheckpointNotice",
    "Interrupted",
    "Progress",
    "SampleReport",
    "Snapshots",
    "SolveProgress",
    "SolverOptions",
    "UnsavedSamplesError",
    "carried",
    "run_key",
    "solve_snapshots",
    "solver_key",
]
