"""The body of a problem file: tets, or a surface as a shell."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..mesh import Body, EmbeddedSurface, ShellMesh, SurfaceFile, shell_of_file
from .json_entries import as_list, as_number, as_object, within

Thickness = float | NDArray[np.float64]


def shell_thickness(content: dict[str, Any]) -> Thickness | None:
    """The thickness of the entry {"body": {"shell": {"thickness": ...}}}; None for a solid.

    A number, or a list with one per triangle. ValueError for a mistyped entry, or a shell without a
    surface.
    """
    if "body" not in content:
        return None
    body = as_object(content["body"], "body", known={"shell"})
    if "shell" not in body:
        return None
    if "mesh" in content:
        raise ValueError("a shell is made of the entry 'surface', not of 'mesh', which names tets")
    shell = as_object(body["shell"], "body.shell", known={"thickness"})
    if "thickness" not in shell:
        raise ValueError("body.shell: the entry 'thickness' is missing, in the surface's unit")
    value = shell["thickness"]
    if not isinstance(value, list):
        return as_number(value, "body.shell.thickness")
    numbers = as_list(value, "body.shell.thickness")
    return np.array([as_number(x, f"body.shell.thickness[{i}]") for i, x in enumerate(numbers)])


def shell_in(
    file: SurfaceFile, thickness: Thickness, path: Path
) -> tuple[ShellMesh, EmbeddedSurface]:
    """`shell_of_file`; faults name the path of the file."""
    with within(path):
        return shell_of_file(file, thickness=thickness)


def body_content(mesh: Body) -> dict[str, Any]:
    """The entry "body" of a mesh; empty for a solid."""
    if not isinstance(mesh, ShellMesh):
        return {}
    thickness = mesh.thickness
    value = thickness.tolist() if isinstance(thickness, np.ndarray) else thickness
    return {"body": {"shell": {"thickness": value}}}
