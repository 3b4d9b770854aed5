"""Handles as painted on a body's own surface, which the page's server stores in models."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..reduction import PosingModel, ReducedModel

#: Key in `ReducedModel.provenance`: vertices of the surface by the handle's name.
KEY = "painted"


def painted_vertices(model: ReducedModel) -> dict[str, list[int]]:
    """Vertices of the surface by the name of the handle that was painted there.

    Parameters
    ----------
    model : ReducedModel
        `provenance["painted"]` is read. The record comes from a file and may hold anything:
        entries that do not fit the surface are left out.
    """
    record = model.provenance.get(KEY)
    if not isinstance(record, dict):
        return {}
    count = len(model.surface.corners)
    return {
        name: vertices
        for name, vertices in record.items()
        if isinstance(vertices, list)
        and all(type(vertex) is int and 0 <= vertex < count for vertex in vertices)
    }


def handle_of_vertex(model: PosingModel) -> NDArray[np.int32]:
    """The handle of each vertex of the surface, (s,), -1 for none.

    As painted, if the model has that for all its handles. Otherwise a vertex belongs to the handle
    of its nearest tet vertex.
    """
    names, painted = model.problem.handles.names, painted_vertices(model)
    if set(names) <= set(painted):
        owners = np.full(len(model.surface.corners), -1, np.int32)
        for index, name in enumerate(names):
            owners[painted[name]] = index
        return owners
    of_tets = np.full(len(model.problem.mesh.vertices), -1, np.int32)
    for index, handle in enumerate(model.problem.handles):
        of_tets[handle.vertices] = index
    return of_tets[model.surface.nearest]
