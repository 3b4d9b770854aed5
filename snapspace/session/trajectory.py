"""Trajectories: frames along a path through keys."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from ..arguments import require_count, require_type
from ..timeline import Timeline

FloatArray = NDArray[np.float64]

EASINGS = ("linear", "smooth")
#: Default number of frames of a path, and frames per second of a timeline.
FRAMES, RATE = 60, 30.0


def path_shares(frames: int, keys: int, easing: str) -> Iterator[tuple[int, float]]:
    """`key_shares`; ValueError for fewer than two frames or keys, or an unknown easing."""
    if easing not in EASINGS:
        raise ValueError(f"animate: unknown easing '{easing}'; known are {', '.join(EASINGS)}")
    if keys < 2:
        raise ValueError("animate: no keys are given, but at least one is needed")
    return key_shares(checked_frames(frames), keys, easing)


def checked_frames(frames: int) -> int:
    """`frames`; ValueError for fewer than two."""
    if require_count("animate", "frames", frames) < 2:
        raise ValueError(
            f"animate: frames is {frames}, but at least two are needed, the first and the last"
        )
    return frames


def keyed(
    keys: Sequence[Any] | Timeline, frames: int | None, easing: str, kind: str
) -> tuple[list[Any], Iterator[tuple[int, float]], bool]:
    """States of keys, `key_shares` of a path through them, and whether it begins at the first key.

    A timeline does, and has 30 frames a second by default. A path through other keys begins at the
    session's current state, and has 60 frames. ValueError as for `path_shares`, and for a timeline
    of another kind.
    """
    if not isinstance(keys, Timeline):
        cure = "give a list of states, such as [{handle: motion}] or [weights], or a Timeline"
        require_type("animate", "keys", keys, Iterable, cure)
        states = list(keys)
        return (
            states,
            path_shares(FRAMES if frames is None else frames, len(states) + 1, easing),
            False,
        )
    if keys.kind != kind:
        raise ValueError(
            f"animate: the timeline is of kind '{keys.kind}', but the model of '{kind}'"
        )
    count = keys.frame_count(RATE) if frames is None else checked_frames(frames)
    return [key.state for key in keys.keys], keys.shares(count), True


def key_shares(frames: int, keys: int, easing: str) -> Iterator[tuple[int, float]]:
    """For each frame, the index of the previous key and the share of the leg from it to the next.

    The first frame is the first key, and the last frame is the last key. The frames between are
    spread evenly over the legs. "smooth" begins and ends each leg slowly (3 s^2 - 2 s^3).
    """
    # integers first: at a key the share is exactly zero
    legs, steps = keys - 1, frames - 1
    for frame in range(frames):
        leg, step = divmod(frame * legs, steps)
        share = step / steps
        yield leg, share * share * (3.0 - 2.0 * share) if easing == "smooth" else share


def between_rows(keys: FloatArray, shares: Iterable[tuple[int, float]]) -> Iterator[FloatArray]:
    """Rows on the straight lines between the rows of keys (k, p), for shares from `key_shares`."""
    for key, share in shares:
        row = keys[key]
        yield row if share == 0.0 else (1.0 - share) * row + share * keys[key + 1]


def between_maps(
    keys: FloatArray, centers: FloatArray, shares: Iterable[tuple[int, float]]
) -> Iterator[FloatArray]:
    """Rigid maps (h, 3, 4) on the path through keys (k, h, 3, 4), for shares from `key_shares`.

    On each leg a center moves straight, and its handle turns about one axis at a constant rate, by
    the smaller of the two angles.
    """
    for key, share in shares:
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
