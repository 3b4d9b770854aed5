"""SurfaceFilling: how surfaces become tets, as the server was asked to do it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from numpy.typing import ArrayLike

from ..filling import fill_surface, stuff_surface
from ..mesh import TetMesh


@dataclass(frozen=True, kw_only=True)
class SurfaceFilling:
    """Quick tets of one size in seconds, or those of fTetWild in minutes.

    edge_length : of the tets, as a share of the diagonal; None for the default of each way: 0.025,
        and 0.02 if exact
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
        sized = {} if self.edge_length is None else {"edge_length": self.edge_length}
        if not self.exact:
            stage("filling")
            try:
                return stuff_surface(vertices, faces, **sized)
            except ValueError:  # the page tells by the stage that it goes on in another way
                pass
        stage("filling exactly")
        return fill_surface(vertices, faces, **sized)
