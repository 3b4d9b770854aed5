"""Wrong arguments of problems, meshes, surfaces and files are refused in one line."""

from __future__ import annotations

from typing import Any

import numpy as np

import snapspace as ss

from .refused import Call, refusals


def surface(snapshots: Any) -> ss.EmbeddedSurface:
    return ss.boundary_surface(snapshots.problem.mesh)


def embedded(snapshots: Any, **changed: Any) -> ss.EmbeddedSurface:
    mesh = snapshots.problem.mesh
    shown = surface(snapshots)
    options = {"mesh": mesh, **changed}
    return ss.embed_surface(shown.vertices(mesh.vertices), shown.faces, **options)


def stuffed(snapshots: Any, edge_length: Any) -> ss.TetMesh:
    mesh = snapshots.problem.mesh
    return ss.stuff_surface(mesh.vertices, mesh.surface, edge_length=edge_length)


WRONG: dict[str, tuple[Call, str]] = {
    "a number as a file's name": (
        lambda m, s: ss.SurfaceFile(3, b""),  # type: ignore[arg-type]
        "SurfaceFile: name is of type int; give the name of a file",
    ),
    "a file's text": (
        lambda m, s: ss.SurfaceFile("a.obj", "v 0 0 0"),  # type: ignore[arg-type]
        "SurfaceFile: data is of type str; give the bytes of the file",
    ),
    "a rotation in words": (
        lambda m, s: ss.RigidMotion("x", np.zeros(3)),  # type: ignore[arg-type]
        "RigidMotion: rotation must be numbers, in rows of one length, but are of type str",
    ),
    "a flat rotation": (
        lambda m, s: ss.RigidMotion(np.eye(2), np.zeros(3)),
        "RigidMotion: rotation must be (3, 3), got (2, 2)",
    ),
    "a scale that mirrors": (
        lambda m, s: ss.RigidMotion(np.eye(3), np.zeros(3), -1.0),
        "RigidMotion: scale is -1.0, but must be positive",
    ),
    "ragged vertices to follow": (
        lambda m, s: m.surface.following([[1, 2], [3]]),
        "EmbeddedSurface: vertices must be numbers, in rows of one length",
    ),
    "a shape of another mesh": (
        lambda m, s: s.problem.value_and_gradient(np.zeros(3), s.parameters[0]),
        "ElasticEnergy: the shape has 3 coordinates, but the mesh has 81 vertices, which need 243",
    ),
    "a mask of vertices to follow": (
        lambda m, s: m.surface.following(np.arange(81) < 5),
        "EmbeddedSurface: vertices must be indices of tet vertices, but are bool; np.flatnonzero(",
    ),
    "transposed vertices": (
        lambda m, s: s.problem.value_and_gradient(s.problem.mesh.vertices.T, s.parameters[0]),
        "ElasticEnergy: the shape has shape (3, 81), but must be (81, 3), one row per vertex, or (",
    ),
    "transposed vertices at handles": (
        lambda m, s: s.problem.handle_energy(
            s.problem.mesh.vertices.T, s.problem.offsets(s.parameters[0])
        ),
        "PosingProblem: the shape has shape (3, 81), but must be (81, 3)",
    ),
    "a transposed direction": (
        lambda m, s: s.problem.energy.hessian_product(s.problem.tau, s.problem.mesh.vertices.T),
        "ElasticEnergy: the direction has shape (3, 81), but must be (81, 3)",
    ),
    "complex numbers": (
        lambda m, s: s.problem.energy.value(s.problem.tau + 1j),
        "ElasticEnergy: the shape must be numbers, in rows of one length, but are of type ndarray",
    ),
    "weights of a surface in words": (
        lambda m, s: ss.EmbeddedSurface(m.surface.faces, m.surface.corners, "x"),  # type: ignore[arg-type]
        "EmbeddedSurface: weights must be numbers, in rows of one length, but are of type str",
    ),
    "the name of a surface's file": (
        lambda m, s: ss.EmbeddedSurface(
            m.surface.faces,
            m.surface.corners,
            m.surface.weights,
            "spot.obj",  # type: ignore[arg-type]
        ),
        "EmbeddedSurface: source is of type str; give open_surface(path)",
    ),
    "a name as the progress of filling": (
        lambda m, s: ss.stuff_surface(
            s.problem.mesh.vertices,
            s.problem.mesh.surface,
            progress="bar",  # type: ignore[arg-type]
        ),
        "stuff_surface: progress is of type str; give a function, or None",
    ),
    "ragged vertices of a handle": (
        lambda m, s: ss.Handles([[[1, 2], [3]], [4]], names=["foot", "head"]),
        "Handles: 'foot': vertices is of type list; give a list of vertex indices or a boolean",
    ),
    "vertices as the name of a handle": (
        lambda m, s: s.problem.handles.without(np.arange(3)),
        "there is no handle 'an array of shape (3,)'; the handles are ",
    ),
    "complex bounds": (
        lambda m, s: ss.HandleBox(translation=np.ones(3) * 1j, angle=0.1),
        "HandleBox: translation must be one number, three, or three for each moving handle, got",
    ),
    "threads that are not a number": (
        lambda m, s: ss.fit_poses(
            s.problem.mesh,
            m.surface,
            [m.surface.vertices(s.problem.mesh.vertices)],
            threads=np.nan,  # type: ignore[arg-type]
        ),
        "fit_poses: threads is nan, but must be a whole number, or None",
    ),
    "the seed of blends in words": (
        lambda m, s: ss.Simplex(corners=5).blends(3, seed="a"),  # type: ignore[arg-type]
        "Simplex: seed is 'a', but must be a whole number",
    ),
    "handles of a shape of another mesh": (
        lambda m, s: s.problem.handle_energy(np.zeros(300), s.problem.offsets(s.parameters[0])),
        "PosingProblem: the shape has 300 coordinates, but the mesh has 81 vertices",
    ),
    "offsets in words": (
        lambda m, s: s.problem.target_displacements("x"),
        "PosingProblem: offsets must be numbers, in rows of one length, but are of type str",
    ),
    "one row of parameters": (
        lambda m, s: s.problem.offsets_of_all(s.parameters[0]),
        "PosingProblem: parameters have shape (12,), but must be (k, p), one sample per row; a",
    ),
    "a list as other handles": (
        lambda m, s: s.problem.with_handles([[0], [1]]),
        "PosingProblem: handles is of type list; give Handles([fixed, moving])",
    ),
    "the number of handles": (
        lambda m, s: ss.Handles(3),  # type: ignore[arg-type]
        "Handles: vertices is of type int; give a list with the vertices of each handle",
    ),
    "a number as names": (
        lambda m, s: ss.Handles([[0], [1]], names=3),  # type: ignore[arg-type]
        "Handles: names is of type int; give a list of names",
    ),
    "the number of the fixed handle": (
        lambda m, s: s.problem.handles.fixing(7),
        "there is no handle '7'; the handles are foot, head, belly",
    ),
    "places among names": (
        lambda m, s: s.problem.handles.places_in(["foot"]),
        "Handles.places_in: others is of type list; give Handles",
    ),
    "a mesh as poses": (
        lambda m, s: ss.InterpolationProblem(s.problem.mesh),
        "InterpolationProblem: poses is of type TetMesh; give Poses, ShellPoses or a list of",
    ),
    "arrays as meshes": (
        lambda m, s: ss.Poses.of([s.problem.mesh, np.eye(3)]),  # type: ignore[list-item]
        "Poses: mesh 1 is of type ndarray; give a list of TetMesh",
    ),
    "tets as shells": (
        lambda m, s: ss.ShellPoses.of([s.problem.mesh]),
        "ShellPoses: mesh 0 is of type TetMesh; give a list of ShellMesh",
    ),
    "half a corner": (
        lambda m, s: ss.Simplex(corners=2.5),  # type: ignore[arg-type]
        "Simplex: corners is 2.5, but must be a whole number",
    ),
    "extrapolation in words": (
        lambda m, s: ss.Simplex(corners=2, extrapolation="x"),  # type: ignore[arg-type]
        "Simplex: extrapolation is 'x', but it must be zero or positive",
    ),
    "an endless grid": (
        lambda m, s: s.problem.domain.grid(np.inf),
        "HandleBox: count is inf, but must be a whole number",
    ),
    "points of another box": (
        lambda m, s: s.problem.domain.from_unit(np.zeros((2, 5))),
        "HandleBox: points have shape (2, 5), but must be (..., 12)",
    ),
    "one vertex in a box": (
        lambda m, s: ss.in_box([0, 0, 0], (0, 0, 0), (1, 1, 1)),
        "box: vertices must have shape (n, 3), got (3,)",
    ),
    "a corner that is a number": (
        lambda m, s: ss.in_box(s.problem.mesh.vertices, 0, (1, 1, 1)),  # type: ignore[arg-type]
        "box: a corner needs three numbers (or null), got 0",
    ),
    "a radius in words": (
        lambda m, s: ss.in_sphere(s.problem.mesh.vertices, (0, 0, 0), "x"),  # type: ignore[arg-type]
        "sphere: the radius is 'x', but it must be positive",
    ),
    "handles in tets without tets": (
        lambda m, s: ss.handles_in_tets(s.problem.handles, surface(s), surface(s)),  # type: ignore[arg-type]
        "handles_in_tets: mesh is of type EmbeddedSurface; give a TetMesh or ShellMesh",
    ),
    "the boundary of a model": (
        lambda m, s: ss.boundary_surface(m),
        "boundary_surface: mesh is of type PosingModel; give a TetMesh or ShellMesh",
    ),
    "a model to embed in": (
        lambda m, s: embedded(s, mesh=m),
        "embed_surface: mesh is of type PosingModel; give the TetMesh that fills the surface",
    ),
    "a distance in words": (
        lambda m, s: embedded(s, farthest="x"),
        "embed_surface: farthest is 'x', but it must be zero or positive",
    ),
    "a surface's shape in words": (
        lambda m, s: surface(s).vertices("x"),
        "EmbeddedSurface: the shape must be numbers, in rows of one length, but are of type str",
    ),
    "a number as faces": (
        lambda m, s: ss.check_surface(s.problem.mesh.vertices, 3),
        "faces must have shape (m, 3), got ()",
    ),
    "an edge length in words": (
        lambda m, s: ss.stuff_surface(
            s.problem.mesh.vertices, s.problem.mesh.surface, edge_length="x"
        ),  # type: ignore[arg-type]
        "stuff_surface: edge_length is 'x', but must be positive and at most",
    ),
    "the path after the mesh": (
        lambda m, s: ss.write_tets("bar.msh", m),
        "write_tets: mesh is of type PosingModel; give path, mesh",
    ),
    "a list as data": (
        lambda m, s: ss.write_tets("bar.msh", s.problem.mesh, point_data=[1]),  # type: ignore[arg-type]
        "write_tets: point_data is of type list; give a dictionary of arrays by name",
    ),
    "a dense mass to register by": (
        lambda m, s: ss.rigid_registration(s.shapes[0], s.shapes[1], np.eye(81)),  # type: ignore[arg-type]
        "rigid_registration: mass is of type ndarray; give mass_matrix(mesh) or problem.mass()",
    ),
    "surfaces to fit in a model": (
        lambda m, s: ss.fit_poses(m, surface(s), np.zeros((1, 3, 3))),
        "fit_poses: mesh is of type PosingModel; give mesh, surface, targets",
    ),
    "a deviation in words": (
        lambda m, s: ss.fit_poses(s.problem.mesh, surface(s), np.zeros((1, 74, 3)), deviation="x"),  # type: ignore[arg-type]
        "fit_poses: deviation is 'x', but it must be positive",
    ),
    "a clamp in words": (
        lambda m, s: s.problem.energy.clamped_hessian(s.shapes[0], threshold="x"),
        "clamped_hessian: threshold is 'x', but must be in (0, 1]",
    ),
    "shapes as morph targets": (
        lambda m, s: ss.write_glb("bar.glb", m, s.shapes),
        "write_glb: morphs is of type ndarray; give those of mode_targets, fitted_targets or",
    ),
    "colours of other vertices": (
        lambda m, s: ss.write_glb("bar.glb", m, ss.mode_targets(m), colors=np.zeros((2, 3))),
        "write_glb: colors have shape (2, 3), but must be (",
    ),
    "an axis for Blender": (
        lambda m, s: ss.write_blender("bar.py", m, ss.mode_targets(m), up="w"),
        "write_blender: up is 'w', but it must be one of x, y, z",
    ),
    "a problem's shape": (
        lambda m, s: ss.still_shape(s.problem, s.shapes[0]),
        "still_shape: model is of type PosingProblem; give that of reduce or load",
    ),
    "no frames": (
        lambda m, s: ss.write_animation("bar.glb", m, 3),  # type: ignore[arg-type]
        "write_animation: shapes is of type int; give the vertices (n, 3) of each frame",
    ),
    "half a target": (
        lambda m, s: ss.fitted_targets(m, s.shapes, count=1.5),  # type: ignore[arg-type]
        "fitted_targets: count is 1.5, but must be a whole number",
    ),
    "a number as title": (
        lambda m, s: ss.export_packed(m, "bar.snapspace", title=3),  # type: ignore[arg-type]
        "packed: the title is of type int; give a string",
    ),
    "no rate": (
        lambda m, s: ss.Timeline("posing", (ss.Key(0.0, {}),)).frame_count("x"),  # type: ignore[arg-type]
        "Timeline.frame_count: frames_per_second is 'x', but must be a number",
    ),
    "one frame": (
        lambda m, s: ss.Timeline("posing", (ss.Key(0.0, {}),)).shares(1),
        "Timeline.shares: frames is 1, but must be at least 2",
    ),
}


test_a_wrong_argument_is_refused_in_one_line = refusals(WRONG)
