"""Certificates: zero where a frame is the solution, and elsewhere right as often as they claim."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.stats import spearmanr

from snapspace import (
    Certificate,
    ErrorEstimator,
    HandleBox,
    Handles,
    PosingModel,
    PosingProblem,
    ReducedModel,
    SolverOptions,
    StVK,
    TetMesh,
    calibrate,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.certificate import residual_sample, scalar_diagonal
from snapspace.generators import bar, creature_handles
from snapspace.mesh import mass_norm

from ..shapes import irregular_bar, random_rotation, random_subspace
from ..snapshots.creatures import creature

FloatArray = NDArray[np.float64]


@pytest.fixture(scope="module")
def creature_model() -> PosingModel:
    mesh = creature(5000)
    parts = creature_handles(mesh)
    handles = Handles([parts["feet"], parts["head"]], names=["feet", "head"])
    problem = PosingProblem(mesh, handles, domain=HandleBox(translation=0.2, angle=0.6))
    snapshots = solve_snapshots(problem, sample(problem.domain, 40, seed=1), threads=1)
    model = reduce(problem, snapshot_pca(snapshots, dimension=15), snapshots=snapshots, threads=1)
    return calibrate(model, samples=59, threads=1)


@pytest.fixture(scope="module")
def frames(creature_model: PosingModel) -> tuple[FloatArray, list[list[Certificate]]]:
    """True distances at samples unseen by model and calibration, and both certificates."""
    problem, subspace = creature_model.problem, creature_model.subspace
    options = SolverOptions(tolerance=1e-8, max_iterations=5000)
    unseen = sample(problem.domain, 120, seed=77)
    solved = solve_snapshots(problem, unseen, options=options, threads=1)
    session, truth, certificates = creature_model.session(), [], [[], []]
    for w, row in zip(unseen, solved.displacements, strict=True):
        session.reset()
        session.pose(w)
        miss = session.vertices.reshape(-1) - problem.base - row
        truth.append(mass_norm(subspace.mass, miss) / np.sqrt(problem.mesh.volume))
        certificates[0].append(session.certificate())
        certificates[1].append(session.certificate(thorough=True))
    return np.array(truth), certificates


@pytest.mark.parametrize("thorough", [False, True])
def test_bounds_hold_on_unseen_samples(
    frames: tuple[FloatArray, list[list[Certificate]]], thorough: bool
) -> None:
    truth, certificates = frames[0], frames[1][thorough]
    upper = np.array([c.upper_distance for c in certificates])
    assert np.mean(truth <= upper) >= 0.8
    ratios = truth / [c.distance for c in certificates]
    assert 0.7 < np.median(ratios) < 1.4
    assert np.median(upper / [c.distance for c in certificates]) < (3 if thorough else 5)


def test_larger_errors_have_larger_estimates(
    frames: tuple[FloatArray, list[list[Certificate]]],
) -> None:
    truth, (quick, thorough) = frames
    ranks = [spearmanr([c.distance for c in some], truth)[0] for some in (quick, thorough)]
    assert ranks[0] > 0.3 and ranks[1] > 0.6 and ranks[1] > ranks[0]


def test_the_relative_distance_is_relative_to_the_displacement(creature_model: PosingModel) -> None:
    session = creature_model.session()
    session.move("head", euler=(0.3, 0.0, 0.4), translation=(0.1, 0.0, 0.1))
    certificate = session.certificate()
    moved = mass_norm(
        creature_model.subspace.mass, session.vertices.reshape(-1) - creature_model.subspace.tau
    ) / np.sqrt(creature_model.problem.mesh.volume)
    assert certificate.relative == pytest.approx(certificate.distance / moved, rel=1e-6)
    ratio = certificate.upper_distance / certificate.distance
    assert certificate.upper_relative == pytest.approx(ratio * certificate.relative)
    assert certificate.upper_distance < session.certificate(confidence=0.95).upper_distance


def test_the_distance_at_rest_is_zero(creature_model: PosingModel) -> None:
    session = creature_model.session()
    moved = session.move("head", euler=(0.3, 0.0, 0.4))
    assert moved.converged
    somewhere = session.certificate().upper_distance
    session.reset()
    for thorough in (False, True):
        certificate = session.certificate(thorough=thorough)
        assert certificate.upper_distance < 1e-8 * somewhere
        assert certificate.relative == 0.0 or not np.isnan(certificate.relative)


def test_a_model_of_all_directions_has_no_distance() -> None:
    mesh = bar(4, 1, 1)  # 20 vertices
    foot, head = (np.flatnonzero(mesh.vertices[:, 0] == x) for x in (0.0, 4.0))
    handles = Handles([foot, head], names=["foot", "head"])
    domain = HandleBox(translation=0.5, angle=0.5)
    problem = PosingProblem(mesh, handles, domain=domain, material=StVK(), stiffness=100.0)
    drawn = residual_sample(np.ones(20), scalar_diagonal(problem))
    found = []
    for dimension in (30, 60):
        model = reduce(problem, random_subspace(mesh, dimension), energy="exact", threads=1)
        nine = np.ones((9, dimension)), np.ones(9), np.ones(9)
        ones = ErrorEstimator(mesh.volume, drawn, *nine)
        session = replace(model, error_estimator=ones).session(tolerance=1e-14)
        assert session.pose([0.3, 0.2, -0.4, 0.3, -0.2, 0.4]).converged
        found.append([session.certificate(thorough=t).relative for t in (False, True)])
    some, everything = np.array(found)
    assert (everything < 1e-5 * some).all()


def test_the_unit_of_the_mesh_does_not_matter() -> None:
    """From metres to millimetres, lengths in the certificate grow by 1000, and nothing else."""
    mesh = irregular_bar(8, 2, 2)
    found = []
    for unit in (1.0, 1000.0):
        vertices, x = unit * (mesh.vertices + 3.0), mesh.vertices[:, 0]
        problem = PosingProblem(
            TetMesh(vertices, mesh.tets),
            Handles([x < 0.3, x > 3.7]),
            domain=HandleBox(translation=0.5 * unit, angle=0.5),
            material=StVK(lam=1.5, mu=0.7),
            stiffness=100.0 / unit**2,
        )
        snapshots = solve_snapshots(
            problem,
            sample(problem.domain, 30, seed=1),
            options=SolverOptions(tolerance=1e-10, precision="double"),
            threads=1,
        )
        model = reduce(problem, snapshot_pca(snapshots, dimension=8), snapshots=snapshots)
        session = calibrate(model, samples=9, threads=1).session(tolerance=1e-12)
        session.pose(problem.domain.from_unit(np.array([0.1, 0.9, 0.3, 0.8, 0.2, 0.6])))
        for thorough in (False, True):
            certificate = session.certificate(thorough=thorough)
            found.append([certificate.relative, certificate.upper_distance / unit])
    np.testing.assert_allclose(found[:2], found[2:], rtol=1e-2)


def test_a_common_motion_of_all_handles_changes_no_certificate(posing_model: PosingModel) -> None:
    session = calibrate(posing_model, samples=9, threads=1).session()
    session.move("head", euler=(0.3, 0.2, -0.4), translation=(0.2, 0.1, 0.3))
    before = session.certificate()
    turn = random_rotation()
    handles = zip(posing_model.problem.handles.names, session._maps.copy(), strict=True)
    for handle, world in handles:
        session.move_affine(handle, np.column_stack([turn @ world[:, :3], turn @ world[:, 3] + 2]))
    assert session.certificate().distance == pytest.approx(before.distance, rel=1e-4)


def test_without_calibration_there_is_no_certificate(
    posing_model: ReducedModel, creature_model: PosingModel
) -> None:
    with pytest.raises(ValueError, match=r"no calibrated error estimate; make one with snapspace"):
        posing_model.session().certificate()
    with pytest.raises(ValueError, match="calibrated for dimension 15, but the session has 10"):
        creature_model.leading(10).session().certificate()
    with pytest.raises(ValueError, match=r"confidence of 0\.99 needs 99 calibration samples"):
        creature_model.session().certificate(confidence=0.99)


def test_blends_have_certificates(blending_model: ReducedModel) -> None:
    model = calibrate(blending_model, samples=19, threads=1)  # type: ignore[type-var]
    session = model.session()
    session.blend([0.2, 0.7, 0.1])
    for thorough in (False, True):
        certificate = session.certificate(thorough=thorough)
        assert 0 < certificate.distance <= certificate.upper_distance
