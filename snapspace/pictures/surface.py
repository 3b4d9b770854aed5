"""Where to shade: one point per pixel and piece of surface, for any number of samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .camera import Camera
from .normals import corner_normals, face_normals
from .rasterize import Raster, barycentric, rasterize

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class ShadingPoints:
    """Points on the seen surface; vectors are (3, k) so that each axis is contiguous."""

    position: Floats  # (3, k)
    normal: Floats  # (3, k) unit, towards the eye's side
    view: Floats  # (3, k) unit, towards the eye
    albedo: Floats  # (3, k) linear light


@dataclass(frozen=True)
class SeenSurface:
    """Shading points, with the pixel that each one belongs to and its share of that pixel."""

    points: ShadingPoints
    pixel: NDArray[np.int64]  # (k,) of the camera's image
    share: NDArray[np.float64]  # (k,) fraction of the pixel's area


def seen_surface(
    vertices: NDArray[np.float64],
    faces: NDArray[np.int32],
    albedo: NDArray[np.float64],
    camera: Camera,
    *,
    samples: int,
) -> SeenSurface:
    """The surface a camera sees, with `samples` x `samples` coverage samples in each pixel.

    Coverage and depth are sampled finely, but shading varies slowly: the samples of a pixel that
    lie on the same piece of surface share one shading point, as in multisampling hardware.
    """
    fine = camera.scaled(samples)
    screen = fine.project(vertices)
    raster = rasterize(screen, faces, width=fine.width, height=fine.height)
    flat = face_normals(vertices, faces)
    pixel, leader = _pieces(raster, flat, samples)

    chosen, counts = np.unique(leader, return_counts=True)
    x, y = raster.centers()
    triangle = raster.triangle[chosen]
    weights = barycentric(screen, faces, triangle, x[chosen], y[chosen])
    # Affine weights on the screen become those on the triangle by dividing by the distances
    # of the corners; the depth is -1 / distance.
    weights *= screen[faces[triangle], 2]
    weights /= weights.sum(axis=1, keepdims=True)

    position = _blend(weights, vertices[faces[triangle]])
    normal = _blend(weights, corner_normals(vertices, faces)[triangle])
    view = camera.eye - position
    # Inner sides (of open or inverted surfaces) are shaded like outer sides.
    inner = np.einsum("ij,ij->i", flat[triangle], view) < 0.0
    normal[inner] *= -1.0
    points = ShadingPoints(
        position=_axes(position),
        normal=_axes(_unit(normal)),
        view=_axes(_unit(view)),
        albedo=_axes(_blend(weights, albedo[faces[triangle]])),
    )
    return SeenSurface(points, pixel[chosen], counts / samples**2)


def _pieces(
    raster: Raster, flat: NDArray[np.float64], samples: int
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Pixel of each sample, and the sample that stands for its piece of surface in that pixel."""
    row, column = np.divmod(raster.pixel, raster.width)
    pixel = (row // samples) * (raster.width // samples) + column // samples
    count = int(pixel.max()) + 1 if len(pixel) else 0
    order = np.arange(len(pixel))

    # The middle sample of each pixel leads if it is covered; any other if not.
    middle = (row % samples == samples // 2) & (column % samples == samples // 2)
    first = np.empty(count, dtype=np.int64)
    first[pixel] = order
    first[pixel[middle]] = order[middle]
    leader = first[pixel]

    normal = flat[raster.triangle]
    aligned = np.einsum("ij,ij->i", normal, normal[leader]) > 0.8
    near = np.abs(raster.depth / raster.depth[leader] - 1.0) < 0.01
    return pixel, np.where(aligned & near, leader, order)


def _blend(weights: NDArray[np.float64], corners: NDArray[np.float64]) -> NDArray[np.float64]:
    result: NDArray[np.float64] = np.einsum("ki,kij->kj", weights, corners)
    return result


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    result: NDArray[np.float64] = vectors / np.where(length == 0.0, 1.0, length)
    return result


def _axes(vectors: NDArray[np.float64]) -> Floats:
    return np.ascontiguousarray(vectors.T, dtype=np.float32)
