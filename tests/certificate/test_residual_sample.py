"""A few vertices estimate the norm of the whole residual."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import InterpolationModel, PosingModel, Session
from snapspace.certificate import ResidualSample, residual_sample, scalar_diagonal

FloatArray = NDArray[np.float64]


@pytest.fixture(params=["posing", "blending"])
def session(
    request: pytest.FixtureRequest, posing_model: PosingModel, blending_model: InterpolationModel
) -> Session:
    """A session off its minimum: at the frame of handles or weights other than the present ones."""
    if request.param == "posing":
        posing = posing_model.session()
        half_widths = posing_model.problem.domain.half_widths
        posing.pose(0.5 * half_widths)
        q = posing.q
        posing.pose(-0.4 * half_widths)
        posing._loop.q = q
        return posing
    blending = blending_model.session()
    blending.blend([0.2, 0.7, 0.1])
    q = blending.q
    blending.blend([0.5, 0.1, 0.4])
    blending._loop.q = q
    return blending


def squares(session: Session) -> FloatArray:
    """|g_v|^2 of all vertices, from the full problem."""
    problem = session.model.problem
    u = session.model.subspace.shape(session.q) - problem.base
    gradient = problem.system.value_and_gradient(u, session._inputs())[1]
    return (gradient.reshape(-1, 3) ** 2).sum(axis=1)


def test_all_vertices_give_the_norm_itself(session: Session) -> None:
    diagonal = scalar_diagonal(session.model.problem)  # type: ignore[arg-type]
    everything = ResidualSample(np.arange(len(diagonal), dtype=np.int32), 1.0 / diagonal)
    norm = np.sqrt((squares(session) / diagonal).sum())
    assert session.residual(everything) == pytest.approx(norm, rel=1e-9)


def test_samples_are_right_on_average(session: Session) -> None:
    diagonal = scalar_diagonal(session.model.problem)  # type: ignore[arg-type]
    expected = np.random.default_rng(0).uniform(0.5, 2.0, len(diagonal)) * squares(session)
    truth = (squares(session) / diagonal).sum()
    estimates = [
        session.residual(residual_sample(expected, diagonal, count=32, seed=seed)) ** 2
        for seed in range(40)
    ]
    assert np.mean(estimates) == pytest.approx(truth, rel=0.1)
    assert np.std(estimates) < 0.3 * truth


def test_only_the_vertices_of_the_sample_matter(session: Session) -> None:
    """The sums over their own tets are complete, and their neighbours' sums are left out."""
    values = squares(session)
    for v in (0, len(values) // 2, len(values) - 1):
        alone = ResidualSample(np.array([v], np.int32), np.ones(1))
        assert session.residual(alone) ** 2 == pytest.approx(values[v], rel=1e-8)


def test_the_diagonal_is_that_of_the_factor(posing_model: PosingModel) -> None:
    """e_v^T A e_v of the matrix whose inverse the system applies.

    The factor of an interpolation takes the poses into account.
    """
    problem = posing_model.problem
    diagonal = scalar_diagonal(problem)
    n = len(diagonal)
    inverse = np.empty((n, n))
    for v, row in enumerate(inverse):
        unit = np.zeros((n, 3))
        unit[v, 0] = 1.0
        row[:] = problem.system.precondition(unit.reshape(-1)).reshape(n, 3)[:, 0]
    np.testing.assert_allclose(np.diag(np.linalg.inv(inverse)), diagonal, rtol=1e-6)


def test_without_any_residual_all_vertices_are_alike() -> None:
    sample = residual_sample(np.zeros(50), np.full(50, 2.0), count=10)
    np.testing.assert_allclose(sample.weights, 50 / (10 * 2.0))


def test_a_sample_of_another_mesh_is_refused(session: Session) -> None:
    with pytest.raises(ValueError, match="has vertex 100000, but the mesh has"):
        session.residual(ResidualSample(np.array([100_000], np.int32), np.ones(1)))
    with pytest.raises(ValueError, match="one positive weight per vertex"):
        ResidualSample(np.array([1, 2], np.int32), np.ones(1))
