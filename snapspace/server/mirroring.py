"""Mirroring: the mirror plane of a body, and mirror images of handles that a page chose."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..mesh import MirrorPlane
from ..page.mirror import mirror_about
from ..reduction import PosingModel
from ..symmetry import (
    NotSymmetricError,
    checked_image,
    mirror_plane,
    mirrored_name,
    mirrored_region,
)
from . import messages
from .body import Body
from .selection import as_vector

AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


class Mirroring:
    """Mirrors the handles of one body across a plane from its file, the page or its shape.

    Parameters
    ----------
    body : Body
    """

    def __init__(self, body: Body) -> None:
        mesh, surface = body.mesh, body.surface
        self._vertices = mesh.vertices if surface is None else surface.vertices(mesh.vertices)
        self._faces = mesh.surface if surface is None else surface.faces
        self._given = body.mirror
        self._found: dict[str | None, MirrorPlane] = {}
        #: The plane that the page or the body's file gives; None: that of the shape.
        self.plane: MirrorPlane | None = body.mirror
        self._about: tuple[object, dict[str, Any]] | None = None  # for the last handles and plane

    def mirrored(self, order: messages.Mirror) -> messages.Mirrored:
        """The mirror image of a handle; the plane becomes that of the body.

        ValueError for an unknown axis or vertex, a shape that is not symmetric if no axis is given,
        and a handle that is its own mirror image.
        """
        plane = self._plane(order.axis)
        handle = order.handle
        region = np.array(handle.vertices, np.int64)
        wrong = region[(region < 0) | (region >= len(self._vertices))]
        if not region.size or wrong.size:
            what = f"vertex index {wrong[0]}" if wrong.size else "no vertices"
            raise ValueError(
                f"handle '{handle.name}' has {what}, but there are {len(self._vertices)} vertices"
            )
        image = mirrored_region(self._vertices, self._faces, region, plane)
        own = checked_image(handle.name, region, image)
        self.plane = self._given if order.axis is None else plane
        shift, angle = handle.translation, handle.angle
        return messages.Mirrored(
            request=order.request,
            handle=replace(
                handle,
                name=mirrored_name(handle.name),
                vertices=tuple(own.tolist()),
                translation=None if shift is None else as_vector(plane.bounds(shift)),
                angle=None if angle is None else as_vector(np.minimum(plane.bounds(angle), np.pi)),
            ),
            normal=as_vector(np.array(plane.normal)),
            point=as_vector(np.array(plane.point)),
            deviation=plane.deviation,
        )

    def about(self, model: PosingModel) -> dict[str, Any]:
        """`mirror_about` of a model of the body; found once for the same handles and plane."""
        key = model.problem.fingerprint, self.plane
        if self._about is None or self._about[0] != key:
            self._about = key, mirror_about(model, self.plane or self._found.get(None))
        return self._about[1]

    def _plane(self, axis: str | None) -> MirrorPlane:
        if axis is None and self._given is not None:
            return self._given
        if axis is not None and axis not in AXES:
            raise ValueError(f"mirror: axis is '{axis}', but it must be one of {', '.join(AXES)}")
        if axis not in self._found:
            normal = None if axis is None else AXES[axis]
            try:
                self._found[axis] = mirror_plane(self._vertices, self._faces, normal=normal)
            except NotSymmetricError as error:
                raise ValueError(f"{error.finding}. Choose the axis across the plane.") from None
        return self._found[axis]
