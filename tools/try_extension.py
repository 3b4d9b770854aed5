"""Runs in Blender's Python: installs the extension from its zip file, and poses a bar with it.

`tools/check_blender.py` calls it with bpy and numpy, and without the packages of the project.
"""

from __future__ import annotations

import importlib.util
import sys
from typing import Any

import bpy
import numpy as np

LENGTH = 4


def bar() -> Any:
    """A closed bar along x, with the vertex groups `foot` and `head` at its ends."""
    bpy.ops.mesh.primitive_cube_add(size=1.0)
    owner = bpy.context.object
    owner.scale = (LENGTH, 1.0, 1.0)
    bpy.ops.object.transform_apply(scale=True)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide(number_cuts=9)
    bpy.ops.object.mode_set(mode="OBJECT")
    x = np.array([vertex.co.x for vertex in owner.data.vertices])
    for name, end in (("foot", -LENGTH / 2), ("head", LENGTH / 2)):
        chosen = np.flatnonzero(np.abs(x - end) < 1e-6)
        owner.vertex_groups.new(name=name).add(chosen.tolist(), 1.0, "REPLACE")
    return owner


def drawn(owner: Any) -> np.ndarray:
    """Points of the mesh as Blender draws it."""
    bpy.context.view_layer.update()
    mesh = owner.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    return np.array([vertex.co[:] for vertex in mesh.vertices])


def main(archive: str) -> None:
    """Installs, computes, moves the empty at the head, and compares; AssertionError if it fails."""
    assert importlib.util.find_spec("snapspace") is None, "snapspace must come from the extension"
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.extensions.package_install_files(
        filepath=archive, repo="user_default", enable_on_install=True
    )
    assert "bl_ext.user_default.snapspace" in bpy.context.preferences.addons, "not enabled"
    owner = bar()
    assert bpy.ops.snapspace.compute() == {"FINISHED"}
    rest = drawn(owner)
    head = {child["snapspace_handle"]: child for child in owner.children}["head"]
    head.location.z += 0.3
    moved = drawn(owner) - rest
    at_head = rest[:, 0] > LENGTH / 2 - 1e-3
    at_foot = rest[:, 0] < -LENGTH / 2 + 1e-3
    assert np.abs(moved[at_head].mean(axis=0) - [0, 0, 0.3]).max() < 0.03, "the head lags behind"
    assert np.abs(moved[at_foot]).max() < 0.03, "the foot does not hold"
    import snapspace

    print(f"Blender {bpy.app.version_string}: snapspace {snapspace.__version__} poses a bar")


if __name__ == "__main__":
    main(sys.argv[-1])
