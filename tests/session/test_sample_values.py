"""A drag compares its frames with training samples, at no cost; a jump starts from them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import InterpolationModel
from snapspace.session import BlendingSession
from snapspace.session.sample_values import SampleValues

from ..shells.strips import blended_strips

FloatArray = NDArray[np.float64]
MODELS = ["blending_model", "blended_cubature_model", "stars"]
#: Ends of a drag, whose steps are shorter than the distance of any sample from it.
START, END = np.array([0.2, 0.6, 0.2]), np.array([0.5, 0.1, 0.4])
SHARES = np.linspace(0.0, 1.0, 101)


class CountedLoop:
    """A loop that counts what a session evaluates besides its solves."""

    def __init__(self, loop: Any) -> None:
        self.__dict__["loop"] = loop
        self.__dict__["evaluations"] = 0

    def value_and_gradient(self, q: FloatArray) -> tuple[float, FloatArray]:
        self.__dict__["evaluations"] += 1
        return self.loop.value_and_gradient(q)  # type: ignore[no-any-return]

    def __getattr__(self, name: str) -> Any:
        return getattr(self.loop, name)

    def __setattr__(self, name: str, value: Any) -> None:
        setattr(self.loop, name, value)


@pytest.fixture(scope="module")
def stars() -> InterpolationModel:
    return blended_strips()


@pytest.fixture(params=MODELS)
def model(request: pytest.FixtureRequest) -> InterpolationModel:
    made: InterpolationModel = request.getfixturevalue(request.param)
    return made


def drag(session: BlendingSession, shares: Sequence[float]) -> list[str]:
    """Where the frames between START and END start."""
    return [session.blend(START + t * (END - START)).start for t in shares]


@pytest.mark.parametrize("dimension", [None, 3])
def test_energies_of_samples_are_sums_over_the_poses(
    model: InterpolationModel, dimension: int | None
) -> None:
    session = model.session()
    session.dimension = dimension or model.dimension
    coordinates = model.training_coordinates[:, : session.dimension]
    poses = len(session.weights)
    values = SampleValues(session._loop, coordinates, poses)
    rng = np.random.default_rng(0)
    ones = np.ones(poses)
    for weights in [*rng.dirichlet(ones, 4), *np.eye(poses), *rng.dirichlet(ones, 2)]:
        session._set_weights(weights)
        for sample in (0, 3):
            expected = session._loop.value_and_gradient(coordinates[sample])[0]
            scale = model.value_scale + abs(expected)
            assert values(sample, weights) == pytest.approx(expected, abs=1e-11 * scale)
        after = session._loop.value_and_gradient(coordinates[1])[0]
        session._loop.set_weights(weights)
        assert session._loop.value_and_gradient(coordinates[1])[0] == after


def test_a_drag_evaluates_a_sample_once_for_every_pose(model: InterpolationModel) -> None:
    session = model.session()
    drag(session, [0.0])
    loop = CountedLoop(session._loop)
    session._loop, session._sample_values = loop, None
    assert set(drag(session, SHARES[1:].tolist())) == {"last frame"}
    passed = len(np.unique(nearest_samples(model)))
    assert 0 < loop.evaluations <= passed * len(session.weights)
    once = loop.evaluations
    drag(session, SHARES[::-1][1:].tolist())
    assert loop.evaluations <= once + len(session.weights), "known samples cost nothing"


def nearest_samples(model: InterpolationModel) -> NDArray[np.intp]:
    path = START + SHARES[:, None] * (END - START)
    away = ((model.training_parameters - path[:, None]) ** 2).sum(axis=2)
    return away.argmin(axis=1)


def test_a_jump_compares_two_energies(model: InterpolationModel) -> None:
    session = model.session()
    drag(session, [0.0])
    loop = CountedLoop(session._loop)
    session._loop = loop
    drag(session, [1.0])
    assert loop.evaluations == 2


def test_a_drag_leaves_a_frame_that_is_above_the_sample(model: InterpolationModel) -> None:
    """One iteration from far away ends above the sample, so that the frame is solved from there."""
    session, fresh = model.session(), model.session()
    fresh.blend(model.training_parameters[5])
    session.blend(model.training_parameters[5])
    far = model.training_coordinates[5] + 0.5 * model.coordinate_scale * np.ones(model.dimension)
    session._loop.q = far
    session.max_iterations = 1
    report = session.blend(model.training_parameters[5])
    assert report.start == "sample"
    assert report.value <= model.value(model.training_coordinates[5], model.training_parameters[5])
    assert np.linalg.norm(session.q - fresh.q) < 1e-2 * np.linalg.norm(far - fresh.q)
