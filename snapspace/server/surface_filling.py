"""SurfaceFilling: how surfaces become tets, as the server was asked to do it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from numpy.typing import ArrayLike

from ..filling import fill_surface, stuff_surface
from ..mesh import TetMesh

#: As shares of the diagonal.
EDGE_LENGTH = 0.025
EXACT_EDGE_LENGTH = 0.02


@dataclass(frozen=True, kw_only=True)
class SurfaceFilling:
    """Quick tets of one size in seconds, or those of fTetWild in minutes.

    edge_length : of the tets, as a share of the diagonal; None for 0.025, and 0.02 if exact
    exact : whether fTetWild is taken at once, and not only for surfaces that quick tets lose
    """

    edge_length: float | None = None
    exact: bool = False

    def fill(
        self, vertices: ArrayLike, faces: ArrayLike, *, stage: Callable[[str], None]
    ) -> TetMesh:
        """Tets inside of a closed surface.

        `stage` gets "filling", and "filling exactly" before what takes minutes. ValueError as of
        `fill_surface`.
        """
        if not self.exact:
            stage("filling")
            try:
                return stuff_surface(vertices, faces, edge_length=self.edge_length or EDGE_LENGTH)
            except ValueError:  # the page tells by the stage that it goes on in another way
                pass
        stage("filling exactly")
        return fill_surface(vertices, faces, edge_length=self.edge_length or EXACT_EDGE_LENGTH)
