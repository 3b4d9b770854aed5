"""Wrong arguments of sessions and models are refused in one line."""

from __future__ import annotations

from typing import Any

import numpy as np

import snapspace as ss

from .refused import Call, check_refused, refusals

REST = ((0, 0, 0), (0, 0, 0))

WRONG: dict[str, tuple[Call, str]] = {
    "a list as the handle": (
        lambda m, s: m.session().move(["head"], euler=(0, 0, 1)),
        "move: handle is of type list; give the name of a handle",
    ),
    "a number as keys": (
        lambda m, s: next(m.session().animate(3)),
        "animate: keys is of type int; give a list of states, such as [{handle: motion}]",
    ),
    "frames in words": (
        lambda m, s: next(m.session().animate([{"head": REST}], frames="x")),
        "animate: frames is 'x', but must be a whole number",
    ),
    "half a frame": (
        lambda m, s: next(m.session().animate([{"head": REST}], frames=2.5)),
        "animate: frames is 2.5, but must be a whole number",
    ),
    "no motions": (
        lambda m, s: m.session().put(3, np.zeros(20)),
        "put: motions is of type int; give a pair (rotation, translation) for each handle",
    ),
    "coordinates in words": (
        lambda m, s: m.session().put([(np.eye(3), (0, 0, 0))] * 3, ["x"]),
        "put: q must be numbers, in rows of one length, but are of type list",
    ),
    "parameters in words": (
        lambda m, s: m.session().pose(["x"] * 12),
        "PosingProblem: parameters must be numbers, in rows of one length, but are of type list",
    ),
    "iterations in words": (
        lambda m, s: m.session().polish(iterations="x"),
        "polish: iterations is 'x' and tolerance",
    ),
    "half an iteration": (
        lambda m, s: m.session().polish(iterations=1.5),
        "polish: iterations is 1.5 and tolerance",
    ),
    "a number to stop": (
        lambda m, s: m.session().polish(should_stop=3),
        "polish: should_stop is of type int; give a function without arguments, or None",
    ),
    "a number as sample": (
        lambda m, s: m.session().residual(3),
        "residual: sample is of type int; give a ResidualSample",
    ),
    "a step in words": (
        lambda m, s: m.session().step("x"),
        "step: dt 'x' must be positive and finite, in seconds",
    ),
    "a frequency in words": (
        lambda m, s: ss.Dynamics(frequency="x"),  # type: ignore[arg-type]
        "Dynamics: frequency 'x' must be positive, in Hz",
    ),
    "no damping": (
        lambda m, s: ss.Dynamics(damping=None),  # type: ignore[arg-type]
        "Dynamics: damping None must be finite and not negative",
    ),
    "half a dimension": (
        lambda m, s: setattr(m.session(), "dimension", 1.5),
        "Session: dimension is of type float; give a whole number",
    ),
    "a list as the minimizer": (
        lambda m, s: m.session(minimizer=["newton"]),
        "Session: unknown minimizer ['newton']; known are newton, bfgs",
    ),
    "a budget in words": (
        lambda m, s: ss.accurate_model(s.problem, budget="x"),  # type: ignore[arg-type]
        "accurate_model: the budget is 'x' seconds, but it must be positive and finite",
    ),
    "samples in words": (
        lambda m, s: ss.accurate_model(s.problem, most_samples="x"),  # type: ignore[arg-type]
        "accurate_model: most_samples is 'x', but at least 20 are needed",
    ),
    "coordinates of another model": (
        lambda m, s: m.elastic.value(np.zeros(3)),
        "Quartic: q must have one entry per dimension, (20,), but has the shape (3,)",
    ),
    "no offsets": (
        lambda m, s: m.value(np.zeros(20), np.zeros((3, 12))),
        "HandleQuadric: offsets have shape (3, 12), but must be (3, 3, 4)",
    ),
    "coefficients in words": (
        lambda m, s: ss.Quartic(2, "x"),  # type: ignore[arg-type]
        "Quartic: coefficients must be numbers, in rows of one length, but are of type str",
    ),
    "a model with the handles of a model": (
        lambda m, s: ss.with_handles(m, m),
        "with_handles: problem is of type PosingModel; give its problem, .problem",
    ),
    "a problem to predict by": (
        lambda m, s: ss.predicted_solutions(s.problem, s.parameters),
        "predicted_solutions: model is of type PosingProblem; give that of reduce or load",
    ),
    "one row to predict": (
        lambda m, s: ss.predicted_solutions(m, s.parameters[0]),
        "predicted_solutions: parameters have shape (12,), but must be (k, p), one sample per row;"
        " a single one is parameters[None]",
    ),
    "one shape as predictions": (
        lambda m, s: ss.Predictions(s.shapes[0]),
        "Predictions: displacements have shape (243,), but must be (k, 3n)",
    ),
    "faces as a surface": (
        lambda m, s: ss.reduce(s.problem, m.subspace, surface=s.problem.mesh.surface),
        "reduce: surface is of type ndarray; give that of embed_surface or boundary_surface",
    ),
    "a negative seed": (
        lambda m, s: ss.reduce(s.problem, m.subspace, snapshots=s, energy="cubature", seed=-1),
        "reduce: seed is -1, but must be at least 0",
    ),
    "half a tet": (
        lambda m, s: ss.reduce(s.problem, m.subspace, snapshots=s, energy="cubature", tets=1.5),  # type: ignore[call-overload]
        "reduce: tets is 1.5, but must be a whole number",
    ),
    "threads in words": (
        lambda m, s: ss.split_errors(m, other_samples(s), threads="x"),  # type: ignore[arg-type]
        "split_errors: threads is 'x', but must be a whole number, or None",
    ),
    "a problem of other handles as samples": (
        lambda m, s: ss.carry_over(s.problem, s.problem),
        "carry_over: snapshots is of type PosingProblem; give those of solve_snapshots",
    ),
    "samples carried to a model": (
        lambda m, s: ss.carry_over(s, m),
        "carry_over: problem is of type PosingModel; give its problem, .problem",
    ),
    "samples joined to shapes": (
        lambda m, s: s.joined(s.shapes),
        "Snapshots.joined: others is of type ndarray; give those of solve_snapshots",
    ),
    "samples without reports": (
        lambda m, s: ss.Snapshots(s.problem, s.parameters, s.displacements, None),  # type: ignore[arg-type]
        "Snapshots: reports is of type NoneType; give a list of SampleReport",
    ),
    "samples of a model": (
        lambda m, s: ss.Snapshots.from_shapes(m, s.parameters, s.shapes, s.reports),
        "Snapshots.from_shapes: problem is of type PosingModel; give its problem, .problem",
    ),
    "more samples of a model": (
        lambda m, s: ss.greedy_snapshots(m, 2),
        "greedy_snapshots: problem is of type PosingModel; give its problem, .problem",
    ),
    "a folder as checkpoint": (
        lambda m, s: ss.solve_snapshots(s.problem, s.parameters, checkpoint="folder"),  # type: ignore[arg-type]
        "solve_snapshots: checkpoint is of type str; give Checkpoint(folder)",
    ),
    "a number of workers": (
        lambda m, s: ss.solve_snapshots(s.problem, s.parameters, executor=4),  # type: ignore[arg-type]
        "solve_snapshots: executor is of type int; give a concurrent.futures.Executor, or None",
    ),
    "progress that is no function": (
        lambda m, s: ss.solve_snapshots(s.problem, s.parameters, progress=1),  # type: ignore[arg-type]
        "solve_snapshots: progress is of type int; give a function, or None",
    ),
    "shapes as predictions": (
        lambda m, s: ss.solve_snapshots(s.problem, s.parameters, predictions=s.shapes),
        "solve_snapshots: predictions is of type ndarray; give Predictions",
    ),
    "no limit of iterations": (
        lambda m, s: ss.SolverOptions(max_iterations=None),  # type: ignore[arg-type]
        "SolverOptions: max_iterations is of type NoneType; give a whole number",
    ),
    "the Gram matrix of a mesh": (
        lambda m, s: ss.SnapshotGram.of(s.problem.mesh),  # type: ignore[arg-type]
        "SnapshotGram.of: problem is of type TetMesh; give a PosingProblem or Interpolation",
    ),
    "rows that there are not": (
        lambda m, s: s.with_gram().gram.held_out_error([0, 1, 99], [2], 3),
        "SnapshotGram.held_out_errors: 99 is not between 0 and 59",
    ),
}


