"""Problems and models of shells that several tests share."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from snapspace import (
    ARAP,
    HandleBox,
    Handles,
    InterpolationModel,
    InterpolationProblem,
    Material,
    PosingModel,
    PosingProblem,
    ShellMesh,
    StableNeoHookean,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)

from .sheets import grid, rolled, sheet

#: A radius of stars that is more than the edges of strips.
WIDE = 0.1


def strip(nx: int = 16, ny: int = 4, *, thickness: ArrayLike = 0.03) -> ShellMesh:
    """A strip of length two, bent to a quarter of a cylinder along its length, and irregular."""
    x, y = np.meshgrid(np.linspace(0, 2, nx + 1), np.linspace(0, 0.5, ny + 1), indexing="ij")
    noise = np.random.default_rng(3).uniform(-0.1, 0.1, size=(2, *x.shape)) / nx
    x, y = x + noise[0], y + noise[1]
    curvature = np.pi / 4
    points = np.stack([np.sin(curvature * x), curvature * y, 1 - np.cos(curvature * x)], -1)
    vertices = points.reshape(-1, 3) / curvature
    return ShellMesh(vertices, grid(nx, ny, alternating=True), thickness=thickness)


def shell_model(
    material: Material | None = None, *, varied: bool = False, radius: float = 0.0
) -> PosingModel:
    """A strip with handles at its ends and in the middle, of thick triangles, in 12 dimensions.

    material : default StableNeoHookean()
    varied : whether thickness and moduli differ from triangle to triangle; of the default or ARAP()
    radius : of the stars of that ARAP
    """
    mesh = strip(thickness=0.1)
    if varied:
        count = len(mesh.triangles)
        mesh = strip(thickness=np.linspace(0.08, 0.12, count))
        lam, mu = np.linspace(2, 1, count), np.linspace(1, 2, count)
        material = ARAP(mu=mu, radius=radius) if material else StableNeoHookean(lam=lam, mu=mu)
    along = _along(mesh)
    problem = PosingProblem(
        mesh,
        Handles([along < 0.1, along > 0.9, np.abs(along - 0.5) < 0.05]),
        domain=HandleBox(translation=0.1, angle=0.3),
        material=material or StableNeoHookean(),
    )
    snapshots = solve_snapshots(problem, sample(problem.domain, 40, seed=1), threads=1)
    return reduce(problem, snapshot_pca(snapshots, dimension=12), snapshots=snapshots)


def blended_strips(material: Material | None = None) -> InterpolationModel:
    """A strip, as-rigid-as-possible by default: bent, straight and wide, in 10 dimensions."""
    mesh = strip(12, 3)
    along, across = _along(mesh), mesh.vertices[:, 1]
    straight = np.stack([np.zeros_like(along), across, 2 * along], axis=1)
    shapes = mesh.vertices, straight, mesh.vertices * [1.2, 1.5, 0.9]
    problem = InterpolationProblem(
        [ShellMesh(shape, mesh.triangles, thickness=mesh.thickness) for shape in shapes],
        material=material or ARAP(),
    )
    snapshots = solve_snapshots(problem, sample(problem.domain, 24, seed=1), threads=1)
    return reduce(problem, snapshot_pca(snapshots, dimension=10), snapshots=snapshots)


def _along(mesh: ShellMesh) -> NDArray[np.float64]:
    """How far along the strip its vertices are, from 0 to 1."""
    return np.arctan2(mesh.vertices[:, 0], 4 / np.pi - mesh.vertices[:, 2]) / (np.pi / 2)


def strip_problem(
    mesh: ShellMesh | None = None,
    *,
    material: Material | None = None,
    translation: float = 0.3,
    angle: float = 0.6,
) -> PosingProblem:
    """A strip that is held at its beginning, and moved at its end; by default neo-Hookean."""
    mesh = mesh or strip()
    along = _along(mesh)
    return PosingProblem(
        mesh,
        Handles([along < 0.1, along > 0.9], names=["root", "tip"]),
        domain=HandleBox(translation=translation, angle=angle),
        material=material or StableNeoHookean(),
    )


def rolled_strips(
    *, turn: NDArray[np.float64] | None = None, **options: Any
) -> InterpolationProblem:
    """A strip, flat and rolled up in two directions, the whole turned."""
    flat = sheet(24, 8, thickness=0.1)
    shapes = [flat.vertices, rolled(flat.vertices, 1.5, 0.2), rolled(flat.vertices, -1.4, 1.2)]
    meshes = [
        ShellMesh(
            x.reshape(-1, 3) @ (np.eye(3) if turn is None else turn.T),
            flat.triangles,
            thickness=flat.thickness,
        )
        for x in shapes
    ]
    return InterpolationProblem(meshes, **options)
