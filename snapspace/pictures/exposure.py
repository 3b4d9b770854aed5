"""One exposure: a mesh in the studio, before it is put on a background."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .backdrop import tone
from .camera import Camera
from .ground import Ground
from .lights import Studio
from .shade import shade
from .surface import seen_surface


@dataclass(frozen=True)
class Exposure:
    """A shape's light, and the part of the background that shape and shadow leave visible."""

    light: NDArray[np.float64]  # (h, w, 3) linear, of the covered part of each pixel
    uncovered: NDArray[np.float64]  # (h, w) part of each pixel that the shape leaves free
    camera: Camera
    ground: Ground | None

    def shadow(self, *, around: tuple[int, int] = (0, 0)) -> NDArray[np.float64]:
        """Brightness of the ground relative to open ground, 1 where there is no ground.

        `around` are pixels to the left and right, and above and below, beyond the frame of the
        camera; the image is larger by twice as many.
        """
        wide = self.camera.extended(*around)
        if self.ground is None:
            return np.ones((wide.height, wide.width))
        return self.ground.in_picture(wide)

    def over(self, background: NDArray[np.float64]) -> NDArray[np.float64]:
        """Linear light (h, w, 3) of the shape before a background (h, w, 3)."""
        return self.light + self.uncovered[:, :, None] * background


def expose(
    vertices: NDArray[np.float64],
    faces: NDArray[np.int32],
    albedo: NDArray[np.float64],
    camera: Camera,
    studio: Studio,
    ground: Ground | None,
    *,
    samples: int,
) -> Exposure:
    """Light of a mesh whose vertices are all used and lie within about a unit of the origin.

    Highlights are compressed before the samples of a pixel are averaged, so that the border of a
    bright part stays as smooth as any other.
    """
    seen = seen_surface(vertices, faces, albedo, camera, samples=samples)
    longer = max(camera.width, camera.height)
    radiance, ground = shade(seen.points, vertices, faces, studio, ground, pixels=longer)

    pixels = camera.width * camera.height
    light: NDArray[np.float64] = np.column_stack(
        [
            np.bincount(seen.pixel, weights=seen.share * axis, minlength=pixels)
            for axis in tone(radiance)
        ]
    )
    covered = np.bincount(seen.pixel, weights=seen.share, minlength=pixels)
    shape = (camera.height, camera.width, 3)
    uncovered = np.clip(1.0 - covered, 0.0, 1.0).reshape(shape[:2])
    return Exposure(light.reshape(shape), uncovered, camera, ground)
