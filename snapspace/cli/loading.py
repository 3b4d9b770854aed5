"""Model files as the commands take them."""

from __future__ import annotations

from pathlib import Path

from ..model_file import load
from ..reduction import InterpolationModel, PosingModel


def load_leading(path: Path, dimension: int | None) -> PosingModel | InterpolationModel:
    """The model of a file, on its first `dimension` modes if that is given."""
    return leading_of(load(path), path, dimension)


def leading_of(
    model: PosingModel | InterpolationModel, path: Path, dimension: int | None
) -> PosingModel | InterpolationModel:
    """The model of a file on its first `dimension` modes if that is given, else itself."""
    if dimension is None:
        return model
    if dimension > model.dimension:
        raise ValueError(
            f"--dimension is {dimension}, but {path} has {model.dimension} modes; build it with "
            "more, or leave the option out"
        )
    return model.leading(dimension)


def load_posing(path: Path, dimension: int | None) -> PosingModel:
    """A model with handles; ValueError for one of interpolation."""
    model = load_leading(path, dimension)
    if not isinstance(model, PosingModel):
        raise ValueError(
            f"{path}: this model interpolates poses and has no handles; use `snapspace blend`"
        )
    return model


def load_interpolation(path: Path, dimension: int | None) -> InterpolationModel:
    """A model of several poses; ValueError for one with handles."""
    model = load_leading(path, dimension)
    if not isinstance(model, InterpolationModel):
        raise ValueError(
            f"{path}: this model has handles and no poses to blend; use `snapspace pose`"
        )
    return model
