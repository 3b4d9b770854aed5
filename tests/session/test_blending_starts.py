"""Where a blend starts, and that no weights break it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from snapspace import InterpolationModel, InterpolationProblem, StVK, TetMesh
from snapspace.generators import cylinder, helix

from ..conftest import interpolation_model
from ..shapes import irregular_bar

FloatArray = NDArray[np.float64]
TIGHT = 1e-12


@pytest.fixture(scope="module")
def twisted_helix() -> InterpolationModel:
    """A cylinder and a helix that is twisted once about its line: far poses have two paths."""
    coil = helix(2, 26, twist=2.0 * np.pi)
    return interpolation_model(
        InterpolationProblem([cylinder(2, 26), coil], material=StVK()), 30, 20
    )


def untrained(model: InterpolationModel) -> InterpolationModel:
    return replace(
        model,
        training_parameters=model.training_parameters[:0],
        training_coordinates=model.training_coordinates[:0],
    )


def by_small_steps(model: InterpolationModel, share: float) -> FloatArray:
    """Vertices at the end of a path of small steps from the mean shape."""
    session = model.session(tolerance=TIGHT)
    for t in np.linspace(0.5, share, 60):
        session.blend([1 - t, t])
    return session.vertices


def by_a_leap(model: InterpolationModel, share: float, *, start: float) -> FloatArray:
    session = model.session(tolerance=TIGHT)
    session.blend([1 - start, start])
    session.blend([1 - share, share])
    return session.vertices


@pytest.mark.parametrize("share", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("start", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("name", ["helix_model", "twisted_helix"])
def test_a_jump_ends_where_small_steps_end(
    name: str, share: float, start: float, request: pytest.FixtureRequest
) -> None:
    model: InterpolationModel = request.getfixturevalue(name)
    leap = by_a_leap(model, share, start=start)
    assert np.abs(leap - by_small_steps(model, share)).max() < 1e-3 * model.problem.mesh.diagonal


def test_without_training_data_a_jump_may_end_elsewhere(twisted_helix: InterpolationModel) -> None:
    """Without the nearest sample as a start, a twist of a whole turn stays locked in."""
    size = twisted_helix.problem.mesh.diagonal
    bare = untrained(twisted_helix)
    assert (
        np.abs(by_a_leap(bare, 0.0, start=0.5) - by_small_steps(twisted_helix, 0.0)).max()
        > 0.05 * size
    )


def test_solving_anew_leaves_a_minimum_that_is_not_the_lowest(
    twisted_helix: InterpolationModel,
) -> None:
    locked = untrained(twisted_helix).session(tolerance=TIGHT)
    locked.blend([0.5, 0.5])
    wrong = locked.blend([1.0, 0.0])
    session = twisted_helix.session(tolerance=TIGHT)
    session.blend([1.0, 0.0])
    session._loop.q = locked.q
    assert session.solve().value == pytest.approx(wrong.value), "a solve does not leave a minimum"
    report = session.solve_anew()
    assert report.start in ("tau", "sample") and report.value < wrong.value
    assert session.vertices == pytest.approx(by_small_steps(twisted_helix, 0.0), abs=1e-3)
    assert session.solve_anew().start == "last frame"


def test_a_jump_starts_from_the_nearest_sample(helix_model: InterpolationModel) -> None:
    """After a single step from the other end, the energy is below that of the sample."""
    known = zip(
        helix_model.training_parameters[:10], helix_model.training_coordinates[:10], strict=True
    )
    for w, q in known:
        session = helix_model.session()
        session.blend(np.eye(2)[w.argmin()])
        session.max_iterations = 1
        report = session.blend(w)
        assert report.value <= helix_model.value(q, w) * (1 + 1e-9)


def test_a_small_step_starts_from_the_last_frame(blending_model: InterpolationModel) -> None:
    """A sample is only taken where it is better: frames of a slow path take few iterations."""
    w, end = np.array([0.2, 0.7, 0.1]), np.array([0.7, 0.1, 0.2])
    near = w + 1e-3 * (end - w)
    session = blending_model.session()
    session.blend(w)
    warm = session.blend(near).iterations
    session.reset()
    assert warm < session.blend(near).iterations


def test_the_same_blends_give_bitwise_the_same_frames(blending_model: InterpolationModel) -> None:
    frames = []
    for _ in range(2):
        session = blending_model.session()
        for w in ([0.2, 0.7, 0.1], [0.0, 0.0, 1.0], [0.6, 0.4, 0.0]):
            session.blend(w)
        frames.append(session.vertices)
    assert np.array_equal(*frames)


def test_two_sessions_of_a_model_do_not_disturb_each_other(
    blending_model: InterpolationModel,
) -> None:
    one, other = blending_model.session(tolerance=TIGHT), blending_model.session(tolerance=TIGHT)
    one.blend([0.2, 0.7, 0.1])
    before = one.vertices
    other.blend([0.0, 0.0, 1.0])
    one.solve()
    assert np.abs(one.vertices - before).max() < 1e-6


def test_an_exhausted_budget_is_reported(helix_model: InterpolationModel) -> None:
    session = helix_model.session(max_iterations=1, tolerance=1e-7)
    report = session.blend([0.33, 0.67])
    assert report.status == "max_iterations" and not report.converged
    for _ in range(300):
        if (report := session.solve()).converged:
            break
    assert report.converged, "further solves converge"


ANY = st.floats(allow_nan=True, allow_infinity=True)


@given(
    path=st.lists(
        st.one_of(
            st.tuples(ANY, ANY, ANY),
            st.tuples(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3)).map(
                lambda ab: (ab[0], ab[1], 1.0 - ab[0] - ab[1])
            ),
            st.floats(1.0, 1e308).map(lambda a: (a, -a, 1.0)),
        ),
        max_size=4,
    )
)
@settings(max_examples=60)
def test_no_weights_make_a_shape_that_is_not_finite(
    blending_model: InterpolationModel, path: list[tuple[float, float, float]]
) -> None:
    """Whether refused or blended, a later blend inside the simplex is the usual one."""
    session = blending_model.session(tolerance=TIGHT)
    for weights in path:
        try:
            report = session.blend(weights, extrapolate=True)
        except ValueError:
            continue
        assert np.isfinite(session.vertices).all()
        assert np.isfinite(report.value) or report.status == "not_finite"
    w = [0.2, 0.7, 0.1]
    assert session.blend(w).status in ("converged", "line_search_failed")
    fresh = blending_model.session(tolerance=TIGHT)
    fresh.blend(w)
    assert np.abs(session.vertices - fresh.vertices).max() < 1e-4


def test_an_energy_without_minimum_is_reported_and_the_shape_stays() -> None:
    """A pose of half the size resists growth twice as much, and 3 - 2 * 2 is negative."""
    rest = irregular_bar()
    half = TetMesh(0.5 * rest.vertices, rest.tets)
    model = interpolation_model(
        InterpolationProblem([rest, half], material=StVK()), samples=6, dimension=1
    )
    session = model.session()
    session.blend([0.6, 0.4])
    before = session.vertices
    report = session.blend([3.0, -2.0], extrapolate=True)
    assert report.status == "unbounded" and not report.converged
    assert np.array_equal(session.vertices, before)
    assert session.weights.tolist() == [0.6, 0.4]
    assert session.blend([0.3, 0.7]).converged
