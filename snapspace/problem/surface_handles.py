"""handles_in_tets: converts handles of a surface to handles of the tets inside it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..arguments import require_type
from ..mesh import Body, EmbeddedSurface, check_body
from ..mesh.closest_corners import closest_corners
from .handles import Handles

Indices = NDArray[np.int32]
Owners = NDArray[np.intp]

#: Fewer vertices cannot hold a part of a body in place.
FEWEST = 3


def handles_in_tets(handles: Handles, mesh: Body, surface: EmbeddedSurface) -> Handles:
    """Handles of tet vertices for handles of surface vertices.

    Parameters
    ----------
    handles : Handles
        Of vertices of the surface.
    mesh : TetMesh or ShellMesh
    surface : EmbeddedSurface
        The surface in the mesh, see `embed_surface`.

    Returns
    -------
    Handles
        They have the same names, and at least 3 vertices each. A tet vertex of the boundary belongs
        to the handle of the closest surface vertex, so handles have no gaps where the surface is
        coarser than the tets. Where the surface is finer, the tet vertex with the largest weight
        for a surface vertex belongs to that vertex's handle as well.

    Raises
    ------
    ValueError
        For arguments of other types, an index out of range, a mask of another length than the
        surface's vertices, or a handle too small for the tets.

    Examples
    --------
    >>> mesh = stuff_surface(vertices, faces)
    >>> surface = embed_surface(vertices, faces, mesh)
    >>> on_surface = Handles([low, high], names=["foot", "head"])
    >>> problem = PosingProblem(mesh, handles_in_tets(on_surface, mesh, surface), domain=box)
    """
    who = "handles_in_tets"
    require_type(who, "handles", handles, Handles, "give Handles of the surface's vertices")
    check_body(mesh, who)
    cure = "give that of embed_surface or boundary_surface"
    require_type(who, "surface", surface, EmbeddedSurface, cure)
    return SurfaceHandles(mesh, surface).in_tets(handles)


class SurfaceHandles:
    """`handles_in_tets` for several sets of handles on the same surface."""

    def __init__(self, mesh: Body, surface: EmbeddedSurface) -> None:
        self._mesh, self._surface = mesh, surface
        #: The surface vertex closest to each tet vertex of the boundary.
        self.closest: NDArray[np.intp] = closest_corners(
            surface.vertices(mesh.vertices), surface.faces, mesh.vertices[mesh.surface_vertices]
        )

    def in_tets(self, handles: Handles, *, known: Sequence[Indices | None] = ()) -> Handles:
        """As `handles_in_tets`; `known` has the tet vertices of handles that keep them."""
        of_surface = self._owners_on_surface(handles)
        of_tets = self._owners_in_tets(of_surface, len(handles))
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
        return Handles(regions, names=handles.names)

    def _owners_on_surface(self, handles: Handles) -> Owners:
        """The index of each surface vertex's handle, (s,), or -1."""
        count = len(self._surface.corners)
        owners = np.full(count, -1)
        for one, handle in enumerate(handles):
            handle.check_in(count, what="surface")
            owners[handle.vertices] = one
        return owners

    def _owners_in_tets(self, of_surface: Owners, count: int) -> Owners:
        """The index of each tet vertex's handle, (n,), or -1."""
        owners = np.full(len(self._mesh.vertices), -1)
        owners[self._mesh.surface_vertices] = of_surface[self.closest]
        for one in range(count):
            _assign_free(owners, self._surface.nearest[of_surface == one], one)
        return owners


def _assign_free(owners: Owners, vertices: Indices, one: int) -> None:
    """Assigns an owner to those of the vertices that have none."""
    owners[vertices[owners[vertices] < 0]] = one
