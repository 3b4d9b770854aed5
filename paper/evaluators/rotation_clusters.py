"""Rotation clustering: the ARAP energy with one rotation for each cluster of tets."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.cluster.vq import kmeans2, vq

import snapspace as ss
from snapspace.cubature.displacement_gradients import displacement_gradients
from snapspace.mesh import solid_of, tet_volumes
from snapspace.reduction import Cubature, HandleQuadric

FloatArray = NDArray[np.float64]
Integers = NDArray[np.int64]

#: Clusters are found among this many tets in this many directions; the others join the nearest.
TRIED, DIRECTIONS, ITERATIONS = 20_000, 16, 20


@dataclass(frozen=True, eq=False)
class ClusteredEnergy:
    """sum_e v_e mu |F_e(q) - R_c(e)|^2 with the best rotation R_c of each cluster c of tets.

    After Jacobson, Baran, Kavan, Popovic, Sorkine 2012, "Fast automatic skinning transformations".
    With the mean gradient F_c of a cluster and its summed weight m_c it is
    q^T spread q + sum_c m_c |F_c(q) - R_c|^2: gradients differ within a cluster by a linear map of
    q, whose squared norm is precomputed, and the rest is a cubature of clusters in place of tets.

    spread : (d, d)
    clusters : Cubature of the mean gradients, of ARAP with mu = 1
    """

    spread: FloatArray
    clusters: Cubature

    @property
    def dimension(self) -> int:
        """d."""
        return len(self.spread)

    def value_and_gradient(self, q: FloatArray) -> tuple[float, FloatArray]:
        """Energy at q (d,) and its gradient (d,)."""
        value, gradient = self.clusters.value_and_gradient(q)
        force = self.spread @ q
        return value + float(q @ force), gradient + 2.0 * force


def clustered_energy(
    problem: ss.PosingProblem, subspace: ss.AffineSubspace, labels: Integers
) -> ClusteredEnergy:
    """The energy for the clusters (m,) of all tets, numbered from zero; none may be empty.

    Raises
    ------
    ValueError
        If the material is not ARAP.
    """
    mesh, material = solid_of(problem.mesh, who="clustered_energy"), problem.material
    if not isinstance(material, ss.ARAP):
        raise ValueError(
            f"clustered_energy: the material is {material.title}, but rotations are clustered for "
            "ARAP only"
        )
    everything = np.arange(len(mesh.tets), dtype=np.int32)
    rows = displacement_gradients(mesh, subspace.basis, everything).astype(np.float64)
    weights = tet_volumes(mesh.vertices, mesh.tets) * material.mu
    count = int(labels.max()) + 1
    sums = np.bincount(labels, weights, minlength=count).astype(np.float64)
    means = np.zeros((count, *rows.shape[1:]))
    np.add.at(means, labels, weights[:, None, None] * rows)
    means /= sums[:, None, None]
    away = rows
    away -= means[labels]
    away *= np.sqrt(weights)[:, None, None]
    flat = away.reshape(-1, subspace.dimension)
    clusters = Cubature(
        np.arange(count, dtype=np.int32), sums, means.astype(np.float32), ss.ARAP(mu=1.0)
    )
    return ClusteredEnergy(flat.T @ flat, clusters)


def rotation_clusters(
    problem: ss.PosingProblem, subspace: ss.AffineSubspace, coordinates: FloatArray, count: int
) -> Integers:
    """Cluster (m,) of each tet, by k-means of the tets' gradients at coordinates (k, d).

    The coordinates of training shapes say how far each mode moves; all that the tets do in them is
    within a few principal directions. Clusters that no tet is nearest to are left out.
    """
    tets = np.arange(len(problem.mesh.elements), dtype=np.int32)
    if count >= len(tets):
        return tets.astype(np.int64)
    rows = displacement_gradients(problem.mesh, subspace.basis, tets)
    spread = np.linalg.cholesky(_moments(coordinates))
    scaled = np.einsum("eak,kj->eaj", rows, spread.astype(np.float32)).reshape(len(tets), -1)
    scaled -= scaled.mean(axis=0)
    _, vectors = np.linalg.eigh(scaled.T @ scaled)
    features = (scaled @ vectors[:, -DIRECTIONS:]).astype(np.float64)
    random = np.random.default_rng(0)
    tried = features[random.permutation(len(tets))[: max(TRIED, 4 * count)]]
    centers, _ = kmeans2(tried, _first_centers(tried, count, random), ITERATIONS, minit="matrix")
    labels, _ = vq(features, centers)
    _, dense = np.unique(labels, return_inverse=True)
    return np.asarray(dense, np.int64)


def _first_centers(points: FloatArray, count: int, random: np.random.Generator) -> FloatArray:
    """k-means++: each is drawn by squared distances from the ones before (SciPy's is slower)."""
    chosen = [int(random.integers(len(points)))]
    squares = np.full(len(points), np.inf)
    while len(chosen) < count:
        away = points - points[chosen[-1]]
        squares = np.minimum(squares, np.einsum("ij,ij->i", away, away))
        sums = np.cumsum(squares)
        chosen.append(int(np.searchsorted(sums, random.random() * sums[-1], side="right")))
    centers: FloatArray = points[np.minimum(chosen, len(points) - 1)]
    return centers


def clustered_model(model: ss.PosingModel, energy: ClusteredEnergy) -> ss.PosingModel:
    """The model with this energy: the core sums its clusters, and K of the handles its rest."""
    handles = HandleQuadric(model.handles.K + energy.spread, model.handles.L, model.handles.S)
    return replace(model, elastic=energy.clusters, handles=handles)


def _moments(coordinates: FloatArray) -> FloatArray:
    """Second moments (d, d), positive definite."""
    moments = coordinates.T @ coordinates / len(coordinates)
    raised: FloatArray = moments + 1e-9 * np.trace(moments) * np.eye(len(moments))
    return raised
