"""The picture of several poses: four at the corners of a sheet, and blends of them between."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from pictures_placing import placed
from scipy.sparse import csr_array, diags_array

import snapspace as ss
from snapspace.cli.motions import Motion, as_parameters
from snapspace.generators import creature, creature_paint
from snapspace.pictures import render_row

FloatArray = NDArray[np.float64]

TETS = 50_000
ROWS, COLUMNS = 3, 4

# The head looks towards +x and the back towards +z; angles in degrees. From the upper left corner
# of the sheet to the lower right one. Stronger motions turn tets inside out.
MOTIONS: dict[str, dict[str, Motion]] = {
    "rear up": {
        "left foot": Motion((0, -20, 0), (0.1, 0, 0.55)),
        "right foot": Motion((0, -10, 0), (0.1, 0, 0.42)),
        "head": Motion((0, -35, 0), (-0.7, 0, 0.6)),
        "tail": Motion((0, -25, 0), (-0.4, 0, -0.6)),
    },
    "look round": {
        "head": Motion((0, 0, -80), (-0.05, -0.4, 0.05)),
        "tail": Motion((0, 0, 50), (0.2, -0.6, -0.1)),
    },
    "sniff": {
        "head": Motion((0, 50, 0), (0.5, 0, -0.6)),
        "tail": Motion((0, -50, 0), (-0.35, 0, -0.5)),
    },
    "play": {
        "left foot": Motion((0, 0, 0), (0.2, 0, 0)),
        "right foot": Motion((0, 0, 0), (0.1, 0, 0)),
        "head": Motion((35, 0, 0), (0.25, -0.2, -0.1)),
        "tail": Motion((-20, 20, 0), (0.15, 0.35, 0.25)),
    },
}


def poses_picture() -> NDArray[np.uint8]:
    """A sheet of blends with bilinear weights; the poses are in its corners."""
    mesh = creature(TETS)
    poses = creature_poses(mesh)
    problem = ss.InterpolationProblem(poses)
    snapshots = ss.solve_snapshots(problem, ss.sample(problem.domain, 30, method="sobol"))
    subspace = ss.snapshot_pca(snapshots, dimension=20)
    session = ss.reduce(problem, subspace, snapshots=snapshots).session()
    shapes = []
    for down in np.linspace(0.0, 1.0, ROWS):
        for across in np.linspace(0.0, 1.0, COLUMNS):
            session.blend(np.kron([1.0 - down, down], [1.0 - across, across]))
            shapes.append(placed(on_hind_feet(session.vertices, mesh)))
    labels = [""] * len(shapes)
    corners = (0, COLUMNS - 1, -COLUMNS, -1)
    for corner, name in zip(corners, poses.names, strict=True):
        labels[corner] = name
    return render_row(
        shapes,
        mesh.surface,
        labels=labels,
        columns=COLUMNS,
        colors=creature_paint(mesh),
        size=(260, 245),
        azimuth=-42.0,
        elevation=12.0,
        margin=0.06,
        font_size=19,
    )


def creature_poses(mesh: ss.TetMesh) -> ss.Poses:
    """The poses of MOTIONS, full solves of a posing problem; none has an inverted tet."""
    return ss.Poses(solved_motions(mesh)[-1], mesh.tets, names=list(MOTIONS))


def many_creature_poses(mesh: ss.TetMesh) -> ss.Poses:
    """At rest, and each of MOTIONS in four steps: rear-up-01, rear-up-02 ..."""
    shapes = {"rest": mesh.vertices}
    steps = solved_motions(mesh)
    for k, name in enumerate(MOTIONS):
        for number, step in enumerate(steps, start=1):
            shapes[f"{name.replace(' ', '-')}-{number:02}"] = step[k]
    return ss.Poses(np.stack(list(shapes.values())), mesh.tets, names=list(shapes))


def solved_motions(mesh: ss.TetMesh) -> list[FloatArray]:
    """Shapes (k, n, 3) of MOTIONS by a quarter, a half, three quarters and whole."""
    vertices = mesh.vertices
    handles = {
        "hind feet": hind_feet(mesh),
        "left foot": ss.in_box(vertices, [0, 0, None], [None, None, 0.1]),
        "right foot": ss.in_box(vertices, [0, None, None], [None, 0, 0.1]),
        "head": ss.in_sphere(vertices, [0.85, 0, 1.7], 0.3),
        "tail": ss.in_sphere(vertices, [-1.42, 0, 1.4], 0.2),
    }
    problem = ss.PosingProblem(
        mesh,
        ss.Handles(list(handles.values()), names=list(handles)),
        domain=ss.HandleBox(translation=1.0, angle=np.deg2rad(90)),
    )
    motions = np.array([as_parameters(problem, motion)[0] for motion in MOTIONS.values()])
    # in four steps, each from the shapes of the last: at once, limbs could fold
    known: ss.Snapshots | None = None
    shapes = []
    for share in (0.25, 0.5, 0.75, 1.0):
        step = ss.solve_snapshots(problem, share * motions, known=known)
        known = step if known is None else known.joined(step)
        shapes.append(step.shapes.reshape(len(motions), -1, 3))
    return shapes


def on_hind_feet(vertices: FloatArray, mesh: ss.TetMesh) -> FloatArray:
    """The vertices (n, 3) moved rigidly so that the hind feet are where they are at rest.

    Blends are registered to the mean shape as a whole: one that rears up would lie lower there.
    """
    mass = csr_array(diags_array(mesh.vertex_masses * hind_feet(mesh)))
    motion = ss.rigid_registration(vertices.reshape(-1), mesh.vertices.reshape(-1), mass)
    return motion.apply(vertices)


def hind_feet(mesh: ss.TetMesh) -> NDArray[np.bool_]:
    """Mask (n,) of the vertices of the hind feet."""
    return ss.in_box(mesh.vertices, [None, None, None], [0, None, 0.15])
