"""mirror_plane: the plane across which a surface is symmetric."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree

from .. import _core as core
from ..mesh import MirrorPlane, compact_surface
from ..mesh.arrays import as_indices, as_points
from ..mesh.validation import check_indices
from .surface_points import even_directions, even_points

FloatArray = NDArray[np.float64]
Indices = NDArray[np.int32]

#: Animals at rest have less than 0.0015, standing figures with their arms apart about 0.01, and
#: bodies that are posed or not symmetric more than 0.025.
MOST_DEVIATION = 0.015
_DENSE, _FEW, _FINE = 6000, 150, 1000  # points
_DIRECTIONS, _APART = 120, np.cos(np.deg2rad(15))
_STARTS = 5
#: A normal this close to an axis is rounded to it, unless the deviation grows by more than a tenth.
_NEAR_AXIS, _WORSE, _EXACT, _ROUNDING = np.cos(np.deg2rad(2)), 1.1, 1e-5, 1e-12

_STEPS = 10

Plane = tuple[FloatArray, float]  # normal . x = offset


def mirror_plane(
    vertices: ArrayLike, faces: ArrayLike, *, normal: tuple[float, float, float] | None = None
) -> MirrorPlane:
    """Finds the plane across which a surface is symmetric, at least roughly.

    Parameters
    ----------
    vertices : array_like, (n, 3)
        For a TetMesh, pass `mesh.vertices` and `mesh.surface`.
    faces : array_like of int, (f, 3)
    normal : three numbers, optional
        Normal of the plane, if you know it. Then only the plane's offset is searched for, and every
        surface is accepted.

    Returns
    -------
    MirrorPlane
        The plane with its `deviation`. The two sides may have different triangles. If there are
        several planes, as for a box, it is the one with the least deviation; among nearly equal
        ones x is preferred to y, and y to z. A normal within two degrees of an axis is rounded to
        it, unless this makes the deviation worse by more than a tenth.

    Raises
    ------
    ValueError
        If no plane has a deviation of at most 0.015, for a surface without faces or without
        extent, vertices that are not finite, an index out of range, or an invalid normal.

    Notes
    -----
    Planes through the centre of area, in 126 directions, are compared at a few points. The best
    ones are improved by iterated closest points (Besl, McKay 1992), then by Gauss-Newton on the
    distances to the tangent planes at closest points (Chen, Medioni 1992).

    Examples
    --------
    >>> plane = mirror_plane(mesh.vertices, mesh.surface)
    >>> plane.normal, plane.deviation
    ((0.0, 1.0, 0.0), 3.2e-17)
    """
    who = "mirror_plane"
    points = as_points(vertices, who=who)
    triangles = as_indices(faces, corners=3, who=who, what="faces")
    if not len(triangles):
        raise ValueError("mirror_plane: the surface has no faces")
    check_indices(triangles, len(points), who=who, what="face")
    if not np.isfinite(points).all():
        row = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])
        raise ValueError(f"mirror_plane: vertex {row} is not finite; give finite coordinates")
    search = _Search(points, triangles)
    if normal is not None:
        return search.across(np.asarray(MirrorPlane(normal).normal, np.float64))
    found = search.best()
    if _deviation(found) > MOST_DEVIATION:
        raise NotSymmetricError(found)
    return found


class NotSymmetricError(ValueError):
    """No plane is good enough; `finding` says how far off the best one is, without advice."""

    def __init__(self, best: MirrorPlane) -> None:
        normal = ", ".join(f"{entry:.2f}" for entry in best.normal)
        self.finding = (
            f"the surface is not symmetric: across the best plane, with the normal ({normal}), it "
            f"is {100 * _deviation(best):.1f} % of its diagonal from its mirror image, more than "
            f"{100 * MOST_DEVIATION:g} %"
        )
        super().__init__(
            f"mirror_plane: {self.finding}; give the plane yourself, for example "
            "MirrorPlane((1, 0, 0)) or normal=(1, 0, 0)"
        )


class _Search:
    """The surface as points, and measures of planes."""

    def __init__(self, vertices: FloatArray, faces: Indices) -> None:
        points, own = compact_surface(vertices, faces)
        self._diagonal = float(np.linalg.norm(np.ptp(points, axis=0)))
        corners = points[own]
        if not np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).any():
            raise ValueError("mirror_plane: the surface has no extent")
        self._few, self._fine, self._dense = (
            even_points(points, own, count) for count in (_FEW, _FINE, _DENSE)
        )
        self._near = cKDTree(self._dense)
        self._center = self._dense.mean(axis=0)
        self._triangles, self._faces = corners, core.FaceTree(points, own)

    def across(self, normal: FloatArray) -> MirrorPlane:
        """The best place of a plane with a normal."""
        return self._refined((normal, float(normal @ self._center)), turning=False)

    def best(self) -> MirrorPlane:
        """The plane with the least deviation."""
        rough = sorted((self._rough(start) for start in self._starts()), key=lambda found: found[0])
        planes: list[MirrorPlane] = []
        for error, plane in rough:
            if error > 2.0 * rough[0][0] + _EXACT * self._diagonal:
                break
            if all(abs(plane[0] @ known.normal) < _APART for known in planes):
                planes.append(self._rounded(self._refined(plane)))
        return min(planes, key=self._rank)

    def _rank(self, plane: MirrorPlane) -> tuple[int, bool, int]:
        """Sort key of planes: deviations if they differ by a tenth or more, then axes x, y, z."""
        level = np.floor(np.log(max(_deviation(plane), _EXACT)) / np.log(_WORSE))
        axis = int(np.argmax(np.abs(plane.normal)))
        return int(level), abs(plane.normal[axis]) < 1.0, axis

    def _starts(self) -> list[FloatArray]:
        """The normals of the best planes through the centre, apart from each other."""
        _, axes = np.linalg.eigh(np.cov(self._dense.T))
        normals = np.vstack([np.eye(3), axes.T, even_directions(_DIRECTIONS)])
        images = [_images(self._few, (n, float(n @ self._center))) for n in normals]
        errors = (self._away(np.concatenate(images)).reshape(len(normals), -1) ** 2).mean(axis=1)
        starts: list[FloatArray] = []
        for one in np.argsort(errors, kind="stable"):
            if all(abs(normals[one] @ known) < _APART for known in starts):
                starts.append(normals[one])
            if len(starts) == _STARTS:
                break
        return starts

    def _rough(self, normal: FloatArray) -> tuple[float, Plane]:
        """A plane improved by fits of closest points, and its root mean square distance."""
        plane: Plane = normal, float(normal @ self._center)
        for _ in range(20):
            _, nearest = self._near.query(_images(self._few, plane))
            before, plane = plane, _fitted(self._few, self._dense[nearest])
            if abs(before[0] @ plane[0]) > 1.0 - 1e-8:
                break
        return float(np.sqrt((self._away(_images(self._few, plane)) ** 2).mean())), plane

    def _away(self, images: FloatArray) -> FloatArray:
        return np.asarray(self._near.query(images)[0], np.float64)

    def _refined(self, plane: Plane, *, turning: bool = True) -> MirrorPlane:
        """A plane improved by Gauss-Newton, as long as that helps; it may keep its normal."""
        best, nearest, feet = self._measured(plane)
        for _ in range(_STEPS):
            plane = self._step(plane, nearest, feet, turning=turning)
            found, nearest, feet = self._measured(plane)
            gain = 1.0 - _deviation(found) / max(_deviation(best), 1e-300)
            if gain > 0:
                best = found
            if gain < 1e-3 or _deviation(best) < _ROUNDING:
                break
        return best

    def _step(self, plane: Plane, nearest: Indices, feet: FloatArray, *, turning: bool) -> Plane:
        """A Gauss-Newton step for the distances of mirrored points to the planes of faces."""
        normal, offset = plane
        images = _images(self._fine, plane)
        triangles = self._triangles[nearest]
        across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        size = np.linalg.norm(across, axis=1, keepdims=True)
        across = np.divide(across, size, out=np.zeros_like(across), where=size > 0)
        # image = p - 2 (n . p - d) n, by n along two tangents and by d, about the centre
        first, second = _tangents(normal)
        local = self._fine - self._center
        height = local @ normal - (offset - normal @ self._center)
        slopes = across @ normal
        columns = np.zeros((len(local), 3))
        columns[:, 2] = 2.0 * slopes
        for k, side in enumerate((first, second)) if turning else ():
            columns[:, k] = -2.0 * (height * (across @ side) + (local @ side) * slopes)
        missing = ((feet - images) * across).sum(axis=1)
        a, b, shift = np.linalg.lstsq(columns, missing, rcond=None)[0]  # least of several
        turned = normal + a * first + b * second
        turned /= np.linalg.norm(turned)
        moved = offset - normal @ self._center + shift
        return turned, float(moved + turned @ self._center)

    def _rounded(self, plane: MirrorPlane) -> MirrorPlane:
        """The plane with its normal along an axis if that is as good."""
        axis = int(np.argmax(np.abs(plane.normal)))
        if abs(plane.normal[axis]) < _NEAR_AXIS:
            return plane
        other = self.across(np.eye(3)[axis])
        return other if _deviation(other) <= _WORSE * _deviation(plane) + _EXACT else plane

    def _measured(self, plane: Plane) -> tuple[MirrorPlane, Indices, FloatArray]:
        """The plane with its deviation; each mirrored point's nearest face and the point on it."""
        nearest, away, feet = self._faces.closest(_images(self._fine, plane), np.inf)
        normal, offset = plane
        point = self._center + (offset - normal @ self._center) * normal
        normal = normal * np.sign(normal[np.argmax(np.abs(normal))])
        deviation = float(np.sqrt((away**2).mean())) / self._diagonal
        return MirrorPlane(tuple(normal.tolist()), tuple(point.tolist()), deviation), nearest, feet


def _deviation(plane: MirrorPlane) -> float:
    assert plane.deviation is not None  # it was measured
    return plane.deviation


def _images(points: FloatArray, plane: Plane) -> FloatArray:
    normal, offset = plane
    return np.asarray(points - 2.0 * (points @ normal - offset)[:, None] * normal)


def _fitted(points: FloatArray, targets: FloatArray) -> Plane:
    """The plane whose mirror images of points (k, 3) are closest to targets (k, 3).

    With p and q about their means, and m the difference of the means, the squared distances are
    n^T A n plus a constant for A = 2 mean(q p^T + p q^T) - m m^T.
    """
    between = targets.mean(axis=0) - points.mean(axis=0)
    p, q = points - points.mean(axis=0), targets - targets.mean(axis=0)
    product = 2.0 * q.T @ p / len(p)
    _, vectors = np.linalg.eigh(product + product.T - np.outer(between, between))
    normal = vectors[:, 0]
    return normal, float(normal @ (points.mean(axis=0) + targets.mean(axis=0))) / 2.0


def _tangents(normal: FloatArray) -> tuple[FloatArray, FloatArray]:
    first = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
    first /= np.linalg.norm(first)
    return first, np.cross(normal, first)
