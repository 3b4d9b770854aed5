"""What Blender draws of a mesh, and the empties that move it."""

from __future__ import annotations

from typing import Any

import numpy as np


def drawn(bpy: Any, owner: Any) -> np.ndarray:
    """Points of the mesh after shape keys and modifiers."""
    bpy.context.view_layer.update()
    mesh = owner.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    points = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", points)
    return points.reshape(-1, 3).astype(float)


def empties(owner: Any) -> dict[str, Any]:
    return {child["snapspace_handle"]: child for child in owner.children}
