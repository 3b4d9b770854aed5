"""What a notebook prints of a result is one line with its main numbers, not its arrays."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from snapspace import (
    AccurateModel,
    CertainRange,
    Checkpoint,
    Cubature,
    ElasticEnergy,
    ErrorCurve,
    ErrorEstimator,
    ErrorSplit,
    Growth,
    LocalRows,
    Polished,
    PoseFit,
    PoseFits,
    PosingModel,
    Predictions,
    SnapshotGram,
    Snapshots,
    StVK,
    Validation,
    mend_surface,
    mode_targets,
    predicted_solutions,
    sample,
    snapshot_pca,
)
from snapspace.accurate import Step
from snapspace.certificate import ResidualSample


def test_snapshots_print_their_number_and_problem(posing_snapshots: Snapshots) -> None:
    problem = repr(posing_snapshots.problem)
    assert repr(posing_snapshots) == f"Snapshots(60 samples, {problem})"
    failed = replace(posing_snapshots.reports[0], status="max_iterations")
    worse = replace(posing_snapshots, reports=[failed, *posing_snapshots.reports[1:]])
    assert repr(worse) == f"Snapshots(60 samples, 1 of them not converged, {problem})"


def test_a_subspace_prints_its_sizes(posing_snapshots: Snapshots) -> None:
    subspace = snapshot_pca(posing_snapshots, dimension=7)
    count = len(posing_snapshots.problem.mesh.vertices)
    assert repr(subspace) == f"AffineSubspace(dimension 7, {count} vertices)"


def validation(errors: list[float], snapshots: Snapshots) -> Validation:
    some = np.array(errors)
    return Validation(some, some, some, some, some, some, some, snapshots)


def test_validations_print_their_errors(posing_snapshots: Snapshots) -> None:
    reference = posing_snapshots.select(range(3))
    fine = validation([0.01, 0.02, 0.06], reference)
    assert repr(fine) == ("Validation(errors of 3 samples: median 0.02, mean 0.03, maximum 0.06)")
    coarse = validation([0.25, 0.5, 0.5], reference)
    assert repr(ErrorCurve(np.array([5, 20]), (coarse, fine))) == (
        "ErrorCurve(median errors of 3 samples: 0.5 at d = 5, 0.02 at d = 20)"
    )
    parts = (np.full(3, share) for share in (0.002, 0.008, 0.001, 0.0, 0.0082, 0.0091234))
    assert repr(ErrorSplit(*parts)) == (
        "ErrorSplit(medians of 3 samples: error 0.00912, subspace 0.002, stiffness 0.008, "
        "cubature 0.001, minimum 0)"
    )


def test_a_search_prints_its_step_and_model(
    posing_model: PosingModel, posing_snapshots: Snapshots
) -> None:
    model, snapshots = repr(posing_model), posing_snapshots
    step = Step(60, 30, 0.001, 0.004, 0.005, 0.006, "motions", "median")
    held_out = np.zeros(len(snapshots), bool)
    found = AccurateModel(posing_model, snapshots, held_out, (step,), step, 0.003, 160)
    assert repr(found) == f"AccurateModel({step}, misses its target of 0.3 %, {model})"
    met = replace(found, target=0.005)
    assert repr(met) == f"AccurateModel({step}, {model})"
    growth = Growth(posing_model, snapshots, held_out, None, 1.2345, final=False)
    assert repr(growth) == f"Growth(preliminary, 1.23 s, {model})"
    assert repr(replace(growth, step=step, final=True)) == f"Growth({step}, 1.23 s, final, {model})"


def test_what_has_many_numbers_prints_its_sizes(posing_model: PosingModel) -> None:
    problem = posing_model.problem
    n, d = len(problem.mesh.vertices), posing_model.dimension
    wanted = sample(problem.domain, 3)
    handle = problem.handles["head"]
    assert repr(handle) == f"Handle(head: {len(handle.vertices)} vertices)"
    bare = Predictions(np.zeros((3, 3 * n)))
    assert repr(bare) == f"Predictions(3 samples, {n} vertices)"
    predicted = predicted_solutions(posing_model, wanted)
    assert repr(predicted) == f"Predictions(3 samples, {n} vertices, Hessians of dimension {d})"
    targets = mode_targets(posing_model)
    count = len(targets.base)
    assert repr(targets) == f"MorphTargets({d} targets, {count} vertices, 0 shapes, error 0)"
    frames = np.ones((4, d))
    sampled = ResidualSample(np.arange(3, dtype=np.int32), np.ones(3))
    estimator = ErrorEstimator(1.0, sampled, frames, np.ones(4))
    assert repr(estimator) == f"ErrorEstimator(dimension {d}, calibrated with 4 frames)"
    both = replace(estimator, movement_ratios=np.ones(4))
    assert repr(both).endswith("calibrated with 4 frames, also for polished ones)")


def test_sessions_and_energies_print_their_sizes(posing_model: PosingModel) -> None:
    problem, d = posing_model.problem, posing_model.dimension
    session = posing_model.session()
    session.dimension = 7
    assert repr(session) == f"PosingSession(dimension 7, {posing_model!r})"
    energy = ElasticEnergy(problem.mesh, StVK())
    assert repr(energy) == f"ElasticEnergy({problem.mesh!r}, {StVK.title})"
    assert repr(posing_model.handles) == f"HandleQuadric(dimension {d}, 3 handles)"
    coefficients = math.comb(d + 4, 4)
    assert repr(posing_model.elastic) == f"Quartic(dimension {d}, {coefficients} coefficients)"
    tets = np.arange(8, dtype=np.int32)
    rows = LocalRows(
        np.array([[8, 2]], np.int32), np.zeros(144, np.float32), np.zeros((2, 5), np.float32)
    )
    assert repr(rows) == "LocalRows(dimension 5, 8 tets, 1 clusters)"
    assert repr(Cubature(tets, np.ones(8), rows, StVK())) == "Cubature(dimension 5, 8 tets)"
    corners = problem.mesh.vertices[problem.mesh.tets]
    certain = CertainRange(np.stack([corners, 2.0 * corners]))
    assert repr(certain) == f"CertainRange(2 poses, {len(corners)} forms each)"
    assert repr(SnapshotGram.of(problem)) == "SnapshotGram(0 displacements)"
    assert repr(Checkpoint("runs")) == "Checkpoint('runs')"


def test_fits_and_mended_surfaces_print_what_is_left() -> None:
    fit = PoseFit("calm", 2e-4, 1e-3, 0, 0.5, 2.0, 3, 20, 0.1, "converged")
    assert (
        repr(PoseFits(np.zeros((1, 4, 3)), [fit]))
        == "PoseFits(1 poses, surfaces within 2.0e-04 rms)"
    )
    missed = replace(fit, rms=3e-3, status="stiffness_limit")
    assert repr(PoseFits(np.zeros((2, 4, 3)), [fit, missed])) == (
        "PoseFits(2 poses, 1 of them farther than the goal, surfaces within 3.0e-03 rms)"
    )
    corners = np.vstack([np.zeros(3), np.eye(3)])
    mended = mend_surface(corners, [[0, 1, 3], [0, 2, 1], [0, 3, 2]])
    assert (
        repr(mended) == f"MendedSurface(4 vertices, 4 faces, 1 of them invented: {mended.notes[0]})"
    )


def test_a_polished_frame_prints_how_far_it_moved(posing_snapshots: Snapshots) -> None:
    report = replace(posing_snapshots.reports[0], status="max_iterations", iterations=10)
    polished = Polished(posing_snapshots.shapes, 0.00291, 0.00838, 0.005, report, 0.1)
    assert repr(polished) == (
        "Polished(moved 0.00291, 0.838 % of the displacement, 10 iterations, max_iterations)"
    )
