"""A still picture of a surface."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .backdrop import backdrop, to_bytes
from .checks import checked_samples, checked_size
from .scene import Scene


def render(
    vertices: Any,
    faces: Any,
    *,
    size: tuple[int, int] = (1200, 900),
    azimuth: float = -60.0,
    elevation: float = 15.0,
    up: str = "z",
    colors: Any = None,
    ground: bool = True,
    background: Sequence[float] | None = None,
    field_of_view: float = 24.0,
    margin: float = 0.10,
    samples: int = 3,
) -> NDArray[np.uint8]:
    """Picture of a triangle mesh in a photographer's studio; needs no display and no GPU.

    The camera frames the mesh; key, fill and rim light turn with it. The same input gives the same
    bytes.

    Parameters
    ----------
    vertices : array_like, (n, 3)
        Positions. Vertices without a face are ignored (they may even be NaN).
    faces : array_like of int, (f, 3)
        Triangles, outward.
    size : (int, int)
        Width and height in pixels.
    azimuth, elevation : float
        Direction from the shape to the eye in degrees: azimuth 0 looks from +x and 90 from +y
        when `up` is "z", from +z and +x when it is "y", from +y and +z when it is "x".
    up : {"x", "y", "z"}
        Axis that points upwards.
    colors : array_like, (3,) or (n, 3), optional
        sRGB in 0..1, of the whole mesh or per vertex; see `tint` and `colormap`. Default: clay.
    ground : bool
        Whether a ground at the lowest vertex catches the shadow and returns light.
    background : (3,), optional
        One sRGB colour in 0..1, for instance white for print. Default: a light studio gradient.
    field_of_view : float
        Angle of the shorter side in degrees.
    margin : float
        Empty border around the mesh as a fraction of the half width and half height.
    samples : int
        Coverage samples per pixel and direction, 1 to 8.

    Returns
    -------
    ndarray, (height, width, 3) uint8
        sRGB. Without ground, pixels beside the silhouette are exactly the background.

    Raises
    ------
    ValueError
        If the mesh is empty, is a single point, is not finite or has indices out of range, or an
        option is out of range.

    Cost: about 5 s for 50k triangles at the default size on one core, most of it in the soft
    shadows of 156 light directions.
    """
    width, height = checked_size(size, who="render")
    scene = Scene.of([vertices], faces, [colors], who="render")
    paper = backdrop(width, height, background)
    (exposure,) = scene.exposures(
        size=(width, height),
        azimuth=azimuth,
        elevation=elevation,
        up=up,
        field_of_view=field_of_view,
        margin=margin,
        ground=ground,
        samples=checked_samples(samples, who="render"),
    )
    return to_bytes(exposure.over(paper * exposure.shadow()[:, :, None]))
