"""Trajectories: frames along a way through keys."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

FloatArray = NDArray[np.float64]

EASINGS = ("linear", "smooth")


def checked_way(frames: int, keys: int, easing: str) -> tuple[int, str]:
    """Frames and easing; ValueError unless there are two frames and keys, and an easing."""
    if easing not in EASINGS:
        raise ValueError(f"animate: unknown easing '{easing}'; known are {', '.join(EASINGS)}")
    if keys < 2:
        raise ValueError("animate: there are no keys; give at least one to go to")
    if frames < 2:
        raise ValueError(
            f"animate: frames is {frames}, but a way has two at least, its first and its last"
        )
    return frames, easing


def key_shares(frames: int, keys: int, easing: str) -> Iterator[tuple[int, float]]:
    """For each frame the key before it, and the share of the way from there to the next one.

    The first frame is the first key and the last frame the last one; in between frames are evenly
    spread over the legs. "smooth" begins and ends each leg slowly (3 s^2 - 2 s^3).
    """
    # integers first: at a key the share is exactly zero
    legs, steps = keys - 1, frames - 1
    for frame in range(frames):
        leg, step = divmod(frame * legs, steps)
        share = step / steps
        yield leg, share * share * (3.0 - 2.0 * share) if easing == "smooth" else share


def between_rows(keys: FloatArray, frames: int, easing: str) -> Iterator[FloatArray]:
    """Rows on the straight way through the rows of keys (k, p)."""
    for key, share in key_shares(frames, len(keys), easing):
        row = keys[key]
        yield row if share == 0.0 else (1.0 - share) * row + share * keys[key + 1]


def between_maps(
    keys: FloatArray, centers: FloatArray, frames: int, easing: str
) -> Iterator[FloatArray]:
    """Rigid maps (h, 3, 4) on the way through keys (k, h, 3, 4).

    Each center moves straight, and each body turns at an even rate about one axis, the shorter way
    round.
    """
    for key, share in key_shares(frames, len(keys), easing):
        if share == 0.0:
            yield keys[key]
            continue
        before, after = keys[key], keys[key + 1]
        turns = Rotation.from_matrix(before[:, :, :3])
        rest = (turns.inv() * Rotation.from_matrix(after[:, :, :3])).as_rotvec()
        linear = (turns * Rotation.from_rotvec(share * rest)).as_matrix()
        places = (1.0 - share) * _moved(before, centers) + share * _moved(after, centers)
        shifts = places - np.einsum("hij,hj->hi", linear, centers)
        yield np.concatenate([linear, shifts[:, :, None]], axis=2)


def _moved(maps: FloatArray, centers: FloatArray) -> FloatArray:
    places: FloatArray = np.einsum("hij,hj->hi", maps[:, :, :3], centers) + maps[:, :, 3]
    return places
