"""ResidualProbe: the sampled residual of a frame, at a cost independent of the mesh."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..energy import ShellMaterial, is_of_stars
from ..material import Material
from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace
from .residual_sample import ResidualSample

FloatArray = NDArray[np.float64]


class ResidualProbe(ABC):
    """The full objective's gradient at the vertices of a sample, for shapes of a subspace.

    It extracts the tets, or the elements of a shell, around these vertices from the mesh, with the
    modes at their corners, so the gradient at the vertices is exact, for every material. Takes
    about 1 ms on any mesh; the page has the same loop (core/online/residual_probe.h).

    Of a surface that is as rigid as possible it takes the triangles around these vertices and their
    neighbours: the rotations of all of them move the gradient.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
        The full problem.
    subspace : AffineSubspace
        The subspace of the shapes.
    sample : ResidualSample
        The sampled vertices and their weights.

    Attributes
    ----------
    corners : (c,), the vertices of these tets, ascending
    tets : (t, 4) int32, as indices of corners
    rests : (1 or k, c, 3), the corners at rest, or in all poses
    material : Material or ShellMaterial of these tets
    places : (s,) int32, indices of the sampled vertices among the corners
    weights : (s,), weights of the sample
    pinned, handles : (p,) int32, indices among the corners of the sampled vertices in handles, and
        the indices of their handles; none for blending
    pulls : (p,), twice the weights of their springs
    arms : (p, 3), vectors to them from the centroids of their handles, at rest

    Raises
    ------
    ValueError
        If the sample has a vertex that the mesh does not have.
    """

    material: Material | ShellMaterial
    pinned: NDArray[np.int32]
    handles: NDArray[np.int32]
    pulls: FloatArray
    arms: FloatArray

    def __init__(
        self,
        problem: PosingProblem | InterpolationProblem,
        subspace: AffineSubspace,
        sample: ResidualSample,
        rests: FloatArray,
    ) -> None:
        n, tets = len(problem.mesh.vertices), problem.mesh.elements
        if sample.vertices.min() < 0 or sample.vertices.max() >= n:
            raise ValueError(
                f"ResidualProbe: the sample has vertex {sample.vertices.max()}, but the mesh has "
                f"{n} vertices; calibrate the model again"
            )
        sampled = np.zeros(n, np.bool_)
        sampled[sample.vertices] = True
        chosen = _elements_around(problem, sampled)
        self.corners, local = np.unique(tets[chosen], return_inverse=True)
        self.tets = local.reshape(-1, 4).astype(np.int32)
        self.rests = np.ascontiguousarray(rests.reshape(len(rests), n, 3)[:, self.corners])
        self.material = problem.element_material.of_tets(chosen)
        self.places = np.searchsorted(self.corners, sample.vertices).astype(np.int32)
        self.weights = sample.weights
        self._find_pins(problem, sampled)
        modes = subspace.basis.reshape(n, 3, -1)[self.corners]
        self._core = core.ResidualProbe(
            np.ascontiguousarray(subspace.tau.reshape(n, 3)[self.corners]),
            np.ascontiguousarray(np.moveaxis(modes, 2, 0)),
            self.rests,
            self.tets,
            self.material.core,
            self.places,
            self.weights,
            pinned=self.pinned,
            handles=self.handles,
            pulls=self.pulls,
            arms=self.arms,
        )

    @abstractmethod
    def norm(self, q: FloatArray, state: FloatArray) -> float:
        """Estimate of sqrt(g^T D^-1 g), see `ResidualSample`, at tau + U q.

        Parameters
        ----------
        q : (d,)
            Reduced coordinates, or fewer leading ones.
        state : (h, 3, 4) or (k,)
            Offsets of the handles, or weights of the poses.
        """

    def _find_pins(
        self, problem: PosingProblem | InterpolationProblem, sampled: NDArray[np.bool_]
    ) -> None:
        """Sets `pinned`, `handles`, `pulls` and `arms`."""
        self.pinned = self.handles = np.zeros(0, np.int32)
        self.pulls, self.arms = np.zeros(0), np.zeros((0, 3))
        if not isinstance(problem, PosingProblem):
            return
        sizes = [len(handle.vertices) for handle in problem.handles]
        owners = np.repeat(np.arange(len(sizes), dtype=np.int32), sizes)
        seen = sampled[problem.pinned]
        vertices = problem.pinned[seen]
        self.handles = owners[seen]
        self.pinned = np.searchsorted(self.corners, vertices).astype(np.int32)
        self.pulls = 2.0 * problem.pin_weights[seen]
        self.arms = problem.mesh.vertices[vertices] - problem.centroids[self.handles]


def has_certificates(problem: PosingProblem | InterpolationProblem) -> bool:
    """Whether residuals at a few vertices depend on few others: not where stars have a radius."""
    return not problem.material.settings.get("radius")


def _elements_around(
    problem: PosingProblem | InterpolationProblem, sampled: NDArray[np.bool_]
) -> NDArray[np.intp]:
    """The elements that the gradient at sampled vertices, (n,) bool, depends on."""
    mesh = problem.mesh
    if not is_of_stars(mesh, problem.material):
        return np.flatnonzero(sampled[mesh.elements].any(axis=1))
    near = sampled.copy()
    near[mesh.cells[sampled[mesh.cells].any(axis=1)]] = True
    # the elements of the mesh begin with its triangles
    return np.flatnonzero(near[mesh.cells].any(axis=1))


class PosingProbe(ResidualProbe):
    """The probe of a posing problem; its state is the handles' offsets (h, 3, 4)."""

    def __init__(
        self, problem: PosingProblem, subspace: AffineSubspace, sample: ResidualSample
    ) -> None:
        super().__init__(problem, subspace, sample, problem.mesh.vertices[None])

    def norm(self, q: FloatArray, state: FloatArray) -> float:
        return self._core.norm(q, offsets=state)


class BlendingProbe(ResidualProbe):
    """The probe of an interpolation problem; its state is the weights of the poses."""

    def __init__(
        self, problem: InterpolationProblem, subspace: AffineSubspace, sample: ResidualSample
    ) -> None:
        super().__init__(problem, subspace, sample, problem.pose_shapes)

    def norm(self, q: FloatArray, state: FloatArray) -> float:
        return self._core.norm(q, weights=state)
