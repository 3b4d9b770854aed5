"""The handles of a problem file: unions of boxes, spheres and vertices."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..mesh import Body
from ..point_text import corner_texts
from .handles import Handles
from .json_entries import as_index, as_list, as_object, as_text, within
from .place_entries import Mask, in_places, listed

MOST_VERTICES = 2**31 - 1
_KNOWN = {"name", "boxes", "spheres", "vertices", "painted", "domain"}


def handles_of(value: Any, mesh: Body) -> Handles:
    """The handles of the entry "handles"; ValueError names the handle and the entry."""
    named = _named(value)
    masks = [_mask(item, name, mesh) for name, item in named]
    return Handles(masks, names=[name for name, _ in named])


def check_handles(value: Any) -> None:
    """ValueError for mistakes in the entry "handles" that do not depend on the mesh."""
    named = _named(value)
    for name, item in named:
        with within(f"handle '{name}'"):
            in_places(item, np.zeros((0, 3)))
            for index in as_list(item.get("vertices", []), "vertices"):
                as_index(index, "a vertex", below=MOST_VERTICES)
    apart = np.eye(len(named), dtype=np.bool_)
    Handles(list(apart), names=[name for name, _ in named])


def _named(value: Any) -> list[tuple[str, dict[str, Any]]]:
    """Name and entries of each handle."""
    items = [
        as_object(item, f"handles[{i}]", known=_KNOWN)
        for i, item in enumerate(as_list(value, "handles"))
    ]
    names = [
        as_text(item.get("name", f"handle_{i}"), f"handles[{i}].name")
        for i, item in enumerate(items)
    ]
    for item, name in zip(items, names, strict=True):
        with within(f"handle '{name}'"):
            for index in as_list(item.get("painted", []), "painted"):
                as_index(index, "a painted vertex", below=MOST_VERTICES)
    return list(zip(names, items, strict=True))


def _mask(item: dict[str, Any], name: str, mesh: Body) -> Mask:
    """The union of a handle's boxes, spheres and vertices; ValueError if no vertex is in it."""
    with within(f"handle '{name}'"):
        vertices = listed(item, "vertices", "a vertex", count=len(mesh.vertices))
        mask = in_places(item, mesh.vertices) | vertices
        if mask.any():
            return mask
        low, high = corner_texts(mesh.vertices.min(axis=0), mesh.vertices.max(axis=0))
        raise ValueError(
            f"it has no vertices of the mesh, which reaches from {low} to {high}; move or "
            "widen its boxes or spheres, or list vertices"
        )
