"""Models from the arrays of a mesh. Nothing here uses bpy, so any thread may run it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

import snapspace as ss
from snapspace.extras import MissingExtraError
from snapspace.stopping import check_stop


@dataclass(frozen=True)
class Solid:
    """A surface and the tets inside it."""

    mesh: ss.TetMesh
    surface: ss.EmbeddedSurface


@dataclass(frozen=True)
class Motions:
    """How far handles move: lengths per axis as a share of the diagonal, and angles in radians."""

    translation: float
    angle: float


def solid_of(points: np.ndarray, faces: np.ndarray, *, edge_length: float) -> Solid:
    """Quick tets inside a surface; fTetWild's where it is too thin or open, if that is installed.

    ValueError if it cannot be filled.
    """
    try:
        mesh = ss.stuff_surface(points, faces, edge_length=edge_length, mend=True)
    except ValueError as reason:
        check_stop()
        try:
            mesh = ss.fill_surface(points, faces, edge_length=edge_length, mend=True)
        except MissingExtraError:  # the extension comes without fTetWild
            mesh = _with_closed_gaps(points, faces, edge_length, reason)
    return Solid(mesh, ss.embed_surface(points, faces, mesh, farthest=1.0))


def _with_closed_gaps(
    points: np.ndarray, faces: np.ndarray, edge_length: float, reason: ValueError
) -> ss.TetMesh:
    """Quick tets that may close any number of narrow gaps; raises `reason` if there are none."""
    every = len(faces)
    try:
        return ss.stuff_surface(
            points, faces, edge_length=edge_length, mend=True, most_closed=every
        )
    except ValueError:
        raise reason from None


def posing_growths(
    solid: Solid,
    handles: Mapping[str, np.ndarray],
    motions: Motions,
    *,
    target_error: float,
) -> Iterator[ss.Growth]:
    """Better and better models of handles; ValueError for fewer than two handles."""
    if len(handles) < 2:
        raise ValueError(
            f"the mesh has {len(handles)} vertex groups with vertices that have a weight of one "
            "half or more; at least two are needed, and the first one stays at rest"
        )
    on_surface = ss.Handles(list(handles.values()), names=list(handles))
    inside = ss.handles_in_tets(on_surface, solid.mesh, solid.surface)
    box = ss.HandleBox(translation=motions.translation * solid.mesh.diagonal, angle=motions.angle)
    problem = ss.PosingProblem(solid.mesh, inside, domain=box)
    yield from ss.growing_models(problem, surface=solid.surface, target_error=target_error)


def blending_growths(
    solid: Solid, poses: Mapping[str, np.ndarray], *, target_error: float
) -> Iterator[ss.Growth]:
    """Better and better models of the rest shape and poses; ValueError for no pose."""
    if not poses:
        raise ValueError("the mesh has no shape keys besides its basis; each of them is a pose")
    fits = ss.fit_poses(
        solid.mesh, solid.surface, np.stack(list(poses.values())), names=list(poses)
    )
    shapes = np.concatenate([solid.mesh.vertices[None], fits.shapes])
    given = ss.Poses(shapes, solid.mesh.tets, names=["Basis", *poses])
    problem = ss.InterpolationProblem(given)
    yield from ss.growing_models(problem, surface=solid.surface, target_error=target_error)


def weights_of(values: Mapping[str, float]) -> np.ndarray:
    """Weights of the rest shape and the poses for the values of shape keys.

    Values below zero count as zero. If the sum of the values is above one, they are divided by it.
    """
    given = np.maximum(list(values.values()), 0.0)
    given = given / max(given.sum(), 1.0)
    return np.concatenate([[1.0 - given.sum()], given])
