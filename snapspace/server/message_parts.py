"""The parts of messages between a page and its server."""

from __future__ import annotations

from dataclasses import dataclass

Vector = tuple[float, float, float]
Matrix = tuple[float, float, float, float, float, float, float, float, float]


@dataclass(frozen=True, kw_only=True)
class HandleChoice:
    """A handle that the page chose, or that a problem file has.

    name : unique among the handles
    vertices : indices among all vertices of the packed mesh, including interior ones
    moving : whether it moves while sampling; at least one handle must not
    translation, angle : its own bounds of the sampled motions; null: the common bounds
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
    vertices : as for a handle; tets with at least three corners among them are in the part
    factor : multiplies all moduli there, 0.0001 to 10000; where parts overlap, the last one counts
    """

    name: str
    vertices: tuple[int, ...]
    factor: float


@dataclass(frozen=True, kw_only=True)
class MaterialChoice:
    """A material that can be computed with.

    kind, title : its name in files and messages, and its name for the reader
    has_poisson : whether Poisson's ratio changes anything
    makes_shells : whether shells can be made of it
    """

    kind: str
    title: str
    has_poisson: bool
    makes_shells: bool


@dataclass(frozen=True, kw_only=True)
class HandleMotion:
    """The motion of a handle: a rigid motion about its centre at rest.

    rotation : matrix, row by row
    """

    rotation: Matrix
    translation: Vector


@dataclass(frozen=True, kw_only=True)
class KeptPoint:
    """A point of the surface that the page has pulled and keeps.

    name : unique among the handles
    corners, shares : three vertices of the surface in the packed model, and their barycentric
        weights
    reach : displacement from rest to where it was pulled, per axis, in the frame of the first
        handle
    """

    name: str
    corners: tuple[int, ...]
    shares: Vector
    reach: Vector


@dataclass(frozen=True, kw_only=True)
class SurfaceFinding:
    """A property of a surface that its user should know, see `doctor.Finding`."""

    name: str
    fault: bool
    text: str
    meaning: str
    cure: str
