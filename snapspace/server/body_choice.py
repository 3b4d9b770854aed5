"""BodyChoice: the body that a page chooses, a solid or a shell."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..mesh import Body as Mesh
from ..mesh import ShellMesh, shell_of_file
from .body import Body


class BodyChoice:
    """A body as it was opened, and its surface as a shell of any thickness.

    Parameters
    ----------
    opened : Body
    """

    def __init__(self, opened: Body) -> None:
        self._opened = self._last = opened

    def of(self, thickness: float | None) -> Body:
        """The shell of this thickness, or the body as it was opened for None.

        ValueError for tets without a surface, and as for `ShellMesh`.
        """
        if thickness is None:
            return self._opened
        for known in (self._opened, self._last):
            if shown_thickness(known.mesh) == thickness:
                return known
        self._last = _shell(self._opened, thickness)
        return self._last


def shown_thickness(mesh: Mesh) -> float | None:
    """The thickness of a shell, the mean if triangles differ; None for a solid."""
    return float(np.mean(mesh.thickness)) if isinstance(mesh, ShellMesh) else None


def _shell(body: Body, thickness: float) -> Body:
    mesh, surface = body.mesh, body.surface
    if isinstance(mesh, ShellMesh):
        mesh = ShellMesh(mesh.vertices, mesh.triangles, thickness=thickness)
    elif surface is not None and surface.source is not None:
        mesh, surface = shell_of_file(surface.source, thickness=thickness)
    else:
        raise ValueError("a shell is made of a surface, but this mesh came as tets")
    return replace(body, mesh=mesh, surface=surface, file=None, problem=None)
