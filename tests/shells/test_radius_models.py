"""Models of surfaces whose stars have a radius."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from safetensors.numpy import load_file

from snapspace import (
    ARAP,
    Cubature,
    InterpolationModel,
    PosingModel,
    PosingSession,
    accurate_model,
    calibrate,
    load,
    sample,
)
from snapspace.cubature import BlendedStars
from snapspace.problem.material_entries import material_content, material_from
from snapspace.reduction.full_energy import full_energy

from ..model_file.test_bad_files import rewrite
from .strips import WIDE, blended_strips, shell_model, strip


@pytest.fixture(scope="module")
def posed() -> PosingModel:
    return shell_model(ARAP(), varied=True, radius=WIDE)


@pytest.fixture(scope="module")
def blended() -> InterpolationModel:
    return blended_strips(ARAP(radius=WIDE))


def test_all_stars_are_the_energy(posed: PosingModel) -> None:
    problem = posed.problem
    assert problem.energy.stars is not None
    count = len(problem.energy.stars)
    assert count < len(problem.mesh.vertices)
    every = np.arange(count, dtype=np.int32)
    whole = Cubature.of_tets(problem, posed.subspace, every, problem.energy.stars.measures)
    full = full_energy(problem, posed.subspace)
    q = 0.1 * posed.coordinate_scale * np.random.default_rng(0).normal(size=posed.dimension)
    value, gradient = full.value_and_gradient(q)
    reduced, slope = whole.value_and_gradient(q)
    assert reduced == pytest.approx(value, rel=1e-4)
    np.testing.assert_allclose(slope, gradient, atol=1e-4 * np.abs(gradient).max())


def test_a_file_gives_the_same_frames(
    posed: PosingModel, blended: InterpolationModel, tmp_path: Path
) -> None:
    for model in (posed, blended):
        path = model.save(tmp_path / "strip.snapspace")
        other = load(path)
        assert other.problem.material == model.problem.material
        w = sample(model.problem.domain, 3, seed=4)[2]
        shapes = []
        for one in (model, other):
            session = one.session()
            session.pose(w) if isinstance(session, PosingSession) else session.blend(w)
            shapes.append(session.vertices)
        np.testing.assert_allclose(*shapes, atol=1e-9 * model.problem.mesh.diagonal)


@pytest.mark.parametrize("name", ["stars_shares", "estimator_stars_shares"])
def test_a_file_with_other_stars_is_refused(posed: PosingModel, tmp_path: Path, name: str) -> None:
    path = calibrate(posed, samples=4, threads=1).save(tmp_path / "strip.snapspace")
    rewrite(path, lambda arrays, header: arrays.update({name: 0.5 * arrays[name]}))
    with pytest.raises(ValueError, match=f"{name} is not that of the surface"):
        load(path)


def test_a_file_without_the_stars_of_its_estimates_is_refused(
    posed: PosingModel, tmp_path: Path
) -> None:
    path = calibrate(posed, samples=4, threads=1).save(tmp_path / "strip.snapspace")
    rewrite(path, lambda arrays, header: arrays.pop("estimator_stars_starts"))
    with pytest.raises(ValueError, match="estimator_stars_starts is missing"):
        load(path)


def test_problem_files_have_the_radius() -> None:
    mesh = strip()
    made = material_from({"model": "arap", "mu": 2.0, "radius": 0.03}, mesh)
    assert made == ARAP(mu=2.0, radius=0.03)
    assert material_from(material_content(made), mesh) == made
    regions = [{"spheres": [[[0, 0, 0], 0.5]], "factor": 3.0}]
    varied = material_from({"model": "arap", "radius": 0.03, "regions": regions}, mesh)
    assert varied.settings == {"radius": 0.03} and not varied.uniform
    with pytest.raises(ValueError, match="radius"):
        material_from({"model": "arap", "radius": -1.0}, mesh)
    with pytest.raises(ValueError, match="radius"):
        material_from({"model": "stvk", "radius": 0.1}, mesh)


def test_files_of_rings_are_as_before_there_was_a_radius(tmp_path: Path) -> None:
    model = shell_model(ARAP(), varied=True)
    path = model.save(tmp_path / "rings.snapspace")
    assert "stars_shares" not in load_file(path)
    assert load(path).problem.material == model.problem.material


def test_builds_are_calibrated() -> None:
    problem = blended_strips(ARAP(radius=WIDE)).problem
    model = accurate_model(problem, target_error=0.05, most_samples=20).model
    assert model.error_estimator is not None
    assert isinstance(model.blends, BlendedStars)
    session = model.session()
    session.blend([0.3, 0.3, 0.4])
    assert 0.0 < session.certificate(confidence=0.5).relative < 0.2
