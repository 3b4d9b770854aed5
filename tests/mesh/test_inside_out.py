"""A mirror image of a closed surface is inside out, and cannot be blended with it."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.mesh.inside_out import check_not_inside_out

from .boxes import box_mesh

BOX = box_mesh()
NAMES = ("stand", "run", "jump")


def test_mirror_images_are_named() -> None:
    shapes = np.stack([BOX.vertices, BOX.vertices + 1e3, BOX.vertices * [-1.0, 1.0, 1.0]])
    with pytest.raises(ValueError, match=r"^jump: is inside out, probably a mirror im"):
        check_not_inside_out(shapes, BOX.surface, NAMES)
    check_not_inside_out(shapes[:2], BOX.surface, NAMES[:2])


def test_faces_may_be_inward_in_all_poses() -> None:
    shapes = np.stack([BOX.vertices, 2.0 * BOX.vertices])
    check_not_inside_out(shapes, BOX.surface[:, ::-1], NAMES[:2])


def test_open_surfaces_and_small_volumes_of_the_other_sign_are_accepted() -> None:
    mirrored = BOX.vertices * [-1.0, 1.0, 1.0]
    check_not_inside_out(np.stack([BOX.vertices, mirrored]), BOX.surface[1:], NAMES[:2])
    flat = BOX.vertices * [-0.1, 1.0, 1.0]
    check_not_inside_out(np.stack([BOX.vertices, flat]), BOX.surface, NAMES[:2])
