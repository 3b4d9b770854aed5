"""given_rotation: a user's rotation in any of the usual forms."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from ..problem import rotation_matrix
from .finite_input import finite, radians

FloatArray = NDArray[np.float64]
#: Three Euler angles (radians, extrinsic x, y, z), a matrix (3, 3), a quaternion (x, y, z, w), or a
#: `Rotation` of SciPy.
Turn: TypeAlias = "ArrayLike | Rotation"


def given_turn(turn: Turn, handle: str, *, who: str) -> FloatArray:
    """A handle's angles or rotation as a matrix (3, 3); ValueError says which of them is wrong."""
    if isinstance(turn, Rotation) or _shape(turn) in ((4,), (3, 3)):
        return given_rotation(turn, f"{who}: rotation of '{handle}'")
    return rotation_matrix(radians(turn, f"{who}: euler of '{handle}'"))


def given_rotation(turn: Turn, name: str) -> FloatArray:
    """The rotation as a matrix (3, 3); ValueError, with the name, if it is not a rotation.

    Quaternions are normalised; a matrix must be orthogonal to 1e-6. Angles are refused.
    """
    if isinstance(turn, Rotation):
        if not turn.single:
            raise ValueError(f"{name} is {len(turn)} rotations, but it must be one")
        return _as_matrix(turn)
    shape = _shape(turn)
    if shape == (4,):
        quaternion = finite(turn, (4,), name)
        if not quaternion.any():
            raise ValueError(f"{name} is the zero quaternion, which is not a rotation")
        return _as_matrix(Rotation.from_quat(quaternion / np.abs(quaternion).max()))
    if shape == (3, 3):
        matrix = finite(turn, (3, 3), name)
        if not is_rotation(matrix, to=1e-6):
            raise ValueError(
                f"{name} is a matrix that is not a rotation; its columns must be orthonormal and "
                "right-handed (move_affine takes any matrix)"
            )
        return matrix
    raise ValueError(
        f"{name} needs a (3, 3) matrix, a quaternion (x, y, z, w) or a Rotation of SciPy, got "
        f"{turn!r}".replace("\n", "")
    )


def is_rotation(matrix: FloatArray, *, to: float = 1e-9) -> bool:
    """Whether a matrix R (3, 3) is right-handed and R R^T = I, each entry to within `to`."""
    orthogonal = np.allclose(matrix @ matrix.T, np.eye(3), rtol=0.0, atol=to)
    return bool(orthogonal and np.linalg.det(matrix) > 0)


def _shape(turn: ArrayLike) -> tuple[int, ...] | None:
    """The shape of an array; None for rows of unequal lengths."""
    try:
        return np.shape(turn)
    except ValueError:
        return None


def _as_matrix(rotation: Rotation) -> FloatArray:
    matrix: FloatArray = rotation.as_matrix()
    return matrix
