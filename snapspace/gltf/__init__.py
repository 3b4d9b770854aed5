"""glTF: models as meshes with morph targets, for viewers, engines and Blender."""

from .blender_script import write_blender
from .morph_targets import MorphTargets, fitted_targets, mode_targets, still_shape
from .sliders import film_targets, sliders
from .write_glb import write_glb

__all__ = [
    "MorphTargets",
    "film_targets",
    "fitted_targets",
    "mode_targets",
    "sliders",
    "still_shape",
    "write_blender",
    "write_glb",
]
