"""The sampled box of a problem file: common bounds, and those of single handles."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .handle_box import HandleBox
from .json_entries import as_number, as_object, as_three

FloatArray = NDArray[np.float64]
Bounds = float | tuple[float, float, float]

_TRANSLATION, _ANGLE = "translation", "angle_degrees"


def handle_box(common: Any, handles: Sequence[dict[str, Any]]) -> HandleBox:
    """The box of a file's entries, angles in radians.

    Parameters
    ----------
    common : the entry "domain" of the file, with both bounds
    handles : the file's handles; all but the first may have an entry "domain", with one or both

    Raises
    ------
    ValueError
        For a bound that is missing or mistyped, an angle beyond 180 degrees, or a domain of the
        first handle; the message names the entry.
    """
    if handles and "domain" in handles[0]:
        raise ValueError(
            "handles[0].domain: the first handle is held at rest; leave it out, or put another "
            "handle first"
        )
    bounds = _bounds(common, "domain")
    for key in (_TRANSLATION, _ANGLE):
        if key not in bounds:
            raise ValueError(f"domain: the entry '{key}' is missing")
    own = [
        _bounds(handle["domain"], f"handles[{i}].domain") if "domain" in handle else {}
        for i, handle in enumerate(handles)
    ][1:]
    if not any(own):
        return HandleBox(translation=bounds[_TRANSLATION], angle=_radians(bounds[_ANGLE]))
    rows = [{**bounds, **each} for each in own]
    return HandleBox(
        translation=np.array([np.broadcast_to(row[_TRANSLATION], 3) for row in rows]),
        angle=np.array([np.broadcast_to(_radians(row[_ANGLE]), 3) for row in rows]),
        moving=len(rows),
    )


def domain_content(bounds: FloatArray) -> dict[str, Any]:
    """The entry "domain" for bounds (6,): translation, then angles in radians."""
    return {_TRANSLATION: bounds[:3].tolist(), _ANGLE: np.rad2deg(bounds[3:]).tolist()}


def _bounds(value: Any, what: str) -> dict[str, Bounds]:
    entries = as_object(value, what, known={_TRANSLATION, _ANGLE})
    bounds = {key: _one_or_three(entry, f"{what}.{key}") for key, entry in entries.items()}
    if np.max(bounds.get(_ANGLE, 0.0)) > 180:
        raise ValueError(f"{what}.{_ANGLE} is {bounds[_ANGLE]}, but it must be at most 180")
    return bounds


def _one_or_three(value: Any, what: str) -> Bounds:
    if not isinstance(value, list):
        return as_number(value, what)
    if len(value) != 3:
        raise ValueError(f"{what} must be one number or three, got {len(value)}")
    return as_three(value, what)


def _radians(degrees: Bounds) -> Bounds:
    if isinstance(degrees, tuple):
        x, y, z = np.deg2rad(degrees).tolist()
        return x, y, z
    return float(np.deg2rad(degrees))
