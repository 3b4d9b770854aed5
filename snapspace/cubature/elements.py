"""Elements: what a cubature is a sum over."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..energy import ShellMaterial, VertexStars
from ..material import Material
from ..mesh import Body, ShellMesh
from ..problem import InterpolationProblem, PosingProblem, Problem
from .displacement_gradients import displacement_gradients

FloatArray = NDArray[np.float64]


class Elements(Protocol):
    """The elements of a body: tets, triangles and hinges, or the stars of vertices."""

    @property
    def measures(self) -> FloatArray:
        """Volume or area of each, (m,)."""
        ...

    @property
    def material(self) -> Material | ShellMaterial:
        """The density of the elements."""
        ...

    def gradients(
        self, basis: FloatArray, which: NDArray[np.int32], *, threads: int | None = None
    ) -> NDArray[np.float32]:
        """The nine numbers of modes (3n, d) in some elements (r,), (r, 9, d)."""
        ...

    def remainder(self, basis: FloatArray) -> FloatArray | None:
        """What the elements leave of the energy, q^T K q: a matrix (d, d), or None for nothing."""
        ...


@dataclass(frozen=True)
class MeshElements:
    """The elements of a mesh; see `Elements`."""

    mesh: Body
    material: Material | ShellMaterial

    @property
    def measures(self) -> FloatArray:
        """See `Elements`."""
        return self.mesh.measures

    def gradients(
        self, basis: FloatArray, which: NDArray[np.int32], *, threads: int | None = None
    ) -> NDArray[np.float32]:
        """See `Elements`."""
        return displacement_gradients(self.mesh, basis, which, threads=threads)

    def remainder(self, basis: FloatArray) -> None:
        """See `Elements`."""


@dataclass(frozen=True)
class StarElements:
    """The stars of a surface that is as rigid as possible; see `Elements`."""

    stars: VertexStars

    @property
    def measures(self) -> FloatArray:
        """See `Elements`."""
        return self.stars.measures

    @property
    def material(self) -> ShellMaterial:
        """See `Elements`."""
        return self.stars.material

    def gradients(
        self, basis: FloatArray, which: NDArray[np.int32], *, threads: int | None = None
    ) -> NDArray[np.float32]:
        """See `Elements`."""
        return self.stars.gradients(basis, which)

    def remainder(self, basis: FloatArray) -> FloatArray:
        """See `Elements`."""
        return self.stars.remainder(basis)


def elements_of(problem: PosingProblem | InterpolationProblem) -> Elements:
    """The elements whose sum is the energy of a problem, or of each of its poses."""
    if isinstance(problem, PosingProblem) and problem.energy.stars is not None:
        return StarElements(problem.energy.stars)
    return MeshElements(problem.mesh, problem.element_material)


def element_count(problem: Problem) -> int:
    """How many elements a cubature may choose from."""
    if isinstance(problem, PosingProblem) and problem.energy.stars is not None:
        return len(problem.energy.stars)
    return len(problem.mesh.elements)


def has_hinges(problem: Problem) -> bool:
    """Whether the elements are triangles and hinges."""
    stars = isinstance(problem, PosingProblem) and problem.energy.stars is not None
    return isinstance(problem.mesh, ShellMesh) and not stars
