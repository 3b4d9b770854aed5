"""Reading poses of a shell: surfaces that are used as they are."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..energy import SHELLS
from ..mesh import EmbeddedSurface, open_surface
from ..mesh.correspondence import check_same_faces
from ..mesh.shell_of_file import welded, welded_surface
from ..problem import ShellPoses
from ..registration import ScalePolicy
from .files import SURFACE_INPUTS
from .given_options import chosen_parameters
from .pose_scales import notice_sizes, scaled_poses

#: Options of `interpolate` that are meaningless for shells.
_OF_TETS = (
    "--tets",
    "--edge-length",
    "--exact",
    "--deviation",
    "--accept-inverted",
    "--save-poses",
    "--repair",
)


def check_shell_options(material: str) -> None:
    """ValueError for options on the command line that contradict --shell."""
    given = {option.opts[-1] for option in chosen_parameters()}
    for name in _OF_TETS:
        if name in given:
            raise ValueError(
                f"{name} is for poses that are tets or filled with tets, but --shell takes "
                "surfaces as they are; leave one of them out"
            )
    known = [shell.kind for shell in SHELLS]
    if material not in known:
        names = f"{', '.join(known[:-1])} or {known[-1]}"
        raise ValueError(f"--material {material} has no form for shells; use {names}")


def read_shell_poses(
    files: Sequence[Path], names: Sequence[str], *, thickness: float, scale: ScalePolicy
) -> tuple[ShellPoses, EmbeddedSurface]:
    """The poses of two or more surface files with the same faces, and the first one's surface.

    Vertices at one position in the first pose, as at seams of texture coordinates, become one.

    Raises
    ------
    ValueError
        For a file that is not a surface, poses that do not correspond, and as for `ShellPoses`.
    """
    for file in files:
        if file.suffix.lower() not in SURFACE_INPUTS:
            raise ValueError(
                f"{file}: poses of a shell are surfaces ({', '.join(SURFACE_INPUTS)}), not tets; "
                "leave --shell out to blend tets"
            )
    opened = [open_surface(file).compact() for file in files]
    check_same_faces([(one.vertices, one.faces) for one in opened], names)
    shapes = scaled_poses(
        np.stack([one.vertices for one in opened]), opened[0].faces, names, policy=scale
    )
    notice_sizes(shapes, opened[0].faces, names, policy=scale)
    _, triangles, first = welded(shapes[0], opened[0].faces)
    poses = ShellPoses(shapes[:, first], triangles, thickness=thickness, names=names)
    return poses, welded_surface(opened[0])
