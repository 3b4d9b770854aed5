"""packed_mesh: a mesh in the format of the page, to choose handles on."""

from __future__ import annotations

import json

import numpy as np

from ..disk.safetensors_bytes import safetensors_bytes
from ..page.pack import FORMAT, VERSION
from .body import Body


def packed_mesh(body: Body, *, up: str) -> bytes:
    """The vertices that a page can choose, and the faces of the surface.

    Parameters
    ----------
    body : Body
        If it has its own surface, all vertices and faces of that are packed. Otherwise all
        vertices of the tets, also those inside, and the faces of their surface.
    up : "x", "y" or "z"
        Axis that points up at first.

    Returns
    -------
    bytes
        safetensors layout: vertices (n, 3) float32, faces (f, 3) int32 with indices among all
        vertices.
    """
    mesh, surface = body.mesh, body.surface
    vertices, faces = mesh.vertices, mesh.surface
    if surface is not None:
        vertices, faces = surface.vertices(mesh.vertices), surface.faces
    about = {"name": body.name, "up": up, "diagonal": mesh.diagonal}
    header = {
        "format": FORMAT,
        "version": str(VERSION),
        "kind": "mesh",
        "about": json.dumps(about, sort_keys=True),
    }
    arrays = {"vertices": vertices.astype(np.float32), "faces": faces.astype(np.int32)}
    return safetensors_bytes(arrays, header)
