"""Snapshots: full-space solutions at sampled parameters."""

from .carry import carry_over, unsolved_snapshots
from .check_solving import check_solving
from .checkpoint import Checkpoint, CheckpointNotice, UnsavedSamplesError, run_key
from .predictions import Predictions, positive_inverse
from .run import Interrupted
from .snapshot_file import SAMPLES_SUFFIX, load_snapshots, save_snapshots
from .snapshots import SampleReport, Snapshots, check_snapshots, check_snapshots_of
from .solve import solve_snapshots, solver_key
from .solve_progress import Progress, SolveProgress
from .solver_options import PRECISIONS, PROJECTIONS, SOLVERS, SolverOptions
from .starts import lowest_start

__all__ = [
    "PRECISIONS",
    "PROJECTIONS",
    "SAMPLES_SUFFIX",
    "SOLVERS",
    "Checkpoint",
    "CheckpointNotice",
    "Interrupted",
    "Predictions",
    "Progress",
    "SampleReport",
    "Snapshots",
    "SolveProgress",
    "SolverOptions",
    "UnsavedSamplesError",
    "carry_over",
    "check_snapshots",
    "check_snapshots_of",
    "check_solving",
    "load_snapshots",
    "lowest_start",
    "positive_inverse",
    "run_key",
    "save_snapshots",
    "solve_snapshots",
    "solver_key",
    "unsolved_snapshots",
]
