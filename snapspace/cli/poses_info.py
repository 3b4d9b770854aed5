"""Figures of interpolation problems."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..problem import InterpolationProblem
from ..reduction import InterpolationModel
from .material_info import material_figures, material_text


def poses_figures(model: InterpolationModel) -> dict[str, Any]:
    """Poses, material and domain, for JSON."""
    problem = model.problem
    return {
        "poses": _poses(problem),
        "parameters": problem.parameter_count,
        "material": material_figures(problem.material),
        "extrapolation": problem.domain.extrapolation,
        "surface": {"vertices": len(model.surface.corners), "faces": len(model.surface.faces)},
    }


def poses_facts(figures: dict[str, Any]) -> list[tuple[str, str]]:
    """The same for people."""
    surface = figures["surface"]
    poses = [
        (
            "" if number else "poses",
            f"{pose['name']}: volume {pose['volume']:.6g}, {pose['distance']:.3g} from the mean "
            "shape" + (f", {pose['inverted_tets']} tets inverted" if pose["inverted_tets"] else ""),
        )
        for number, pose in enumerate(figures["poses"])
    ]
    domain = "weights that sum to one"
    if figures["extrapolation"]:
        domain += f", in a simplex that is larger by {figures['extrapolation']:g}"
    return [
        *poses,
        ("parameters", f"{figures['parameters']}, {domain}"),
        ("surface", f"{surface['vertices']} vertices, {surface['faces']} faces"),
        ("material", material_text(figures["material"])),
    ]


def _poses(problem: InterpolationProblem) -> list[dict[str, Any]]:
    """Name, volume, inverted tets, rms distance from the mean shape relative to the diagonal."""
    poses = problem.poses
    offsets = (problem.pose_shapes - problem.tau).reshape(len(poses), -1, 3)
    masses = problem.mass(lumped=True).diagonal()
    squares = (offsets**2).sum(axis=2) @ masses / masses.sum()
    return [
        {
            "name": name,
            "volume": float(volumes.sum()),
            "inverted_tets": int(inverted),
            "distance": float(np.sqrt(square)) / problem.mesh.diagonal,
        }
        for name, volumes, inverted, square in zip(
            poses.names, poses.volumes, poses.inverted_tets, squares, strict=True
        )
    ]
