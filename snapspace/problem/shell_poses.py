"""ShellPoses: several shapes of one shell."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..input_error import InputError, fault_of
from ..mesh import ShellMesh
from ..mesh.correspondence import check_same_faces
from ..mesh.inside_out import check_not_inside_out
from .pose_shapes import PoseShapes, as_names, check_meshes, check_pose_count

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int32]


class ShellPoses(PoseShapes):
    """Two or more shapes of one surface, vertex i at vertex i; their arrays are read-only.

    Nothing is filled, and no pose is fitted: the triangles themselves are the body.

    Parameters
    ----------
    shapes : array_like, (k, n, 3)
        Vertices of each pose, in one unit of length; each pose may be in its own frame.
    triangles : array_like of int, (f, 3)
        0-based vertex indices.
    thickness : float or array_like (f,), > 0
        Thickness in all poses, in the unit of length; see `ShellMesh`.
    names : sequence of str, optional
        One per pose, unique. Default: pose 0, pose 1, ...

    Raises
    ------
    ValueError
        For fewer than two poses, wrong array shapes, names that do not match, coordinates that are
        not finite, a pose that is not a valid `ShellMesh`, of one component, or a closed surface
        that is inside out relative to the first. The message names the pose.

    Notes
    -----
    Nothing holds the components of blended shapes together, so only one is allowed.
    """

    def __init__(
        self,
        shapes: ArrayLike,
        triangles: ArrayLike,
        *,
        thickness: ArrayLike,
        names: Sequence[str] | None = None,
    ) -> None:
        super().__init__(shapes, names, who="ShellPoses")
        meshes = [
            _mesh(shape, triangles, thickness, name)
            for shape, name in zip(self._shapes, self._names, strict=True)
        ]
        self._reference = meshes[0]
        _check_connected(self._reference)
        try:
            check_not_inside_out(self._shapes, self.triangles, self._names)
        except ValueError as error:
            raise ValueError(f"ShellPoses: {error}") from None
        self._volumes = np.stack([mesh.volumes for mesh in meshes])
        self._volumes.setflags(write=False)

    @classmethod
    def of(cls, meshes: Sequence[ShellMesh], *, names: Sequence[str] | None = None) -> ShellPoses:
        """Poses from shells with the same triangles and the thickness of the first.

        ValueError names the first difference.
        """
        check_meshes(meshes, ShellMesh, who="ShellPoses")
        check_pose_count(len(meshes), who="ShellPoses")
        names = as_names(names, len(meshes), who="ShellPoses")
        try:
            check_same_faces([(mesh.vertices, mesh.triangles) for mesh in meshes], names)
        except ValueError as error:
            raise ValueError(f"ShellPoses: {error}") from None
        first = meshes[0]
        for mesh, name in zip(meshes[1:], names[1:], strict=True):
            if not np.array_equal(mesh.thickness, first.thickness):
                raise ValueError(
                    f"ShellPoses: {name} has another thickness than {names[0]}; give all poses the "
                    "same"
                )
        shapes = np.stack([mesh.vertices for mesh in meshes])
        return cls(shapes, first.triangles, thickness=first.thickness, names=names)

    @property
    def triangles(self) -> IndexArray:
        """Vertex indices of the triangles, (f, 3) int32."""
        return self._reference.triangles

    @property
    def thickness(self) -> float | FloatArray:
        """Thickness of all triangles, or of each, (f,)."""
        return self._reference.thickness

    @property
    def reference(self) -> ShellMesh:
        """The first pose."""
        return self._reference

    @property
    def volumes(self) -> FloatArray:
        """Areas of the triangles in each pose, times their thickness, (k, f)."""
        return self._volumes

    @property
    def inverted_tets(self) -> NDArray[np.int64]:
        """Zeros, (k,): a surface has no inside."""
        return np.zeros(len(self), np.int64)

    def __repr__(self) -> str:
        n, f = self._shapes.shape[1], len(self.triangles)
        return f"ShellPoses({', '.join(self._names)}: {n} vertices, {f} triangles)"


def _mesh(shape: FloatArray, triangles: ArrayLike, thickness: ArrayLike, name: str) -> ShellMesh:
    try:
        return ShellMesh(shape, triangles, thickness=thickness)
    except ValueError as error:
        raise InputError(f"ShellPoses: {name}", fault_of(error)) from None


def _check_connected(mesh: ShellMesh) -> None:
    count = int(mesh.components.max()) + 1
    if count > 1:
        raise ValueError(
            f"ShellPoses: the surface has {count} components, and nothing holds them together; "
            "blend each one by itself"
        )
