"""Symmetry: mirror images of solved samples, where a body and its handles are symmetric.

The paper leaves open whether symmetries can reduce the cost of a subspace (sec. 8.1). A mirror
image of a solution is the solution for mirrored motions. On a symmetric mesh it is exact; on
another mesh of a symmetric shape, displacements are interpolated at the vertices' mirror images.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

import snapspace as ss
from snapspace.mesh import solid_of, vertex_normals

FloatArray = NDArray[np.float64]

#: A body is symmetric if its asymmetry, a share of the diagonal, is at most this.
SYMMETRIC = 0.01
#: Largest distance of a handle's mirrored centre from its partner's centre, as such a share.
PARTNERS = 0.02
_ROUNDS = 30


@dataclass(frozen=True)
class Mirror:
    """The plane normal . x = offset, and how far a body is from its mirror image.

    asymmetry : distance from the mirror image's surface vertices to the surface, 99th percentile,
        as a share of the diagonal
    """

    normal: FloatArray
    offset: float
    asymmetry: float

    def points(self, points: FloatArray) -> FloatArray:
        """Mirror images of points (n, 3)."""
        away = points @ self.normal - self.offset
        return points - 2.0 * away[:, None] * self.normal

    def directions(self, directions: FloatArray) -> FloatArray:
        """Mirror images of displacements (..., 3)."""
        return directions - 2.0 * (directions @ self.normal)[..., None] * self.normal


def mirror_of(mesh: ss.TetMesh) -> Mirror:
    """The plane about which a body is most nearly symmetric.

    Starts from the three principal planes of the surface; each is moved to the plane between its
    vertices and the ones nearest to their mirror images, again and again.
    """
    surface = mesh.surface
    used = np.unique(surface)
    points = mesh.vertices[used]
    tree, normals = cKDTree(points), vertex_normals(mesh.vertices, surface)[used]
    center = points.mean(axis=0)
    axes = np.linalg.eigh(np.cov((points - center).T))[1].T
    found = [_refined(normal, float(normal @ center), points, tree) for normal in axes]
    judged = []
    for normal, offset in found:
        mirror = Mirror(normal, offset, 0.0)
        images = mirror.points(points)
        nearest = tree.query(images)[1]
        # to the tangent plane: vertices of the two surfaces need not coincide
        away = np.abs(((images - points[nearest]) * normals[nearest]).sum(axis=1))
        asymmetry = float(np.quantile(away, 0.99)) / mesh.diagonal
        judged.append(Mirror(normal, offset, asymmetry))
    return min(judged, key=lambda mirror: mirror.asymmetry)


def partners(problem: ss.PosingProblem, mirror: Mirror) -> list[int] | None:
    """The index of each handle's mirror image among the handles; None if one has none."""
    vertices = problem.mesh.vertices
    centers = np.array([vertices[handle.vertices].mean(axis=0) for handle in problem.handles])
    images = mirror.points(centers)
    found = []
    for image in images:
        away = np.linalg.norm(centers - image, axis=1)
        nearest = int(np.argmin(away))
        if away[nearest] > PARTNERS * problem.mesh.diagonal:
            return None
        found.append(nearest)
    return found if sorted(found) == list(range(len(centers))) else None


def mirrored(problem: ss.PosingProblem, shapes: FloatArray, mirror: Mirror) -> FloatArray:
    """Mirror images (k, 3n) of shapes (k, 3n), at the vertices of the mesh."""
    mesh = problem.mesh
    images = mirror.points(mesh.vertices)
    solid = solid_of(mesh, who="symmetry")
    carrier = ss.embed_surface(images, mesh.surface, solid, farthest=3 * SYMMETRIC)
    at_rest = carrier.vertices(mesh.vertices)
    result = np.empty_like(shapes)
    for row, shape in zip(result, shapes, strict=True):
        moved = carrier.vertices(shape.reshape(-1, 3)) - at_rest
        row[:] = (mesh.vertices + mirror.directions(moved)).reshape(-1)
    return result


def _refined(
    normal: FloatArray, offset: float, points: FloatArray, tree: cKDTree
) -> tuple[FloatArray, float]:
    for _ in range(_ROUNDS):
        images = Mirror(normal, offset, 0.0).points(points)
        pairs = points[tree.query(images)[1]]
        apart = pairs - points
        # the common direction of all pairs, and the plane through their middles
        moments = apart.T @ apart
        _, vectors = np.linalg.eigh(moments)
        found = vectors[:, -1]
        normal = found if found @ normal >= 0.0 else -found
        offset = float(normal @ (points + pairs).mean(axis=0) / 2.0)
    return normal, offset
