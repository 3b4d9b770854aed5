"""Poses: several shapes of one tet mesh."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..input_error import InputError, fault_of
from ..mesh import TetMesh, tet_volumes
from ..mesh.correspondence import check_same_tets
from ..mesh.inside_out import MIRROR_BACK
from ..mesh.quality import flat_tets
from .pose_shapes import PoseShapes, as_names, check_meshes, check_pose_count

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int32]


class Poses(PoseShapes):
    """Two or more shapes of one tet mesh, vertex i at vertex i; their arrays are read-only.

    Parameters
    ----------
    shapes : array_like, (k, n, 3)
        Vertices of each pose, in one unit of length; each pose may be in its own frame.
    tets : array_like of int, (m, 4)
        0-based vertex indices; the tets of the first pose have positive volumes.
    names : sequence of str, optional
        One per pose, unique. Default: pose 0, pose 1, ...
    accept_inverted : bool, default False
        Accepts inverted tets in all poses except the first. Their energy is that of the mirrored
        tet, so interpolated shapes may have inverted tets as well.

    Raises
    ------
    ValueError
        For fewer than two poses, wrong array shapes, names that do not match, coordinates that are
        not finite, a first pose that is not a valid `TetMesh`, a tet without volume in any pose, or
        an inverted tet unless accepted. The message names the pose.
    """

    def __init__(
        self,
        shapes: ArrayLike,
        tets: ArrayLike,
        *,
        names: Sequence[str] | None = None,
        accept_inverted: bool = False,
    ) -> None:
        super().__init__(shapes, names, who="Poses")
        self._reference = _reference(self._shapes[0], tets, self._names[0])
        self._volumes = np.stack([self._volumes_of(pose) for pose in range(len(self))])
        inverted: NDArray[np.int64] = (self._volumes < 0).sum(axis=1)
        self._inverted_tets = inverted
        if not accept_inverted:
            self._check_inverted()
        for array in (self._volumes, self._inverted_tets):
            array.setflags(write=False)

    @classmethod
    def of(
        cls,
        meshes: Sequence[TetMesh],
        *,
        names: Sequence[str] | None = None,
        accept_inverted: bool = False,
    ) -> Poses:
        """Poses from meshes with the same tets; ValueError names the first difference."""
        check_meshes(meshes, TetMesh, who="Poses")
        check_pose_count(len(meshes), who="Poses")
        names = as_names(names, len(meshes), who="Poses")
        try:
            check_same_tets([(mesh.vertices, mesh.tets) for mesh in meshes], names)
        except ValueError as error:
            raise ValueError(f"Poses: {error}") from None
        shapes = np.stack([mesh.vertices for mesh in meshes])
        return cls(shapes, meshes[0].tets, names=names, accept_inverted=accept_inverted)

    @property
    def tets(self) -> IndexArray:
        """Vertex indices of the tets, (m, 4) int32."""
        return self._reference.tets

    @property
    def reference(self) -> TetMesh:
        """The first pose."""
        return self._reference

    @property
    def volumes(self) -> FloatArray:
        """Signed volumes of the tets in each pose, (k, m); negative if inverted, never zero."""
        return self._volumes

    @property
    def inverted_tets(self) -> NDArray[np.int64]:
        """Number of inverted tets in each pose, (k,); zero unless they were accepted."""
        return self._inverted_tets

    def __repr__(self) -> str:
        inverted = self._inverted_tets.sum()
        note = f", {inverted} tets inverted" if inverted else ""
        n, m = self._shapes.shape[1], len(self.tets)
        return f"Poses({', '.join(self._names)}: {n} vertices, {m} tets{note})"

    def _volumes_of(self, pose: int) -> FloatArray:
        """Signed volumes (m,) of a pose, none of them zero."""
        vertices = self._shapes[pose]
        with np.errstate(over="ignore", invalid="ignore"):
            volumes = tet_volumes(vertices, self.tets)
        if not np.isfinite(volumes).all():
            raise ValueError(
                f"Poses: {self._names[pose]}: coordinates up to {np.abs(vertices).max():g} are too "
                "large for the volumes to be computed: choose another unit of length"
            )
        flat = np.flatnonzero(flat_tets(vertices, self.tets, volumes))
        if flat.size:
            raise ValueError(
                f"Poses: {self._names[pose]}: {flat.size} of {len(volumes)} tets have no volume, "
                f"the first is tet {flat[0]} ({', '.join(map(str, self.tets[flat[0]]))}); move "
                "their vertices apart, or fit the pose from its surface"
            )
        return volumes

    def _check_inverted(self) -> None:
        for name, count, volumes in zip(
            self._names, self._inverted_tets, self._volumes, strict=True
        ):
            if count == len(volumes) > 1:
                raise ValueError(
                    f"Poses: {name}: all {count} tets are inverted, so the pose is probably a "
                    f"mirror image of the body; {MIRROR_BACK}"
                )
            if count:
                first = np.flatnonzero(volumes < 0)[0]
                raise ValueError(
                    f"Poses: {name}: {count} of {len(volumes)} tets are inverted, the first is tet "
                    f"{first} (volume {volumes[first]:g}); fit the pose from its surface, "
                    "mend it, or pass accept_inverted=True (command line: "
                    "--accept-inverted)"
                )


def _reference(vertices: FloatArray, tets: ArrayLike, name: str) -> TetMesh:
    try:
        return TetMesh(vertices, tets)
    except ValueError as error:
        raise InputError(f"Poses: {name}", fault_of(error)) from None
