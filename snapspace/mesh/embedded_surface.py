"""TEMPORARY by the lead; to be overwritten by the helper."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class EmbeddedSurface:
    faces: object
    corners: object
    weights: object

    def vertices(self, shape):
        x = shape.reshape(-1, 3)
        return np.einsum("sk,skc->sc", self.weights, x[self.corners])


def boundary_surface(mesh):

    used = mesh.surface_vertices
    place = np.zeros(len(mesh.vertices), np.int32)
    place[used] = np.arange(len(used))
    c = np.repeat(used[:, None], 4, 1).astype(np.int32)
    w = np.zeros((len(used), 4))
    w[:, 0] = 1
    return EmbeddedSurface(place[mesh.surface], c, w)


embed_surface = None
