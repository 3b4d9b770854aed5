"""Loading model files for the commands."""

from __future__ import annotations

from pathlib import Path

from ..model_file import load
from ..reduction import InterpolationModel, PosingModel


def load_leading(path: Path, dimension: int | None) -> PosingModel | InterpolationModel:
    """Loads a model file, with its first `dimension` modes if that is given."""
    return leading_of(load(path), path, dimension)


def leading_of(
    model: PosingModel | InterpolationModel, path: Path, dimension: int | None
) -> PosingModel | InterpolationModel:
    """A loaded model with its first `dimension` modes, or with all modes if that is None."""
    if dimension is None:
        return model
    if dimension > model.dimension:
        raise ValueError(
            f"--dimension is {dimension}, but {path} has {model.dimension} modes; build it with "
            "more, or leave the option out"
        )
    return model.leading(dimension)


def load_posing(path: Path, dimension: int | None) -> PosingModel:
    """Loads a model with handles; ValueError for one that blends poses."""
    model = load_leading(path, dimension)
    if not isinstance(model, PosingModel):
        raise ValueError(
            f"{path}: this model interpolates poses and has no handles; use `snapspace blend`"
        )
    return model


def load_interpolation(path: Path, dimension: int | None) -> InterpolationModel:
    """Loads a model that blends poses; ValueError for one with handles."""
    model = load_leading(path, dimension)
    if not isinstance(model, InterpolationModel):
        raise ValueError(
            f"{path}: this model has handles and no poses to blend; use `snapspace pose`"
        )
    return model
