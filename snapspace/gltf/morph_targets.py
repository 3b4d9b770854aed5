"""MorphTargets: shapes of a surface as weighted sums of displacements."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import as_numbers, require_count
from ..blas import single_threaded_blas
from ..mesh import vertex_normals
from ..reduction import ReducedModel, check_model
from .drawn_surface import DrawnSurface, drawn_surface

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class MorphTargets:
    """The surfaces base + sum_i weights_i targets_i, as glTF draws them.

    base : (s, 3) vertices for zero weights
    targets : (m, s, 3) displacements
    normals : (g, 3) unit normals of the base, one per vertex and several at sharp edges of the
    user's file; normal_targets : (m, g, 3) their changes, which are exact to first order only:
    viewers add them up and normalise
    weights : (k, m) weights of k shapes
    error : largest distance between a vertex of these shapes and its position by the targets, in
    the mesh's length unit; zero if the targets are exact
    drawn : the points, normals and materials of the surface
    """

    base: FloatArray
    targets: FloatArray
    normals: FloatArray
    normal_targets: FloatArray
    weights: FloatArray
    error: float
    drawn: DrawnSurface

    def __repr__(self) -> str:
        targets, vertices = self.targets.shape[:2]
        sizes = f"{targets} targets, {vertices} vertices, {len(self.weights)} shapes"
        return f"MorphTargets({sizes}, error {self.error:.3g})"


def mode_targets(model: ReducedModel, shapes: ArrayLike | None = None) -> MorphTargets:
    """All modes of a model as targets: exactly tau + U q on the surface.

    Parameters
    ----------
    model : ReducedModel
    shapes : array_like, (k, n, 3), optional
        Vertices of shapes in the subspace, whose coordinates become the weights. Default: none.

    Notes
    -----
    Changes of the normals are fitted to the training samples, or to the given shapes if there are
    more of them.
    """
    check_model(model, "mode_targets")
    surface, subspace = model.surface, model.subspace
    base = surface.vertices(subspace.tau.reshape(-1, 3))
    targets = np.array(
        [surface.vertices(mode.reshape(-1, 3)) for mode in np.ascontiguousarray(subspace.basis.T)]
    )
    weights = np.zeros((0, subspace.dimension))
    error = 0.0
    if shapes is not None:
        given = _given(shapes, "mode_targets")
        weights = subspace.coordinates(given.reshape(len(given), -1))
        error = _largest_distance(base, targets, weights, _on_surface(model, given))
    known = model.training_coordinates
    if len(weights) > len(known):
        known = weights
    drawn = drawn_surface(surface)
    normals, changes = _normals(base, targets, known, drawn)
    return MorphTargets(base, targets, normals, changes, weights, error, drawn)


def fitted_targets(model: ReducedModel, shapes: ArrayLike, *, count: int = 8) -> MorphTargets:
    """The best few targets for given shapes, by the least squares of all vertices.

    Parameters
    ----------
    model : ReducedModel
    shapes : array_like, (k, n, 3)
        Vertices of the shapes, such as the frames of a path.
    count : int, default 8
        Largest number of targets; many engines support only eight.

    Returns
    -------
    MorphTargets
        Targets with the shape tau as the base; fewer than `count` if fewer are exact.

    Raises
    ------
    ValueError
        For no shapes, or a count that is not positive.
    """
    check_model(model, "fitted_targets")
    given = _given(shapes, "fitted_targets")
    count = require_count("fitted_targets", "count", count)
    if len(given) == 0 or count < 1:
        raise ValueError(
            f"fitted_targets: needs shapes and at least one target, not {len(given)} shapes and "
            f"{count} targets"
        )
    surface = model.surface
    base = surface.vertices(model.subspace.tau.reshape(-1, 3))
    seen = _on_surface(model, given)
    targets, weights = _leading((seen - base).reshape(len(given), -1), count)
    targets = targets.reshape(len(targets), *base.shape)
    error = _largest_distance(base, targets, weights, seen)
    drawn = drawn_surface(surface)
    normals, changes = _normals(base, targets, weights, drawn)
    return MorphTargets(base, targets, normals, changes, weights, error, drawn)


def still_shape(model: ReducedModel, shape: ArrayLike) -> MorphTargets:
    """One shape (n, 3) without any targets; ValueError for a shape of another mesh."""
    check_model(model, "still_shape")
    base = model.surface.vertices(shape)
    drawn = drawn_surface(model.surface)
    none = np.zeros((0, *base.shape))
    normals, changes = _normals(base, none, np.zeros((0, 0)), drawn)
    return MorphTargets(base, none, normals, changes, np.zeros((0, 0)), 0.0, drawn)


def unit_normals(vertices: FloatArray, faces: NDArray[np.int32]) -> FloatArray:
    """`vertex_normals` (s, 3), but (0, 0, 1) where there is none: glTF has no zero normals."""
    normals = vertex_normals(vertices, faces)
    normals[~normals.any(axis=1)] = (0.0, 0.0, 1.0)
    return normals


def _given(shapes: ArrayLike, who: str) -> FloatArray:
    """Shapes (k, n, 3) or (k, 3n); ValueError for a single one, or for anything but numbers."""
    given = as_numbers(who, "shapes", shapes)
    if given.ndim not in (2, 3):
        raise ValueError(f"{who}: shapes have shape {given.shape}, but must be (k, n, 3)")
    return given


def _on_surface(model: ReducedModel, shapes: FloatArray) -> FloatArray:
    return np.array([model.surface.vertices(shape) for shape in shapes])


@single_threaded_blas
def _leading(rows: FloatArray, count: int) -> tuple[FloatArray, FloatArray]:
    """Directions (m, 3s), at most `count`, and the rows' weights (k, m), each at most one."""
    values, vectors = np.linalg.eigh(rows @ rows.T)
    order = np.argsort(values)[::-1][:count]
    order = order[values[order] > 1e-14 * max(values.max(), 0.0)]
    weights = vectors[:, order] * np.sqrt(values[order])
    largest = np.abs(weights).max(axis=0, initial=0.0)
    weights, lengths = weights / largest, largest
    directions = (vectors[:, order] / np.sqrt(values[order])).T @ rows
    return directions * lengths[:, None], weights


@single_threaded_blas
def _normals(
    base: FloatArray, targets: FloatArray, weights: FloatArray, drawn: DrawnSurface
) -> tuple[FloatArray, FloatArray]:
    """Normals of the base and their changes per target, fitted to the shapes of some weights."""
    vertex, faces = drawn.normal_vertex, drawn.normal_faces
    normals = unit_normals(base[vertex], faces)
    if len(weights) == 0:
        return normals, np.zeros((len(targets), *normals.shape))
    flat = targets.reshape(len(targets), base.size)
    shapes = ((base + (w @ flat).reshape(-1, 3))[vertex] for w in weights)
    changes = np.array([unit_normals(shape, faces) - normals for shape in shapes])
    fitted = np.linalg.pinv(weights, rcond=1e-6) @ changes.reshape(len(weights), normals.size)
    return normals, fitted.reshape(len(targets), *normals.shape)


def _largest_distance(
    base: FloatArray, targets: FloatArray, weights: FloatArray, shapes: FloatArray
) -> float:
    flat = targets.reshape(len(targets), base.size)
    most = 0.0
    for w, shape in zip(weights, shapes, strict=True):
        miss = base + (w @ flat).reshape(-1, 3) - shape
        most = max(most, float(np.sqrt((miss**2).sum(axis=1)).max()))
    return most
