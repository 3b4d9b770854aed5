"""SurfaceRegions: handles chosen on a surface, as handles of the tets inside of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..mesh import EmbeddedSurface, TetMesh
from ..mesh.closest_corners import closest_corners
from ..problem import Handles
from .messages import HandleChoice

Indices = NDArray[np.int32]
Owners = NDArray[np.intp]

#: Fewer vertices hold no part of a body in its place.
FEWEST = 3


class SurfaceRegions:
    """Tet vertices for the vertices of a surface that a page chooses, and back.

    A tet vertex of the boundary belongs to the surface vertex that is closest to it, so handles
    have no gaps where the surface is coarser than the tets. The one that a chosen surface vertex
    follows most belongs to it too: there are others where the surface is finer.

    Parameters
    ----------
    mesh : TetMesh
    surface : EmbeddedSurface
        In the mesh.
    """

    def __init__(self, mesh: TetMesh, surface: EmbeddedSurface) -> None:
        self._mesh, self._surface = mesh, surface
        self._closest = closest_corners(
            surface.vertices(mesh.vertices), surface.faces, mesh.vertices[mesh.surface_vertices]
        )
        self._known: dict[bytes, Indices] = {}  # tet vertices by the bytes of surface vertices

    @property
    def surface_vertices(self) -> int:
        """How many vertices the surface has."""
        return len(self._surface.corners)

    def through(self, chosen: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Which tet vertices are in a part of the surface, (n,), with those below it.

        Parameters
        ----------
        chosen : ndarray of bool, (s,)
            Which vertices of the surface are.
        """
        inside: NDArray[np.bool_] = chosen[self._closest_of_all]
        inside[self._surface.nearest[chosen]] = True
        return inside

    @cached_property
    def _closest_of_all(self) -> NDArray[np.intp]:
        """The surface vertex closest to each tet vertex, (n,), also those inside."""
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
        """Handles of the tets with the vertices of the surface that follow them most.

        `painted` has the vertices of the surface for handles, by name, that were chosen there.
        Indices that the surface does not have are left out.
        """
        regions = [np.array(choice.vertices, np.int32) for choice in choices]
        count = self.surface_vertices
        chosen = []
        for choice, region in zip(choices, regions, strict=True):
            own = np.unique(np.array((painted or {}).get(choice.name, ()), np.int64))
            own = own[(own >= 0) & (own < count)]
            chosen.append(own if own.size else self._surface.following(region))
        for one, region in enumerate(regions):
            if not chosen[one].size:  # no surface vertex is near: those around it
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

        Those that were shown, or taken the last time, are the same again.

        Raises
        ------
        ValueError
            For an index that the surface does not have, or a handle too small for the tets.
        """
        of_surface = self._owners_on_surface(handles)
        of_tets = self._owners_in_tets(of_surface, len(handles))
        known = [self._known.get(handle.vertices.tobytes()) for handle in handles]
        for one, region in enumerate(known):
            if region is not None:
                of_tets[of_tets == one] = -1
        for one, region in enumerate(known):
            if region is not None:
                of_tets[region] = one
        regions = []
        for one, handle in enumerate(handles):
            if np.count_nonzero(of_tets == one) < FEWEST:
                _give(of_tets, self._surface.corners[handle.vertices], one)
            regions.append(np.flatnonzero(of_tets == one).astype(np.int32))
            if regions[-1].size < FEWEST:
                raise ValueError(
                    f"handle '{handle.name}' has {len(handle.vertices)} of the surface's vertices, "
                    f"which hold {regions[-1].size} of the tets'; at least {FEWEST} are needed: "
                    "choose a larger part, or fill the surface with shorter tets (--edge-length)"
                )
        self._known = {
            handle.vertices.tobytes(): region
            for handle, region in zip(handles, regions, strict=True)
        }
        return Handles(regions, names=handles.names)

    def _owners_on_surface(self, handles: Handles) -> Owners:
        """Which handle each surface vertex is of, or -1."""
        count = len(self._surface.corners)
        owners = np.full(count, -1)
        for one, handle in enumerate(handles):
            if handle.vertices[-1] >= count:
                raise ValueError(
                    f"handle '{handle.name}' has vertex index {handle.vertices[-1]}, but the "
                    f"surface has {count} vertices"
                )
            owners[handle.vertices] = one
        return owners

    def _owners_in_tets(self, of_surface: Owners, count: int) -> Owners:
        """Which handle each tet vertex is of, or -1."""
        owners = np.full(len(self._mesh.vertices), -1)
        owners[self._mesh.surface_vertices] = of_surface[self._closest]
        for one in range(count):
            _give(owners, self._surface.nearest[of_surface == one], one)
        return owners


def _give(owners: Owners, vertices: Indices, one: int) -> None:
    """Those of the vertices that are free get an owner."""
    owners[vertices[owners[vertices] < 0]] = one
