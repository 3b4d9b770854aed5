"""Elements: the terms of the sum that a cubature approximates."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..energy import ShellMaterial, VertexStars, is_of_stars
from ..material import Material
from ..mesh import Body, ShellMesh
from ..problem import InterpolationProblem, PosingProblem, Problem
from .displacement_gradients import displacement_gradients
from .star_poses import StarPoses

FloatArray = NDArray[np.float64]


class Elements(Protocol):
    """The elements of a body: tets, triangles and hinges, or stars."""

    @property
    def measures(self) -> FloatArray:
        """Volume or area of each, (m,)."""
        ...

    def gradients(
        self, basis: FloatArray, which: NDArray[np.int32], *, threads: int | None = None
    ) -> NDArray[np.float32]:
        """The nine numbers of modes (3n, d) in some elements (r,), (r, 9, d).

        Stars of a blend have nine for each pose, (r, 9 poses, d).
        """
        ...


class PosedElements(Elements, Protocol):
    """The elements of a body with one rest shape."""

    @property
    def material(self) -> Material | ShellMaterial:
        """The density of the elements."""
        ...

    def remainder(self, basis: FloatArray) -> FloatArray | None:
        """The energy that is not in the elements, q^T K q: a matrix (d, d), or None for nothing."""
        ...


@dataclass(frozen=True)
class MeshElements:
    """The elements of a mesh; see `PosedElements`."""

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
    """The stars of an as-rigid-as-possible surface; see `PosedElements`."""

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
        return self.stars.gradients(basis, which).astype(np.float32)

    def remainder(self, basis: FloatArray) -> FloatArray:
        """See `Elements`."""
        return self.stars.remainder(basis)


@dataclass(frozen=True)
class PoseStarElements:
    """The stars of a blend; see `Elements`."""

    poses: StarPoses

    @property
    def measures(self) -> FloatArray:
        """See `Elements`."""
        return self.poses.measures

    def gradients(
        self, basis: FloatArray, which: NDArray[np.int32], *, threads: int | None = None
    ) -> NDArray[np.float32]:
        """See `Elements`."""
        return self.poses.rows(basis, which)


def elements_of(problem: PosingProblem | InterpolationProblem) -> Elements:
    """The elements whose sum is the energy of a problem, or of each of its poses."""
    if isinstance(problem, PosingProblem):
        return posed_elements_of(problem)
    if has_stars(problem):
        return PoseStarElements(StarPoses(problem))
    return MeshElements(problem.mesh, problem.element_material)


def posed_elements_of(problem: PosingProblem) -> PosedElements:
    """The elements of a posing problem, with the energy that is not in them."""
    if problem.energy.stars is not None:
        return StarElements(problem.energy.stars)
    return MeshElements(problem.mesh, problem.element_material)


def element_count(problem: Problem) -> int:
    """Number of elements that a cubature may choose from."""
    assert isinstance(problem, PosingProblem | InterpolationProblem)
    return len(elements_of(problem).measures)


def has_stars(problem: Problem) -> bool:
    """Whether the elements are stars, those of an as-rigid-as-possible surface."""
    return is_of_stars(problem.mesh, problem.material)


def has_hinges(problem: Problem) -> bool:
    """Whether the elements are triangles and hinges."""
    return isinstance(problem.mesh, ShellMesh) and not has_stars(problem)
