"""The check that handles hold a body in its place."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh import Body

#: Points are on one line if they are this close to it, as a share of the diagonal.
_LINE = 1e-9


def check_held(mesh: Body, pinned: NDArray[np.int32], *, who: str) -> None:
    """Raises ValueError unless the pinned vertices keep every component from turning."""
    is_pinned = np.zeros(len(mesh.vertices), np.bool_)
    is_pinned[pinned] = True
    parts = int(mesh.components.max()) + 1
    for part in range(parts):
        of_part = np.zeros(len(mesh.vertices), np.bool_)
        of_part[mesh.cells[mesh.components == part]] = True
        points = mesh.vertices[of_part & is_pinned]
        if _on_a_line(points, mesh.diagonal):
            if parts == 1:
                raise ValueError(
                    f"{who}: the vertices of all handles lie on one line, so the shape could turn "
                    "about it; give the handles more vertices"
                )
            first = int(np.flatnonzero(of_part)[0])
            raise ValueError(
                f"{who}: component {part} of {parts}, that of vertex {first}, is not held: "
                f"{len(points)} of its vertices are in handles, and they lie on one line; give "
                "handles vertices of every component, or remove it"
            )


def _on_a_line(points: NDArray[np.float64], diagonal: float) -> bool:
    if len(points) < 3:
        return True
    extents = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return bool(extents[1] <= _LINE * diagonal)
