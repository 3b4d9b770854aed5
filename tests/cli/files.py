"""Files of a small bar for the commands: a mesh, a problem, poses, and altered copies of them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from snapspace import TetMesh, write_surface, write_tets
from snapspace.generators import bar
from snapspace.mesh import compact_surface

from ..shapes import bent

FloatArray = NDArray[np.float64]
Surface = tuple[FloatArray, NDArray[np.int32]]

POSES = ("rest", "bent", "twisted")


def bar_mesh(nx: int = 8, ny: int = 2, nz: int = 2) -> TetMesh:
    return bar(nx, ny, nz)


def problem_content(**changes: Any) -> dict[str, Any]:
    """A bar of length 4 that is fixed at its left end and moved at its right one."""
    left = {"name": "left", "boxes": [[[None, None, None], [0.01, None, None]]]}
    right = {"name": "right", "boxes": [[[3.99, None, None], [None, None, None]]]}
    content = {
        "mesh": "bar.msh",
        "material": {"model": "stvk", "lam": 1.0, "mu": 1.0},
        "stiffness": 1000,
        "domain": {"translation": 0.5, "angle_degrees": 30},
        "handles": [left, right],
    }
    return {**content, **changes}


def write_problem(folder: Path, name: str = "bar.json", **changes: Any) -> Path:
    """The problem file; the mesh is written beside it if it is not there."""
    if not (folder / "bar.msh").exists():
        write_tets(folder / "bar.msh", bar_mesh())
    path = folder / name
    path.write_text(json.dumps(problem_content(**changes)), encoding="utf-8")
    return path


def bar_shapes() -> dict[str, FloatArray]:
    """Vertices of the bar at rest, bent, and bent the other way and twisted."""
    mesh = bar_mesh()
    shapes = (mesh.vertices, bent(mesh, 1.2), bent(mesh, -0.7, twist=1.0))
    return dict(zip(POSES, shapes, strict=True))


def bar_surfaces() -> dict[str, Surface]:
    """Vertices and faces of the bar's poses, in an order other than that of the tet vertices."""
    surfaces = {}
    for name, shape in bar_shapes().items():
        vertices, faces = compact_surface(shape, bar_mesh().surface)
        last = len(vertices) - 1
        surfaces[name] = vertices[::-1].copy(), last - faces
    return surfaces


def write_tet_poses(folder: Path, suffix: str = ".mesh") -> list[Path]:
    """The poses of the bar as tet meshes."""
    paths = [folder / f"{name}{suffix}" for name in POSES]
    for path, shape in zip(paths, bar_shapes().values(), strict=True):
        write_tets(path, bar_mesh(), vertices=shape)
    return paths


def write_surface_poses(folder: Path, suffix: str = ".obj") -> list[Path]:
    """The poses of the bar as surfaces."""
    paths = [folder / f"{name}{suffix}" for name in POSES]
    for path, surface in zip(paths, bar_surfaces().values(), strict=True):
        write_surface(path, *surface)
    return paths


def surface_first() -> TetMesh:
    """The bar with the vertices of its surface before the others, in the surface's order."""
    mesh = bar_mesh()
    outer = mesh.surface_vertices[::-1]
    order = np.concatenate([outer, np.setdiff1d(np.arange(len(mesh.vertices)), outer)])
    return TetMesh(mesh.vertices[order], np.argsort(order)[mesh.tets])


def enclosing_mesh() -> TetMesh:
    """Tets around the bar that share no vertex with it, in a random order."""
    mesh = bar(10, 3, 3, length=4.2, width=1.2, height=1.2)
    order = np.random.default_rng(0).permutation(len(mesh.vertices))
    return TetMesh(mesh.vertices[order] - 0.1, np.argsort(order)[mesh.tets])


def write_raw(path: Path, vertices: FloatArray, tets: NDArray[np.int32]) -> None:
    """Writes a MEDIT file without any check."""
    rows = [f"{x!r} {y!r} {z!r} 0" for x, y, z in vertices.tolist()]
    cells = [" ".join(str(i + 1) for i in tet) + " 0" for tet in tets.tolist()]
    head = ["MeshVersionFormatted 2", "Dimension 3"]
    lines = [*head, f"Vertices {len(rows)}", *rows, f"Tetrahedra {len(cells)}", *cells, "End"]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def contents(folder: Path) -> dict[str, bytes]:
    """All files below a folder, to check that none has changed."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }
