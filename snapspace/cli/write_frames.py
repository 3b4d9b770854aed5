"""write_frames: the frames of a path or a timeline, as a film or in a folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..animation import shape_suffix, write_animation
from ..pictures import tint
from ..reduction import InterpolationModel, PosingModel
from .frames import is_film, notice_old_frames
from .glb import write_path

FloatArray = NDArray[np.float64]


def write_frames(
    output: Path | None,
    model: PosingModel | InterpolationModel,
    shapes: Sequence[FloatArray],
    *,
    kind: str | None,
    frames_per_second: float,
    up: str | None,
) -> list[Path]:
    """Writes shapes (n, 3) to a film with tinted handles, or to a folder; returns the files.

    up : axis that points up in films and new .glb files; None: the model's own
    """
    if output is None:
        return []
    axis = up or model.up
    if is_film(output):
        colors = handle_colors(model) if isinstance(model, PosingModel) else None
        write = write_path if output.suffix.lower() == ".glb" else write_animation
        return write(
            output, model, shapes, frames_per_second=frames_per_second, up=axis, colors=colors
        )
    suffix = shape_suffix(model, kind)
    notice_old_frames(output, len(shapes), suffix=suffix)
    turned: dict[str, Any] = {"up": axis} if suffix == ".glb" else {}
    rate = frames_per_second
    return write_animation(output, model, shapes, kind=kind, frames_per_second=rate, **turned)


def handle_colors(model: PosingModel) -> FloatArray:
    """Colours of the shown surface's vertices, (s, 3), with the handles tinted."""
    regions = [model.surface.following(handle.vertices) for handle in model.problem.handles]
    return tint(len(model.surface.corners), regions)
