"""Rigid motions of a handle."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

FloatArray = NDArray[np.float64]


def rotation_matrix(euler: ArrayLike) -> FloatArray:
    """R = Rz(gamma) Ry(beta) Rx(alpha) of extrinsic Euler angles (alpha, beta, gamma) in radians.

    (..., 3) angles give (..., 3, 3) matrices.
    """
    angles = np.asarray(euler, np.float64)
    # one row per rotation: SciPy takes more axes only since 1.17
    rows = angles.reshape(-1, angles.shape[-1])
    matrices: FloatArray = Rotation.from_euler("xyz", rows).as_matrix()
    return matrices.reshape(*angles.shape, 3)


def euler_of_rotation(rotation: ArrayLike) -> FloatArray:
    """Extrinsic Euler angles (alpha, beta, gamma) of a rotation: the inverse of `rotation_matrix`.

    Parameters
    ----------
    rotation : array_like, (..., 3, 3)
        Orthogonal matrices with determinant 1.

    Returns
    -------
    ndarray, (..., 3)
        In radians, with |beta| <= pi / 2 and the others in [-pi, pi]. Their `rotation_matrix`
        always equals `rotation` up to rounding. At beta = pi / 2 and -pi / 2 (gimbal lock) only
        alpha - gamma or alpha + gamma is determined, and alpha is zero.
    """
    R = np.asarray(rotation, np.float64)
    # row 2 of R is (-sin beta, cos beta sin alpha, cos beta cos alpha)
    level = np.hypot(R[..., 2, 1], R[..., 2, 2])
    locked = level <= 4.0 * np.finfo(float).eps
    alpha = np.where(locked, 0.0, np.arctan2(R[..., 2, 1], R[..., 2, 2]))
    beta = np.arctan2(-R[..., 2, 0], level)
    # gamma from R Rx(-alpha) = Rz Ry: near gimbal lock alpha is mostly rounding error, for which
    # this gamma compensates; gamma from column 0 of R would have an independent error
    sine, cosine = np.sin(alpha), np.cos(alpha)
    gamma = np.arctan2(
        sine * R[..., 0, 2] - cosine * R[..., 0, 1], cosine * R[..., 1, 1] - sine * R[..., 1, 2]
    )
    return np.stack([alpha, beta, gamma], axis=-1)


def rigid_offset(euler: ArrayLike, translation: ArrayLike) -> FloatArray:
    """Offsets [R - I | t], (..., 3, 4), of rigid motions about a centroid.

    An offset maps (rest position - centroid, 1) to the displacement of the motion: target = R (v -
    c) + c + t. The identity has offset zero.
    """
    rotation = rotation_matrix(euler) - np.eye(3)
    return np.concatenate([rotation, np.asarray(translation, np.float64)[..., None]], axis=-1)


def affine_offset(matrix: ArrayLike, centroid: ArrayLike) -> FloatArray:
    """(3, 4) offset of an affine map `matrix` (3, 4) that acts on world positions (v, 1)."""
    linear, shift = np.asarray(matrix, np.float64)[:, :3], np.asarray(matrix, np.float64)[:, 3]
    c = np.asarray(centroid, np.float64)
    return np.concatenate([linear - np.eye(3), (linear @ c + shift - c)[:, None]], axis=1)
