"""PoseEnergies: the energies of several poses of one body, each with a pose as its rest shape."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .. import _core
from ..arguments import is_whole, shown
from ..material import ARAP, Material
from ..mesh import Body, ShellMesh
from .arap_triangles import star_hats
from .shell_material import ShellMaterial, is_of_stars, shell_materials
from .vertex_stars import VertexStars

FloatArray = NDArray[np.float64]


class PoseEnergies:
    """The energies E_k of a blend, each a function of displacements from its pose.

    Parameters
    ----------
    mesh : TetMesh or ShellMesh
        The first pose.
    shapes : (k, n, 3)
        All poses, in any frames.
    material : Material
        Of tets, or of triangles.

    Raises
    ------
    ValueError
        For a shell of a material that has no such form.
    """

    def __init__(self, mesh: Body, shapes: FloatArray, material: Material) -> None:
        self._mesh, self._shapes, self._material = mesh, np.ascontiguousarray(shapes), material
        self._compiled: dict[int, _core.ElasticEnergy] = {}

    def in_frames(self, shapes: FloatArray) -> PoseEnergies:
        """The same energies with the poses (k, n, 3) in other frames.

        They keep the same stars: recomputed lengths would round differently, which may change the
        centers of stars.
        """
        moved = PoseEnergies(self._mesh, shapes, self._material)
        moved.hats = self.hats
        return moved

    @cached_property
    def hats(self) -> _core.StarHats | None:
        """The hats of the stars, the same in all poses; None for one-rings and other bodies."""
        if not (isinstance(self._mesh, ShellMesh) and isinstance(self._material, ARAP)):
            return None
        return star_hats(self._mesh, self._shapes, self._material)

    def __len__(self) -> int:
        return len(self._shapes)

    @property
    def corners(self) -> NDArray[np.int32]:
        """Corners of the elements that the core sums: all, or the triangles of stars, (m, 4)."""
        if not is_of_stars(self._mesh, self._material):
            return self._mesh.elements
        return np.ascontiguousarray(self._mesh.elements[: len(self._mesh.cells)])

    @cached_property
    def materials(self) -> Sequence[Material | ShellMaterial]:
        """The material of these elements in each pose."""
        if not isinstance(self._mesh, ShellMesh):
            return [self._material] * len(self)
        return shell_materials(
            self._mesh, self._shapes, self._material, hats=self.hats, who="InterpolationProblem"
        )

    @cached_property
    def stars(self) -> list[VertexStars] | None:
        """The stars of each pose of an as-rigid-as-possible surface; None for others."""
        if not is_of_stars(self._mesh, self._material):
            return None
        return [VertexStars(self.energy(k)) for k in range(len(self))]

    def energy(self, pose: int) -> _core.ElasticEnergy:
        """E_k, compiled, a function of displacements (3n,) from the pose."""
        if not (is_whole(pose) and 0 <= pose < len(self)):
            raise ValueError(
                f"InterpolationProblem: pose is {shown(pose)}, but must be between 0 and "
                f"{len(self) - 1}"
            )
        if pose not in self._compiled:
            self._compiled[pose] = _core.ElasticEnergy(
                self._shapes[pose], self.corners, self.materials[pose].core
            )
        return self._compiled[pose]
