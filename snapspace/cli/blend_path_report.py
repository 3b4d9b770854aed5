"""What `snapspace blend --path` reports: motions from frame to frame, and jumps."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from .blend_shape import BlendedShape
from .console import notice
from .even_path import PathJump


def path_figures(shapes: Sequence[BlendedShape], jumps: Sequence[PathJump]) -> dict[str, Any]:
    """The entry "path": the largest motion of a vertex from frame to frame, and jumps."""
    steps = [b.vertices - a.vertices for a, b in pairwise(shapes)]
    return {
        "motions": [float(np.linalg.norm(step, axis=1).max()) for step in steps],
        "jumps": [
            {
                "frame": jump.frame,
                "weights": jump.weights.tolist(),
                "motion": jump.motion,
                "deformation": jump.deformation,
                "turns": jump.turns,
            }
            for jump in jumps
        ],
    }


def path_facts(figures: dict[str, Any]) -> list[tuple[str, str]]:
    """The table line about motions, for a path."""
    if "path" not in figures:
        return []
    motions = figures["path"]["motions"]
    return [("largest motion", f"{min(motions):.3g} to {max(motions):.3g} from frame to frame")]


def notice_jumps(jumps: Sequence[PathJump]) -> None:
    """Prints a notice for each jump."""
    for jump in jumps:
        weights = ",".join(f"{w:.4g}" for w in jump.weights)
        where = f"by {jump.motion:.3g} before frame {jump.frame}, at --weights {weights}"
        if jump.turns:
            notice(
                f"notice: the body turns as a whole {where}, however small the step; after "
                f"registration, the two shapes differ by {jump.deformation:.3g}"
            )
        else:
            notice(
                f"notice: the shape jumps {where}, however small the step; add poses between those "
                "of the path"
            )
