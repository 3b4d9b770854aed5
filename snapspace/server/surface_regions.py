"""SurfaceRegions: converts handles of a surface to handles of the tets inside it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..mesh import Body, EmbeddedSurface
from ..mesh.closest_corners import closest_corners
from ..problem import Handles
from ..problem.surface_handles import SurfaceHandles
from .messages import HandleChoice

Indices = NDArray[np.int32]


class SurfaceRegions:
    """Converts chosen surface vertices to tet vertices, and back.

    See `handles_in_tets` for the vertices of handles.

    Parameters
    ----------
    mesh : TetMesh or ShellMesh
    surface : EmbeddedSurface
        A surface embedded in the mesh.
    """

    def __init__(self, mesh: Body, surface: EmbeddedSurface) -> None:
        self._mesh, self._surface = mesh, surface
        self._handles = SurfaceHandles(mesh, surface)
        self._closest = self._handles.closest
        self._known: dict[bytes, Indices] = {}  # tet vertices by the bytes of surface vertices

    @property
    def surface_vertices(self) -> int:
        """Number of the surface's vertices."""
        return len(self._surface.corners)

    def through(self, chosen: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Mask (n,) of the tet vertices in a part of the surface, including those below it.

        Parameters
        ----------
        chosen : ndarray of bool, (s,)
            Mask of the surface vertices in the part.
        """
        inside: NDArray[np.bool_] = chosen[self._closest_of_all]
        inside[self._surface.nearest[chosen]] = True
        return inside

    @cached_property
    def _closest_of_all(self) -> NDArray[np.intp]:
        """The surface vertex closest to each tet vertex, (n,), including interior ones."""
        closest = np.empty(len(self._mesh.vertices), np.intp)
        closest[self._mesh.surface_vertices] = self._closest
        inner = np.setdiff1d(np.arange(len(closest)), self._mesh.surface_vertices)
        if inner.size:
            points = self._surface.vertices(self._mesh.vertices)
            closest[inner] = closest_corners(
                points, self._surface.faces, self._mesh.vertices[inner]
            )
        return closest

    def shown(
        self, choices: Sequence[HandleChoice], painted: Mapping[str, Sequence[int]] | None = None
    ) -> tuple[HandleChoice, ...]:
        """The handles of the tets, with the surface vertices that follow them most.

        `painted` has, by name, the surface vertices of handles that were painted on the surface.
        Indices out of range are left out.
        """
        regions = [np.array(choice.vertices, np.int32) for choice in choices]
        count = self.surface_vertices
        chosen = []
        for choice, region in zip(choices, regions, strict=True):
            own = np.unique(np.array((painted or {}).get(choice.name, ()), np.int64))
            own = own[(own >= 0) & (own < count)]
            chosen.append(own if own.size else self._surface.following(region))
        for one, region in enumerate(regions):
            if not chosen[one].size:  # no surface vertex follows it: use those around it
                around = self._closest[np.isin(self._mesh.surface_vertices, region)]
                others = np.concatenate([*chosen[:one], *chosen[one + 1 :]])
                chosen[one] = np.setdiff1d(around, others)
        self._known = {
            own.astype(np.int32).tobytes(): region
            for own, region in zip(chosen, regions, strict=True)
        }
        return tuple(
            replace(choice, vertices=tuple(own.tolist()))
            for choice, own in zip(choices, chosen, strict=True)
        )

    def in_tets(self, handles: Handles) -> Handles:
        """Handles of tet vertices for handles of surface vertices.

        Handles from the last `shown` or `in_tets` get the same tet vertices again.

        Raises
        ------
        ValueError
            For an index out of range, or a handle too small for the tets.
        """
        known = [self._known.get(handle.vertices.tobytes()) for handle in handles]
        found = self._handles.in_tets(handles, known=known)
        self._known = {
            handle.vertices.tobytes(): own.vertices
            for handle, own in zip(handles, found, strict=True)
        }
        return found
