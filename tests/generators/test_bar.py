from __future__ import annotations

import re

import numpy as np
import pytest

from snapspace.generators import bar

from .conforming import assert_solid


@pytest.mark.parametrize("counts", [(1, 1, 1), (2, 1, 3), (5, 4, 3)])
def test_fills_the_box_with_equal_tets(counts: tuple[int, int, int]) -> None:
    mesh = bar(*counts, length=3.0, width=0.5, height=2.0)
    assert_solid(mesh, euler=2)
    np.testing.assert_allclose(mesh.volumes, 3.0 / (6 * np.prod(counts)), rtol=1e-12)
    assert mesh.vertices.min(axis=0).tolist() == [0.0, 0.0, 0.0]
    assert mesh.vertices.max(axis=0).tolist() == [3.0, 0.5, 2.0]


def test_cubical_cells_have_the_angles_of_kuhn_tets() -> None:
    angles = bar(4, 2, 3, length=4.0, width=2.0, height=3.0).dihedral_angles
    nearest = np.array([45.0, 60.0, 90.0])
    assert np.abs(angles[..., None] - nearest).min(axis=-1).max() < 1e-6
    assert angles.min() == pytest.approx(45.0)


def test_the_same_call_gives_the_same_bits() -> None:
    assert bar().fingerprint == bar().fingerprint


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"nx": 0}, "bar: nx is 0, but must be at least 1"),
        ({"ny": 2.5}, "bar: ny is 2.5, but must be a whole number"),
        ({"width": -1.0}, "bar: width is -1.0, but must be positive"),
        ({"height": float("nan")}, "bar: height is nan, but must be finite"),
        ({"length": "long"}, "bar: length is 'long', but must be a number"),
    ],
)
def test_refuses(options: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        bar(**options)  # type: ignore[arg-type]
