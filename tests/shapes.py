"""Generated meshes, deformations and problems that several test packages share."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from snapspace.generators import bar, cylinder
from snapspace.material import StVK
from snapspace.mesh import (
    EmbeddedSurface,
    TetMesh,
    compact_surface,
    embed_surface,
    mass_matrix,
)
from snapspace.problem import HandleBox, Handles, InterpolationProblem, Poses, PosingProblem
from snapspace.subspace import AffineSubspace, pca

FloatArray = NDArray[np.float64]

CORNER_TET = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)


def one_tet(vertices: FloatArray = CORNER_TET) -> TetMesh:
    return TetMesh(vertices, [[0, 1, 2, 3]])


def irregular_bar(nx: int = 3, ny: int = 2, nz: int = 2, *, seed: int = 5) -> TetMesh:
    """A bar without symmetries, whose coordinates use all digits of a double."""
    regular = bar(nx, ny, nz, length=0.5 * nx, width=0.5 * ny, height=0.5 * nz)
    noise = np.random.default_rng(seed).uniform(-0.06, 0.06, regular.vertices.shape)
    return TetMesh(regular.vertices + noise, regular.tets)


def flat_cylinder() -> TetMesh:
    """A cylinder of flat tets, about forty times as long as high, away from the origin."""
    mesh = cylinder(2, 4, length=0.05, radius=1.0)
    return TetMesh(mesh.vertices + np.array([3.0, -2.0, 1.0]), mesh.tets)


def deformed(mesh: TetMesh, size: float, *, seed: int = 1) -> FloatArray:
    """Positions (3n,) with every coordinate moved at random by up to `size`."""
    rng = np.random.default_rng(seed)
    return mesh.vertices.reshape(-1) + rng.uniform(-size, size, mesh.vertices.size)


def random_rotation(seed: int = 2) -> FloatArray:
    return Rotation.from_quat(np.random.default_rng(seed).normal(size=4)).as_matrix()


def moved(x: FloatArray, rotation: FloatArray, shift: FloatArray | float = 0.0) -> FloatArray:
    """R v + t for every vertex v of a shape vector."""
    return (x.reshape(-1, 3) @ rotation.T + shift).reshape(-1)


def bar_problem(mesh: TetMesh | None = None, *, stiffness: float = 100.0) -> PosingProblem:
    """A bar with the handles foot and head at its ends and belly in the middle."""
    mesh = mesh or irregular_bar(8, 2, 2)
    x = (mesh.vertices[:, 0] - mesh.vertices[:, 0].min()) / np.ptp(mesh.vertices[:, 0])
    belly = (np.abs(x - 0.5) < 0.1) & (mesh.vertices[:, 2] < mesh.vertices[:, 2].mean())
    return PosingProblem(
        mesh,
        Handles([x < 0.1, x > 0.9, belly], names=["foot", "head", "belly"]),
        domain=HandleBox(translation=0.8, angle=0.8),
        material=StVK(lam=1.5, mu=0.7),
        stiffness=stiffness,
    )


def slender_problem() -> PosingProblem:
    """A bar forty times as long as it is thick, between its ends: it bends easily."""
    mesh = bar(60, 2, 2, length=40.0)
    x = mesh.vertices[:, 0]
    domain = HandleBox(translation=4.0, angle=np.pi / 4)
    return PosingProblem(mesh, Handles([x < 0.4, x > 39.6]), domain=domain)


def random_subspace(
    mesh: TetMesh, dimension: int, *, tau: FloatArray | None = None, seed: int = 3
) -> AffineSubspace:
    """A subspace of random directions, attached to the rest shape or to another shape tau."""
    tau = mesh.vertices.reshape(-1) if tau is None else tau
    directions = np.random.default_rng(seed).normal(size=(tau.size, dimension)).T
    return pca(tau + directions, tau, mass_matrix(mesh), dimension=dimension)


def bent(mesh: TetMesh, angle: float, *, twist: float = 0.0) -> FloatArray:
    """Vertices (n, 3) of a bar bent to an arc in the x-y plane and twisted about its middle line.

    Both angles, in radians, are reached at the far end. The middle line keeps its length.
    """
    lower, upper = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    x, y, z = (mesh.vertices - [lower[0], *(0.5 * (lower + upper)[1:])]).T
    length = upper[0] - lower[0]
    turn, roll = angle * x / length, twist * x / length
    y, z = np.cos(roll) * y - np.sin(roll) * z, np.sin(roll) * y + np.cos(roll) * z
    # sin(a)/a and (1 - cos(a))/a, which stay finite for a straight bar
    along, across = np.sinc(turn / np.pi), np.sin(turn / 2) * np.sinc(turn / 2 / np.pi)
    return np.stack([x * along - y * np.sin(turn), x * across + y * np.cos(turn), z], axis=1)


def bar_poses(mesh: TetMesh | None = None) -> Poses:
    """A bar at rest, bent, and bent the other way and twisted, each in its own frame."""
    mesh = mesh or irregular_bar(8, 2, 2)
    shapes = [mesh.vertices, bent(mesh, 1.2), bent(mesh, -0.7, twist=1.0)]
    for k in (1, 2):
        motion = random_rotation(k), np.array([3.0 * k, -2.0, 1.0])
        shapes[k] = moved(shapes[k].reshape(-1), *motion).reshape(-1, 3)
    return Poses(np.stack(shapes), mesh.tets, names=["rest", "bent", "twisted"])


def interpolation_problem(**options: float) -> InterpolationProblem:
    """The problem of blending a bar's poses, in a material whose two moduli differ."""
    return InterpolationProblem(bar_poses(), material=StVK(lam=1.5, mu=0.7), **options)


def symmetric_bar() -> TetMesh:
    """A bar that the mirror y -> -y maps onto itself, vertex to vertex and tet to tet."""
    half = bar(8, 1, 2, width=0.5)
    tets, vertices = half.tets, half.vertices * [1.0, -1.0, 1.0]
    inner = half.vertices[:, 1] == 0
    twin = np.where(inner, np.arange(len(inner)), len(inner) - 1 + np.cumsum(~inner))
    both = np.concatenate([half.vertices, vertices[~inner]])
    return TetMesh(both, np.concatenate([tets, twin[tets][:, [1, 0, 2, 3]]]))


def mirror_image(mesh: TetMesh) -> NDArray[np.intp]:
    """For each vertex of `symmetric_bar`, the vertex that the mirror y -> -y puts in its place."""
    index = {tuple(vertex): i for i, vertex in enumerate(mesh.vertices.tolist())}
    return np.array([index[x, -y, z] for x, y, z in mesh.vertices.tolist()])


def surface_around(mesh: TetMesh) -> EmbeddedSurface:
    """A box around a bar, a hundredth larger and with a finer surface, embedded in the bar."""
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    box = bar(20, 5, 5, length=1.0, width=1.0, height=1.0)
    vertices, faces = compact_surface(box.vertices, box.surface)
    unit = (vertices - vertices.min(axis=0)) / np.ptp(vertices, axis=0)
    larger = low + (high - low) * (1.01 * unit - 0.005)
    return embed_surface(larger, faces, mesh, farthest=0.1)
