"""Model files as the commands take them."""

from __future__ import annotations

from pathlib import Path

from ..model_file import load
from ..reduction import ReducedModel


def load_leading(path: Path, dimension: int | None) -> ReducedModel:
    """The model of a file, on its first `dimension` modes if that is given."""
    model = load(path)
    if dimension is None:
        return model
    if dimension > model.dimension:
        raise ValueError(
            f"--dimension is {dimension}, but {path} has {model.dimension} modes; build it with "
            "more, or leave the option out"
        )
    return model.leading(dimension)
