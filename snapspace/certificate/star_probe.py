"""StarProbe: the sampled residual of a surface that is as rigid as possible."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..problem import PosingProblem
from ..subspace import AffineSubspace
from .residual_probe import PosingProbe
from .residual_sample import ResidualSample

FloatArray = NDArray[np.float64]


class StarProbe:
    """The full objective's gradient at the vertices of a sample, as `PosingProbe` has it.

    The rotations of a vertex and its neighbours move its gradient. They depend on the triangles at
    all of them, which are taken from the mesh.

    Parameters
    ----------
    problem : PosingProblem
        Of a shell of `ARAP`.
    subspace : AffineSubspace
        The subspace of the shapes.
    sample : ResidualSample
        The sampled vertices and their weights.
    """

    def __init__(
        self, problem: PosingProblem, subspace: AffineSubspace, sample: ResidualSample
    ) -> None:
        mesh, energy = problem.mesh, problem.energy
        near = np.zeros(len(mesh.vertices), np.bool_)
        near[sample.vertices] = True
        near[mesh.cells[near[mesh.cells].any(axis=1)]] = True
        chosen = np.flatnonzero(near[mesh.cells].any(axis=1))
        vertices, corners = np.unique(energy.corners[chosen], return_inverse=True)
        self._energy = core.ElasticEnergy(
            np.ascontiguousarray(mesh.vertices[vertices]),
            corners.reshape(-1, 4).astype(np.int32),
            energy.element_material.of_tets(chosen).core,
        )
        columns = (3 * vertices[:, None] + np.arange(3)).reshape(-1)
        self._modes = np.ascontiguousarray(subspace.basis[columns])
        self._origin = (subspace.tau - problem.base)[columns]
        self._places = np.searchsorted(vertices, sample.vertices)
        self._weights = sample.weights
        pinned = near[problem.pinned]  # all pins at sampled vertices, and others
        self._pins = np.searchsorted(vertices, problem.pinned[pinned])
        self._pulls = 2.0 * problem.pin_weights[pinned]
        self._wanted = np.flatnonzero(pinned)
        self._problem = problem

    def norm(self, q: FloatArray, state: FloatArray) -> float:
        """Estimate of sqrt(g^T D^-1 g), see `ResidualProbe.norm`."""
        u = self._origin + self._modes[:, : len(q)] @ q
        gradient = self._energy.value_and_gradient(u)[1].reshape(-1, 3)
        wanted = self._problem.target_displacements(state)[self._wanted]
        missed = u.reshape(-1, 3)[self._pins] - wanted
        np.add.at(gradient, self._pins, self._pulls[:, None] * missed)
        squares = (gradient[self._places] ** 2).sum(axis=1)
        return float(np.sqrt(self._weights @ squares))


def posing_probe(
    problem: PosingProblem, subspace: AffineSubspace, sample: ResidualSample
) -> PosingProbe | StarProbe:
    """The probe of a posing problem."""
    if problem.energy.stars is None:
        return PosingProbe(problem, subspace, sample)
    return StarProbe(problem, subspace, sample)
