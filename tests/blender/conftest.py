"""Blender with the extension, and a bar in an empty scene."""

from __future__ import annotations

import importlib
import os
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from snapspace.generators import bar

LENGTH = 4.0


@pytest.fixture(scope="session")
def bpy() -> Iterator[Any]:
    """The module, with the extension registered."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        needed = os.environ.get("SNAPSPACE_NEEDS_BLENDER") == "1"
        found = importlib.import_module("bpy") if needed else pytest.importorskip("bpy")
        import blender
    blender.register()
    yield found
    blender.unregister()


@pytest.fixture
def unsaved(bpy: Any) -> Any:
    """A bar along x with the vertex groups foot and head."""
    bpy.ops.wm.read_homefile(use_empty=True)
    body = bar(8, 2, 2, length=LENGTH, width=1.0, height=1.0)
    used, faces = np.unique(body.surface, return_inverse=True)
    points = body.vertices[used]
    mesh = bpy.data.meshes.new("bar")
    mesh.from_pydata(points.tolist(), [], faces.reshape(-1, 3).tolist())
    owner = bpy.data.objects.new("bar", mesh)
    bpy.context.scene.collection.objects.link(owner)
    bpy.context.view_layer.objects.active = owner
    x = points[:, 0] - points[:, 0].min()
    for name, chosen in (("foot", x < 0.1), ("head", x > LENGTH - 0.1)):
        group = owner.vertex_groups.new(name=name)
        group.add(np.flatnonzero(chosen).tolist(), 1.0, "REPLACE")
    owner.snapspace.edge_length = 0.1
    owner.snapspace.error = 50.0
    return owner


@pytest.fixture
def owner(bpy: Any, unsaved: Any, tmp_path: Path) -> Any:
    """The bar in a file that was saved."""
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    return unsaved


@pytest.fixture
def computed(bpy: Any, owner: Any) -> Any:
    assert bpy.ops.snapspace.compute() == {"FINISHED"}
    return owner
