"""Snapshots: full-space solutions at sampled parameters."""

from .carry import carried
from .checkpoint import Checkpoint, CheckpointNotice, UnsavedSamplesError, run_key
from .displacement_rows import DisplacementRows
from .run import Interrupted
from .snapshot_gram import SnapshotGram
from .snapshots import SampleReport, Snapshots
from .solve import solve_snapshots, solver_key
from .solve_progress import Progress, SolveProgress
from .solver_options import PRECISIONS, SOLVERS, SolverOptions

__all__ = [
    "PRECISIONS",
    "SOLVERS",
    "Checkpoint",
    "CheckpointNotice",
    "DisplacementRows",
    "Interrupted",
    "Progress",
    "SampleReport",
    "SnapshotGram",
    "Snapshots",
    "SolveProgress",
    "SolverOptions",
    "UnsavedSamplesError",
    "carried",
    "run_key",
    "solve_snapshots",
    "solver_key",
]
