"""Where the meshes of a glTF file are: the transforms of its nodes."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def mesh_transforms(content: dict[str, Any]) -> dict[int, FloatArray]:
    """The affine map (3, 4) of each mesh in the scene into the scene's frame, by mesh.

    A mesh with a skin is placed by its joints, so its node's own transform is ignored (glTF 2.0,
    3.7.3.3).

    Raises
    ------
    ValueError
        If two nodes share a mesh, since a pose would then move both, or if the nodes are not a
        tree.
    """
    nodes = content.get("nodes", [])
    scenes = content.get("scenes") or [{"nodes": list(range(len(nodes)))}]
    found: dict[int, FloatArray] = {}
    try:
        stack = [(root, np.eye(4)) for root in scenes[content.get("scene", 0)].get("nodes", [])]
        seen: set[int] = set()
        while stack:
            number, above = stack.pop()
            if number in seen:
                raise ValueError(f"node {number} has several parents")
            seen.add(number)
            node = nodes[number]
            here = above @ _local(node)
            stack += [(child, here) for child in node.get("children", [])]
            mesh = node.get("mesh")
            if mesh is None:
                continue
            if mesh in found:
                raise ValueError(
                    f"mesh {mesh} is used by several nodes; make a copy of it for each of them "
                    "(Blender: Object > Relations > Make Single User)"
                )
            found[mesh] = np.eye(4)[:3] if "skin" in node else here[:3]
    except (LookupError, TypeError, AttributeError):
        raise ValueError("its nodes are incomplete") from None
    return dict(sorted(found.items()))


def _local(node: dict[str, Any]) -> FloatArray:
    if "matrix" in node:
        return np.array(node["matrix"], np.float64).reshape(4, 4).T
    x, y, z, w = (float(value) for value in node.get("rotation", (0, 0, 0, 1)))
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    local = np.eye(4)
    local[:3, :3] = turn * np.array(node.get("scale", (1, 1, 1)), np.float64)
    local[:3, 3] = node.get("translation", (0, 0, 0))
    return local
