"""glTF: models as meshes with morph targets, for viewers, engines and Blender."""

from .blender_script import write_blender
from .morph_targets import MorphTargets, fitted_targets, mode_targets, still_shape
from .write_glb import write_glb

__all__ = [
    "MorphTargets",
    "fitted_targets",
    "mode_targets",
    "still_shape",
    "write_blender",
    "write_glb",
]
