"""ResidualProbe: the sampled residual of a frame, at a cost that does not depend on the mesh."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace
from .residual_sample import ResidualSample

FloatArray = NDArray[np.float64]


class ResidualProbe(ABC):
    """The full objective's gradient at the vertices of a sample, for shapes of a subspace.

    It takes the tets around these vertices out of the mesh, with the modes at their corners; within
    them the gradient is exact. About 1 ms on any mesh.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
    subspace : AffineSubspace
    sample : ResidualSample

    Attributes
    ----------
    corners : (c,), the vertices of these tets, ascending
    tets : (t, 4) int32, among the corners
    places : (s,), of the sampled vertices among the corners
    weights : (s,), of the sample
    """

    def __init__(
        self,
        problem: PosingProblem | InterpolationProblem,
        subspace: AffineSubspace,
        sample: ResidualSample,
    ) -> None:
        n, tets = len(problem.mesh.vertices), problem.mesh.tets
        if sample.vertices.min() < 0 or sample.vertices.max() >= n:
            raise ValueError(
                f"ResidualProbe: the sample has vertex {sample.vertices.max()}, but the mesh has "
                f"{n} vertices; calibrate the model again"
            )
        chosen = np.zeros(n, np.bool_)
        chosen[sample.vertices] = True
        around = tets[chosen[tets].any(axis=1)]
        self.corners, local = np.unique(around, return_inverse=True)
        self.tets = local.reshape(-1, 4).astype(np.int32)
        self.places = np.searchsorted(self.corners, sample.vertices)
        self.weights = sample.weights
        self._tau = subspace.tau.reshape(-1, 3)[self.corners].reshape(-1)
        modes = subspace.basis.reshape(n, 3, -1)[self.corners].reshape(len(self._tau), -1)
        self._modes = np.ascontiguousarray(modes.T)

    def norm(self, q: FloatArray, state: FloatArray) -> float:
        """Estimate of sqrt(g^T D^-1 g), see `ResidualSample`, at tau + U q.

        Parameters
        ----------
        q : (d,), or fewer leading coordinates
        state : offsets (h, 3, 4) of the handles, or weights of the poses
        """
        shape = core.reconstruct(self._tau, self._modes[: len(q)], q)
        squares = (self._gradient(shape, state)[self.places] ** 2).sum(axis=1)
        return float(np.sqrt(self.weights @ squares))

    @abstractmethod
    def _gradient(self, shape: FloatArray, state: FloatArray) -> FloatArray:
        """Of the objective, (c, 3) at the corners of the tets; true at the sampled vertices."""

    def _energy(self, rest: FloatArray, problem: PosingProblem | InterpolationProblem) -> _Part:
        """The elastic energy of the tets around, with rest (n, 3)."""
        corners = np.ascontiguousarray(rest[self.corners])
        material = problem.material
        energy = core.ElasticEnergy(corners, self.tets, material.lam, material.mu)
        return _Part(energy, corners.reshape(-1))


class PosingProbe(ResidualProbe):
    """Of a posing problem; the state are the handles' offsets (h, 3, 4).

    Attributes
    ----------
    pinned, handles, pulls : (p,), the sampled vertices that handles hold: places among the corners,
    indices of the handles, twice the weights (p, 1) of their springs
    """

    def __init__(
        self, problem: PosingProblem, subspace: AffineSubspace, sample: ResidualSample
    ) -> None:
        super().__init__(problem, subspace, sample)
        self._part = self._energy(problem.mesh.vertices, problem)
        sizes = [len(handle.vertices) for handle in problem.handles]
        handles = np.repeat(np.arange(len(sizes)), sizes)
        seen = np.isin(problem.pinned, sample.vertices)
        self.handles = handles[seen]
        self.pinned = np.searchsorted(self.corners, problem.pinned[seen])
        self.pulls = 2.0 * problem.pin_weights[seen, None]
        arms = problem.mesh.vertices[problem.pinned[seen]] - problem.centroids[self.handles]
        self._arms = np.column_stack([arms, np.ones(len(arms))])

    def _gradient(self, shape: FloatArray, state: FloatArray) -> FloatArray:
        moved, gradient = self._part.displacement_and_gradient(shape)
        wanted = np.einsum("prk,pk->pr", state[self.handles], self._arms)
        np.add.at(gradient, self.pinned, self.pulls * (moved[self.pinned] - wanted))
        return gradient


class BlendingProbe(ResidualProbe):
    """Of an interpolation problem; the state are the weights of the poses."""

    def __init__(
        self, problem: InterpolationProblem, subspace: AffineSubspace, sample: ResidualSample
    ) -> None:
        super().__init__(problem, subspace, sample)
        self._parts = [self._energy(pose.reshape(-1, 3), problem) for pose in problem.pose_shapes]

    def _gradient(self, shape: FloatArray, state: FloatArray) -> FloatArray:
        gradient = np.zeros((len(self.corners), 3))
        for weight, part in zip(state, self._parts, strict=True):
            gradient += weight * part.displacement_and_gradient(shape)[1]
        return gradient


class _Part:
    """An elastic energy of some tets, as a function of positions."""

    def __init__(self, energy: core.ElasticEnergy, rest: FloatArray) -> None:
        self._core, self._rest = energy, rest

    def displacement_and_gradient(self, shape: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Both (c, 3), at positions (3c,)."""
        displacement = shape - self._rest
        _, gradient = self._core.value_and_gradient(displacement)
        return displacement.reshape(-1, 3), gradient.reshape(-1, 3)
