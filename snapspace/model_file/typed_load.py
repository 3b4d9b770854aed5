"""load_posing, load_blending: model files of a known kind."""

from __future__ import annotations

from pathlib import Path

from ..arguments import as_path
from ..reduction import InterpolationModel, PosingModel
from .model_file import SUFFIX, load


def load_posing(path: str | Path) -> PosingModel:
    """`load` for a model with handles, whose session moves them.

    Raises
    ------
    ValueError
        As for `load`, and for a model that blends poses.
    """
    model = load(as_path("load_posing", path, what=f"{SUFFIX} file"))
    if not isinstance(model, PosingModel):
        raise ValueError(
            f"{path}: this model blends poses and has no handles; read it with load_blending"
        )
    return model


def load_blending(path: str | Path) -> InterpolationModel:
    """`load` for a model of several poses, whose session blends them.

    Raises
    ------
    ValueError
        As for `load`, and for a model with handles.
    """
    model = load(as_path("load_blending", path, what=f"{SUFFIX} file"))
    if not isinstance(model, InterpolationModel):
        raise ValueError(
            f"{path}: this model has handles and no poses to blend; read it with load_posing"
        )
    return model
