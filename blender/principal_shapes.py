"""The fewest shapes whose weighted sums are a film within a tolerance. Nothing here uses bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class PrincipalShapes:
    """A film as weighted sums of shapes.

    shapes : (k, s, 3) displacements from rest
    values : (f, k), between -1 and 1; frame i is the sum of values[i, j] shapes[j]
    error : largest distance of a vertex from the film
    """

    shapes: np.ndarray
    values: np.ndarray
    error: float


def principal_shapes(film: np.ndarray, *, tolerance: float, most: int) -> PrincipalShapes:
    """Principal components of a film's displacements, as few as the tolerance allows.

    Parameters
    ----------
    film : (f, s, 3)
        Displacements from rest in every frame.
    tolerance : float
        Largest distance of a vertex from the film.
    most : int
        Largest number of shapes, even if the tolerance needs more.
    """
    rows = film.reshape(len(film), -1)
    # the Gram matrix is small: a film has fewer frames than a mesh has vertices
    energies, vectors = np.linalg.eigh(rows @ rows.T)
    order = np.argsort(energies)[::-1]
    rank = int(np.count_nonzero(energies > 1e-14 * max(energies.max(), 0.0)))
    left = film.copy()
    shapes: list[np.ndarray] = []
    values: list[np.ndarray] = []

    def error() -> float:
        return float(np.sqrt((left**2).sum(axis=2).max(initial=0.0)))

    for one in order[: min(rank, most)]:
        if error() <= tolerance:
            break
        direction = vectors[:, one]
        largest = np.abs(direction).max()
        shape = (direction @ rows * largest).reshape(film.shape[1:])
        value = direction / largest
        shapes.append(shape)
        values.append(value)
        left -= value[:, None, None] * shape
    count = len(shapes)
    return PrincipalShapes(
        np.array(shapes).reshape(count, *film.shape[1:]),
        np.array(values).reshape(count, len(film)).T,
        error(),
    )