def other_samples(snapshots: ss.Snapshots) -> ss.Snapshots:
    """A solution that the model has not seen."""
    problem: Any = snapshots.problem
    parameters = ss.sample(problem.domain, 1, seed=9)
    return ss.solve_snapshots(problem, parameters)


test_a_wrong_argument_is_refused_in_one_line = refusals(WRONG)


def test_keys_and_weights_of_blends(blending_model: ss.InterpolationModel) -> None:
    session: Any = blending_model.session()
    check_refused(lambda: next(session.animate(3)), "animate: keys is of type int; give a list")
    check_refused(
        lambda: session.model.problem.registered("x"),
        "InterpolationProblem: displacements must be numbers",
    )
    check_refused(lambda: blending_model.elastic("x"), "InterpolationModel: weights must be")
    check_refused(lambda: blending_model.elastic([1.0]), "InterpolationModel: weights have shape")
    check_refused(lambda: session.model.problem.pose_energy(-1), "pose is -1, but must be between")
    check_refused(lambda: session.model.problem.pose_energy("x"), "pose is 'x', but must be")


def test_a_confidence_in_words(posing_model: ss.PosingModel) -> None:
    session: Any = ss.calibrate(posing_model, samples=4, thorough=False).session()
    message = "certificate: confidence is 'x', but it must be between 0 and 1"
    check_refused(lambda: session.certificate(confidence="x"), message)
