"""A probe reads the gradient of the full objective, for every registered material."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import PosingModel
from snapspace.certificate import ResidualSample, residual_probe
from snapspace.material import MATERIALS

from ..page.material_models import material_model


@pytest.mark.parametrize("kind", sorted(MATERIALS))
def test_it_is_the_full_gradient_with_moduli_of_single_tets(
    cubature_model: PosingModel, kind: str
) -> None:
    model = material_model(cubature_model, kind)
    problem, n = model.problem, len(model.problem.mesh.vertices)
    q = 0.02 * model.coordinate_scale * np.linspace(1.0, -1.0, model.dimension)
    parameters = 0.3 * problem.domain.half_widths
    displacement = model.subspace.basis @ q
    inputs = problem.inputs(parameters[None])[0]
    _, gradient = problem.system.value_and_gradient(displacement, inputs)
    squares = (gradient.reshape(-1, 3) ** 2).sum(axis=1)
    weights = np.random.default_rng(3).uniform(1.0, 2.0, n)
    everything = ResidualSample(np.arange(n, dtype=np.int32), weights)
    offsets = problem.offsets(parameters)
    found = residual_probe(problem, model.subspace, everything).norm(q, offsets)
    assert found == pytest.approx(np.sqrt(weights @ squares), rel=1e-9)
    few = np.array([0, n // 2, n // 2, n - 1], np.int32)
    sample = ResidualSample(few, np.array([1.0, 2.0, 3.0, 4.0]))
    found = residual_probe(problem, model.subspace, sample).norm(q, offsets)
    assert found == pytest.approx(np.sqrt(sample.weights @ squares[few]), rel=1e-9)


def test_arguments_of_another_size_are_refused(cubature_model: PosingModel) -> None:
    model = cubature_model
    sample = ResidualSample(model.problem.pinned[:2], np.ones(2))
    probe = residual_probe(model.problem, model.subspace, sample)
    offsets = np.zeros((3, 3, 4))
    with pytest.raises(ValueError, match="more entries than there are modes"):
        probe.norm(np.zeros(model.dimension + 1), offsets)
    with pytest.raises(ValueError, match=r"offsets must be \(handles, 3, 4\)"):
        probe.norm(np.zeros(2), np.zeros((3, 3, 3)))
    with pytest.raises(ValueError, match="has vertex 1000000, but the mesh has"):
        residual_probe(
            model.problem, model.subspace, ResidualSample(np.array([10**6], np.int32), np.ones(1))
        )
