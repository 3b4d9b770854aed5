"""SurfaceFilling: quick tets, or tets by fTetWild."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from numpy.typing import ArrayLike

from ..mesh import TetMesh
from .closed_input import NoSolidError
from .fill_surface import fill_surface
from .stuff_surface import stuff_surface

#: The stage of `SurfaceFilling.fill` in which fTetWild works.
EXACTLY = "filling exactly"


@dataclass(frozen=True, kw_only=True)
class SurfaceFilling:
    """Quick tets of a lattice in seconds, or tets by fTetWild in up to some minutes.

    edge_length : edge length of the tets, as a share of the diagonal; None for the default of each
        method: 0.025, and 0.02 for fTetWild
    exact : whether to use fTetWild at once, and not only for surfaces where quick tets fail
    most_closed : largest number of narrow gaps or holes that quick tets may close
    """

    edge_length: float | None = None
    exact: bool = False
    most_closed: int = 4

    def fill(self, vertices: ArrayLike, faces: ArrayLike, *, stage: Callable[..., None]) -> TetMesh:
        """Tets inside a surface, which is mended if it is not closed.

        `stage` is called with "filling", with "filling inside" and "filling boundary" and the
        numbers done and in all, and with "filling exactly" before fTetWild, which takes up to some
        minutes, and at each of its passes. ValueError as for `fill_surface`.
        """
        sized = {} if self.edge_length is None else {"edge_length": self.edge_length}
        if not self.exact:
            stage("filling")
            try:
                return stuff_surface(
                    vertices,
                    faces,
                    mend=True,
                    most_closed=self.most_closed,
                    progress=lambda part, done, total: stage(f"filling {part}", done, total),
                    **sized,
                )
            except NoSolidError:
                raise
            except ValueError:  # the next stage shows on the page that the method has changed
                pass
        stage(EXACTLY)
        return fill_surface(
            vertices,
            faces,
            mend=True,
            progress=lambda passes: stage(EXACTLY, passes),
            **sized,
        )
