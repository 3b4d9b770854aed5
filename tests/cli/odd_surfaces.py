"""Surfaces that are odd in one way each, and what is known about them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from snapspace.generators import bar
from snapspace.mesh import compact_surface

from ..filling.surfaces import Surface, beside, inside_out


@dataclass(frozen=True, kw_only=True)
class Odd:
    """A surface, and its outcome.

    faults, others : names of what `check` finds
    volume : of the tets, None where quick tets do not fill it
    said : a part of the notice of filling, or of the error
    """

    surface: Surface
    faults: tuple[str, ...] = ()
    others: tuple[str, ...] = ()
    volume: float | None = None
    said: str = ""


def block(x: float = 0.0, y: float = 0.0, z: float = 0.0, scale: float = 1.0) -> Surface:
    """A block of 2 x 1 x 1, 320 faces."""
    mesh = bar(8, 4, 4, length=2.0, width=1.0, height=1.0)
    vertices, faces = compact_surface(mesh.vertices, mesh.surface)
    return scale * vertices + np.array([x, y, z]), faces


def ball(rings: int, radius: float = 1.0) -> Surface:
    """A sphere around the origin, 4 rings (rings - 1) faces."""
    around = 2 * rings
    polar = np.linspace(0.0, np.pi, rings + 1)[1:-1, None]
    angle = np.linspace(0.0, 2.0 * np.pi, around, endpoint=False)
    x, y = np.sin(polar) * np.cos(angle), np.sin(polar) * np.sin(angle)
    inner = np.stack([x, y, np.cos(polar) + 0.0 * angle], axis=-1).reshape(-1, 3)
    here = np.arange(around)
    after = np.roll(here, -1)
    row = around * np.arange(rings - 2)[:, None]
    a, b, c, d = row + here, row + after, row + around + here, row + around + after
    top, bottom, last = len(inner), len(inner) + 1, around * (rings - 2)
    faces = [
        np.stack([a, c, b], axis=-1).reshape(-1, 3),
        np.stack([b, c, d], axis=-1).reshape(-1, 3),
        np.stack([np.full(around, top), here, after], axis=-1),
        np.stack([np.full(around, bottom), last + after, last + here], axis=-1),
    ]
    vertices = np.concatenate([inner, [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]])
    return radius * vertices, np.concatenate(faces).astype(np.int32)


def together(*surfaces: Surface) -> Surface:
    """Several surfaces as one, with equal points merged."""
    points, faces = beside(*surfaces)
    merged, index = np.unique(np.round(points, 9), axis=0, return_inverse=True)
    return merged, index.reshape(-1)[faces].astype(np.int32)


def sheet() -> Surface:
    """The lower side of the block."""
    vertices, faces = block()
    low = vertices[:, 2] == vertices[:, 2].min()
    return compact_surface(vertices, faces[low[faces].all(axis=1)])


def cloth() -> Surface:
    """A sheet above the block that is bent, so that its edge is no flat hole."""
    vertices, faces = sheet()
    x = vertices[:, 0] - vertices[:, 0].mean()
    return np.stack([vertices[:, 0], vertices[:, 1], 1.05 + x**2], axis=1), faces


def with_fin() -> Surface:
    """The block with a face that stands on one of its edges."""
    vertices, faces = block()
    fin = [[faces[0, 0], faces[0, 1], len(vertices)]]
    out = 2.0 * vertices[faces[0]].mean(axis=0) - vertices.mean(axis=0)
    return np.concatenate([vertices, [out]]), np.concatenate([faces, fin]).astype(np.int32)


TRIANGLE = np.eye(3), np.array([[0, 1, 2]], np.int32)
LINE = np.outer([0.0, 1.0, 2.0], [1.0, 1.0, 0.0]), TRIANGLE[1]
NO_VOLUME = "encloses no volume"

ODD = {
    "nothing odd": Odd(surface=block(), volume=2.0),
    "one triangle": Odd(surface=TRIANGLE, faults=("flat",), said=NO_VOLUME),
    "a triangle that is a line": Odd(
        surface=LINE, faults=("flat",), others=("slivers",), said=NO_VOLUME
    ),
    "a sheet": Odd(surface=sheet(), faults=("flat",), said=NO_VOLUME),
    "a sheet with two sides": Odd(
        surface=together(sheet(), inside_out(sheet())),
        faults=("duplicate faces", "flat"),
        said=NO_VOLUME,
    ),
    "parts apart": Odd(
        surface=together(block(), block(y=3.0)),
        faults=("components",),
        said="has 2 separate parts (the second largest: 320 faces",
    ),
    "dust beside it": Odd(
        surface=together(block(), block(x=2.2, scale=0.02)),
        others=("components",),
        volume=2.0,
        said="1 small part of the surface is apart",
    ),
    "cloth beside it": Odd(
        surface=together(block(), cloth()),
        faults=("holes",),
        others=("components",),
        volume=2.0,
        said="open parts of the surface, such as cloth or hair, are left out of the tets",
    ),
    "parts that overlap": Odd(
        surface=together(block(), block(x=1.1, y=0.31, z=0.27)),
        faults=("self-intersections",),
        others=("components",),
    ),
    "a wall inside": Odd(
        surface=together(block(), block(y=1.0)),
        faults=("duplicate faces",),
        volume=4.0,
        said="dropped 128 faces",
    ),
    "two blocks that meet in a wall": Odd(
        surface=beside(block(), block(y=1.0)),
        faults=("duplicate faces",),
        others=("seams",),
        volume=4.0,
        said="dropped 128 faces",
    ),
    "a copy of itself": Odd(
        surface=beside(block(), block()),
        faults=("duplicate faces",),
        others=("seams",),
        volume=2.0,
        said="dropped 320 faces",
    ),
    "an edge of four faces": Odd(
        surface=together(block(), block(y=1.0, z=1.0)), others=("non-manifold edges",)
    ),
    "an edge of three faces": Odd(surface=with_fin(), faults=("holes", "non-manifold edges")),
    "a thin shell": Odd(
        surface=together(ball(16), inside_out(ball(16, 0.98))), others=("components", "thin")
    ),
    "as large as 1e6": Odd(surface=block(scale=1e6), volume=2e18),
    "as small as 1e-6": Odd(surface=block(scale=1e-6), volume=2e-18),
    "far away, at 1e6": Odd(surface=block(x=1e6, y=-1e6), others=("place",), volume=2.0),
}
