"""check_entries: mistakes in a problem file that can be found before there is a mesh."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..mesh import MirrorPlane, TetMesh
from .domain_entries import handle_box
from .handle_entries import check_handles
from .json_entries import as_number, as_object, as_three
from .material_entries import material_from

AXES = ("x", "y", "z")

_EXAMPLES = {
    "domain": '"domain": {"translation": 0.2, "angle_degrees": 45}, the largest motions of a '
    "handle in the mesh's unit of length",
    "handles": '"handles": [{"name": "feet", "boxes": [...]}, {"name": "head", "spheres": [...]}]',
    "mesh": '"mesh": "FILE", or "surface": "FILE"',
}


def check_entries(content: dict[str, Any]) -> None:
    """ValueError for mistakes in a problem of a solid that do not depend on its mesh.

    Filling a surface may take minutes, so mistakes are found before it. Places without vertices,
    indices out of range, and lists with one value per tet are checked once there is a mesh.
    """
    check_look(content)
    check_handles(entry(content, "handles"))
    handle_box(entry(content, "domain"), content["handles"])
    if "stiffness" in content:
        as_number(content["stiffness"], "stiffness")
    _check_material(as_object(content.get("material", {}), "material"))


def check_look(content: dict[str, Any]) -> None:
    """ValueError for a wrong axis or plane."""
    if "up" in content and content["up"] not in AXES:
        raise ValueError(f"up must be one of {', '.join(AXES)}, got {content['up']!r:.60}")
    if "mirror" not in content:
        return
    entries = as_object(content["mirror"], "mirror", known={"normal", "point"})
    normal = as_three(entry(entries, "normal"), "mirror.normal")
    MirrorPlane(normal, as_three(entries.get("point", [0, 0, 0]), "mirror.point"))


def entry(content: dict[str, Any], key: str) -> Any:
    """A required entry; ValueError, with an example, if it is missing."""
    if key not in content:
        example = f"; add {_EXAMPLES[key]}" if key in _EXAMPLES else ""
        raise ValueError(f"the entry '{key}' is missing{example}")
    return content[key]


def _check_material(content: dict[str, Any]) -> None:
    """Checks the material without its regions, as that of a single tet."""
    if any(isinstance(value, list) for key, value in content.items() if key != "regions"):
        return
    tet = TetMesh(np.vstack([np.zeros(3), np.eye(3)]), [[0, 1, 2, 3]])
    material_from({key: value for key, value in content.items() if key != "regions"}, tet)
