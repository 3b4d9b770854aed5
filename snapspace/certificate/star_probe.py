"""StarProbe: the residual of an as-rigid-as-possible surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..energy import ShellMaterial, StarParts, VertexStars
from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace
from .probe_pins import ProbePins
from .residual_probe import ResidualProbe, rest_shapes
from .residual_sample import ResidualSample

FloatArray = NDArray[np.float64]


class StarProbe(ResidualProbe):
    """The residual from the stars around sampled vertices, whose rotations turn the forces there.

    The energy is a quadratic form plus a sum over stars, see `VertexStars`. So the gradient at a
    vertex is a linear function of the shape plus the stresses of the stars around it, times
    vectors. Stars may be large, so the probe stores their nine numbers for every mode, not their
    corners.

    Attributes
    ----------
    vertices : (v,), the sampled vertices, each once, ascending
    weights : (v,), their weights
    stars : (r,), the stars around them, ascending
    origins : (1 or k, 9 r + 3 v), the numbers of tau: nine per star, and three per vertex for the
        linear functions, with the pulls of pins
    modes : (1 or k, d, 9 r + 3 v) float32, those of the modes
    material : ShellMaterial of the stars of all poses, with modulus one
    part_stars, part_places : (p,) int32, pairs of a star and a vertex that its stress pulls at
    part_vectors : (1 or k, p, 3)
    pins : ProbePins, among the vertices
    """

    def __init__(
        self,
        problem: PosingProblem | InterpolationProblem,
        subspace: AffineSubspace,
        sample: ResidualSample,
    ) -> None:
        super().__init__(problem)
        self.vertices, places = np.unique(sample.vertices, return_inverse=True)
        self.weights: FloatArray = np.zeros(len(self.vertices))
        np.add.at(self.weights, places, sample.weights)
        self.pins = ProbePins.of_vertices(problem, self.vertices, self.vertices)
        poses = stars_of(problem)
        parts = [stars.parts(self.vertices) for stars in poses]
        self.stars, among = np.unique(parts[0].stars, return_inverse=True)
        self.part_stars, self.part_places = among.astype(np.int32), parts[0].places
        self.part_vectors = np.stack([one.vectors for one in parts])
        rows = np.concatenate([stars.material.moduli[self.stars] for stars in poses])
        rows[:, 0] = 1.0
        self.material = ShellMaterial(poses[0].material.kind, rows)

        offsets = subspace.tau - rest_shapes(problem).reshape(len(poses), -1)
        self.origins = np.stack(
            [
                self._numbers(stars, part, offset[:, None])[:, 0]
                for stars, part, offset in zip(poses, parts, offsets, strict=True)
            ]
        )
        basis = np.ascontiguousarray(subspace.basis)
        self.modes = np.stack(
            [
                self._numbers(stars, part, basis).T.astype(np.float32, order="C")
                for stars, part in zip(poses, parts, strict=True)
            ]
        )
        self._core = core.star_probe(
            self.origins,
            self.modes,
            self.material.core,
            self.part_stars,
            self.part_places,
            self.part_vectors,
            self.weights,
            **self.pins.arguments,
        )

    def _numbers(
        self, stars: VertexStars, parts: StarParts, displacements: FloatArray
    ) -> FloatArray:
        """The numbers (9 r + 3 v, d) of displacements (3n, d) from one pose."""
        nine = stars.gradients(displacements, self.stars)
        forces = stars.dirichlet_forces(displacements, self.vertices)
        own = nine.reshape(len(nine), 3, 3, -1)[self.part_stars]
        # the quadratic form lacks the Dirichlet energy of a star's best affine map
        np.subtract.at(forces, parts.places, 2.0 * np.einsum("pabd,pb->pad", own, parts.vectors))
        pinned = self.pins.pinned
        moved = displacements.reshape(-1, 3, forces.shape[2])[self.vertices[pinned]]
        forces[pinned] += self.pins.pulls[:, None, None] * moved
        columns = nine.shape[2]
        return np.concatenate([nine.reshape(-1, columns), forces.reshape(-1, columns)])


def stars_of(problem: PosingProblem | InterpolationProblem) -> list[VertexStars]:
    """The stars of a surface at rest, or in each pose."""
    stars = (
        [problem.energy.stars]
        if isinstance(problem, PosingProblem)
        else problem.pose_energies.stars or []
    )
    return [one for one in stars if one is not None]
