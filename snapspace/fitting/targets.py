"""Target surfaces: checked, weighted by area, and registered to the rest shape."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array, diags_array

from ..arguments import as_numbers, require_type
from ..mesh import TetMesh
from ..mesh.embedded_surface import EmbeddedSurface
from ..registration import rigid_registration

FloatArray = NDArray[np.float64]


def checked_targets(
    mesh: TetMesh, surface: EmbeddedSurface, targets: ArrayLike, names: Sequence[str] | None
) -> tuple[FloatArray, list[str]]:
    """Targets as (k, s, 3) float64 and a name for each; ValueError if they do not match.

    The corners of the surface must be vertices of the mesh.
    """
    require_type("fit_poses", "mesh", mesh, TetMesh, "give mesh, surface, targets")
    cure = "give that of embed_surface or boundary_surface"
    require_type("fit_poses", "surface", surface, EmbeddedSurface, cure)
    count = len(surface.corners)
    if surface.corners.max() >= len(mesh.vertices):
        point = int(np.flatnonzero((surface.corners >= len(mesh.vertices)).any(axis=1))[0])
        raise ValueError(
            f"fit_poses: point {point} of the surface has vertex {surface.corners[point].max()}, "
            f"but the mesh has {len(mesh.vertices)}; the surface must be embedded in this mesh"
        )
    surfaces = np.ascontiguousarray(as_numbers("fit_poses", "targets", targets))
    if surfaces.ndim != 3 or surfaces.shape[1:] != (count, 3) or len(surfaces) == 0:
        raise ValueError(
            f"fit_poses: targets have shape {surfaces.shape}, but the surface has {count} points, "
            f"so (poses, {count}, 3) is needed"
        )
    require_type("fit_poses", "names", names, Sequence | None, "give a list of names")
    labels = [str(i) for i in range(len(surfaces))] if names is None else list(names)
    if len(labels) != len(surfaces):
        raise ValueError(f"fit_poses: {len(surfaces)} targets have {len(labels)} names")
    bad = np.argwhere(~np.isfinite(surfaces).all(axis=2))
    if len(bad):
        pose, point = bad[0]
        raise ValueError(f"fit_poses: point {point} of pose {labels[pose]} is not finite")
    return surfaces, labels


def point_areas(vertices: FloatArray, faces: NDArray[np.integer]) -> FloatArray:
    """A third of the total area of the faces at each point, (s,)."""
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    thirds = np.repeat(np.linalg.norm(normals, axis=1) / 6.0, 3)
    areas = np.bincount(faces.ravel(), thirds, minlength=len(vertices))
    return np.asarray(areas, dtype=np.float64)


def registered_targets(targets: FloatArray, onto: FloatArray, areas: FloatArray) -> FloatArray:
    """The targets, each moved rigidly as close as possible to the surface `onto` (s, 3)."""
    mass = csr_array(diags_array(areas))
    flat = onto.reshape(-1)
    return np.stack([rigid_registration(t.reshape(-1), flat, mass).apply(t) for t in targets])
