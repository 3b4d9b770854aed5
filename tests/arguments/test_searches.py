"""Wrong arguments of searches, fits, models and sessions are refused in one line, before work."""

from __future__ import annotations

import numpy as np

import snapspace as ss

from .refused import Call, refusals

WRONG: dict[str, tuple[Call, str]] = {
    "an infinite tolerance of a session": (
        lambda m, s: m.session(tolerance=np.inf),
        "Session: tolerance inf, max_iterations 300 and max_evaluations 500 must be positive and",
    ),
    "an infinite tolerance of a polish": (
        lambda m, s: m.session().polish(tolerance=np.inf),
        "polish: iterations 10 must not be negative, and tolerance inf must be positive and finite",
    ),
    "an endless page": (
        lambda m, s: m.show(height=np.inf),
        "show: height is inf pixels, but the page needs 100 or more",
    ),
    "options of a search in words": (
        lambda m, s: ss.accurate_model(s.problem, options="fast"),
        "accurate_model: options is of type str; give SolverOptions(tolerance=..., ...)",
    ),
    "a folder as the checkpoint of a search": (
        lambda m, s: ss.accurate_model(s.problem, checkpoint="runs"),
        "accurate_model: checkpoint is of type str; give Checkpoint(folder)",
    ),
    "a folder as the checkpoint of greedy samples": (
        lambda m, s: ss.greedy_snapshots(s.problem, 4, checkpoint="runs"),  # type: ignore[arg-type]
        "greedy_snapshots: checkpoint is of type str; give Checkpoint(folder)",
    ),
    "empty options of greedy samples": (
        lambda m, s: ss.greedy_snapshots(s.problem, 4, options={}),  # type: ignore[arg-type]
        "greedy_snapshots: options is of type dict; give SolverOptions(tolerance=..., ...)",
    ),
    "a line as the progress of fits": (
        lambda m, s: ss.fit_poses(
            s.problem.mesh,
            m.surface,
            [m.surface.vertices(s.problem.mesh.vertices)],
            progress="bar",  # type: ignore[arg-type]
        ),
        "fit_poses: progress is of type str; give a function, or None",
    ),
    "a shear modulus of rubber in words": (
        lambda m, s: ss.MooneyRivlin.from_lame(lam=1.0, mu="soft"),
        "MooneyRivlin: mu must be numbers, in rows of one length, but are of type str",
    ),
    "a complex modulus": (
        lambda m, s: ss.StVK(mu=np.array(1 + 1j)),  # type: ignore[arg-type]
        "StVK: mu must be a number, or one per tet, got array(1.+1.j)",
    ),
    "a rate of no frames": (
        lambda m, s: ss.write_animation("frames", m, [], frames_per_second=0.0),
        "write_animation: frames_per_second is 0.0, but must be positive",
    ),
    "an animation without shapes": (
        lambda m, s: ss.write_animation("frames", m, iter(())),
        "write_animation: there are no shapes; give one for each frame",
    ),
    "a line as the listener of a search": (
        lambda m, s: ss.accurate_model(s.problem, tell="line"),
        "accurate_model: tell is of type str; give a function, or None",
    ),
    "a part as the listener of a growing search": (
        lambda m, s: next(ss.growing_models(s.problem, begins="energy")),
        "growing_models: begins is of type str; give a function, or None",
    ),
    "a mesh as the surface of a search": (
        lambda m, s: ss.accurate_model(s.problem, surface=s.problem.mesh),
        "accurate_model: surface is of type TetMesh; give that of embed_surface or",
    ),
    "a record that is a text": (
        lambda m, s: ss.reduce(s.problem, m.subspace, snapshots=s, provenance="mine"),
        "reduce: provenance is of type str; give a dict, or None",
    ),
    "a record that no file can store": (
        lambda m, s: ss.reduce(s.problem, m.subspace, snapshots=s, provenance={"d": np.int64(3)}),
        "reduce: provenance must be valid JSON with strings as keys (Object of type int64 is not",
    ),
    "inner products as an array": (
        lambda m, s: ss.Snapshots(
            s.problem,
            s.parameters,
            s.displacements,
            s.reports,
            np.eye(len(s)),  # type: ignore[arg-type]
        ),
        "Snapshots: gram is of type ndarray; leave it out",
    ),
    "ragged numbers of samples": (
        lambda m, s: s.select([[1, 2], [3]]),
        "Snapshots.select: which is of type list; give a boolean mask (60,) or whole numbers (c,)",
    ),
}


test_a_wrong_argument_is_refused_in_one_line = refusals(WRONG)
