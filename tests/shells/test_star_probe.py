"""Residuals of as-rigid-as-possible surfaces are those of the full objective."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import ARAP, InterpolationModel, PosingModel
from snapspace.certificate import ResidualSample, residual_probe

from .strips import WIDE, blended_strips, shell_model

FloatArray = NDArray[np.float64]
WEIGHTS = np.array([0.7, 0.5, -0.2])


@pytest.fixture(params=[0.0, WIDE], ids=["rings", "radius"], scope="module")
def posed(request: pytest.FixtureRequest) -> PosingModel:
    return shell_model(ARAP(), varied=True, radius=request.param)


@pytest.fixture(params=[0.0, WIDE], ids=["rings", "radius"], scope="module")
def blended(request: pytest.FixtureRequest) -> InterpolationModel:
    return blended_strips(ARAP(radius=request.param))


def some_shape(model: PosingModel | InterpolationModel) -> FloatArray:
    d = model.dimension
    return np.asarray(0.05 * model.coordinate_scale * np.linspace(1.0, -1.0, d))


def samples(gradient: FloatArray) -> list[tuple[ResidualSample, float]]:
    """Samples of all and of few vertices, one of them twice, and the norms of the gradient."""
    n = len(gradient) // 3
    squares = (gradient.reshape(-1, 3) ** 2).sum(axis=1)
    everything = np.arange(n, dtype=np.int32)
    weights = np.random.default_rng(3).uniform(1.0, 2.0, n)
    few = np.array([0, n // 2, n // 2, n - 1], np.int32)
    return [
        (ResidualSample(vertices, own), float(np.sqrt(own @ squares[vertices])))
        for vertices, own in ((everything, weights), (few, np.array([1.0, 2.0, 3.0, 4.0])))
    ]


def test_residuals_of_a_posed_surface(posed: PosingModel) -> None:
    problem, q = posed.problem, some_shape(posed)
    parameters = 0.3 * problem.domain.half_widths
    inputs = problem.inputs(parameters[None])[0]
    for size in (posed.dimension, 3):
        displacement = posed.subspace.basis[:, :size] @ q[:size]
        _, gradient = problem.system.value_and_gradient(displacement, inputs)
        for chosen, expected in samples(gradient):
            probe = residual_probe(problem, posed.subspace, chosen)
            found = probe.norm(q[:size], problem.offsets(parameters))
            assert found == pytest.approx(expected, rel=1e-6)


def test_residuals_of_a_blend(blended: InterpolationModel) -> None:
    problem, q = blended.problem, some_shape(blended)
    shape = blended.subspace.tau + blended.subspace.basis @ q
    for weights in (WEIGHTS, np.array([0.0, 0.4, 0.6])):
        _, gradient = problem.value_and_gradient(shape, weights)
        for chosen, expected in samples(gradient):
            probe = residual_probe(problem, blended.subspace, chosen)
            assert probe.norm(q, weights) == pytest.approx(expected, rel=1e-6)
