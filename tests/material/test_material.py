from __future__ import annotations

import math

import numpy as np
import pytest

from snapspace import StVK


def test_youngs_modulus_and_poisson_ratio_are_those_of_a_pulled_bar() -> None:
    """Hooke's law 2 mu e + lam tr(e) I: strain diag(1, -nu, -nu) has stress diag(E, 0, 0)."""
    youngs_modulus, poisson_ratio = 2.5, 0.3
    material = StVK.from_young(youngs_modulus=youngs_modulus, poisson_ratio=poisson_ratio)
    strain = np.diag([1.0, -poisson_ratio, -poisson_ratio])
    stress = 2 * material.mu * strain + material.lam * np.trace(strain) * np.eye(3)
    assert stress == pytest.approx(np.diag([youngs_modulus, 0.0, 0.0]), abs=1e-12)


def test_default_is_that_of_the_paper() -> None:
    assert StVK() == StVK(lam=1.0, mu=1.0)


def test_a_material_without_volume_term_is_allowed() -> None:
    assert StVK(lam=0.0).lam == 0.0
    assert StVK.from_young(youngs_modulus=1.0, poisson_ratio=0.0).lam == 0.0


@pytest.mark.parametrize("mu", [0.0, -1.0, math.nan, math.inf])
def test_mu_must_be_positive_and_finite(mu: float) -> None:
    with pytest.raises(ValueError, match=r"StVK: mu is .*shear modulus must be positive"):
        StVK(mu=mu)


@pytest.mark.parametrize("lam", [-1e-3, math.nan, math.inf])
def test_lam_must_not_be_negative(lam: float) -> None:
    with pytest.raises(ValueError, match=r"StVK: lam is .*must be zero or positive"):
        StVK(lam=lam)


@pytest.mark.parametrize("youngs_modulus", [0.0, -1.0, math.nan, math.inf])
def test_youngs_modulus_must_be_positive(youngs_modulus: float) -> None:
    with pytest.raises(ValueError, match=r"youngs_modulus is .*must be positive"):
        StVK.from_young(youngs_modulus=youngs_modulus, poisson_ratio=0.3)


@pytest.mark.parametrize("poisson_ratio", [-0.1, 0.5, math.nan])
def test_poisson_ratio_must_be_below_a_half(poisson_ratio: float) -> None:
    with pytest.raises(ValueError, match=r"poisson_ratio is .*must be in \[0, 0\.5\)"):
        StVK.from_young(youngs_modulus=1.0, poisson_ratio=poisson_ratio)
