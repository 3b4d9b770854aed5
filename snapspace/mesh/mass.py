"""Mass of linear tets at density 1: the scalar mass matrix M, and M applied to shape vectors.

A shape vector is (n, 3) vertices flattened, x0 y0 z0 x1 ...; its mass matrix is M kron I3. That
3n x 3n matrix is never formed: M is applied to the three coordinates at once.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array

from .arrays import FloatArray, IndexArray
from .tet_mesh import TetMesh

_EDGES = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]])


def mass_matrix(mesh: TetMesh, *, lumped: bool = False) -> csr_array:
    """Mass matrix of the linear tets at density 1.

    Parameters
    ----------
    mesh : TetMesh
    lumped : bool, default False
        True puts `mesh.vertex_masses` (the row sums) on the diagonal.

    Returns
    -------
    csr_array, (n, n) float64
        Symmetric positive definite; all entries sum to the volume. The consistent matrix has
        volume / 20 * (1 + delta_ij) per tet (Zienkiewicz & Taylor, The Finite Element Method), so
        that x^T M y is the exact integral of the product of two piecewise linear functions.
    """
    return mass_of_tets(mesh.tets, mesh.volumes, lumped=lumped)


def mass_of_tets(tets: IndexArray, volumes: FloatArray, *, lumped: bool = False) -> csr_array:
    """`mass_matrix` for tets (m, 4) of given volumes (m,), all positive."""
    n = int(tets.max()) + 1
    if lumped:
        quarter = np.repeat(volumes / 4.0, 4)
        return csr_array(diags_array(np.bincount(tets.ravel(), quarter, minlength=n)))
    pairs = np.sort(tets[:, _EDGES], axis=2).reshape(-1, 2)
    values = np.repeat(volumes / 20.0, len(_EDGES))
    above = csr_array(coo_array((values, (pairs[:, 0], pairs[:, 1])), shape=(n, n)))
    diagonal = np.bincount(tets.ravel(), np.repeat(volumes / 10.0, 4), minlength=n)
    return csr_array(above + above.T + diags_array(diagonal))


def apply_mass(mass: csr_array, shapes: FloatArray) -> FloatArray:
    """(M kron I3) times shape vectors.

    Parameters
    ----------
    mass : csr_array, (n, n)
        M, from `mass_matrix`.
    shapes : ndarray, (3n,) or (3n, k)
        One shape vector, or one per column.

    Returns
    -------
    ndarray
        The product, with the shape of `shapes`.

    Raises
    ------
    ValueError
        If the number of rows is not 3n.
    """
    shapes = np.asarray(shapes, dtype=np.float64)
    n = mass.shape[0]
    if shapes.ndim not in (1, 2) or shapes.shape[0] != 3 * n:
        raise ValueError(
            f"apply_mass: shapes must be ({3 * n},) or ({3 * n}, k) for a mass matrix of {n} "
            f"vertices, got {shapes.shape}"
        )
    # row 3i + c, column j  ->  row i, column (c, j): the coordinates become right-hand sides
    product = mass @ shapes.reshape(n, -1)
    return np.asarray(product, dtype=np.float64).reshape(shapes.shape)


def mass_inner(mass: csr_array, a: FloatArray, b: FloatArray) -> float:
    """Inner product a^T (M kron I3) b of two shape vectors, both (3n,).

    Raises ValueError for blocks of shapes, which `mass_gram` takes.
    """
    _check_vector(a, who="mass_inner", block="mass_gram")
    _check_vector(b, who="mass_inner", block="mass_gram")
    return float(np.dot(a, apply_mass(mass, b)))


def mass_gram(mass: csr_array, a: FloatArray, b: FloatArray) -> FloatArray:
    """Inner products A^T (M kron I3) B of all columns of (3n, k) and (3n, l): (k, l)."""
    if np.ndim(a) != 2 or np.ndim(b) != 2:
        raise ValueError(
            f"mass_gram: needs two blocks with one shape per column, got {np.shape(a)} and "
            f"{np.shape(b)}; mass_inner is for two vectors"
        )
    return np.asarray(np.asarray(a).T @ apply_mass(mass, b), dtype=np.float64)


def mass_norm(mass: csr_array, a: FloatArray) -> float:
    """Norm sqrt(a^T (M kron I3) a) of a shape vector (3n,): for a displacement, its L2 norm.

    Raises ValueError for a block of shapes, which `mass_norms` takes.
    """
    _check_vector(a, who="mass_norm", block="mass_norms")
    return float(np.sqrt(np.dot(a, apply_mass(mass, a))))


def mass_norms(mass: csr_array, a: FloatArray) -> FloatArray:
    """Norms of the columns of a (3n, k) block of shapes, (k,)."""
    if np.ndim(a) != 2:
        raise ValueError(
            f"mass_norms: needs a block with one shape per column, got {np.shape(a)}; mass_norm is "
            "for a vector"
        )
    return np.asarray(np.sqrt(np.einsum("ij,ij->j", a, apply_mass(mass, a))), dtype=np.float64)


def _check_vector(shape: FloatArray, *, who: str, block: str) -> None:
    if np.ndim(shape) != 1:
        raise ValueError(
            f"{who}: needs shape vectors (3n,), got {np.shape(shape)}; {block} takes one shape per "
            "column"
        )
