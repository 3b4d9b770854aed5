"""with_local_coordinates: neighbouring tets of a cubature share a few coordinates."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from ..blas import single_threaded_blas
from .blended_stars import BlendedStars
from .blended_sum import BlendedSum
from .clusters import clusters
from .cubature import Cubature
from .elastic_states import ElasticStates
from .elements import has_stars
from .local_rows import LocalRows

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]

#: Smallest number of entries, four megabytes: smaller rows stay in a core's caches.
FEWEST_NUMBERS = 1_000_000
#: Largest number of tets in a cluster. With 32, 48, 64 and 88 tets evaluations take 0.42, 0.42,
#: 0.46 and 0.46 of the time on the Armadillo, and errors are about the same
#: (docs/notes/local-coordinates.md).
CLUSTER = 48
#: What may be left out of a cluster: a motion of unit energy by this share; displacement gradients
#: at the states, and stresses there, in units of the root of the mean energy of all tets.
OF_MOTIONS, OF_GRADIENTS, OF_STRESSES = 0.1, 0.001, 0.01
#: Largest number of states that are used.
STATES = 200


Energy = TypeVar("Energy", bound=Cubature | BlendedSum)


@single_threaded_blas
def with_local_coordinates(
    energy: Energy,
    states: ElasticStates,
    *,
    fewest: int = FEWEST_NUMBERS,
    threads: int | None = None,
) -> Energy:
    """The same sum over tets, with local coordinates if its rows are large; otherwise unchanged.

    Tets near each other depend on few combinations of the modes. A cluster's local coordinates
    span, up to what may be left out, the displacement gradients and the stresses of its tets at the
    states, and all motions, measured by the compliance at tau. What is left out of displacement
    gradients is orthogonal to these stresses, so that it does no work at the states.

    Parameters
    ----------
    energy : Cubature, BlendedCubature or BlendedStars
        A trained sum. A sum over the stars of a blend stays as it is.
    states : ElasticStates
        States like those in use. At most 200 of them, evenly spread, are used.
    fewest : int, default 1,000,000
        Rows of fewer numbers stay as they are.
    threads : int, optional
        Default: all. The result is bitwise the same for any number.
    """
    if isinstance(energy, BlendedStars) or energy.rows.size < fewest:
        return energy
    parts = _Parts.of(energy, states)
    if parts is None:
        return energy
    groups = clusters(_centroids(states, energy.tets), CLUSTER)
    with ThreadPoolExecutor(max_workers=threads or os.cpu_count() or 1) as pool:
        found = list(pool.map(parts.local, groups))
    sizes = [(len(own), len(modes)) for own, (_, modes) in zip(groups, found, strict=True)]
    rows = LocalRows(
        np.array(sizes, np.int32),
        np.concatenate([maps.reshape(-1) for maps, _ in found]),
        np.concatenate([modes for _, modes in found]),
    )
    return cast(Energy, energy.in_clusters(np.concatenate(groups), rows)) if rows.saves else energy


@dataclass(frozen=True)
class _Parts:
    """What clusters are made from.

    scaled : (r, 9, d), rows of displacement gradients times the roots of the tets' stiffnesses
    scales : (r,), these roots
    root : (d, d), a root of the matrix that weights motions and states
    stresses : (n, r, 9), at the states, over the scales and in units of what may be left out
    """

    scaled: FloatArray
    scales: FloatArray
    root: FloatArray
    stresses: FloatArray

    @classmethod
    def of(cls, energy: Cubature | BlendedSum, states: ElasticStates) -> _Parts | None:
        """None if most tets have no stiffness, or none has a stress at any of the states."""
        some = states.chosen(np.unique(np.linspace(0, len(states) - 1, STATES).round().astype(int)))
        curvatures, stresses = some.curvatures(energy), some.sum_stresses(energy)
        stiffnesses = np.trace(curvatures.astype(np.float64), axis1=1, axis2=2) / 9.0
        typical = float(np.median(stiffnesses))
        if typical <= 0.0 or not stresses.any():
            return None
        # Tets that a pose compresses are far stiffer, and some may have negative curvature.
        scales = np.sqrt(np.maximum(stiffnesses, 1e-6 * typical))
        stresses = stresses / scales[:, None]
        unit = np.linalg.norm(stresses)
        gradients = some.coordinates / (OF_GRADIENTS * unit)
        values, vectors = np.linalg.eigh(some.hessians(energy)(None))
        motions = vectors / np.sqrt(np.maximum(values, 1e-10 * values[-1])) / OF_MOTIONS
        values, vectors = np.linalg.eigh(motions @ motions.T + gradients.T @ gradients)
        return cls(
            energy.rows * scales[:, None, None],
            scales,
            vectors * np.sqrt(np.maximum(values, 0.0)),
            stresses / (OF_STRESSES * unit),
        )

    def local(self, own: IndexArray) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Maps (t, 9, rank) of some tets from their local coordinates, and modes (rank, d)."""
        # Forces do not depend on stresses outside the span of the displacement gradients.
        span, inside = np.linalg.qr(self.scaled[own].reshape(9 * len(own), -1))
        stresses = span.T @ self.stresses[:, own].reshape(len(self.stresses), -1).T
        columns = np.concatenate([inside @ self.root, stresses], axis=1)
        values, vectors = np.linalg.eigh(columns @ columns.T)
        kept = vectors[:, min(np.searchsorted(values, 1.0), len(values) - 1) :]
        maps = (span @ kept).reshape(len(own), 9, -1) / self.scales[own, None, None]
        return maps.astype(np.float32), (kept.T @ inside).astype(np.float32)


def _centroids(states: ElasticStates, tets: NDArray[np.int32]) -> FloatArray:
    """Centroids of elements at rest, or the vertices of stars, (r, 3)."""
    mesh = states.problem.mesh
    if has_stars(states.problem):
        return mesh.vertices[tets]
    centroids: FloatArray = mesh.vertices[mesh.elements[tets]].mean(axis=1)
    return centroids
