"""The corpus: small files of every kind, written by the project itself, to be mutated."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import meshio
import numpy as np

import snapspace as ss
from snapspace.generators import bar
from snapspace.mesh import EmbeddedSurface, TetMesh
from snapspace.page import packed
from snapspace.snapshots.sample_file import write_samples


@cache
def mesh() -> TetMesh:
    """A bar of a dozen tets."""
    return bar(2, 1, 1)


@cache
def posing_problem(material: ss.Material | None = None) -> ss.PosingProblem:
    """The bar with handles at its ends; St.Venant-Kirchhoff unless a material is given."""
    x = mesh().vertices[:, 0]
    handles = ss.Handles([x < x.min() + 0.1, x > x.max() - 0.1], names=["foot", "head"])
    domain = ss.HandleBox(translation=0.2, angle=0.3)
    material = material or ss.StVK(lam=1.5, mu=0.7)
    return ss.PosingProblem(mesh(), handles, domain=domain, material=material)


@cache
def snapshots() -> ss.Snapshots:
    """Twelve solutions of the posing problem."""
    problem = posing_problem()
    return ss.solve_snapshots(problem, ss.sample(problem.domain, 12, seed=1), threads=1)


def models() -> Iterator[tuple[str, ss.ReducedModel]]:
    """A model of every kind of file, and of every part that a file may have."""
    yield "posing", posing_model(energy="exact")
    soft = np.linspace(0.5, 2.0, len(mesh().tets))
    material = ss.StableNeoHookean(lam=1.5 * soft, mu=soft)
    cubature = posing_model(material, energy="cubature")
    yield "posing-cubature", ss.calibrate(cubature, samples=8)
    corners = np.array([[0, 1, 2, 3], [4, 5, 6, 7], [0, 2, 4, 6]], np.int32)
    surface = EmbeddedSurface(np.array([[0, 1, 2]], np.int32), corners, np.full((3, 4), 0.25))
    yield "own-surface", replace(posing_model(energy="exact"), surface=surface)
    for kind in (ss.StVK(lam=1.5, mu=0.7), ss.StableNeoHookean(lam=1.5, mu=0.7)):
        bent = mesh().vertices * [1.0, 1.3, 0.8]
        bent[:, 2] += 0.3 * bent[:, 0] ** 2
        poses = ss.Poses([mesh().vertices, bent], mesh().tets, names=["rest", "bent"])
        problem = ss.InterpolationProblem(poses, material=kind)
        solved = ss.solve_snapshots(problem, ss.sample(problem.domain, 12, seed=1), threads=1)
        subspace = ss.snapshot_pca(solved, dimension=3)
        yield f"interpolation-{kind.kind}", ss.reduce(problem, subspace, snapshots=solved)
    for kind in (ss.ARAP(), ss.StableNeoHookean(lam=1.5, mu=0.7)):
        yield f"shell-{kind.kind}", ss.calibrate(shell_model(kind), samples=8)
        yield f"shells-{kind.kind}", blended_shells(kind)


def sheet() -> ss.ShellMesh:
    """The surface of the bar without its end, as a shell."""
    faces = mesh().surface[(mesh().vertices[mesh().surface][:, :, 0] > 1e-9).any(axis=1)]
    used, triangles = np.unique(faces, return_inverse=True)
    return ss.ShellMesh(mesh().vertices[used], triangles.reshape(-1, 3), thickness=0.1)


def shell_model(material: ss.Material) -> ss.PosingModel:
    """A model of the sheet with three modes."""
    x = sheet().vertices[:, 0]
    domain = ss.HandleBox(translation=0.2, angle=0.3)
    handles = ss.Handles([x < 0.1, x > x.max() - 0.1])
    problem = ss.PosingProblem(sheet(), handles, domain=domain, material=material)
    return _reduced(problem)


def blended_shells(material: ss.Material) -> ss.InterpolationModel:
    """A model of the sheet, as it is and bent, with three modes."""
    bent = sheet().vertices * [1.0, 1.3, 0.8]
    bent[:, 2] += 0.3 * bent[:, 0] ** 2
    poses = ss.ShellPoses([sheet().vertices, bent], sheet().triangles, thickness=0.1)
    return _reduced(ss.InterpolationProblem(poses, material=material))


def _reduced(problem: ss.PosingProblem | ss.InterpolationProblem) -> Any:
    solved = ss.solve_snapshots(problem, ss.sample(problem.domain, 12, seed=1), threads=1)
    return ss.reduce(problem, ss.snapshot_pca(solved, dimension=3), snapshots=solved)


KINDS = ("model", "page", "samples", "checkpoint", "problem", "surface", "tets", "timeline")


def write_corpus(folder: Path) -> None:
    """Writes the files for all targets, each into the folder of its kind."""
    for kind in KINDS:
        (folder / kind).mkdir(parents=True, exist_ok=True)
    for name, model in models():
        model.save(folder / "model" / f"{name}.snapspace")
        (folder / "page" / f"{name}.page").write_bytes(packed(model, name=name))
    ss.save_snapshots(snapshots(), folder / "samples" / "bar.samples")
    rows = list(snapshots().displacements.array())
    reports = snapshots().reports
    write_samples(folder / "checkpoint" / "bar.safetensors", range(len(rows)), rows, reports)
    _write_problem(folder / "problem" / "bar.json")
    for suffix in (".obj", ".off", ".ply"):
        ss.write_surface(folder / "surface" / f"bar{suffix}", mesh().vertices, mesh().surface)
    cells = {"triangle": mesh().surface}
    for name, binary in (("text", False), ("binary", True)):
        path = folder / "surface" / f"{name}.stl"
        meshio.Mesh(mesh().vertices, cells).write(path, binary=binary)
    (folder / "surface" / "many.obj").write_text(_OBJ, encoding="ascii")
    (folder / "surface" / "text.ply").write_text(_PLY, encoding="ascii")
    model = posing_model(energy="exact")
    ss.write_glb(folder / "surface" / "bar.glb", model, ss.mode_targets(model))
    _write_tets(folder / "tets")
    turn = ((0.1, 0.2, 0.3), (0.4, 0.5, 0.6))
    keys = (ss.Key(0.0, {}), ss.Key(1.5, {"head": turn}, "hold"), ss.Key(2.0, {}, "linear"))
    ss.write_timeline(folder / "timeline" / "posing.json", ss.Timeline("posing", keys, loop=True))
    weights = (ss.Key(0.0, {"rest": 1.0}), ss.Key(1.0, {"rest": 0.25, "bent": 0.75}))
    ss.write_timeline(folder / "timeline" / "weights.json", ss.Timeline("interpolation", weights))


def posing_model(material: ss.Material | None = None, *, energy: str) -> ss.PosingModel:
    """A model of the bar with three modes."""
    problem = posing_problem(material)
    solved = ss.solve_snapshots(problem, ss.sample(problem.domain, 12, seed=1), threads=1)
    subspace = ss.snapshot_pca(solved, dimension=3)
    return ss.reduce(problem, subspace, energy=energy, snapshots=solved)


def _write_problem(path: Path) -> None:
    regions = [{"boxes": [[[0, None, None], [1, 1, 1]]], "factor": 2}]
    sphere = {"name": "head", "spheres": [[[2, 0, 0], 0.5]], "domain": {"translation": [1, 0, 0]}}
    content = {
        "mesh": "bar.mesh",
        "material": {"model": "stvk", "young": 2.5, "poisson": 0.25, "regions": regions},
        "stiffness": 100.0,
        "domain": {"translation": 0.5, "angle_degrees": [10, 20, 30]},
        "handles": [{"name": "foot", "vertices": [0, 1, 2]}, sphere],
    }
    path.write_text(json.dumps(content), encoding="utf-8")


def _write_tets(folder: Path) -> None:
    tets = meshio.Mesh(mesh().vertices, {"tetra": mesh().tets})
    for suffix in (".mesh", ".msh", ".vtk", ".node", ".veg"):
        try:
            ss.write_tets(folder / f"bar{suffix}", mesh())
        except ValueError:  # a format that is only read
            continue
    tets.write(folder / "bar.meshb")
    tets.write(folder / "two.msh", file_format="gmsh22", binary=False)
    tets.write(folder / "four.msh", file_format="gmsh", binary=False)
    tets.write(folder / "binary.msh", file_format="gmsh", binary=True)
    tets.write(folder / "text.vtk", binary=False)
    tets.write(folder / "binary.vtk", binary=True)
    tets.write(folder / "text.vtu", binary=False)
    tets.write(folder / "binary.vtu", binary=True)
    (folder / "bar.veg").write_text(_veg(), encoding="ascii")
    (folder / "bar.node").write_text(_rows(mesh().vertices, "3 0 0"), encoding="ascii")
    (folder / "bar.ele").write_text(_rows(mesh().tets + 1, "4 0"), encoding="ascii")


def _rows(table: np.ndarray, header: str) -> str:
    """A table as TetGen and VegaFEM write it: with a count, and each row with its number."""
    rows = [" ".join(map(str, [i, *row])) for i, row in enumerate(table.tolist(), start=1)]
    return "\n".join([f"{len(table)} {header}", *rows]) + "\n"


def _veg() -> str:
    vertices = _rows(mesh().vertices, "3 0 0")
    return f"# bar\n*VERTICES\n{vertices}*ELEMENTS\nTET\n{_rows(mesh().tets + 1, '4 0')}"


_OBJ = """# a square and a fan
o part
v 0 0 0
v 1 0 0 1.0
v 1 1 0
v 0 1 0.5
vt 0 0
vn 0 0 1
f 1/1/1 2//1 3/1 \\
 -1
f -4 -3 -2
"""

_PLY = """ply
format ascii 1.0
comment with colours
element vertex 4
property float x
property float y
property float z
property uchar red
element face 2
property uchar flags
property list uchar int vertex_index
element edge 1
property int a
end_header
0 0 0 255
1 0 0 255
1 1 0 0
0 1 0 0
7 4 0 1 2 3
7 3 0 1 2
5
"""
