"""Maps of world positions that move handles."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import require_type
from ..problem import affine_offset
from .finite_input import finite
from .given_rotation import Turn, given_turn, is_rotation

FloatArray = NDArray[np.float64]
#: A rotation about the centroid, and a translation.
Motion: TypeAlias = tuple[Turn, ArrayLike]


def world_map(offset: FloatArray, center: FloatArray) -> FloatArray:
    """The map (3, 4) of world positions for an offset [A - I | t] about a center."""
    linear = offset[:, :3] + np.eye(3)
    return np.column_stack([linear, center + offset[:, 3] - linear @ center])


def world_maps(offsets: FloatArray, centers: FloatArray) -> FloatArray:
    """Maps (h, 3, 4) of world positions for offsets (h, 3, 4) about centers (h, 3)."""
    return np.array([world_map(*pair) for pair in zip(offsets, centers, strict=True)])


def motions_of(
    maps: FloatArray, names: Sequence[str], centers: FloatArray
) -> dict[str, tuple[FloatArray, FloatArray]]:
    """By name, the linear part (3, 3) about a center and the translation (3,) of each map."""
    return {
        name: (own[:, :3].copy(), own[:, :3] @ center + own[:, 3] - center)
        for name, own, center in zip(names, maps, centers, strict=True)
    }


def wanted_maps(
    motions: Mapping[str, Motion], center: Callable[[str], FloatArray], *, who: str
) -> dict[str, FloatArray]:
    """Maps (3, 4) by handle, for rotations about the handles' centers and translations.

    ValueError, which names the handle, for a motion that is not a pair, or an invalid rotation or
    translation; `center` rejects unknown handles.
    """
    if not isinstance(motions, Mapping):
        raise ValueError(
            f"{who}: the motions are a {type(motions).__name__}, but a mapping from the names of "
            "handles to pairs (rotation, translation) is needed"
        )
    maps = {}
    for handle, motion in motions.items():
        about = center(handle)
        turn, translation = _pair(motion, handle, who=who)
        linear = given_turn(turn, handle, who=who)
        shift = finite(translation, (3,), f"{who}: translation of '{handle}'")
        maps[handle] = world_map(np.column_stack([linear - np.eye(3), shift]), about)
    return maps


def given_maps(
    motions: Sequence[tuple[ArrayLike, ArrayLike]], names: Sequence[str], centers: FloatArray
) -> dict[str, FloatArray]:
    """Maps (3, 4) by handle, for rotations (3, 3) about the centers and translations (3,).

    ValueError for a wrong number of motions, or one that is not a pair, finite or rigid.
    """
    cure = "give a pair (rotation, translation) for each handle"
    require_type("put", "motions", motions, Sequence, cure)
    if len(motions) != len(names):
        raise ValueError(f"put: got {len(motions)} motions, but there are {len(names)} handles")
    maps = {}
    for name, center, motion in zip(names, centers, motions, strict=True):
        rotation, translation = _pair(motion, name, who="put")
        turn = finite(rotation, (3, 3), f"put: the rotation of '{name}'")
        shift = finite(translation, (3,), f"put: the translation of '{name}'")
        if not is_rotation(turn, to=1e-6):
            raise ValueError(f"put: the matrix of '{name}' is not a rotation")
        maps[name] = world_map(np.column_stack([turn - np.eye(3), shift]), center)
    return maps


def _pair(motion: tuple[Any, Any], handle: str, *, who: str) -> tuple[Any, Any]:
    """The motion; ValueError unless it is a pair."""
    try:
        turn, translation = motion
    except (TypeError, ValueError):
        raise ValueError(
            f"{who}: the motion of '{handle}' must be a pair of a rotation and a translation, such "
            f"as ((0, 0, 0), (0, 0, 0.1)), got {motion!r}".replace("\n", "")
        ) from None
    return turn, translation


def relative_offsets(maps: FloatArray, centers: FloatArray) -> FloatArray:
    """Offsets (h, 3, 4) about the centers of maps (h, 3, 4), relative to the first, rigid map."""
    back = maps[0, :, :3].T  # inverse rotation of the first handle
    offsets = [np.zeros((3, 4))]
    for target, center in zip(maps[1:], centers[1:], strict=True):
        shift = target[:, 3] - maps[0, :, 3]
        relative = np.column_stack([back @ target[:, :3], back @ shift])
        offsets.append(affine_offset(relative, center))
    return np.array(offsets)
