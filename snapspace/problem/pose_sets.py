"""Poses of tets or of a shell: from the user's arguments, and from pickles."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arguments import require_type
from ..mesh import ShellMesh, TetMesh
from .poses import Poses
from .shell_poses import ShellPoses

FloatArray = NDArray[np.float64]


def as_poses(
    poses: Poses | ShellPoses | Sequence[TetMesh] | Sequence[ShellMesh],
) -> Poses | ShellPoses:
    """The given poses, or poses made from meshes.

    ValueError for a mixture of tets and shells, or a pose that is neither.
    """
    if isinstance(poses, (Poses, ShellPoses)):
        return poses
    cure = "give Poses, ShellPoses or a list of meshes"
    require_type("InterpolationProblem", "poses", poses, Sequence, cure)
    for place, mesh in enumerate(poses):
        if not isinstance(mesh, (TetMesh, ShellMesh)):
            raise ValueError(
                f"InterpolationProblem: pose {place} is a {type(mesh).__name__}, but each must be "
                "a TetMesh or ShellMesh, such as TetMesh(vertices, tets)"
            )
    shells = [mesh for mesh in poses if isinstance(mesh, ShellMesh)]
    tets = [mesh for mesh in poses if isinstance(mesh, TetMesh)]
    if shells and tets:
        raise ValueError(
            f"InterpolationProblem: {len(shells)} of {len(poses)} poses are shells; give tets "
            "alone or shells alone"
        )
    return ShellPoses.of(shells) if shells else Poses.of(tets)


def pose_arguments(poses: Poses | ShellPoses) -> tuple[Any, ...]:
    """The arguments from which `restored_poses` makes the poses."""
    if isinstance(poses, ShellPoses):
        option: dict[str, Any] = {"thickness": poses.thickness}
    else:
        option = {"accept_inverted": bool(poses.inverted_tets.any())}
    return type(poses), poses.shapes, poses.reference.cells, poses.names, option


def restored_poses(
    kind: type[Poses] | type[ShellPoses],
    shapes: FloatArray,
    cells: NDArray[np.int32],
    names: Sequence[str],
    option: dict[str, Any],
) -> Poses | ShellPoses:
    """The poses from `pose_arguments`, checked again."""
    return kind(shapes, cells, names=names, **option)
