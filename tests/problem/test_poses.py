from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace.mesh import TetMesh
from snapspace.problem.poses import Poses

from ..shapes import deformed, irregular_bar, moved, one_tet, random_rotation

FloatArray = NDArray[np.float64]
BAR = irregular_bar()
BENT = deformed(BAR, 0.03).reshape(-1, 3)
TURNED = moved(BENT.reshape(-1), random_rotation(), 5.0).reshape(-1, 3)
SHAPES = np.stack([BAR.vertices, BENT, TURNED])


def tet_with_apex(*heights: float) -> list[FloatArray]:
    """One tet with its fourth vertex at several heights over the first three."""
    shapes = []
    for height in heights:
        vertices = one_tet().vertices.copy()
        vertices[3, 2] = height
        shapes.append(vertices)
    return shapes


def test_poses_hold_what_they_were_given() -> None:
    poses = Poses(SHAPES, BAR.tets, names=["rest", "bent", "turned"])
    assert len(poses) == 3
    assert np.array_equal(poses.shapes, SHAPES)
    assert np.array_equal(poses.tets, BAR.tets)
    assert poses.names == ("rest", "bent", "turned")
    assert poses.reference.fingerprint == BAR.fingerprint
    assert not poses.inverted_tets.any()
    assert repr(poses) == (
        f"Poses(rest, bent, turned: {len(BAR.vertices)} vertices, {len(BAR.tets)} tets)"
    )


def test_each_pose_has_the_volumes_of_its_mesh() -> None:
    poses = Poses(SHAPES, BAR.tets)
    for shape, volumes in zip(SHAPES, poses.volumes, strict=True):
        assert np.array_equal(volumes, TetMesh(shape, BAR.tets).volumes)
    # a rigid motion keeps them
    assert poses.volumes[2] == pytest.approx(poses.volumes[1])


def test_arrays_are_copied_and_cannot_be_changed() -> None:
    given = SHAPES.copy()
    poses = Poses(given, BAR.tets)
    given[:] = 0.0
    assert np.array_equal(poses.shapes, SHAPES)
    for array in (poses.shapes, poses.tets, poses.volumes, poses.inverted_tets):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


def test_poses_of_meshes_equal_those_of_arrays() -> None:
    poses = Poses.of([TetMesh(shape, BAR.tets) for shape in SHAPES])
    assert np.array_equal(poses.shapes, SHAPES)
    assert np.array_equal(poses.volumes, Poses(SHAPES, BAR.tets).volumes)
    assert poses.names == ("pose 0", "pose 1", "pose 2")


def test_inverted_tets_are_counted_if_they_are_accepted() -> None:
    shapes = np.stack([BAR.vertices, BENT, BENT * [1, 1, -1]])
    poses = Poses(shapes, BAR.tets, accept_inverted=True)
    assert poses.inverted_tets.tolist() == [0, 0, len(BAR.tets)]
    assert poses.volumes[2] == pytest.approx(-poses.volumes[1])
    assert repr(poses).endswith(f"{len(BAR.tets)} tets inverted)")


