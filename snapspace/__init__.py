"""Sample a shape problem, keep the best small space, solve in it live."""

from importlib.metadata import version as _version

from .accurate import AccurateModel, Growth, accurate_model, growing_models
from .animation import write_animation
from .calibration import calibrated
from .certificate import Certificate, ErrorEstimator
from .cubature import Cubature, CubatureErrors
from .displacements import DisplacementRows, SnapshotGram
from .energy import ElasticEnergy
from .filling import fill_surface, stuff_surface
from .fitting import PoseFit, PoseFits, fit_poses
from .greedy import greedy_snapshots
from .material import (
    ARAP,
    MATERIALS,
    Corotational,
    Material,
    MooneyRivlin,
    StableNeoHookean,
    StVK,
    SymmetricDirichlet,
)
from .mesh import (
    EmbeddedSurface,
    MeshNotice,
    TetMesh,
    boundary_surface,
    embed_surface,
    mass_matrix,
    read_surface,
    read_tets,
    repair_tets,
    write_surface,
    write_tets,
)
from .model_file import load, load_blending, load_posing, save_model
from .page import export_html
from .problem import (
    CertainRange,
    Handle,
    HandleBox,
    Handles,
    InterpolationProblem,
    Poses,
    PosingProblem,
    Simplex,
    in_box,
    in_sphere,
    read_problem,
    read_problem_surface,
)
from .reduction import (
    HandleQuadric,
    InterpolationModel,
    PosingModel,
    Quartic,
    ReducedModel,
    reduce,
)
from .registration import RigidMotion, matched_scales, registered, rigid_registration
from .sampling import sample
from .session import BlendingSession, FrameReport, Polished, PosingSession, Session
from .snapshots import (
    Checkpoint,
    CheckpointNotice,
    Interrupted,
    SampleReport,
    Snapshots,
    SolveProgress,
    SolverOptions,
    UnsavedSamplesError,
    carried,
    load_snapshots,
    save_snapshots,
    solve_snapshots,
)
from .subspace import AffineSubspace, affine_subspace, pca, snapshot_pca
from .validation import (
    ErrorCurve,
    ErrorSplit,
    NextOption,
    Validation,
    error_curve,
    next_option,
    split_errors,
    validate,
)

__version__ = _version("snapspace")

__all__ = [
    "ARAP",
    "MATERIALS",
    "AccurateModel",
    "AffineSubspace",
    "BlendingSession",
    "CertainRange",
    "Certificate",
    "Checkpoint",
    "CheckpointNotice",
    "Corotational",
    "Cubature",
    "CubatureErrors",
    "DisplacementRows",
    "ElasticEnergy",
    "EmbeddedSurface",
    "ErrorCurve",
    "ErrorEstimator",
    "ErrorSplit",
    "FrameReport",
    "Growth",
    "Handle",
    "HandleBox",
    "HandleQuadric",
    "Handles",
    "InterpolationModel",
    "InterpolationProblem",
    "Interrupted",
    "Material",
    "MeshNotice",
    "MooneyRivlin",
    "NextOption",
    "Polished",
    "PoseFit",
    "PoseFits",
    "Poses",
    "PosingModel",
    "PosingProblem",
    "PosingSession",
    "Quartic",
    "ReducedModel",
    "RigidMotion",
    "SampleReport",
    "Session",
    "Simplex",
    "SnapshotGram",
    "Snapshots",
    "SolveProgress",
    "SolverOptions",
    "StVK",
    "StableNeoHookean",
    "SymmetricDirichlet",
    "TetMesh",
    "UnsavedSamplesError",
    "Validation",
    "accurate_model",
    "affine_subspace",
    "boundary_surface",
    "calibrated",
    "carried",
    "embed_surface",
    "error_curve",
    "export_html",
    "fill_surface",
    "fit_poses",
    "greedy_snapshots",
    "growing_models",
    "in_box",
    "in_sphere",
    "load",
    "load_blending",
    "load_posing",
    "load_snapshots",
    "mass_matrix",
    "matched_scales",
    "next_option",
    "pca",
    "read_problem",
    "read_problem_surface",
    "read_surface",
    "read_tets",
    "reduce",
    "registered",
    "repair_tets",
    "rigid_registration",
    "sample",
    "save_model",
    "save_snapshots",
    "snapshot_pca",
    "solve_snapshots",
    "split_errors",
    "stuff_surface",
    "validate",
    "write_animation",
    "write_surface",
    "write_tets",
]
