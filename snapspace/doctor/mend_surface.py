"""mend_surface: mends what can be mended without guessing the shape, and closes holes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..counted import counted
from ..mesh.arrays import IndexArray
from ..mesh.closed_surface import enclosed_volume
from ..mesh.edges import edges_of
from ..mesh.quality import triangle_areas
from ..mesh.surface import compact_surface
from ..mesh.surface_file.surface_file import checked_surface
from .cleaned import cleaned
from .components import orientation
from .fill_holes import closable_holes

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False, kw_only=True)
class MendedSurface:
    """A surface after `mend_surface`.

    vertices : (n, 3), those of the input that faces use, in their order
    faces : (f, 3)
    invented : number of faces that close holes; these are the last ones
    invented_area : their area
    notes : what was done, one sentence per kind of fault; empty if nothing was
    """

    vertices: FloatArray
    faces: IndexArray
    invented: int
    invented_area: float
    notes: tuple[str, ...]

    def __repr__(self) -> str:
        invented = f", {self.invented} of them invented" if self.invented else ""
        done = f": {'; '.join(self.notes)}" if self.notes else ""
        sizes = f"{len(self.vertices)} vertices, {len(self.faces)} faces{invented}"
        return f"MendedSurface({sizes}{done})"


def mend_surface(
    vertices: ArrayLike, faces: ArrayLike, *, close_holes: bool = True
) -> MendedSurface:
    """Makes a surface closed and consistently oriented, as far as that is safe.

    In this order, it merges vertices with equal positions if the surface is not closed without that
    or if faces coincide; drops faces that name a vertex twice or repeat another face, and both
    sides of walls between solids; drops vertices without faces; flips faces until neighbours agree;
    closes holes that are simple loops and flat (within 15 % of their diameter) or small (5 % of the
    diagonal), with the triangulation of smallest area between their vertices; and turns all faces
    outward.

    Parameters
    ----------
    vertices : array_like, (n, 3)
    faces : array_like of int, (f, 3)
    close_holes : bool, default True
        False leaves a surface open, as a shell may be.

    Returns
    -------
    MendedSurface
        Not always closed: `check_surface` says what is left.

    Raises
    ------
    ValueError
        For wrong shapes or types, no faces, coordinates that are not finite, an index out of
        range, or if no face would be left.
    """
    points, triangles = checked_surface(vertices, faces, who="mend_surface")
    clean = cleaned(points, triangles)
    if not len(clean.faces):
        raise ValueError(
            f"mend_surface: no face would be left: all {len(triangles)} name a vertex twice, or "
            "are covered by one that runs the other way"
        )
    notes = []
    if clean.merged:
        notes.append(
            f"merged {counted(clean.merged, 'vertex', 'vertices')} with others at the same position"
        )
    if clean.degenerate:
        notes.append(f"dropped {counted(clean.degenerate, 'face')} with a repeated vertex")
    if clean.duplicate:
        notes.append(f"dropped {counted(clean.duplicate, 'face')} with the vertices of another one")
    used, mended = compact_surface(points, clean.faces)
    unused = len(points) - len(used) - clean.merged
    if unused > 0:
        notes.append(f"dropped {counted(unused, 'vertex', 'vertices')} without faces")
    turn, _, _ = orientation(edges_of(mended))
    if turn.any():
        mended[turn] = mended[turn][:, ::-1]
        notes.append(f"flipped {counted(int(turn.sum()), 'face')} to agree with their neighbours")
    holes = closable_holes(used, mended) if close_holes else []
    fills = [fill for _, fill in holes if fill is not None]
    if fills:
        mended = np.concatenate([mended, *fills])
    invented = sum(map(len, fills))
    area = float(triangle_areas(used, mended[len(mended) - invented :]).sum())
    if fills:
        closed = counted(len(fills), "hole")
        notes.append(f"closed {closed} with {counted(invented, 'face')}, area {area:.4g}")
    center = (used.min(axis=0) + used.max(axis=0)) / 2.0
    if not edges_of(mended).balance.any() and enclosed_volume(used - center, mended) < 0:
        mended = np.ascontiguousarray(mended[:, ::-1])
        notes.append("turned all faces outward")
    return MendedSurface(
        vertices=used, faces=mended, invented=invented, invented_area=area, notes=tuple(notes)
    )
