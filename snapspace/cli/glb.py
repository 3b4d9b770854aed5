"""glTF files and Blender scripts of the command line, with lines about their errors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..gltf import (
    MorphTargets,
    film_targets,
    fitted_targets,
    mode_targets,
    write_blender,
    write_glb,
)
from ..reduction import ReducedModel
from .console import notice
from .units import in_bytes

FloatArray = NDArray[np.float64]
#: Largest number of targets for a path; many engines support no more.
FEW = 8


def write_path(
    output: Path,
    model: ReducedModel,
    shapes: Sequence[FloatArray],
    *,
    up: str,
    frames_per_second: float,
    colors: FloatArray | None = None,
) -> list[Path]:
    """Writes shapes (n, 3) as the frames of an animation of at most eight morph targets.

    The colours (s, 3) are for surfaces without materials of their own.
    """
    morphs = film_targets(model, np.array(shapes), count=FEW)
    tint = colors if morphs.drawn.look is None else None
    write_glb(output, model, morphs, up=up, frames_per_second=frames_per_second, colors=tint)
    notice(described(output, model, morphs))
    return [output]


def write_model(
    output: Path, model: ReducedModel, *, targets: int | None, name: str, up: str | None
) -> dict[str, Any]:
    """Writes a model with all modes, or with targets fitted to its samples; returns the figures."""
    morphs = _targets(model, targets)
    write_glb(output, model, morphs, name=name, up=up)
    notice(described(output, model, morphs))
    return {
        "glb": str(output),
        "glb_bytes": output.stat().st_size,
        "targets": len(morphs.targets),
        "target_error": morphs.error / model.problem.mesh.diagonal,
    }


def write_script(
    output: Path, model: ReducedModel, *, targets: int | None, name: str, up: str | None
) -> dict[str, Any]:
    """Writes a script that makes the model's modes shape keys in Blender; returns the figures."""
    morphs = _targets(model, targets)
    write_blender(output, model, morphs, name=name, up=up)
    notice(f"{described(output, model, morphs)}; run it in Blender's text editor")
    return {"blender": str(output), "shape_keys": len(morphs.targets)}


def described(output: Path, model: ReducedModel, morphs: MorphTargets) -> str:
    """A line for the user."""
    error = morphs.error / model.problem.mesh.diagonal
    off = f"at most {100 * error:.2g} % of the diagonal off" if error > 1e-6 else "exact"
    size = in_bytes(output.stat().st_size)
    return f"wrote {output}, {size}, {len(morphs.targets)} morph targets, {off}"


def _targets(model: ReducedModel, count: int | None) -> MorphTargets:
    return mode_targets(model) if count is None else _fitted_to_samples(model, count)


def _fitted_to_samples(model: ReducedModel, count: int) -> MorphTargets:
    samples = model.training_coordinates
    if len(samples) == 0:
        raise ValueError("--targets: the model has no training samples to fit to; leave it out")
    shapes = np.array([model.subspace.shape(q).reshape(-1, 3) for q in samples])
    found = fitted_targets(model, shapes, count=count)
    # a file without an animation begins with the shape tau
    return replace(found, weights=np.zeros((0, len(found.targets))))
