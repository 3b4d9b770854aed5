from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from snapspace.generators import cylinder

from .conforming import assert_solid


@pytest.mark.parametrize(("radial", "along"), [(1, 1), (2, 5), (4, 3)])
def test_volume_is_that_of_the_inscribed_prism(radial: int, along: int) -> None:
    mesh = cylinder(radial, along, length=3.0, radius=0.5)
    assert_solid(mesh, euler=2)
    corners = 6 * radial
    area = 0.5 * corners * 0.25 * math.sin(2.0 * math.pi / corners)
    assert mesh.volume == pytest.approx(3.0 * area, rel=1e-12)
    assert len(mesh.vertices) == (1 + 3 * radial * (radial + 1)) * (along + 1)
    assert len(mesh.tets) == 18 * radial**2 * along


def test_volume_converges_at_second_order() -> None:
    exact = 3.0 * math.pi * 0.25
    errors = [exact - cylinder(r, 2, length=3.0, radius=0.5).volume for r in (2, 4, 8)]
    assert errors[0] > 0.0
    for coarse, fine in pairwise(errors):
        assert coarse / fine == pytest.approx(4.0, rel=0.05)


def test_cross_section_is_balanced() -> None:
    # Six-fold symmetry: the axis is the line of centroids, at every layer.
    mesh = cylinder(3, 4)
    layers = mesh.vertices.reshape(5, -1, 3)
    np.testing.assert_allclose(layers[..., :2].mean(axis=1), 0.0, atol=1e-14)


def test_default_is_well_shaped_and_of_the_papers_size() -> None:
    mesh = cylinder()
    assert 950 <= len(mesh.vertices) <= 1050
    assert mesh.dihedral_angles.min() > 30.0


def test_the_same_call_gives_the_same_bits() -> None:
    assert cylinder().fingerprint == cylinder().fingerprint


def test_refuses_what_cannot_be_made() -> None:
    with pytest.raises(ValueError, match="cylinder: radial is 0, but must be at least 1"):
        cylinder(0)
    with pytest.raises(ValueError, match="cylinder: along is -3, but must be at least 1"):
        cylinder(2, -3)
    with pytest.raises(ValueError, match=r"cylinder: radius is 0\.0, but must be positive"):
        cylinder(radius=0.0)
    with pytest.raises(ValueError, match="cylinder: length is inf, but must be finite"):
        cylinder(length=math.inf)
