"""KeptFactor: an inverse Hessian that learns from steps."""

from __future__ import annotations

import numpy as np
from scipy.linalg import cho_factor

from snapspace.session.kept_factor import KeptFactor

CHANCE = np.random.default_rng(5)
SIZE = 6


def definite() -> np.ndarray:
    half = CHANCE.standard_normal((SIZE, SIZE))
    return half @ half.T + np.eye(SIZE)


def test_a_fresh_one_gives_newtons_direction() -> None:
    hessian, gradient = definite(), CHANCE.standard_normal(SIZE)
    kept = KeptFactor(cho_factor(hessian))
    np.testing.assert_allclose(hessian @ kept.direction(gradient), -gradient, atol=1e-12)


def test_it_meets_the_secant_equation_of_its_last_step() -> None:
    """Where the Hessian has changed, the last change of the gradient gives the last step."""
    kept, now = KeptFactor(cho_factor(definite())), definite()
    for _ in range(3):
        step = CHANCE.standard_normal(SIZE)
        kept.learn(step, now @ step)
        np.testing.assert_allclose(kept.direction(now @ step), -step, rtol=1e-9, atol=1e-9)
    gradient = CHANCE.standard_normal(SIZE)
    assert kept.direction(gradient) @ gradient < 0.0, "a direction of descent"


def test_it_minimises_a_quadratic_whose_hessian_it_does_not_have() -> None:
    """With exact line searches BFGS ends after as many steps as there are dimensions."""
    kept, now, at = KeptFactor(cho_factor(definite())), definite(), CHANCE.standard_normal(SIZE)
    for _ in range(SIZE):
        gradient = now @ at
        move = kept.direction(gradient)
        step = -float(move @ gradient) / float(move @ now @ move) * move
        kept.learn(step, now @ step)
        at = at + step
    assert np.abs(at).max() < 1e-9


def test_steps_along_which_the_energy_curves_downwards_are_not_learned() -> None:
    kept = KeptFactor(cho_factor(definite()))
    step, gradient = CHANCE.standard_normal((2, SIZE))
    before = kept.direction(gradient)
    kept.learn(step, -step)
    kept.learn(step, np.zeros(SIZE))
    np.testing.assert_array_equal(kept.direction(gradient), before)
