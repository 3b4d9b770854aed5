"""check_orthonormal: checks that the basis of an AffineSubspace is M-orthonormal."""

from __future__ import annotations

import numpy as np

from ..blas import single_threaded_blas
from ..mesh import apply_mass
from .affine_subspace import AffineSubspace

#: Largest deviation of U^T M U from the identity. Single precision leaves 1e-7; all solvers and
#: errors assume the identity.
TOLERANCE = 1e-4
_PROBES = 8


@single_threaded_blas
def check_orthonormal(subspace: AffineSubspace, *, who: str) -> None:
    """Raises a ValueError in the name of `who` unless U is (3n, d), finite and M-orthonormal.

    The check applies U^T M U to eight random vectors, always the same ones, which costs eight
    products with U instead of d. A deviation from the identity is almost never zero on all of them.
    """
    n, (rows, d) = subspace.mass.shape[0], subspace.basis.shape
    if rows != 3 * n or rows != subspace.tau.size or not d:
        raise ValueError(
            f"{who}: the basis is {subspace.basis.shape}, but a mass matrix of {n} vertices and a "
            f"reference shape of {subspace.tau.size} coordinates need (3n, d) with d > 0"
        )
    if not np.isfinite(subspace.basis).all():
        raise ValueError(f"{who}: the basis of the subspace has numbers that are not finite")
    probes = np.random.default_rng(0).standard_normal((d, min(d, _PROBES))).T
    probes /= np.linalg.norm(probes, axis=1, keepdims=True)
    images = apply_mass(subspace.mass, probes @ subspace.basis.T) @ subspace.basis
    deviation = float(np.linalg.norm(images - probes, axis=1).max())
    if not deviation <= TOLERANCE:
        raise ValueError(
            f"{who}: the basis of the subspace is not M-orthonormal: U^T M U deviates from the "
            f"identity by {deviation:.2g}; affine_subspace(directions, problem) makes an "
            "orthonormal one"
        )
