"""Numbers about interpolation problems, for `info`."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..reduction import InterpolationModel
from .material_info import material_figures, material_text


def poses_figures(model: InterpolationModel) -> dict[str, Any]:
    """Poses, material and domain, for JSON."""
    problem = model.problem
    return {
        "poses": _poses(model),
        "parameters": problem.parameter_count,
        "material": material_figures(problem.material),
        "extrapolation": problem.domain.extrapolation,
        "surface": {"vertices": len(model.surface.corners), "faces": len(model.surface.faces)},
    }


def poses_facts(figures: dict[str, Any]) -> list[tuple[str, str]]:
    """The same as lines for the user."""
    surface = figures["surface"]
    poses = [
        (
            "" if number else "poses",
            f"{pose['name']}: volume {pose['volume']:.6g}, {pose['distance']:.3g} from the mean "
            "shape"
            + (f", {pose['inverted_tets']} tets inverted" if pose["inverted_tets"] else "")
            + _ends_text(pose["certain_weights"]),
        )
        for number, pose in enumerate(figures["poses"])
    ]
    domain = "weights that sum to one"
    if figures["extrapolation"]:
        domain += f", in a simplex that is larger by {figures['extrapolation']:g}"
    if figures["poses"][0]["certain_weights"] is None:
        domain += "; how far below zero blends have a minimum is unknown for this material"
    return [
        *poses,
        ("parameters", f"{figures['parameters']}, {domain}"),
        ("surface", f"{surface['vertices']} vertices, {surface['faces']} faces"),
        ("material", material_text(figures["material"])),
    ]


def _poses(model: InterpolationModel) -> list[dict[str, Any]]:
    """Name, volume, inverted tets, rms distance from the mean shape relative to the diagonal.

    Also the smallest and largest weight for which the model's energy certainly has a minimum, with
    the other weights equal; None if no test is known, and for an end that does not exist.
    """
    problem = model.problem
    poses, certain = problem.poses, model.certain_range
    limits = [None] * len(poses) if certain is None else [_ends(row) for row in certain.limits()]
    offsets = (problem.pose_shapes - problem.tau).reshape(len(poses), -1, 3)
    masses = problem.mass(lumped=True).diagonal()
    squares = (offsets**2).sum(axis=2) @ masses / masses.sum()
    return [
        {
            "name": name,
            "volume": float(volumes.sum()),
            "inverted_tets": int(inverted),
            "distance": float(np.sqrt(square)) / problem.mesh.diagonal,
            "certain_weights": ends,
        }
        for name, volumes, inverted, square, ends in zip(
            poses.names, poses.volumes, poses.inverted_tets, squares, limits, strict=True
        )
    ]


def _ends(limits: NDArray[np.float64]) -> list[float | None]:
    return [float(weight) if np.isfinite(weight) else None for weight in limits]


def _ends_text(ends: list[float | None] | None) -> str:
    if ends is None:
        return ""
    least, greatest = ("no end" if weight is None else f"{100 * weight:.0f} %" for weight in ends)
    return f", weight certain from {least} to {greatest}"
