"""UserSurface: a surface that a user opened, to become a solid or a shell."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..doctor.holes import has_wide_hole
from ..filling import SurfaceFilling
from ..input_error import located
from ..material import Material
from ..mesh import Body as Mesh
from ..mesh import EmbeddedSurface, MirrorPlane, ShellMesh, SurfaceFile, embed_file, shell_of_file
from ..mesh.embed_surface import WHOLE_DIAGONAL
from ..mesh.validation import check_points
from .body import Body

#: Usual thickness of a shell, as a share of the diagonal. Thinner shells bend so easily that a
#: linear subspace stretches what should only bend, and thicker ones bend like solids
#: (docs/shells.md).
USUAL_THICKNESS = 0.02


@dataclass(frozen=True, kw_only=True)
class UserSurface:
    """A surface file that has been read, with everything that a body needs besides a mesh.

    name, folder, up, mirror, material : as for `Body`
    source : SurfaceFile, compact
    path : Path of the file, or None if it is not a file of the user
    """

    name: str
    source: SurfaceFile
    folder: Path
    path: Path | None
    up: str | None = None
    mirror: MirrorPlane | None = None
    material: Material | None = None

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box."""
        return float(np.linalg.norm(np.ptp(self.source.vertices, axis=0)))

    def check(self) -> None:
        """ValueError unless all coordinates are finite."""
        with self._located():
            check_points(self.source.vertices, who="surface")

    def filled(self, filling: SurfaceFilling, *, stage: Callable[..., None]) -> Body:
        """The solid inside the surface; ValueError as for `SurfaceFilling.fill`."""
        with self._located():
            mesh = filling.fill(self.source.vertices, self.source.faces, stage=stage)
            return self._body(mesh, embed_file(self.source, mesh, farthest=WHOLE_DIAGONAL))

    def shell(self, thickness: float) -> Body:
        """The surface as a shell; ValueError as for `ShellMesh`."""
        with self._located():
            return self._body(*shell_of_file(self.source, thickness=thickness))

    def own_shell(self) -> Body | None:
        """The surface as a shell of the usual thickness if it is open; None if it is closed.

        Also None if it is not a valid shell, since filling mends more.
        """
        try:
            body = self.shell(usual_thickness(self.diagonal))
        except ValueError:
            return None
        return body if is_open(body.mesh) else None

    def _located(self) -> AbstractContextManager[None]:
        return located(self.source.name if self.path is None else self.path)

    def _body(self, mesh: Mesh, surface: EmbeddedSurface) -> Body:
        return Body(
            name=self.name,
            mesh=mesh,
            file=None,
            folder=self.folder,
            surface=surface,
            surface_file=self.path,
            up=self.source.up if self.up is None else self.up,
            mirror=self.mirror,
            material=self.material,
        )


def is_open(mesh: Mesh) -> bool:
    """Whether a body is a shell with a hole that is wider than a fault, which filling closes."""
    return isinstance(mesh, ShellMesh) and has_wide_hole(mesh.vertices, mesh.triangles)


def usual_thickness(diagonal: float) -> float:
    """A fiftieth of the diagonal, to two digits."""
    return float(f"{USUAL_THICKNESS * diagonal:.2g}")
