"""What messages between a page and its server are made of."""

from __future__ import annotations

from dataclasses import dataclass

Vector = tuple[float, float, float]
Matrix = tuple[float, float, float, float, float, float, float, float, float]


@dataclass(frozen=True, kw_only=True)
class HandleChoice:
    """A handle as the page chose it, or as a problem file has it.

    name : unique among the handles
    vertices : indices among all vertices of the packed mesh, also those inside
    moving : whether it moves while sampling; one handle at least does not
    translation, angle : its own bounds of the sampled motions; null: the common ones
    """

    name: str
    vertices: tuple[int, ...]
    moving: bool = True
    translation: Vector | None = None
    angle: Vector | None = None


@dataclass(frozen=True, kw_only=True)
class PartChoice:
    """A part of the body that is stiffer or softer.

    name : unique among the parts
    vertices : as those of a handle; tets with three of their corners among them are in the part
    factor : of all moduli there, 0.0001 to 10000; of parts that overlap the later one counts
    """

    name: str
    vertices: tuple[int, ...]
    factor: float


@dataclass(frozen=True, kw_only=True)
class MaterialChoice:
    """A material that can be computed with.

    kind, title : its name in files and messages, and for the reader
    has_poisson : whether Poisson's ratio changes anything
    """

    kind: str
    title: str
    has_poisson: bool


@dataclass(frozen=True, kw_only=True)
class HandleMotion:
    """Where a handle is: a rigid motion about its centre at rest.

    rotation : row by row
    """

    rotation: Matrix
    translation: Vector
