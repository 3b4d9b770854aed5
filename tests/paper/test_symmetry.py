"""Mirror images of solutions, on a body that is symmetric."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import snapspace as ss
from paper.limits_orderings import limits_in_order
from paper.symmetry import SYMMETRIC, mirror_of, mirrored, partners
from snapspace.generators import bar


def problem() -> ss.PosingProblem:
    """A bar along x, held at both ends and in the middle, turned in space."""
    straight = bar(8, 3, 2)
    turn = Rotation.from_rotvec([0.3, 0.5, -0.2]).as_matrix()
    vertices = straight.vertices @ turn.T + [1.0, 2.0, 3.0]
    x = straight.vertices[:, 0]
    low, high, middle = x.min(), x.max(), np.median(x)
    regions = [np.flatnonzero(np.abs(x - at) < 1e-9) for at in (middle, low, high)]
    handles = ss.Handles(regions, names=["middle", "left", "right"])
    domain = ss.HandleBox(translation=0.4, angle=0.4)
    return ss.PosingProblem(ss.TetMesh(vertices, straight.tets), handles, domain=domain)


def test_the_plane_and_the_partners_are_found() -> None:
    given = problem()
    mirror = mirror_of(given.mesh)
    assert mirror.asymmetry < 1e-9
    found = partners(given, mirror)
    assert found in ([0, 1, 2], [0, 2, 1])
    images = mirror.points(given.mesh.vertices)
    np.testing.assert_allclose(mirror.points(images), given.mesh.vertices, atol=1e-12)


def test_the_mirror_image_of_a_solution_is_one() -> None:
    """Its energy is that of the solution, although the tets are not symmetric."""
    given = problem()
    mirror = mirror_of(given.mesh)
    parameters = np.zeros((1, given.parameter_count))
    parameters[0, :3] = [0.2, -0.1, 0.15]
    solved = ss.solve_snapshots(given, parameters)
    images = mirrored(given, solved.shapes, mirror)
    again = mirrored(given, images, mirror)
    size = np.abs(solved.shapes - given.tau).max()
    assert np.abs(images - solved.shapes).max() > 0.1 * size
    np.testing.assert_allclose(again, solved.shapes, atol=1e-6 * size)


def test_a_body_without_symmetry_is_not_symmetric() -> None:
    vertices = bar(6, 2, 2).vertices
    bent = vertices + np.column_stack(
        [vertices[:, 0] ** 2 / 3, 0 * vertices[:, 0], vertices[:, 1] * vertices[:, 0]]
    )
    assert mirror_of(ss.TetMesh(bent, bar(6, 2, 2).tets)).asymmetry > SYMMETRIC


@pytest.mark.parametrize(
    ("limit", "errors", "fault"),
    [
        (
            "symmetry",
            {"samples": 0.1, "samples and mirror images": 0.11, "twice the samples": 0.05},
            "symmetry, bar: mirror images hurt",
        ),
        (
            "other handles",
            {"old handles": 0.1, "old handles and linear responses": 0.2, "new samples": 0.05},
            "other handles, bar: responses do not help",
        ),
        (
            "other handles",
            {"old handles": 0.1, "old handles and linear responses": 0.05, "new samples": 0.1},
            "other handles, bar: new samples are no better than the old",
        ),
    ],
)
def test_broken_orderings_are_reported(limit: str, errors: dict[str, float], fault: str) -> None:
    rows = [
        {"limit": limit, "shape": "bar", "variant": variant, "error": error}
        for variant, error in errors.items()
    ]
    assert limits_in_order(rows) == [fault]
