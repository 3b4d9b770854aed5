"""Problem: the interface of parametrised shape problems, for all later stages."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from ..energy import ShellMaterial
from ..material import Material
from ..mesh import Body, TetMesh
from ..sampling import Domain
from .solver_traits import SolverTraits

FloatArray = NDArray[np.float64]


class ProblemDomain(Domain, Protocol):
    """A parameter domain that can be sampled and in which distances can be compared."""

    def scaled(self, parameters: FloatArray) -> FloatArray:
        """Coordinates for parameters (k, p) in which distances are comparable."""
        ...


class Problem(Protocol):
    """Minimise F(x, w) over shapes x, for parameters w of a domain (paper, eq. 1).

    `PosingProblem` and `InterpolationProblem` are problems.
    """

    @property
    def mesh(self) -> Body:
        """The mesh whose elements all shapes share."""
        ...

    @property
    def material(self) -> Material:
        """The material of the body; moduli are uniform, or one per cell of the mesh."""
        ...

    @property
    def element_material(self) -> Material | ShellMaterial:
        """The material of the elements of the mesh: tets, or triangles and hinges."""
        ...

    @property
    def domain(self) -> ProblemDomain:
        """The domain of the parameters."""
        ...

    @property
    def parameter_count(self) -> int:
        """Number of entries p of a parameter vector."""
        ...

    @property
    def base(self) -> FloatArray:
        """Shape (3n,) from which the solvers measure displacements."""
        ...

    @property
    def tau(self) -> FloatArray:
        """Shape (3n,) that subspaces go through."""
        ...

    @property
    def system(self) -> Any:
        """The compiled problem: solve_fast and solve_newton."""
        ...

    @property
    def solving(self) -> SolverTraits:
        """What this problem needs of the solvers."""
        ...

    @property
    def fingerprint(self) -> str:
        """Hash of everything that solutions depend on."""
        ...

    def mass(self, *, lumped: bool = False) -> csr_array:
        """Mass matrix (n, n) of tau, in whose norm shapes are compared."""
        ...

    def check(self, parameters: FloatArray) -> None:
        """ValueError unless a parameter vector (p,) can be solved for."""
        ...

    def inputs(self, parameters: FloatArray) -> FloatArray:
        """Inputs of the system for parameters (k, p)."""
        ...

    def guesses(self, parameters: FloatArray) -> FloatArray | None:
        """Displacements (k, 3n) from `base` near the solutions for parameters (k, p), or None."""
        ...

    def known_solutions(self) -> tuple[FloatArray, FloatArray]:
        """Parameters (j, p) and shapes (j, 3n) of solutions that are known beforehand."""
        ...

    def aligned(self, shape: FloatArray, onto: FloatArray) -> FloatArray:
        """A shape (3n,) moved onto another one, as far as solutions are free to move."""
        ...

    def registered(self, displacements: FloatArray) -> FloatArray:
        """Solutions (k, 3n), as displacements from `base`, moved to where they can be compared."""
        ...


def is_quartic(problem: Problem) -> bool:
    """Whether the elastic energy is a polynomial of degree four of the shape: StVK in tets."""
    return isinstance(problem.mesh, TetMesh) and problem.material.exact_degree == 4


def solutions_beyond_tau(problem: Problem) -> tuple[FloatArray, FloatArray]:
    """The known solutions that are not tau itself: parameters (j, p) and shapes (j, 3n)."""
    parameters, shapes = problem.known_solutions()
    differs = (shapes != problem.tau).any(axis=1)
    return parameters[differs], shapes[differs]
