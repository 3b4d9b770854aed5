"""Mass of linear tets and triangles at density 1: the scalar matrix M, applied to shape vectors.

A shape vector is (n, 3) vertices flattened, x0 y0 z0 x1 ...; its mass matrix is M kron I3. That
3n x 3n matrix is never formed: M is applied to the three coordinates at once.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import coo_array, csr_array, diags_array, issparse

from ..arguments import wrong_type
from .arrays import FloatArray, IndexArray
from .body import Body
from .check_body import check_body
from .shape_rows import shape_or_rows, shape_rows


def mass_matrix(mesh: Body, *, lumped: bool = False) -> csr_array:
    """Mass matrix of the linear tets, or triangles, at density 1.

    Parameters
    ----------
    mesh : TetMesh or ShellMesh
    lumped : bool, default False
        True puts `mesh.vertex_masses` (the row sums) on the diagonal.

    Returns
    -------
    csr_array, (n, n) float64
        Symmetric positive definite; all entries sum to the volume. The consistent matrix has
        volume / 20 * (1 + delta_ij) per tet and volume / 12 * (1 + delta_ij) per triangle
        (Zienkiewicz & Taylor, The Finite Element Method), so that x^T M y is the exact integral of
        the product of two piecewise linear functions.

    Raises
    ------
    ValueError
        For something other than a mesh.
    """
    check_body(mesh, "mass_matrix")
    return mass_of_cells(mesh.cells, mesh.volumes, lumped=lumped)


def mass_of_cells(cells: IndexArray, volumes: FloatArray, *, lumped: bool = False) -> csr_array:
    """`mass_matrix` for tets (m, 4) or triangles (m, 3) of volumes (m,), all positive."""
    n, k = int(cells.max()) + 1, cells.shape[1]
    if lumped:
        share = np.repeat(volumes / k, k)
        return csr_array(diags_array(np.bincount(cells.ravel(), share, minlength=n)))
    edges = np.array(list(combinations(range(k), 2)))
    pairs = np.sort(cells[:, edges], axis=2).reshape(-1, 2)
    values = np.repeat(volumes / (k * (k + 1.0)), len(edges))
    above = csr_array(coo_array((values, (pairs[:, 0], pairs[:, 1])), shape=(n, n)))
    twice = np.repeat(2.0 * volumes / (k * (k + 1.0)), k)
    return csr_array(above + above.T + diags_array(np.bincount(cells.ravel(), twice, minlength=n)))


def check_mass(mass: csr_array, size: int | None = None, *, who: str) -> None:
    """ValueError of `who` unless `mass` is a csr_array (n, n), for shape vectors of size 3n."""
    if not isinstance(mass, csr_array):
        cure = "give mass_matrix(mesh) or problem.mass()"
        if issparse(mass):
            cure = "give scipy.sparse.csr_array(mass)"
        raise wrong_type(who, "mass", mass, cure)
    n = mass.shape[0] if size is None else size // 3
    if mass.shape != (n, n):
        raise ValueError(f"{who}: mass has shape {mass.shape}, but must be ({n}, {n})")


def apply_mass(mass: csr_array, shapes: ArrayLike) -> FloatArray:
    """(M kron I3) times shape vectors, one per row; for a basis U (3n, d) pass U.T.

    Parameters
    ----------
    mass : csr_array, (n, n)
        M, from `mass_matrix`.
    shapes : array_like, (3n,) or (k, 3n)
        One shape vector, or one per row.

    Returns
    -------
    ndarray
        The product, with the shape of `shapes`.

    Raises
    ------
    ValueError
        For an array of another shape.
    """
    x = shape_or_rows(shapes, 3 * mass.shape[0], who="apply_mass")
    product = np.empty(x.shape)
    for target, shape in zip(np.atleast_2d(product), np.atleast_2d(x), strict=True):
        # the three coordinates are right-hand sides
        target[:] = (mass @ shape.reshape(-1, 3)).reshape(-1)
    return product


def mass_inner(mass: csr_array, a: FloatArray, b: FloatArray) -> float:
    """Inner product a^T (M kron I3) b of two shape vectors, both (3n,).

    Raises ValueError for blocks of shapes; use `mass_gram` for these.
    """
    _check_vector(a, who="mass_inner", block="mass_gram")
    _check_vector(b, who="mass_inner", block="mass_gram")
    return float(np.dot(a, apply_mass(mass, b)))


def mass_gram(mass: csr_array, a: ArrayLike, b: ArrayLike) -> FloatArray:
    """Inner products A (M kron I3) B^T of all rows of (k, 3n) and (l, 3n): (k, l).

    For a basis U (3n, d) pass U.T. Raises ValueError for other shapes, and for two vectors; use
    `mass_inner` for these.
    """
    size = 3 * mass.shape[0]
    left = shape_rows(a, size, who="mass_gram", what="a")
    right = shape_rows(b, size, who="mass_gram", what="b")
    gram: FloatArray = left @ apply_mass(mass, right).T
    return gram


def mass_norm(mass: csr_array, a: FloatArray) -> float:
    """Norm sqrt(a^T (M kron I3) a) of a shape vector (3n,): for a displacement, its L2 norm.

    Raises ValueError for a block of shapes; use `mass_norms` for these.
    """
    _check_vector(a, who="mass_norm", block="mass_norms")
    return float(np.sqrt(np.dot(a, apply_mass(mass, a))))


def mass_norms(mass: csr_array, a: ArrayLike) -> FloatArray:
    """Norms (k,) of the rows of a block of shapes (k, 3n).

    Raises ValueError for other shapes, and for a vector; use `mass_norm` for that.
    """
    rows = shape_rows(a, 3 * mass.shape[0], who="mass_norms", what="a")
    norms: FloatArray = np.sqrt(np.einsum("ij,ij->i", rows, apply_mass(mass, rows)))
    return norms


def _check_vector(shape: FloatArray, *, who: str, block: str) -> None:
    if np.ndim(shape) != 1:
        raise ValueError(
            f"{who}: needs shape vectors (3n,), got {np.shape(shape)}; {block} takes one shape per "
            "row"
        )
