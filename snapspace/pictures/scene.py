"""Meshes ready for the studio: checked, free of unused vertices, of unit size at the origin."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .camera import Camera, horizontal_axes
from .checks import check_finite, checked_colors, checked_faces, checked_vertices
from .color import to_linear
from .exposure import Exposure, expose
from .ground import Ground
from .lights import studio

#: Largest number of shapes that are drawn at the same time: 640 x 480 pixels take 0.14 GB each.
AT_ONCE = 4


@dataclass(frozen=True)
class Scene:
    """Shapes of one mesh in a common frame of length 1, which all light constants refer to."""

    shapes: tuple[NDArray[np.float64], ...]  # (n, 3) each
    faces: NDArray[np.int32]
    albedo: tuple[NDArray[np.float64], ...]  # (n, 3) linear light each

    @classmethod
    def of(cls, shapes: Sequence[Any], faces: Any, colors: Sequence[Any], *, who: str) -> Scene:
        """The scene of some shapes, checked with their colours: one entry of `colors` per shape."""
        given = [checked_vertices(shape, who=who) for shape in shapes]
        count = len(given[0])
        for number, shape in enumerate(given):
            if len(shape) != count:
                raise ValueError(
                    f"{who}: shape {number} has {len(shape)} vertices, but shape 0 has {count}; "
                    "all must be shapes of one mesh"
                )
        checked = checked_faces(faces, count, who=who)
        used, flat = np.unique(checked, return_inverse=True)
        for shape in given:
            check_finite(shape, used.astype(np.intp), who=who)
        albedo = tuple(to_linear(checked_colors(color, count, who=who)[used]) for color in colors)
        kept = [shape[used] for shape in given]
        low = np.min([shape.min(axis=0) for shape in kept], axis=0)
        high = np.max([shape.max(axis=0) for shape in kept], axis=0)
        with np.errstate(over="ignore"):
            size = float(np.linalg.norm(high - low))
        if not 0.0 < size < np.inf:
            raise ValueError(f"{who}: the mesh has size {size}; there is nothing to draw")
        unit = tuple((shape - 0.5 * (low + high)) / size for shape in kept)
        return cls(unit, flat.reshape(-1, 3).astype(np.int32), albedo)

    def exposures(
        self,
        *,
        size: tuple[int, int],
        azimuth: float,
        elevation: float,
        up: str,
        field_of_view: float,
        margin: float,
        ground: bool,
        samples: int,
    ) -> Iterator[Exposure]:
        """Each shape with the same camera, light and ground level, in order.

        A few are made at the same time: NumPy releases the interpreter's lock, so a film of Spot
        (12k vertices) takes two thirds of the time on two cores.
        """
        points = np.concatenate(self.shapes)
        camera = Camera.framing(
            points,
            width=size[0],
            height=size[1],
            azimuth=azimuth,
            elevation=elevation,
            up=up,
            field_of_view=field_of_view,
            margin=margin,
        )
        light = studio(azimuth, up)
        level = float((points @ horizontal_axes(up)[2]).min())
        # The ground covers about three times the frame: nodes every ten pixels or so.
        nodes = int(np.clip(max(size) * 0.27, 48, 480))

        def exposed(number: int) -> Exposure:
            shape, albedo = self.shapes[number], self.albedo[number]
            below = Ground.below(shape, up=up, level=level, nodes=nodes) if ground else None
            return expose(shape, self.faces, albedo, camera, light, below, samples=samples)

        workers = min(AT_ONCE, os.cpu_count() or 1)
        with ThreadPoolExecutor(max_workers=workers) as pool:
            waiting: deque[Future[Exposure]] = deque()
            try:
                for number in range(len(self.shapes)):
                    waiting.append(pool.submit(exposed, number))
                    if len(waiting) > workers:
                        yield waiting.popleft().result()
                while waiting:
                    yield waiting.popleft().result()
            finally:  # after Ctrl-C nothing more is drawn
                for future in waiting:
                    future.cancel()
