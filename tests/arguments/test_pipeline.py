"""Wrong arguments of the pipeline are refused in one line: who, what came and what to give."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import pytest

import snapspace as ss

from .refused import Call, refusals


def problem(snapshots: Any, **changed: Any) -> ss.PosingProblem:
    one = snapshots.problem
    parts: dict[str, Any] = {"mesh": one.mesh, "handles": one.handles, "domain": one.domain}
    return ss.PosingProblem(**{**parts, **changed})


WRONG: dict[str, tuple[Call, str]] = {
    "moduli without names": (
        lambda m, s: ss.StableNeoHookean().with_moduli(3),  # type: ignore[arg-type]
        "StableNeoHookean: moduli is of type int; give a mapping from names to numbers",
    ),
    "a number as names": (
        lambda m, s: m.problem.domain.renamed(["tail"], 3),
        "HandleBox: new is of type int; give the names of the moving handles",
    ),
    "a handle without a name": (
        lambda m, s: ss.Handle(None, np.arange(3)),  # type: ignore[arg-type]
        "Handle: name is of type NoneType; give a name",
    ),
    "words as a handle": (
        lambda m, s: ss.Handle("tail", "x"),  # type: ignore[arg-type]
        "Handle: vertices is of type str; give an array of vertex indices",
    ),
    "arrays as a mesh": (
        lambda m, s: problem(s, mesh=(s.problem.mesh.vertices, s.problem.mesh.tets)),
        "PosingProblem: mesh is of type tuple; give a TetMesh or ShellMesh, such as TetMesh(",
    ),
    "masks as handles": (
        lambda m, s: problem(s, handles=[[0, 1], [2]]),
        "PosingProblem: handles is of type list; give Handles([fixed, moving])",
    ),
    "numbers as a domain": (
        lambda m, s: problem(s, domain=(0.2, 0.3)),
        "PosingProblem: domain is of type tuple; give HandleBox(translation=..., angle=...)",
    ),
    "no domain": (
        lambda m, s: problem(s, domain=None),
        "PosingProblem: domain is of type NoneType; give HandleBox(",
    ),
    "several stiffnesses": (
        lambda m, s: problem(s, stiffness=[1, 2]),
        "PosingProblem: stiffness is of type list; give a positive number",
    ),
    "a bound beyond all numbers": (
        lambda m, s: ss.HandleBox(translation=10**400, angle=0.1),
        "HandleBox: translation must be one number, three, or three for each moving handle, got 1",
    ),
    "a tolerance beyond all numbers": (
        lambda m, s: ss.SolverOptions(tolerance=10**400),
        "SolverOptions: tolerance is 100",
    ),
    "a tolerance that is a huge whole number": (
        lambda m, s: ss.SolverOptions(tolerance=10**30),
        "SolverOptions: tolerance is 1000000000000000000000000000000, but it must be below 1",
    ),
    "more samples than there are numbers": (
        lambda m, s: ss.sample(s.problem.domain, 10**30),
        f"but must be at most {sys.maxsize}",
    ),
    "half a handle": (
        lambda m, s: ss.HandleBox(translation=1, angle=1, moving=1.5),  # type: ignore[arg-type]
        "HandleBox: moving is of type float; give a whole number",
    ),
    "no seed": (
        lambda m, s: ss.sample(s.problem.domain, 3, seed=None),  # type: ignore[arg-type]
        "sample: the seed is None, but must be a whole number",
    ),
    "a generator as the seed": (
        lambda m, s: ss.sample(s.problem.domain, 3, seed=np.random.default_rng(0)),  # type: ignore[arg-type]
        "sample: the seed is Generator(PCG64)",
    ),
    "parameters before the problem": (
        lambda m, s: ss.solve_snapshots(s.parameters, s.problem),
        "solve_snapshots: problem is of type ndarray; give a PosingProblem or InterpolationProblem",
    ),
    "options as a dictionary": (
        lambda m, s: ss.solve_snapshots(s.problem, s.parameters, options={"tolerance": 1e-5}),
        "solve_snapshots: options is of type dict; give SolverOptions(tolerance=..., ...)",
    ),
    "half a thread": (
        lambda m, s: ss.solve_snapshots(s.problem, s.parameters, threads=1.5),  # type: ignore[arg-type]
        "solve_snapshots: threads is 1.5, but must be a whole number, or None",
    ),
    "a tolerance in words": (
        lambda m, s: ss.SolverOptions(tolerance="1e-3"),  # type: ignore[arg-type]
        "SolverOptions: tolerance is of type str; give a number",
    ),
    "half an iteration": (
        lambda m, s: ss.SolverOptions(max_iterations=1.5),  # type: ignore[arg-type]
        "SolverOptions: max_iterations is of type float; give a whole number",
    ),
    "a tolerance that all starts meet": (
        lambda m, s: ss.SolverOptions(tolerance=2),
        "SolverOptions: tolerance is 2, but it must be below 1: it is a share of the objective",
    ),
    "shapes as snapshots": (
        lambda m, s: ss.snapshot_pca(s.shapes, dimension=3),
        "snapshot_pca: snapshots is of type ndarray; give those of solve_snapshots; pca takes an",
    ),
    "half a dimension": (
        lambda m, s: ss.snapshot_pca(s, dimension=3.5),  # type: ignore[arg-type]
        "pca: dimension is 3.5, but must be a whole number",
    ),
    "the subspace before the problem": (
        lambda m, s: ss.reduce(m.subspace, s.problem, snapshots=s),
        "reduce: problem is of type AffineSubspace; give the problem first, then the subspace",
    ),
    "a basis as the subspace": (
        lambda m, s: ss.reduce(s.problem, m.subspace.basis),
        "reduce: subspace is of type ndarray; give that of snapshot_pca or affine_subspace",
    ),
    "a session to validate": (
        lambda m, s: ss.validate(m.session()),
        "validate: model is of type PosingSession; give session.model",
    ),
    "a problem to calibrate": (
        lambda m, s: ss.calibrate(s.problem),
        "calibrate: model is of type PosingProblem; give that of reduce or load",
    ),
    "a session to split": (
        lambda m, s: ss.split_errors(m.session(), s),
        "split_errors: model is of type PosingSession; give session.model",
    ),
    "a session to film": (
        lambda m, s: ss.write_animation("nod.gif", m.session(), []),
        "write_animation: model is of type PosingSession; give session.model",
    ),
    "another name for a film's frame rate": (
        lambda m, s: ss.write_animation("nod.gif", m, [], fps=10),
        "write_animation: unknown option fps for nod.gif; known are frames_per_second, size, ",
    ),
    "a film's option for morph targets": (
        lambda m, s: ss.write_animation("nod.glb", m, [], size=(4, 4)),
        "write_animation: unknown option size for nod.glb; known are frames_per_second, name, up",
    ),
    "a session as a page": (
        lambda m, s: ss.export_html(m.session(), "bar.html"),
        "export_html: model is of type PosingSession; give session.model",
    ),
    "the path before the model": (
        lambda m, s: ss.export_packed("bar.snapspace", m),  # type: ignore[arg-type]
        "export_packed: model is of type str; give model, path",
    ),
    "a number to load": (
        lambda m, s: ss.load(3),  # type: ignore[arg-type]
        "load: path is of type int; give the name of a .snapspace file",
    ),
    "a session to save": (
        lambda m, s: ss.save_model(m.session(), "bar.snapspace"),
        "save_model: model is of type PosingSession; give session.model",
    ),
    "the path before the model to save": (
        lambda m, s: ss.save_model("bar.snapspace", m),  # type: ignore[arg-type]
        "save_model: model is of type str; give model, path",
    ),
    "a problem as samples": (
        lambda m, s: ss.save_snapshots(s.problem, "bar.samples"),
        "save_snapshots: snapshots is of type PosingProblem; give those of solve_snapshots or load",
    ),
    "a session as glTF": (
        lambda m, s: ss.write_glb("bar.glb", m.session(), ss.mode_targets(m)),
        "write_glb: model is of type PosingSession; give session.model",
    ),
    "a session for Blender": (
        lambda m, s: ss.write_blender("bar.py", m.session(), ss.mode_targets(m)),
        "write_blender: model is of type PosingSession; give session.model",
    ),
    "a file's name as the reference": (
        lambda m, s: ss.validate(m, reference="bar.samples"),  # type: ignore[arg-type]
        "validate: reference is of type str; give those of solve_snapshots or load_snapshots",
    ),
    "no reference to split by": (
        lambda m, s: ss.split_errors(m, None),  # type: ignore[arg-type]
        "split_errors: reference is of type NoneType; give those of",
    ),
    "shapes to reduce by": (
        lambda m, s: ss.reduce(s.problem, m.subspace, snapshots=s.shapes),
        "reduce: snapshots is of type ndarray; give those of solve_snapshots",
    ),
    "shapes as known samples": (
        lambda m, s: ss.greedy_snapshots(s.problem, 4, known=s.shapes),
        "greedy_snapshots: known is of type ndarray; give those of solve_snapshots",
    ),
    "a session as the problem of samples": (
        lambda m, s: ss.load_snapshots("bar.samples", m.session()),
        "load_snapshots: problem is of type PosingSession; give path, problem",
    ),
    "a session's error curve": (
        lambda m, s: ss.error_curve(m.session()),
        "error_curve: model is of type PosingSession; give session.model",
    ),
    "a session with other handles": (
        lambda m, s: ss.with_handles(m.session(), s.problem),
        "with_handles: model is of type PosingSession; give session.model",
    ),
    "a session's morph targets": (
        lambda m, s: ss.mode_targets(m.session()),
        "mode_targets: model is of type PosingSession; give session.model",
    ),
    "a session's fitted targets": (
        lambda m, s: ss.fitted_targets(m.session(), s.shapes),
        "fitted_targets: model is of type PosingSession; give session.model",
    ),
    "a number as keys": (
        lambda m, s: ss.Timeline("posing", 3),  # type: ignore[arg-type]
        "Timeline: keys is of type int; give a list, such as [Key(0, state)]",
    ),
    "motions as keys": (
        lambda m, s: ss.Timeline("posing", ({"head": 0},)),  # type: ignore[arg-type]
        "Timeline: key 0 is of type dict; give Key(time, state)",
    ),
    "a motion as the state of a key": (
        lambda m, s: ss.Timeline("posing", (ss.Key(0.0, [0, 0]),)),  # type: ignore[arg-type]
        "Timeline: the state of key 0 is of type list; give motions by handle, or weights by pose",
    ),
    "a time in words": (
        lambda m, s: ss.Timeline("posing", (ss.Key("1 s", {}),)),  # type: ignore[arg-type]
        "Timeline: key 0 is at 1 s s, but times are 0 or more",
    ),
    "the mass of arrays": (
        lambda m, s: ss.mass_matrix((s.problem.mesh.vertices, s.problem.mesh.tets)),  # type: ignore[arg-type]
        "mass_matrix: mesh is of type tuple; give a TetMesh or ShellMesh",
    ),
    "the material before the mesh": (
        lambda m, s: ss.ElasticEnergy(ss.StVK(), s.problem.mesh),  # type: ignore[arg-type]
        "ElasticEnergy: mesh is of type StVK; give a TetMesh or ShellMesh",
    ),
    "a number as a timeline": (
        lambda m, s: ss.write_timeline("nod.json", 3),  # type: ignore[arg-type]
        "write_timeline: timeline is of type int; give path, timeline, such as Timeline(",
    ),
    "a session's tolerance in words": (
        lambda m, s: m.session(tolerance="a"),
        "Session: tolerance is of type str; give a positive number",
    ),
    "half an iteration of a session": (
        lambda m, s: m.session(max_iterations=1.5),
        "Session: max_iterations is of type float; give a whole number",
    ),
}


test_a_wrong_argument_is_refused_in_one_line = refusals(WRONG)


@pytest.mark.parametrize("count", [True, np.int64(1)])
def test_any_whole_number_counts_samples(posing_model: ss.PosingModel, count: Any) -> None:
    assert len(ss.sample(posing_model.problem.domain, count)) == 1
