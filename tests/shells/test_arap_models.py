"""Reduced as-rigid-as-possible surfaces: cubature, sessions, files, certificates, pages."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

from snapspace import (
    ARAP,
    Cubature,
    PosingModel,
    Snapshots,
    calibrate,
    export_html,
    load,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
    validate,
)
from snapspace.certificate import residual_sample, scalar_diagonal
from snapspace.page.pack import packed
from snapspace.reduction.full_energy import full_energy

from .strips import strip, strip_problem


@pytest.fixture(scope="module")
def snapshots() -> Snapshots:
    problem = strip_problem(strip(), material=ARAP())
    return solve_snapshots(problem, sample(problem.domain, 60, seed=1), threads=1)


@pytest.fixture(scope="module")
def model(snapshots: Snapshots) -> PosingModel:
    subspace = snapshot_pca(snapshots, dimension=24)
    return reduce(snapshots.problem, subspace, snapshots=snapshots, threads=1)  # type: ignore[call-overload, no-any-return]


def test_the_cubature_of_all_stars_is_the_energy(model: PosingModel) -> None:
    problem = model.problem
    assert problem.energy.stars is not None
    every = np.arange(len(problem.energy.stars), dtype=np.int32)
    whole = Cubature.of_tets(problem, model.subspace, every, problem.energy.stars.measures)
    full = full_energy(problem, model.subspace)
    rng = np.random.default_rng(0)
    for size in (0.01, 0.1):
        q = size * model.coordinate_scale * rng.normal(size=model.dimension)
        value, gradient = full.value_and_gradient(q)
        reduced, slope = whole.value_and_gradient(q)
        assert reduced == pytest.approx(value, rel=1e-4)
        np.testing.assert_allclose(slope, gradient, atol=1e-4 * np.abs(gradient).max())
        hessian = full.hessian(q)
        for found in (whole.hessian(q), whole.rough_hessian(q)):
            np.testing.assert_allclose(found, hessian, atol=1e-4 * np.abs(hessian).max())


def test_the_leading_coordinates_have_the_leading_remainder(model: PosingModel) -> None:
    few, q = model.leading(6), np.zeros(model.dimension)
    q[:6] = 0.05 * model.coordinate_scale * np.random.default_rng(2).normal(size=6)
    offsets = model.problem.offsets(np.zeros(6))
    assert few.value(q[:6], offsets) == pytest.approx(model.value(q, offsets), rel=1e-12)
    again = pickle.loads(pickle.dumps(few.elastic))
    assert again.value(q[:6]) == few.elastic.value(q[:6])


def test_frames_are_near_full_solutions(model: PosingModel) -> None:
    result = validate(model, samples=10, seed=9)
    assert np.median(result.error) < 0.02


def test_the_session_minimises_the_reduced_objective(model: PosingModel) -> None:
    session = model.session()
    w = sample(model.problem.domain, 1, seed=6)[0]
    report = session.pose(w)
    assert report.converged
    offsets = model.problem.offsets(w)
    assert report.value == pytest.approx(model.value(session.q, offsets), rel=1e-9)
    before = model.problem.value_and_gradient(session.vertices, w)[0]
    session.polish()
    assert model.problem.value_and_gradient(session.vertices, w)[0] <= before


def test_a_file_gives_the_same_frames(model: PosingModel, tmp_path: Path) -> None:
    other = load(model.save(tmp_path / "strip.snapspace"))
    assert isinstance(other, PosingModel)
    here, there = model.session(), other.session()
    w = sample(model.problem.domain, 1, seed=4)[0]
    here.pose(w)
    there.pose(w)
    np.testing.assert_array_equal(here.vertices, there.vertices)


def test_the_probe_sees_the_gradient_of_the_whole_surface(model: PosingModel) -> None:
    problem, count = model.problem, len(model.problem.mesh.vertices)
    diagonal = scalar_diagonal(problem)
    sampled = residual_sample(np.ones(count), diagonal, count=12)
    session = model.session()
    w = sample(problem.domain, 1, seed=8)[0]
    session.pose(w)
    gradient = problem.value_and_gradient(session.vertices, w)[1].reshape(-1, 3)
    exact = np.sqrt(sampled.weights @ (gradient[sampled.vertices] ** 2).sum(axis=1))
    # rows are in single precision
    assert session.residual(sampled) == pytest.approx(exact, rel=1e-6)


def test_frames_have_certificates(model: PosingModel, snapshots: Snapshots) -> None:
    other = calibrate(model, reference=validate(model, samples=10, seed=3).reference)
    session = other.session()
    session.pose(0.5 * snapshots.parameters[7])
    assert 0 < session.certificate().relative < 1


def test_a_page_takes_the_density_of_the_stars(model: PosingModel, tmp_path: Path) -> None:
    assert b"shell-arap" in packed(model, name="strip")
    assert export_html(model, tmp_path / "strip.html").is_file()
