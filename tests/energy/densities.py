"""All materials of the registry, helpers to evaluate them, and formulas of some.

A density that is registered later is tested for every property that needs no formula. With a line
in `FORMULAS` its values and stresses are compared, too.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from snapspace import MATERIALS, Material
from snapspace import _core as core

from ..shapes import CORNER_TET

FloatArray = NDArray[np.float64]
LAM, MU = 1.5, 0.7
KINDS = list(MATERIALS.values())
#: One material of each kind, with different Lame parameters.
EACH = [kind.from_lame(lam=LAM, mu=MU) for kind in KINDS]

every_kind = pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.kind)
every_material = pytest.mark.parametrize("material", EACH, ids=lambda material: material.kind)


def varied(kind: type[Material], tets: int, *, seed: int = 6) -> Material:
    """A material with its own moduli in every tet."""
    lam, mu = np.random.default_rng(seed).uniform(0.3, 3.0, (2, tets))
    return kind.from_lame(lam=lam, mu=mu)


def single_tets(material: Material, count: int) -> core.ElasticEnergy:
    """The energy of `count` unit corner tets that share no vertex, each of volume 1/6."""
    tets = np.arange(4 * count, dtype=np.int32).reshape(-1, 4)
    return core.ElasticEnergy(np.tile(CORNER_TET, (count, 1)), tets, material.core)


def displacements(F: FloatArray) -> FloatArray:
    """Displacements (12 k,) of `single_tets` with deformation gradients F (k, 3, 3)."""
    u = np.zeros((len(F), 4, 3))
    u[:, 1:] = (F - np.eye(3)).swapaxes(1, 2)
    return u.reshape(-1)


def densities(material: Material, F: FloatArray) -> tuple[FloatArray, FloatArray]:
    """psi (k,) and the first Piola-Kirchhoff stress (k, 3, 3) at F (k, 3, 3)."""
    stresses, energies = single_tets(material, len(F)).tet_stresses(displacements(F))
    return 6.0 * energies, 6.0 * stresses.reshape(-1, 3, 3)


def has_barrier(material: Material) -> bool:
    """Whether the density is infinite for inverted tets."""
    return not np.isfinite(densities(material, np.diag([1.0, 1.0, -1.0])[None])[0][0])


def random_stretches(count: int, *, inverted: bool, seed: int = 3) -> FloatArray:
    """Signed singular values (count, 3), the last one negative if `inverted`.

    No two of them nearly cancel: there the nearest rotation jumps.
    """
    s = np.random.default_rng(seed).uniform(0.2, 2.0, (count, 3))
    s = -np.sort(-s, axis=1)
    if inverted:
        s[:, :2] += 0.5
        s[:, 2] *= -1.0
    return s


def turned(s: FloatArray, *, seed: int = 4) -> tuple[FloatArray, FloatArray, FloatArray]:
    """F = U diag(s) V^T with random rotations U and V; returns F, U and V."""
    U = Rotation.random(len(s), random_state=seed).as_matrix()
    V = Rotation.random(len(s), random_state=seed + 1).as_matrix()
    return U * s[:, None, :] @ V.swapaxes(1, 2), U, V


def _stvk(s: Any, lam: float, mu: float) -> Any:
    e = (s**2 - 1) / 2
    return mu * (e**2).sum(-1) + lam / 2 * e.sum(-1) ** 2


def _stable_neo_hookean(s: Any, lam: float, mu: float) -> Any:
    J = s.prod(-1)
    return mu / 2 * ((s**2).sum(-1) - 3) - mu * (J - 1) + (lam + mu) / 2 * (J - 1) ** 2


def _arap(s: Any, lam: float, mu: float) -> Any:
    return mu * ((s - 1) ** 2).sum(-1)


def _corotational(s: Any, lam: float, mu: float) -> Any:
    return _arap(s, lam, mu) + lam / 2 * (s.prod(-1) - 1) ** 2


def _symmetric_dirichlet(s: Any, lam: float, mu: float) -> Any:
    return mu / 4 * (s**2 + s**-2.0 - 2).sum(-1)


#: psi of signed singular values (..., 3), lam and mu; they may be complex.
FORMULAS: dict[str, Callable[[Any, float, float], Any]] = {
    "stvk": _stvk,
    "stable-neo-hookean": _stable_neo_hookean,
    "arap": _arap,
    "corotational": _corotational,
    "symmetric-dirichlet": _symmetric_dirichlet,
}
with_formula = pytest.mark.parametrize(
    "material", [m for m in EACH if m.kind in FORMULAS], ids=lambda material: material.kind
)


def formula(material: Material, s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """psi (k,) at signed singular values (k, 3), and its gradient (k, 3) by complex steps."""
    psi = FORMULAS[material.kind]
    gradient = [
        psi(s + 1e-100j * axis, material.lam, material.mu).imag / 1e-100 for axis in np.eye(3)
    ]
    return psi(s, material.lam, material.mu), np.stack(gradient, axis=1)
