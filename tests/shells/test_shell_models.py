"""Reduced shells: the cubature of triangles and hinges, sessions, files and pages."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from safetensors import safe_open

from snapspace import (
    Cubature,
    PosingModel,
    Snapshots,
    export_html,
    load,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
    validate,
    with_handles,
)
from snapspace.page.pack import packed

from ..taylor import observed_order
from .strips import strip, strip_problem


@pytest.fixture(scope="module")
def snapshots() -> Snapshots:
    problem = strip_problem(strip(thickness=0.08), translation=0.15, angle=0.4)
    return solve_snapshots(problem, sample(problem.domain, 80, seed=1), threads=1)


@pytest.fixture(scope="module")
def model(snapshots: Snapshots) -> PosingModel:
    subspace = snapshot_pca(snapshots, dimension=30)
    return reduce(snapshots.problem, subspace, snapshots=snapshots, threads=1)  # type: ignore[call-overload, no-any-return]


def test_the_cubature_of_all_elements_is_the_energy(model: PosingModel) -> None:
    problem = model.problem
    every = np.arange(len(problem.mesh.elements), dtype=np.int32)
    whole = Cubature.of_tets(problem, model.subspace, every, problem.mesh.measures)
    rng = np.random.default_rng(0)
    for size in (0.01, 0.1):
        q = size * model.coordinate_scale * rng.normal(size=model.dimension)
        value, gradient = problem.energy.value_and_gradient(model.subspace.shape(q))
        reduced, slope = whole.value_and_gradient(q)
        assert reduced == pytest.approx(value, rel=1e-4)
        exact = model.subspace.basis.T @ gradient
        np.testing.assert_allclose(slope, exact, atol=1e-4 * np.abs(exact).max())


def test_the_cubature_is_consistent(model: PosingModel) -> None:
    elastic = model.cubature
    assert elastic is not None
    q = 0.05 * model.coordinate_scale * np.random.default_rng(1).normal(size=model.dimension)
    d = 0.05 * model.coordinate_scale * np.random.default_rng(2).normal(size=model.dimension)
    value, gradient = elastic.value_and_gradient(q)
    hessian = elastic.hessian(q)
    np.testing.assert_allclose(hessian, hessian.T, atol=1e-12 * np.abs(hessian).max())
    steps = [0.02 * 0.5**k for k in range(4)]
    assert observed_order(
        lambda h: elastic.value(q + h * d) - value - h * (gradient @ d), steps
    ) == pytest.approx(2, abs=0.15)
    assert observed_order(
        lambda h: elastic.value_and_gradient(q + h * d)[1] - gradient - h * (hessian @ d), steps
    ) == pytest.approx(2, abs=0.15)


def test_it_has_both_triangles_and_hinges(model: PosingModel) -> None:
    assert model.cubature is not None
    triangles = len(model.problem.mesh.cells)
    assert 0 < (model.cubature.tets < triangles).sum() < len(model.cubature.tets)
    assert len(model.cubature.tets) <= 12 * model.dimension


def test_frames_are_near_full_solutions(model: PosingModel) -> None:
    result = validate(model, samples=12, seed=9)
    assert np.median(result.error) < 0.03
    assert (result.inverted_tets == 0).all()


def test_a_file_gives_the_same_frames(model: PosingModel, tmp_path: Path) -> None:
    path = model.save(tmp_path / "strip.snapspace")
    with safe_open(path, framework="np") as file:
        assert file.metadata()["kind"] == "posing-shell"
    other = load(path)
    assert isinstance(other, PosingModel)
    assert other.problem.fingerprint == model.problem.fingerprint
    here, there = model.session(), other.session()
    for w in sample(model.problem.domain, 3, seed=4):
        here.pose(w)
        there.pose(w)
        np.testing.assert_array_equal(here.vertices, there.vertices)


def test_a_shell_polishes_steps_and_takes_other_handles(model: PosingModel) -> None:
    session = model.session()
    w = sample(model.problem.domain, 1, seed=6)[0]
    report = session.pose(w)
    assert report.converged
    before = model.problem.value_and_gradient(session.vertices, w)[0]
    session.polish()
    assert model.problem.value_and_gradient(session.vertices, w)[0] <= before
    session.reset()
    for _ in range(5):
        assert np.isfinite(session.step(0.02).value)
    handles = model.problem.handles.adding("middle", [40, 41, 42, 45])
    other = with_handles(model, model.problem.with_handles(handles))
    assert other.session().solve().converged


def test_a_model_packs_the_densities_of_its_elements(model: PosingModel, tmp_path: Path) -> None:
    content = packed(model, name="strip")
    assert b"shell-stable-neo-hookean" in content
    assert export_html(model, tmp_path / "strip.html").is_file()


def test_random_drags_stay_finite(model: PosingModel) -> None:
    session = model.session()
    rng = np.random.default_rng(3)
    w, bounds = np.zeros(6), np.array([0.15, 0.15, 0.15, 0.4, 0.4, 0.4])
    size = 2.0 * model.problem.mesh.diagonal
    for _ in range(200):
        w = np.clip(w + 0.3 * bounds * rng.normal(size=6), -bounds, bounds)
        assert session.pose(w).converged
        assert np.abs(session.vertices).max() < size
