"""parts_apart groups the components that may belong to one solid."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from snapspace.doctor.parts_apart import parts_apart
from snapspace.filling import stuff_surface
from snapspace.mesh import MeshNotice
from snapspace.mesh.closed_surface import enclosed_volume

from ..cli.odd_surfaces import ball, block, together
from ..filling.surfaces import Surface, inside_out

SPHERE = ball(12)
#: A block in a corner of the sphere's bounding box, and outside of the sphere.
CORNER = block(0.75, 0.75, 0.75, scale=0.1)
INSIDE = block(0.0, 0.0, 0.0, scale=0.1)
CAVITY = inside_out(ball(12, 0.5))

CASES: dict[str, tuple[tuple[Surface, ...], list[int]]] = {
    "apart, with boxes that overlap": ((SPHERE, CORNER), [0, 1]),
    "inside": ((SPHERE, INSIDE), [0, 0]),
    "a cavity": ((SPHERE, CAVITY), [0, 0]),
    "a solid in a cavity": ((SPHERE, CAVITY, INSIDE), [0, 0, 1]),
    "a solid in the wall of a cavity": ((SPHERE, CAVITY, block(0.55, 0, 0, scale=0.1)), [0, 0, 0]),
    "faces that cross": ((SPHERE, block(0.9, 0.0, 0.0)), [0, 0]),
    "a gap as narrow as fTetWild's tolerance": ((block(), block(2.0005)), [0, 0]),
    "a wider gap": ((block(), block(2.01, scale=0.5)), [0, 1]),
    "joined by a third one": ((block(), block(3.0), block(1.5, 0.3, 0.3, scale=0.9)), [0, 0, 0]),
}


def volumes_of(parts: tuple[Surface, ...]) -> list[float]:
    """Signed volumes of the parts."""
    return [enclosed_volume(*part) for part in parts]


@pytest.mark.parametrize(("parts", "expected"), CASES.values(), ids=CASES)
@pytest.mark.parametrize("inward", [False, True])
@pytest.mark.parametrize(("unit", "shift"), [(1.0, 0.0), (1e3, 5e4)])
def test_groups(
    parts: tuple[Surface, ...], expected: list[int], inward: bool, unit: float, shift: float
) -> None:
    """They depend neither on unit and place nor on which side of all faces is called outside."""
    vertices, faces = together(*parts)
    group, share = parts_apart(unit * vertices + shift, faces[:, ::-1] if inward else faces)
    counts = [len(triangles) for _, triangles in parts]
    assert [sorted(set(some)) for some in np.split(group, np.cumsum(counts)[:-1])] == [
        [one] for one in expected
    ]
    volumes = np.abs(np.bincount(expected, volumes_of(parts)))
    assert_allclose(share, volumes / volumes.sum(), rtol=1e-6)


def test_parts_of_an_open_surface_are_apart_only_if_their_boxes_are() -> None:
    """The inside of an open surface is not clear, and its parts are measured by their areas."""
    vertices, faces = SPHERE
    near = together((vertices, faces[1:]), CORNER)
    assert not parts_apart(*near)[0].any()
    group, share = parts_apart(*together((vertices, faces[1:]), block(3.0)))
    assert group.max() == 1
    assert share[0] == pytest.approx(4 * np.pi / (4 * np.pi + 10.0), rel=0.02)


def test_dust_within_the_bounding_box_does_not_hinder_quick_filling() -> None:
    """It used to be left to fTetWild, which takes ten times as long, or was filled as well."""
    flake = (block(scale=0.1)[0] * [1.0, 1.0, 0.02] + 0.75, block()[1])
    with pytest.warns(MeshNotice, match="1 small part of the surface is apart"):
        mesh = stuff_surface(*together(SPHERE, flake), edge_length=0.05)
    assert mesh.volume == pytest.approx(enclosed_volume(*SPHERE), rel=0.03)


def test_a_large_part_within_the_bounding_box_is_refused_before_filling() -> None:
    with pytest.raises(ValueError, match=r"2 separate parts \(the second largest: 320 faces"):
        stuff_surface(*together(SPHERE, block(0.75, 0.75, 0.75, scale=0.2)))
