"""A mesh as the page reads it, to choose handles on."""

from __future__ import annotations

import json

import numpy as np

from ..mesh import TetMesh
from ..model_file.container import container_bytes
from ..page.pack import FORMAT, VERSION


def packed_mesh(mesh: TetMesh, *, name: str, up: str) -> bytes:
    """All vertices, also those inside, and the faces of the surface.

    Parameters
    ----------
    mesh : TetMesh
    name : str
        Shown as the title.
    up : "x", "y" or "z"
        Axis that points up at first.

    Returns
    -------
    bytes
        safetensors layout: vertices (n, 3) float32, faces (f, 3) int32, outward, with indices among
        all vertices.
    """
    about = {"name": name, "up": up, "diagonal": mesh.diagonal}
    header = {
        "format": FORMAT,
        "version": str(VERSION),
        "kind": "mesh",
        "about": json.dumps(about, sort_keys=True),
    }
    arrays = {
        "vertices": mesh.vertices.astype(np.float32),
        "faces": mesh.surface.astype(np.int32),
    }
    return container_bytes(arrays, header)
