"""ElementProbe: the residual of a body whose elements are independent."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..energy import ShellMaterial
from ..material import Material
from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace
from .probe_pins import ProbePins
from .residual_probe import ResidualProbe, rest_shapes
from .residual_sample import ResidualSample

FloatArray = NDArray[np.float64]


class ElementProbe(ResidualProbe):
    """The residual from the tets around the sampled vertices, or from the elements of a shell.

    Attributes
    ----------
    corners : (c,), the vertices of these tets, ascending
    tets : (t, 4) int32, as indices of corners
    rests : (1 or k, c, 3), the corners at rest, or in all poses
    material : Material or ShellMaterial of these tets
    places : (s,) int32, indices of the sampled vertices among the corners
    weights : (s,), weights of the sample
    pins : ProbePins, among the corners
    """

    material: Material | ShellMaterial

    def __init__(
        self,
        problem: PosingProblem | InterpolationProblem,
        subspace: AffineSubspace,
        sample: ResidualSample,
    ) -> None:
        super().__init__(problem)
        n, tets = len(problem.mesh.vertices), problem.mesh.elements
        sampled = np.zeros(n, np.bool_)
        sampled[sample.vertices] = True
        chosen = np.flatnonzero(sampled[tets].any(axis=1))
        self.corners, local = np.unique(tets[chosen], return_inverse=True)
        self.tets = local.reshape(-1, 4).astype(np.int32)
        self.rests = np.ascontiguousarray(rest_shapes(problem)[:, self.corners])
        self.material = problem.element_material.of_tets(chosen)
        self.places = np.searchsorted(self.corners, sample.vertices).astype(np.int32)
        self.weights = sample.weights
        self.pins = ProbePins.of_vertices(problem, self.corners, sample.vertices)
        modes = subspace.basis.reshape(n, 3, -1)[self.corners]
        self._core = core.element_probe(
            np.ascontiguousarray(subspace.tau.reshape(n, 3)[self.corners]),
            np.ascontiguousarray(np.moveaxis(modes, 2, 0)),
            self.rests,
            self.tets,
            self.material.core,
            self.places,
            self.weights,
            **self.pins.arguments,
        )
