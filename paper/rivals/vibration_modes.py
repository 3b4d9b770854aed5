"""Vibration modes: the softest deformations of a free body (Pentland & Williams 1989)."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import bsr_array, csr_array, kron
from scipy.sparse.linalg import LinearOperator, eigsh

import snapspace as ss
from snapspace import _core as core

from .sparse_solver import SparseSolver

FloatArray = NDArray[np.float64]

#: Rigid motions of a free body in three dimensions.
RIGID = 6
#: Share of an eigenvalue bound by which the singular stiffness matrix is shifted.
SHIFT = 1e-6


@dataclass(frozen=True, eq=False)
class Vibrations:
    """The softest vibration modes of a free body at rest, without its rigid motions.

    K modes_i = eigenvalues_i M modes_i, and modes^T M modes = I.

    energy : elastic energy of displacements from rest
    stiffness : (3n, 3n) its Hessian K at rest
    mass : (3n, 3n) mass matrix M of x, y, z
    rigid : (3n, 6) M-orthonormal infinitesimal rigid motions
    modes : (3n, m), softest first
    eigenvalues : (m,), ascending
    solver : solver for K + s M, with a small shift s that makes it definite
    """

    energy: core.ElasticEnergy
    stiffness: csr_array
    mass: csr_array
    rigid: FloatArray
    modes: FloatArray
    eigenvalues: FloatArray
    solver: SparseSolver


def vibrations(
    energy: core.ElasticEnergy, mass: csr_array, vertices: FloatArray, count: int
) -> Vibrations:
    """The `count` softest modes of a body with this energy at rest; handles are ignored.

    Parameters
    ----------
    energy : ElasticEnergy of displacements from rest
    mass : (n, n) scalar mass matrix
    vertices : (n, 3) rest shape
    count : m >= 1

    Raises
    ------
    scipy.sparse.linalg.ArpackNoConvergence
        If the modes are not found.
    """
    stiffness = hessian_at(energy, np.zeros(vertices.size))
    mass3 = csr_array(kron(mass, np.eye(3)))
    rigid = rigid_motions(vertices, mass3)
    shift = SHIFT * float(stiffness.diagonal().sum() / mass3.diagonal().sum())
    solver = _solver(_Matrix.of(csr_array(stiffness + shift * mass3)))

    def deflated(right: FloatArray) -> FloatArray:
        solved = solver.solve(right)
        return solved - rigid @ (rigid.T @ (mass3 @ solved))

    inverse = LinearOperator(stiffness.shape, matvec=deflated, dtype=np.float64)
    start = deflated(np.random.default_rng(0).standard_normal(vertices.size))
    values, modes = eigsh(
        stiffness, count, mass3, sigma=-shift, OPinv=inverse, v0=start, which="LM"
    )
    order = np.argsort(values)
    return Vibrations(energy, stiffness, mass3, rigid, modes[:, order], values[order], solver)


@dataclass(frozen=True)
class _Matrix:
    """A matrix compared by its entries, so that its factor is found in the cache."""

    digest: str
    content: csr_array = field(compare=False, repr=False)

    @classmethod
    def of(cls, content: csr_array) -> _Matrix:
        digest = hashlib.sha256(content.data.tobytes())
        digest.update(content.indices.tobytes())
        return cls(digest.hexdigest(), content)


@lru_cache(maxsize=1)
def _solver(matrix: _Matrix) -> SparseSolver:
    """The factor of a body, shared by its subspaces because it takes longer than their modes."""
    return SparseSolver(matrix.content, per_vertex=3)


def forget_factors() -> None:
    """Lets the next subspace factor its body again, so that its time includes that."""
    _solver.cache_clear()


def vibration_subspace(problem: ss.PosingProblem, dimension: int) -> ss.AffineSubspace:
    """The `dimension` softest modes of the body at rest, its six rigid motions first.

    ValueError for a dimension below seven.
    """
    if dimension <= RIGID:
        raise ValueError(f"vibration_subspace: dimension is {dimension}, but must be above {RIGID}")
    body = (problem.energy.core, problem.mass(), problem.mesh.vertices)
    found = vibrations(*body, dimension - RIGID)
    return ss.affine_subspace(np.hstack([found.rigid, found.modes]), problem)


def hessian_at(energy: core.ElasticEnergy, displacement: FloatArray) -> csr_array:
    """Hessian (3n, 3n) of an elastic energy."""
    starts, columns, blocks = energy.hessian_blocks(displacement)
    size = displacement.size
    return bsr_array((blocks, columns, starts), shape=(size, size)).tocsr()


def rigid_motions(vertices: FloatArray, mass: csr_array) -> FloatArray:
    """M-orthonormal translations and infinitesimal rotations (3n, 6) of a shape."""
    motions = np.zeros((len(vertices), 3, RIGID))
    centered = vertices - vertices.mean(axis=0)
    for axis in range(3):
        motions[:, axis, axis] = 1.0
        motions[:, :, 3 + axis] = np.cross(np.eye(3)[axis], centered)
    flat = motions.reshape(-1, RIGID)
    factor = np.linalg.cholesky(flat.T @ (mass @ flat))
    return np.asarray(np.linalg.solve(factor, flat.T).T, np.float64)
