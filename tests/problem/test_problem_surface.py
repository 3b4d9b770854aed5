"""The surface that a problem file names."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from snapspace import read_problem, read_problem_surface
from snapspace.mesh import write_surface, write_tets
from snapspace.problem import problem_content

from ..shapes import bar_problem, surface_around

PROBLEM = bar_problem()
SURFACE = surface_around(PROBLEM.mesh)
POINTS = SURFACE.vertices(PROBLEM.mesh.vertices)


def saved(folder: Path, surface: object = "own.obj") -> Path:
    write_tets(folder / "bar.msh", PROBLEM.mesh)
    content = problem_content(PROBLEM, "bar.msh") | {"surface": surface}
    path = folder / "bar.json"
    path.write_text(json.dumps(content), encoding="utf-8")
    return path


def test_the_surface_is_embedded_in_the_tets(tmp_path: Path) -> None:
    path = saved(tmp_path)
    write_surface(tmp_path / "own.obj", POINTS, SURFACE.faces)
    problem = read_problem(path)
    surface = read_problem_surface(path, problem.mesh)
    assert surface is not None
    assert np.array_equal(surface.faces, SURFACE.faces)
    assert surface.vertices(problem.mesh.vertices) == pytest.approx(POINTS, abs=1e-12)


def test_quads_become_triangles_and_loose_vertices_are_left_out(tmp_path: Path) -> None:
    low, high = PROBLEM.mesh.vertices.min(axis=0), PROBLEM.mesh.vertices.max(axis=0)
    corners = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    box = low + (high - low) * np.array([[99.0, 99, 99], *corners])
    quads = ["2 3 5 4", "6 8 9 7", "2 6 7 3", "4 5 9 8", "2 4 8 6", "3 7 9 5"]
    text = [f"v {x} {y} {z}" for x, y, z in box.tolist()] + [f"f {quad}" for quad in quads]
    (tmp_path / "own.obj").write_text("\n".join(text), encoding="utf-8")
    surface = read_problem_surface(saved(tmp_path), PROBLEM.mesh)
    assert surface is not None and len(surface.faces) == 12
    assert surface.vertices(PROBLEM.mesh.vertices) == pytest.approx(box[1:], abs=1e-12)


def test_a_file_may_name_no_surface(tmp_path: Path) -> None:
    path = tmp_path / "bar.json"
    path.write_text(json.dumps(problem_content(PROBLEM, "bar.msh")), encoding="utf-8")
    assert read_problem_surface(path, PROBLEM.mesh) is None


@pytest.mark.parametrize(
    ("scale", "surface", "message"),
    [
        (1.0, "gone.obj", "gone.obj"),
        (1.0, 7, "surface must be a string, got 7"),
        (100.0, "own.obj", "embed_surface: vertex 0 lies .* in the same unit and frame"),
    ],
)
def test_a_surface_that_does_not_fit_the_mesh_is_refused(
    tmp_path: Path, scale: float, surface: object, message: str
) -> None:
    path = saved(tmp_path, surface)
    write_surface(tmp_path / "own.obj", scale * POINTS, SURFACE.faces)
    with pytest.raises(ValueError, match=message) as caught:
        read_problem_surface(path, PROBLEM.mesh)
    assert str(caught.value).startswith(f"{path}: ") and "\n" not in str(caught.value)
