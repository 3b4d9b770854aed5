"""Rigid registration of shapes in the M-norm (paper, sec. 4.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array
from scipy.spatial.transform import Rotation

from ..arguments import as_numbers, require_positive
from ..blas import single_threaded_blas
from ..mesh import check_mass, shape_or_rows

FloatArray = NDArray[np.float64]

# Singular values of the cross covariance below this share of the size of its terms are rounding.
_NOISE = 1e-13


@dataclass(frozen=True, eq=False)
class RigidMotion:
    """The map x -> scale * R x + t, for every vertex of a shape.

    rotation : (3, 3) R, orthogonal with determinant 1
    translation : (3,) t
    scale : float, default 1; positive

    Raises ValueError for other shapes or a scale that is not positive.
    """

    rotation: FloatArray
    translation: FloatArray
    scale: float = 1.0

    def __post_init__(self) -> None:
        for name, shape in (("rotation", (3, 3)), ("translation", (3,))):
            found = as_numbers("RigidMotion", name, getattr(self, name)).shape
            if found != shape:
                raise ValueError(f"RigidMotion: {name} must be {shape}, got {found}")
        require_positive("RigidMotion", "scale", self.scale)

    @single_threaded_blas
    def apply(self, shape: ArrayLike) -> FloatArray:
        """The moved shape, for a shape vector (3n,) or points (n, 3); ValueError otherwise."""
        x = np.ascontiguousarray(as_numbers("RigidMotion", "shape", shape))
        if not ((x.ndim == 1 and x.size % 3 == 0) or (x.ndim == 2 and x.shape[1] == 3)):
            raise ValueError(f"RigidMotion: a shape must be (3n,) or (n, 3), got {x.shape}")
        points: FloatArray = self.scale * (x.reshape(-1, 3) @ self.rotation.T) + self.translation
        return points.reshape(x.shape)

    def inverse(self) -> RigidMotion:
        """The motion that undoes this one."""
        back = self.rotation.T / self.scale
        return RigidMotion(self.rotation.T, -(back @ self.translation), 1.0 / self.scale)


@single_threaded_blas
def rigid_registration(
    shape: ArrayLike, onto: ArrayLike, mass: csr_array, *, scale: bool = False
) -> RigidMotion:
    """The rigid motion that brings a shape as close as possible to another, in the M-norm.

    Parameters
    ----------
    shape, onto : array_like, (3n,)
        Shape vectors x0 y0 z0 x1 ... of one mesh.
    mass : csr_array, (n, n)
        M, from `mass_matrix`.
    scale : bool, default False
        Whether the motion may also change the size.

    Returns
    -------
    RigidMotion
        Minimises |scale R x + t - onto|_M over rotations R with determinant 1 and translations t
        (and over scales > 0 if `scale`). A reflection is never used. Where several rotations are
        equally good, it is one of them: the identity for a shape without extent; for a shape on a
        line, the rotation nearest to the identity.

    Raises
    ------
    ValueError
        For sizes that do not agree, coordinates that are not finite, or `scale` with shapes whose
        cross covariance is zero, so that no scale is best.

    Notes
    -----
    Kabsch 1976 and Umeyama 1991 with M in place of weights: centroids and the cross covariance
    X^T M Y of the centred shapes are those of M, even if M is not diagonal.

    The difference between the moved shape and `onto` is M-orthogonal to the three translations and
    to the three infinitesimal rotations omega x onto. A subspace of such differences holds no
    infinitesimal rigid motion of `onto`: the reduced Hessian there has no rigid null directions.
    """
    target = _Target(onto, mass, who="rigid_registration")
    return target.registration(target.points_of(shape, "shape"), scale=scale)


@single_threaded_blas
def registered(shapes: ArrayLike, onto: ArrayLike, mass: csr_array) -> FloatArray:
    """Shapes after the rigid motions that bring each of them closest to `onto` in the M-norm.

    Parameters
    ----------
    shapes : array_like, (3n,) or (k, 3n)
        One shape vector, or one per row; each gets its own motion.
    onto : array_like, (3n,)
    mass : csr_array, (n, n)
        M, from `mass_matrix`.

    Returns
    -------
    ndarray
        The moved shapes, with the shape of `shapes`. The differences to `onto` are M-orthogonal to
        its rigid motions, see `rigid_registration`.

    Raises
    ------
    ValueError
        For sizes that do not agree, or coordinates that are not finite.
    """
    target = _Target(onto, mass, who="registered")
    x = shape_or_rows(shapes, 3 * mass.shape[0], who="registered")
    result = np.empty(x.shape)
    for index in np.ndindex(x.shape[:-1]):
        points = target.points_of(x[index], f"row {index[0]} of shapes" if index else "shapes")
        result[index] = target.registration(points, scale=False).apply(points).reshape(-1)
    return result


class _Target:
    """A shape that others are registered onto, with values that every registration needs."""

    def __init__(self, onto: ArrayLike, mass: csr_array, *, who: str) -> None:
        check_mass(mass, who=who)
        self._who = who
        self._mass = mass
        row_sums = np.asarray(mass.sum(axis=1), np.float64)
        self._total = float(row_sums.sum())
        self._weights: FloatArray = row_sums / self._total
        points = self.points_of(onto, "onto")
        self._largest = float(np.abs(points).max())
        self._centroid, self._centred = self._split(points)
        self._weighted: FloatArray = mass @ self._centred

    def points_of(self, shape: ArrayLike, what: str) -> FloatArray:
        """A shape vector as (n, 3) points; ValueError unless it fits M and is finite."""
        # contiguous: BLAS rounds strided vectors differently
        x = np.ascontiguousarray(as_numbers(self._who, what, shape))
        n = self._mass.shape[0]
        if x.shape != (3 * n,):
            raise ValueError(
                f"{self._who}: {what} has shape {x.shape}, but the mass matrix has {n} vertices, "
                f"so ({3 * n},) is needed"
            )
        if not np.isfinite(x).all():
            vertex = np.flatnonzero(~np.isfinite(x))[0] // 3
            raise ValueError(f"{self._who}: {what} is not finite at vertex {vertex}")
        return x.reshape(-1, 3)

    def registration(self, points: FloatArray, *, scale: bool) -> RigidMotion:
        """The motion of (n, 3) points onto this shape."""
        centroid, centred = self._split(points)
        covariance = centred.T @ self._weighted
        largest = float(np.abs(points).max())
        terms = largest * np.abs(self._centred).max() + np.abs(centred).max() * self._largest
        noise = _NOISE * self._total * float(terms)
        rotation = _best_rotation(covariance, noise)
        factor = 1.0
        if scale:
            gain = float(np.trace(rotation @ covariance))
            if gain <= 3.0 * noise:
                raise ValueError(
                    f"{self._who}: the shapes have no extent in common, so no scale is best; "
                    "check them, or register with scale=False"
                )
            factor = gain / float(np.sum(centred * (self._mass @ centred)))
        return RigidMotion(rotation, self._centroid - factor * (rotation @ centroid), factor)

    def _split(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Mass centroid (3,) and the points relative to it."""
        centroid: FloatArray = self._weights @ points
        return centroid, points - centroid


def _best_rotation(covariance: FloatArray, noise: float) -> FloatArray:
    """Rotation R of determinant 1 with the largest trace(R covariance)."""
    left, values, right = np.linalg.svd(covariance)
    if values[0] <= noise:
        return np.eye(3)
    # the sign goes where it costs least: on the smallest singular direction
    sign = float(np.sign(np.linalg.det(left) * np.linalg.det(right)))
    rotation: FloatArray = (right.T * [1.0, 1.0, sign]) @ left.T
    if values[1] + sign * values[2] > noise:
        return rotation
    # Free to turn about the first direction. For R T(angle) with a turn T about it, the trace is
    # cosine * cos(angle) + sine * sin(angle) + a constant; at its largest R T is nearest to I.
    axis = left[:, 0]
    cosine = np.trace(rotation) - axis @ rotation @ axis
    sine = np.sum(rotation * np.cross(axis, np.eye(3)))
    turn: FloatArray = Rotation.from_rotvec(np.arctan2(sine, cosine) * axis).as_matrix()
    return rotation @ turn
