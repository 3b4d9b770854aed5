"""Sample a shape problem, keep the best small space, solve in it live.

Names are imported from their packages on first use, so `import snapspace` alone takes a tenth of
the time. Type checkers read `__init__.pyi`; a test keeps it equal to `EXPORTS`.
"""

from importlib import import_module as _import_module
from typing import Any as _Any

#: The packages and modules, each with the names that `snapspace` exports from it.
EXPORTS = {
    "accurate": ("AccurateModel", "Growth", "accurate_model", "growing_models"),
    "animation": ("write_animation",),
    "calibration": ("calibrate",),
    "certificate": ("Certificate", "ErrorEstimator"),
    "cubature": ("Cubature", "CubatureErrors", "LocalRows"),
    "displacements": ("DisplacementRows", "SnapshotGram"),
    "doctor": ("Finding", "MendedSurface", "SurfaceReport", "check_surface", "mend_surface"),
    "energy": ("ElasticEnergy",),
    "filling": ("fill_surface", "stuff_surface"),
    "fitting": ("PoseFit", "PoseFits", "fit_poses"),
    "greedy": ("greedy_snapshots",),
    "material": (
        "ARAP",
        "MATERIALS",
        "Corotational",
        "Material",
        "MooneyRivlin",
        "StableNeoHookean",
        "StVK",
        "SymmetricDirichlet",
    ),
    "mesh": (
        "EmbeddedSurface",
        "MeshNotice",
        "MirrorPlane",
        "ShellMesh",
        "SurfaceFile",
        "TetMesh",
        "boundary_surface",
        "embed_surface",
        "mass_matrix",
        "open_surface",
        "read_surface",
        "read_tets",
        "repair_tets",
        "write_surface",
        "write_tets",
    ),
    "gltf": (
        "MorphTargets",
        "fitted_targets",
        "mode_targets",
        "still_shape",
        "write_blender",
        "write_glb",
    ),
    "model_file": ("load", "load_blending", "load_posing", "save_model"),
    "page": ("export_html", "export_packed"),
    "problem": (
        "CertainRange",
        "Handle",
        "HandleBox",
        "Handles",
        "InterpolationProblem",
        "Poses",
        "PosingProblem",
        "ShellPoses",
        "Simplex",
        "handles_in_tets",
        "in_box",
        "in_sphere",
        "read_problem",
        "read_problem_surface",
    ),
    "reduction": (
        "HandleQuadric",
        "InterpolationModel",
        "PosingModel",
        "Quartic",
        "ReducedModel",
        "reduce",
        "with_handles",
    ),
    "registration": ("RigidMotion", "matched_scales", "registered", "rigid_registration"),
    "sampling": ("sample",),
    "session": (
        "BlendingSession",
        "Dynamics",
        "FrameReport",
        "Polished",
        "PosingSession",
        "Session",
        "mirror_pose",
        "predicted_solutions",
    ),
    "snapshots": (
        "Checkpoint",
        "CheckpointNotice",
        "Interrupted",
        "Predictions",
        "SampleReport",
        "Snapshots",
        "SolveProgress",
        "SolverOptions",
        "UnsavedSamplesError",
        "carry_over",
        "load_snapshots",
        "save_snapshots",
        "solve_snapshots",
    ),
    "subspace": (
        "AffineSubspace",
        "affine_subspace",
        "handle_windows",
        "pca",
        "snapshot_pca",
        "widen",
    ),
    "symmetry": (
        "counterparts",
        "mirror_handle",
        "mirror_plane",
        "mirrored_name",
        "mirrored_region",
    ),
    "timeline": ("Key", "Timeline", "read_timeline", "write_timeline"),
    "validation": (
        "ErrorCurve",
        "ErrorSplit",
        "NextOption",
        "Validation",
        "error_curve",
        "next_option",
        "split_errors",
        "validate",
    ),
}
_HOMES = {name: home for home, names in EXPORTS.items() for name in names}

__all__ = sorted(_HOMES)


def __getattr__(name: str) -> _Any:
    """Imports a name on its first use, or a package that was not imported yet."""
    if name in _HOMES:
        value = getattr(_import_module(f".{_HOMES[name]}", __name__), name)
    elif name == "__version__":
        from importlib.metadata import version

        value = version(__name__)
    elif name in EXPORTS or name == "generators":
        return _import_module(f".{name}", __name__)
    else:
        raise AttributeError(f"module 'snapspace' has no attribute '{name}'")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__, *EXPORTS, "__version__"})
