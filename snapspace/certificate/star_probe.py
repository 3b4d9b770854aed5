"""Probes of surfaces that are as rigid as possible: the sampled residual of a frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..mesh import ShellMesh
from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace
from .residual_probe import BlendingProbe, PosingProbe
from .residual_sample import ResidualSample

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.integer[Any]]


@dataclass(frozen=True, eq=False)
class Surroundings:
    """The triangles that the gradient at sampled vertices depends on.

    The rotations of a vertex and its neighbours move its gradient, and they depend on the triangles
    at all of them.

    triangles : (t,), which triangles
    near : (n,) bool, the sampled vertices and their neighbours
    vertices : (c,), the corners of these triangles, ascending
    corners : (t, 4) int32, as indices of vertices
    """

    triangles: IndexArray
    near: NDArray[np.bool_]
    vertices: IndexArray
    corners: NDArray[np.int32]

    @classmethod
    def of(cls, mesh: ShellMesh, sample: ResidualSample) -> Surroundings:
        """Those of the vertices of a sample."""
        near = np.zeros(len(mesh.vertices), np.bool_)
        near[sample.vertices] = True
        near[mesh.cells[near[mesh.cells].any(axis=1)]] = True
        chosen = np.flatnonzero(near[mesh.cells].any(axis=1))
        # the elements of a mesh begin with its triangles
        vertices, corners = np.unique(mesh.elements[chosen], return_inverse=True)
        return cls(chosen, near, vertices, corners.reshape(-1, 4).astype(np.int32))

    @property
    def columns(self) -> IndexArray:
        """The coordinates (3c,) of the corners among those of all vertices."""
        columns: IndexArray = (3 * self.vertices[:, None] + np.arange(3)).reshape(-1)
        return columns


class _SampledNorm:
    """The weighted norm of a gradient at the sampled vertices."""

    def __init__(self, around: Surroundings, sample: ResidualSample) -> None:
        self._places = np.searchsorted(around.vertices, sample.vertices)
        self._weights = sample.weights

    def __call__(self, gradient: FloatArray) -> float:
        squares = (gradient.reshape(-1, 3)[self._places] ** 2).sum(axis=1)
        return float(np.sqrt(self._weights @ squares))


class StarProbe:
    """The full objective's gradient at the vertices of a sample, as `PosingProbe` has it.

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
        assert isinstance(mesh, ShellMesh)
        around = Surroundings.of(mesh, sample)
        self._energy = core.ElasticEnergy(
            np.ascontiguousarray(mesh.vertices[around.vertices]),
            around.corners,
            energy.element_material.of_tets(around.triangles).core,
        )
        self._modes = np.ascontiguousarray(subspace.basis[around.columns])
        self._origin = (subspace.tau - problem.base)[around.columns]
        self._norm = _SampledNorm(around, sample)
        pinned = around.near[problem.pinned]  # all pins at sampled vertices, and others
        self._pins = np.searchsorted(around.vertices, problem.pinned[pinned])
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
        return self._norm(gradient)


class BlendingStarProbe:
    """The same of a blend, as `BlendingProbe` has it.

    Parameters
    ----------
    problem : InterpolationProblem
        Of `ShellPoses` and `ARAP`.
    subspace, sample
        As for `StarProbe`.
    """

    def __init__(
        self, problem: InterpolationProblem, subspace: AffineSubspace, sample: ResidualSample
    ) -> None:
        assert isinstance(problem.mesh, ShellMesh)
        around = Surroundings.of(problem.mesh, sample)
        poses = problem.pose_shapes.reshape(problem.poses.shapes.shape)
        self._energies = [
            core.ElasticEnergy(
                np.ascontiguousarray(pose[around.vertices]),
                around.corners,
                material.of_tets(around.triangles).core,
            )
            for pose, material in zip(poses, problem.pose_energies.materials, strict=True)
        ]
        self._modes = np.ascontiguousarray(subspace.basis[around.columns])
        self._origins = (subspace.tau - problem.pose_shapes)[:, around.columns]
        self._norm = _SampledNorm(around, sample)

    def norm(self, q: FloatArray, state: FloatArray) -> float:
        """Estimate of sqrt(g^T D^-1 g), see `ResidualProbe.norm`; the state is the weights."""
        move = self._modes[:, : len(q)] @ q
        gradient = np.zeros(len(move))
        for weight, energy, origin in zip(state, self._energies, self._origins, strict=True):
            gradient += weight * energy.value_and_gradient(origin + move)[1]
        return self._norm(gradient)


def posing_probe(
    problem: PosingProblem, subspace: AffineSubspace, sample: ResidualSample
) -> PosingProbe | StarProbe:
    """The probe of a posing problem."""
    if problem.energy.stars is None:
        return PosingProbe(problem, subspace, sample)
    return StarProbe(problem, subspace, sample)


def blending_probe(
    problem: InterpolationProblem, subspace: AffineSubspace, sample: ResidualSample
) -> BlendingProbe | BlendingStarProbe:
    """The probe of an interpolation problem."""
    if problem.pose_energies.stars is None:
        return BlendingProbe(problem, subspace, sample)
    return BlendingStarProbe(problem, subspace, sample)
