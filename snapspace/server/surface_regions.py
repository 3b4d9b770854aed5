"""SurfaceRegions: handles chosen on a surface, as handles of the tets inside it."""

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

#: Fewer vertices cannot hold a part of a body in place.
FEWEST = 3


class SurfaceRegions:
    """Converts chosen surface vertices to tet vertices, and back.

    A tet vertex of the boundary belongs to the closest surface vertex, so handles have no gaps
    where the surface is coarser than the tets. The tet vertex that a chosen surface vertex follows
    most belongs to it too, for places where the surface is finer.

    Parameters
    ----------
    mesh : TetMesh
    surface : EmbeddedSurface
        A surface embedded in the mesh.
    """

    def __init__(self, mesh: TetMesh, surface: EmbeddedSurface) -> None:
        self._mesh, self._surface = mesh, surface
        self._closest = closest_corners(
            surface.vertices(mesh.vertices), surface.faces, mesh.vertices[mesh.surface_vertices]
        )
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
            if not chosen[one].size:  # no surface vertex follows it: take those around it
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
                _assign_free(of_tets, self._surface.corners[handle.vertices], one)
            regions.append(np.flatnonzero(of_tets == one).astype(np.int32))
            if regions[-1].size < FEWEST:
                raise ValueError(
                    f"handle '{handle.name}' has {len(handle.vertices)} of the surface's vertices, "
                    f"but only {regions[-1].size} of the tets'; at least {FEWEST} are needed: "
                    "choose a larger part, or fill the surface with smaller tets (--edge-length)"
                )
        self._known = {
            handle.vertices.tobytes(): region
            for handle, region in zip(handles, regions, strict=True)
        }
        return Handles(regions, names=handles.names)

    def _owners_on_surface(self, handles: Handles) -> Owners:
        """The index of each surface vertex's handle, (s,), or -1."""
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
        """The index of each tet vertex's handle, (n,), or -1."""
        owners = np.full(len(self._mesh.vertices), -1)
        owners[self._mesh.surface_vertices] = of_surface[self._closest]
        for one in range(count):
            _assign_free(owners, self._surface.nearest[of_surface == one], one)
        return owners


def _assign_free(owners: Owners, vertices: Indices, one: int) -> None:
    """Assigns an owner to those of the vertices that have none."""
    owners[vertices[owners[vertices] < 0]] = one
