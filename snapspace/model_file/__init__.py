"""Model files."""

from .model_file import FORMAT, SUFFIX, VERSION, check_model_path, load, save_model
from .typed_load import load_blending, load_posing

__all__ = [
    "FORMAT",
    "SUFFIX",
    "VERSION",
    "check_model_path",
    "load",
    "load_blending",
    "load_posing",
    "save_model",
]
