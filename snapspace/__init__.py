"""Sample a shape problem, keep the best small space, solve in it live."""

from importlib.metadata import version as _version

from .energy import ElasticEnergy, StVK
from .mesh import (
    MeshNotice,
    TetMesh,
    mass_matrix,
    read_surface,
    read_tets,
    repair_tets,
    write_surface,
    write_tets,
)
from .model_file import load, save_model
from .problem import Handle, HandleBox, Handles, PosingProblem, in_box, in_sphere, read_problem
from .reduction import HandleQuadric, Quartic, ReducedModel, reduce
from .sampling import sample
from .session import FrameReport, Session
from .snapshots import (
    Checkpoint,
    Interrupted,
    SampleReport,
    Snapshots,
    SolverOptions,
    solve_snapshots,
)
from .subspace import AffineSubspace, pca, snapshot_pca
from .validation import Validation, validate

__version__ = _version("snapspace")

__all__ = [
    "AffineSubspace",
    "Checkpoint",
    "ElasticEnergy",
    "FrameReport",
    "Handle",
    "HandleBox",
    "HandleQuadric",
    "Handles",
    "Interrupted",
    "MeshNotice",
    "PosingProblem",
    "Quartic",
    "ReducedModel",
    "SampleReport",
    "Session",
    "Snapshots",
    "SolverOptions",
    "StVK",
    "TetMesh",
    "Validation",
    "in_box",
    "in_sphere",
    "load",
    "mass_matrix",
    "pca",
    "read_problem",
    "read_surface",
    "read_tets",
    "reduce",
    "repair_tets",
    "sample",
    "save_model",
    "snapshot_pca",
    "solve_snapshots",
    "validate",
    "write_surface",
    "write_tets",
]
