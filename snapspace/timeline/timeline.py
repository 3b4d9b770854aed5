"""Timeline: keys in time, and the easings between them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import floor
from typing import Any

from ..arguments import is_finite, require_count, require_positive, wrong_type

#: How the state moves from a key to the next: slowly at both ends, at a constant rate, or not at
#: all.
EASINGS = ("smooth", "linear", "hold")
KINDS = ("posing", "interpolation")


@dataclass(frozen=True)
class Key:
    """Where handles or weights are at a time.

    time : seconds, not negative
    state : for posing, motions from rest by handle, as `PosingSession.move_all` takes them; a
        handle without an entry stays as in the key before. For blending, weights by pose; a pose
        without an entry has weight zero
    easing : "smooth", "linear" or "hold", default "smooth"; how the state moves to the next key
    """

    time: float
    state: Mapping[str, Any]
    easing: str = "smooth"


@dataclass(frozen=True)
class Timeline:
    """Keys in the order of their times.

    kind : "posing" or "interpolation", as of models
    keys : one or more, with increasing times
    loop : bool, default False; whether players begin again at the end

    ValueError for an unknown kind or easing, keys of another type, no keys, and times that are
    negative, not finite or not increasing.
    """

    kind: str
    keys: tuple[Key, ...]
    loop: bool = False

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise ValueError(f"Timeline: unknown kind '{self.kind}'; known are {', '.join(KINDS)}")
        if not isinstance(self.keys, Sequence):
            raise wrong_type("Timeline", "keys", self.keys, "give a list, such as [Key(0, state)]")
        if not self.keys:
            raise ValueError("Timeline: there are no keys, but at least one is needed")
        for number, key in enumerate(self.keys):
            if not isinstance(key, Key):
                raise wrong_type("Timeline", f"key {number}", key, "give Key(time, state)")
            if not isinstance(key.state, Mapping):
                cure = "give motions by handle, or weights by pose"
                raise wrong_type("Timeline", f"the state of key {number}", key.state, cure)
            if not (is_finite(key.time) and key.time >= 0.0):
                raise ValueError(
                    f"Timeline: key {number} is at {key.time} s, but times are 0 or more"
                )
            if key.easing not in EASINGS:
                raise ValueError(
                    f"Timeline: key {number} has the easing '{key.easing}'; known are "
                    f"{', '.join(EASINGS)}"
                )
        for number, (before, after) in enumerate(pairwise(self.keys), start=1):
            if after.time <= before.time:
                raise ValueError(
                    f"Timeline: key {number} is at {after.time} s, not after the one before it, "
                    f"at {before.time} s"
                )

    @property
    def duration(self) -> float:
        """Seconds from the first key to the last."""
        return self.keys[-1].time - self.keys[0].time

    def frame_count(self, frames_per_second: float) -> int:
        """Number of frames with both ends, at least two. ValueError unless the rate is positive."""
        require_positive("Timeline.frame_count", "frames_per_second", frames_per_second)
        return max(2, floor(self.duration * frames_per_second + 1e-9) + 1)

    def shares(self, frames: int) -> Iterator[tuple[int, float]]:
        """For evenly spaced frames, the index of a key each, and the share of the way to the next.

        The first frame is the first key, and the last frame is the last key. ValueError for fewer
        than two frames.
        """
        require_count("Timeline.shares", "frames", frames, at_least=2)
        return self._shares(frames)

    def _shares(self, frames: int) -> Iterator[tuple[int, float]]:
        first, last = self.keys[0].time, len(self.keys) - 1
        at = 0
        for frame in range(frames):
            time = first + self.duration * frame / (frames - 1)
            while at < last and self.keys[at + 1].time <= time + 1e-12 * (1.0 + time):
                at += 1
            if at == last or frame == frames - 1:
                yield last, 0.0
                continue
            key = self.keys[at]
            share = max(0.0, (time - key.time) / (self.keys[at + 1].time - key.time))
            yield at, eased(share, key.easing)


def eased(share: float, easing: str) -> float:
    """The share of the way after a share of the time; "smooth" is 3 s^2 - 2 s^3."""
    if easing == "hold":
        return 0.0
    return share * share * (3.0 - 2.0 * share) if easing == "smooth" else share
