"""Places in files: boxes and spheres, in the entries of handles and of material regions."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .json_entries import as_index, as_list, as_number, as_three
from .region import in_box, in_sphere

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]


def in_places(item: dict[str, Any], points: FloatArray) -> Mask:
    """Mask (k,) of the points (k, 3) in any of the item's "boxes" and "spheres".

    A box is [[min corner], [max corner]], with null for an open side; a sphere is
    [[x, y, z], radius].

    Raises
    ------
    ValueError
        For an entry of another form.
    """
    mask = np.zeros(len(points), np.bool_)
    for box in as_list(item.get("boxes", []), "boxes"):
        mask |= _in_box(box, points)
    for sphere in as_list(item.get("spheres", []), "spheres"):
        center, radius = as_list(sphere, "a sphere", items=("center", "radius"))
        mask |= in_sphere(points, as_three(center, "a center"), as_number(radius, "a radius"))
    return mask


def listed(item: dict[str, Any], key: str, what: str, *, count: int) -> Mask:
    """Mask (count,) of the indices in the item's list `key`; ValueError if one is out of range."""
    mask = np.zeros(count, np.bool_)
    for index in as_list(item.get(key, []), key):
        mask[as_index(index, what, below=count)] = True
    return mask


def _in_box(box: Any, points: FloatArray) -> Mask:
    lower, upper = (
        [
            None if bound is None else as_number(bound, "a corner")
            for bound in as_list(corner, "a corner")
        ]
        for corner in as_list(box, "a box", items=("min corner", "max corner"))
    )
    return in_box(points, lower, upper)
