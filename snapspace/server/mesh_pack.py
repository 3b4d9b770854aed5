"""packed_mesh: a mesh or a surface in the format of the page, to choose handles on."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from ..disk.safetensors_bytes import safetensors_bytes
from ..mesh import SurfaceFile
from ..mesh.arrays import FloatArray, IndexArray
from ..model_file.appearance import file_arrays
from ..model_file.model_file import PACKED_FORMAT
from ..page.pack import VERSION
from .body import Body
from .user_surface import UserSurface


def packed_mesh(shown: Body | UserSurface, *, up: str) -> bytes:
    """The vertices that a page can choose, and the faces of the surface.

    Parameters
    ----------
    shown : Body or UserSurface
        For a surface that is not filled yet, or a body with its own surface, all vertices and faces
        of that surface are packed, so both are the same. Otherwise these are all vertices of the
        tets, including interior ones, and the faces of their surface.
    up : "x", "y" or "z"
        Axis that points up at first.

    Returns
    -------
    bytes
        safetensors layout: vertices (n, 3) float32, faces (f, 3) int32 with indices among all
        vertices. A surface has the arrays of its own materials, see `file_arrays`.
    """
    if isinstance(shown, UserSurface):
        about = {"name": shown.name, "up": up, "diagonal": shown.diagonal}
        return _packed(shown.source.vertices, shown.source.faces, shown.source, about)
    mesh, surface = shown.mesh, shown.surface
    vertices, faces, source = mesh.vertices, mesh.surface, None
    if surface is not None:
        vertices, faces = surface.vertices(mesh.vertices), surface.faces
        source = surface.source
    return _packed(
        vertices, faces, source, {"name": shown.name, "up": up, "diagonal": mesh.diagonal}
    )


def _packed(
    vertices: FloatArray, faces: IndexArray, source: SurfaceFile | None, about: dict[str, Any]
) -> bytes:
    look, about["appearance"] = ({}, None) if source is None else file_arrays(source)
    header = {
        "format": PACKED_FORMAT,
        "version": str(VERSION),
        "kind": "mesh",
        "about": json.dumps(about, sort_keys=True),
    }
    arrays = {"vertices": vertices.astype(np.float32), "faces": faces.astype(np.int32)}
    return safetensors_bytes(arrays | look, header)
