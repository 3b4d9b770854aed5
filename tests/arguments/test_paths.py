"""An argument that is no path is refused by name, by every function that takes a path."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import pytest

import snapspace as ss
from snapspace.pictures import save_film, save_png

KEYS = (ss.Key(0.0, {}),)

#: Every function that takes a path, given a model, its snapshots and something in its place.
PATHS: dict[str, Callable[[Any, Any, Any], Any]] = {
    "Checkpoint": lambda m, s, path: ss.Checkpoint(path),
    "SurfaceFile.write": lambda m, s, path: ss.SurfaceFile("a.off", b"").write(path, []),
    "export_html": lambda m, s, path: ss.export_html(m, path),
    "export_packed": lambda m, s, path: ss.export_packed(m, path),
    "load": lambda m, s, path: ss.load(path),
    "load_blending": lambda m, s, path: ss.load_blending(path),
    "load_posing": lambda m, s, path: ss.load_posing(path),
    "load_snapshots": lambda m, s, path: ss.load_snapshots(path, s.problem),
    "open_surface": lambda m, s, path: ss.open_surface(path),
    "read_problem": lambda m, s, path: ss.read_problem(path),
    "read_problem_surface": lambda m, s, path: ss.read_problem_surface(path, s.problem.mesh),
    "read_surface": lambda m, s, path: ss.read_surface(path),
    "read_tets": lambda m, s, path: ss.read_tets(path),
    "read_timeline": lambda m, s, path: ss.read_timeline(path),
    "save_film": lambda m, s, path: save_film(path, [], m.surface.faces),
    "save_model": lambda m, s, path: m.save(path),
    "save_png": lambda m, s, path: save_png(path, []),
    "save_snapshots": lambda m, s, path: ss.save_snapshots(s, path),
    "write_animation": lambda m, s, path: ss.write_animation(path, m, []),
    "write_blender": lambda m, s, path: ss.write_blender(path, m, ss.mode_targets(m)),
    "write_glb": lambda m, s, path: ss.write_glb(path, m, ss.mode_targets(m)),
    "write_surface": lambda m, s, path: ss.write_surface(path, m.session().vertices, []),
    "write_tets": lambda m, s, path: ss.write_tets(path, s.problem.mesh),
    "write_timeline": lambda m, s, path: ss.write_timeline(path, ss.Timeline("posing", KEYS)),
}


@pytest.mark.parametrize("path", [3, None, b"bar.obj", ["bar.obj"]])
@pytest.mark.parametrize("who", PATHS)
def test_an_argument_that_is_no_path_is_refused_by_name(
    posing_model: ss.PosingModel, posing_snapshots: ss.Snapshots, who: str, path: Any
) -> None:
    message = f"{who}: path is of type {type(path).__name__}; give the name of a "
    with pytest.raises(ValueError, match=re.escape(message)):
        PATHS[who](posing_model, posing_snapshots, path)


def test_every_function_with_a_path_is_among_them() -> None:
    functions = {name: getattr(ss, name) for name in ss.__all__ if callable(getattr(ss, name))}
    taking = {name for name, function in functions.items() if takes_path(function)}
    assert taking <= set(PATHS)


def takes_path(function: Any) -> bool:
    given = getattr(function, "__annotations__", {}).items()
    return any(name != "return" and "Path" in str(kind) for name, kind in given)
