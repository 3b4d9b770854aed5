"""Whether a basis is what an AffineSubspace says it is: M-orthonormal."""

from __future__ import annotations

import numpy as np

from ..mesh import apply_mass
from .affine_subspace import AffineSubspace

#: Of the deviation of U^T M U from the identity; single precision leaves 1e-7, and every solver
#: and error takes the identity for granted.
TOLERANCE = 1e-4
_PROBES = 8


def check_orthonormal(subspace: AffineSubspace, *, who: str) -> None:
    """ValueError of `who` unless U is (3n, d) and finite, and its columns are M-orthonormal.

    U^T M U is applied to eight random combinations, always the same ones, which costs a few
    products with U in place of d of them. No deviation is orthogonal to all of these.
    """
    n, (rows, d) = subspace.mass.shape[0], subspace.basis.shape
    if rows != 3 * n or rows != subspace.tau.size or not d:
        raise ValueError(
            f"{who}: the basis is {subspace.basis.shape}, but a mass matrix of {n} vertices and a "
            f"reference shape of {subspace.tau.size} coordinates need (3n, d) with d > 0"
        )
    if not np.isfinite(subspace.basis).all():
        raise ValueError(f"{who}: the basis of the subspace has numbers that are not finite")
    probes = np.random.default_rng(0).standard_normal((d, min(d, _PROBES)))
    probes /= np.linalg.norm(probes, axis=0)
    images = subspace.basis.T @ apply_mass(subspace.mass, subspace.basis @ probes)
    deviation = float(np.linalg.norm(images - probes, axis=0).max())
    if not deviation <= TOLERANCE:
        raise ValueError(
            f"{who}: the basis of the subspace is not M-orthonormal: U^T M U deviates from the "
            f"identity by {deviation:.2g}; affine_subspace(directions, problem) makes it so"
        )