NAMES = ["stand", "run"]
TET = [[0, 1, 2, 3]]
BAD: list[tuple[Any, dict[str, Any], str]] = [
    (SHAPES[:1], {}, "got 1 pose, but at least two are needed"),
    (SHAPES[:0], {}, "got 0 poses, but at least two are needed"),
    (SHAPES[0], {}, "shapes must be real numbers (k, n, 3), got float64 of shape (36, 3)"),
    (SHAPES[:, :, :2], {}, "shapes must be real numbers (k, n, 3), got float64 of shape (3, 36, 2"),
    (SHAPES.astype(str), {}, "shapes must be real numbers (k, n, 3), got <U"),
    (SHAPES + 0j, {}, "shapes must be real numbers (k, n, 3), got complex128"),
    ([SHAPES[0], SHAPES[1][1:]], {}, "shapes must be one array (k, n, 3); the poses have differen"),
    (SHAPES, {"names": NAMES}, "got 2 names for 3 poses"),
    (SHAPES, {"names": ["a", "b", "a"]}, "the name 'a' is used twice"),
    (SHAPES, {"names": ["a", " ", "c"]}, "a name must be a non-empty string, got ' '"),
    (SHAPES, {"names": ["a", 2, "c"]}, "a name must be a non-empty string, got 2"),
    (SHAPES, {"tets": [[0, 1, 2, 99]]}, "pose 0: tet 0 has vertex index 99, but vertices has 36"),
    (SHAPES, {"tets": BAR.tets[:, :3]}, "pose 0: tets must have shape (m, 4), got"),
    (SHAPES * [1, 1, -1], {}, "pose 0: every tet (72) is inverted"),
    (SHAPES * [1, 1, -1], {"accept_inverted": True}, "pose 0: every tet (72) is inverted"),
    (SHAPES * [[[1]], [[1]], [[1e150]]], {}, "pose 2: coordinates up to"),
]


@pytest.mark.parametrize(("shapes", "options", "message"), BAD)
def test_wrong_poses_are_refused(shapes: Any, options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(f"Poses: {message}")) as caught:
        Poses(shapes, **{"tets": BAR.tets, **options})
    assert "\n" not in str(caught.value)


def test_the_vertex_that_is_not_finite_is_named() -> None:
    shapes = SHAPES.copy()
    shapes[2, 17, 1] = np.nan
    with pytest.raises(ValueError, match=r"Poses: pose 2: vertex 17 is not finite \(.*nan"):
        Poses(shapes, BAR.tets)


def test_the_pose_with_inverted_tets_is_named_with_a_cure() -> None:
    with pytest.raises(ValueError) as caught:
        Poses(tet_with_apex(1.0, 2.0, -0.6), TET, names=["rest", "tall", "pushed in"])
    assert str(caught.value) == (
        "Poses: pushed in: 1 of 1 tets are inverted, the first is tet 0 (volume -0.1); fit the "
        "pose from its surface, mend it, or pass accept_inverted=True "
        "(command line: --accept-inverted)"
    )


@pytest.mark.parametrize("accept_inverted", [False, True])
@pytest.mark.parametrize("height", [0.0, 1e-15, -1e-15])
def test_a_tet_without_volume_is_always_refused(height: float, accept_inverted: bool) -> None:
    """Its energy would divide by the volume."""
    with pytest.raises(ValueError) as caught:
        Poses(tet_with_apex(1.0, height), TET, names=NAMES, accept_inverted=accept_inverted)
    assert "Poses: run: 1 of 1 tets have no volume, the first is tet 0 (0, 1, 2, 3)" in str(
        caught.value
    )


def test_volumes_are_judged_in_the_unit_of_the_pose() -> None:
    """A pose in other units is small, but not flat."""
    poses = Poses(SHAPES * [[[1.0]], [[1e-6]], [[1e6]]], BAR.tets)
    assert (poses.volumes > 0).all()


def test_meshes_that_do_not_correspond_are_refused() -> None:
    tets = BAR.tets.copy()
    tets[4] = tets[4][[1, 2, 0, 3]]
    other = TetMesh(BENT, tets)
    row, first = ", ".join(map(str, tets[4])), ", ".join(map(str, BAR.tets[4]))
    message = f"Poses: run: tet 4 has vertices {row}, but in stand {first}; 1 of 72 tets differ"
    with pytest.raises(ValueError, match=re.escape(message)):
        Poses.of([BAR, other], names=NAMES)
    with pytest.raises(ValueError, match="Poses: pose 1: has 4 vertices, but pose 0 has 36"):
        Poses.of([BAR, one_tet()])
    with pytest.raises(ValueError, match="Poses: got 1 pose, but at least two are needed"):
        Poses.of([BAR])
    with pytest.raises(ValueError, match="Poses: got 1 names for 2 poses"):
        Poses.of([BAR, BAR], names=["stand"])
