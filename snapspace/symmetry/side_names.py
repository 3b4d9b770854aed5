"""Names of the left and right side."""

from __future__ import annotations

import re

from ..arguments import require_type

# A word, at a change of case or next to anything but a letter: not the end of "bright".
_WORD = re.compile(
    r"(?<![A-Za-z])(left|right|Left|Right|LEFT|RIGHT)(?![a-z])|(?<=[a-z])(Left|Right)(?![a-z])"
)
_LETTER = re.compile(r"(?<=[._\- ])[lrLR](?=\Z|\.\d+\Z)|\A[lrLR](?=[._\- ]|\Z)")
_OTHER = {"left": "right", "right": "left", "l": "r", "r": "l"}
_SUFFIX = " mirrored"


def mirrored_name(name: str) -> str:
    """The name of the counterpart on the other side; applied twice, it gives the name itself.

    The word left or right is swapped, in any of the usual cases: "left ear", "EarLeft", "LEFT_EAR".
    So is the letter l or r at the end after one of . _ - or a space, or at the beginning before
    one: "ear.L", "ear_r", "L_ear", and before a number as in "ear.L.001". Other names gain or lose
    " mirrored" at the end. ValueError for something other than a name.
    """
    require_type("mirrored_name", "name", name, str, "give the name of a handle")
    other = _on_other_side(name)
    if other is not None:
        return other
    base = name.removesuffix(_SUFFIX)
    was_mirrored = base not in ("", name) and _on_other_side(base) is None
    return base if was_mirrored else name + _SUFFIX


def _on_other_side(name: str) -> str | None:
    """The name with its side changed; None if it names no side."""
    for pattern in (_WORD, _LETTER):
        changed, count = pattern.subn(_other, name, count=1)
        if count:
            return changed
    return None


def _other(found: re.Match[str]) -> str:
    side = found[0]
    other = _OTHER[side.lower()]
    if side.isupper():
        return other.upper()
    return other.capitalize() if side[0].isupper() else other
