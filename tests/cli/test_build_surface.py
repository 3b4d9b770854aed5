"""`build` fills a surface by itself: one command from the surface to the model."""

from __future__ import annotations

import json
from pathlib import Path
from typing import NoReturn

import numpy as np
import pytest

from snapspace import (
    PosingModel,
    load,
    read_problem,
    read_surface,
    read_tets,
    stuff_surface,
)
from snapspace.filling import surface_filling
from snapspace.mesh import compact_surface, write_surface

from .conftest import Run
from .files import bar_mesh, problem_content

SMALL = ("--samples", 12, "--dimension", 6)
#: Fewer tets than by default, which would take most of the time.
LARGE_TETS = ("--edge-length", 0.08)


@pytest.fixture
def surface(tmp_path: Path) -> Path:
    """The surface of a bar."""
    mesh = bar_mesh()
    path = tmp_path / "bar.obj"
    write_surface(path, *compact_surface(mesh.vertices, mesh.surface))
    return path


def problem(folder: Path, **changes: object) -> Path:
    path = folder / "bar.json"
    content = problem_content(**changes)
    del content["mesh"]
    path.write_text(json.dumps(content), encoding="utf-8")
    return path


def posing_model(path: Path) -> PosingModel:
    model = load(path)
    assert isinstance(model, PosingModel)
    return model


def test_a_surface_is_filled_shown_and_posed(run: Run, surface: Path, tmp_path: Path) -> None:
    named = problem(tmp_path, surface=surface.name)
    first, second = tmp_path / "first.snapspace", tmp_path / "second.snapspace"
    told = run("build", "--problem", named, *SMALL, *LARGE_TETS, "-o", first)
    assert told.code == 0 and "filled bar.obj with" in told.err
    given = problem(tmp_path)  # names neither tets nor a surface
    assert run("build", "--problem", given, surface, *SMALL, *LARGE_TETS, "-o", second).code == 0
    one, other = posing_model(first), posing_model(second)
    assert np.array_equal(one.subspace.basis, other.subspace.basis), "the same tets"
    assert one.provenance["mesh"] == "bar.obj"
    shown = one.surface.vertices(one.problem.mesh.vertices)
    np.testing.assert_allclose(shown, read_surface(surface)[0], atol=1e-12)
    assert one.surface.source is not None


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"domain": {"translation": 1}}, "domain: the entry 'angle_degrees' is missing"),
        ({"handles": []}, "needs a fixed handle and at least one to move"),
        (
            {"handles": [{"name": "a", "boxes": [[[0, 0], [1, 1]]]}, {"name": "b"}]},
            "handle 'a': box: a corner needs three numbers (or null), got [0.0, 0.0]",
        ),
        ({"handles": [{"name": "a"}, {"name": "a"}]}, "the name 'a' is used twice"),
        ({"handles": [{"vertices": [-1]}, {}]}, "handle 'handle_0': a vertex index is -1"),
        ({"material": {"model": "rubber"}}, "material: unknown material 'rubber'"),
        ({"material": {"young": 1.0}}, "material: 'young' also needs the entry 'poisson'"),
        ({"stiffness": "high"}, "stiffness must be a number"),
        ({"up": "Z"}, "up must be one of x, y, z"),
        ({"mirror": {"normal": [0, 0, 0]}}, "the normal is zero"),
    ],
)
def test_mistakes_in_a_problem_are_found_before_a_surface_is_filled(
    run: Run,
    surface: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    changes: dict[str, object],
    message: str,
) -> None:
    """Filling may take minutes."""

    def fill(*_: object, **__: object) -> NoReturn:
        raise AssertionError("it was filled")

    monkeypatch.setattr("snapspace.filling.SurfaceFilling.fill", fill)
    monkeypatch.setattr("snapspace.problem.problem_file.stuff_surface", fill)
    named = problem(tmp_path, surface=surface.name, **changes)
    assert message in run("build", "--problem", named, "-o", tmp_path / "m.snapspace").error
    with pytest.raises(ValueError) as caught:
        read_problem(named)
    assert message in str(caught.value)


def test_repair_is_refused_where_there_are_no_tets(run: Run, surface: Path, tmp_path: Path) -> None:
    named = problem(tmp_path, surface=surface.name)
    words = ("build", "--problem", named, "--repair", "-o", tmp_path / "m.snapspace")
    assert f"--repair is for tets, but {surface} is a surface" in run(*words).error
    assert "--repair is for tets, but a shell has none" in run(*words, "--shell", 0.1).error


def test_lists_with_one_value_per_tet_wait_for_the_tets(
    run: Run, surface: Path, tmp_path: Path
) -> None:
    named = problem(tmp_path, surface=surface.name, material={"lam": [1.0, 2.0], "mu": 1.0})
    result = run("build", "--problem", named, *LARGE_TETS, "-o", tmp_path / "m.snapspace")
    assert result.code == 2 and "filled bar.obj" in result.err
    assert "the material has moduli for 2 tets, but the mesh has" in result.err


def test_python_fills_the_same_tets(surface: Path, tmp_path: Path) -> None:
    vertices, faces = read_surface(surface)
    mesh = read_problem(problem(tmp_path, surface=surface.name)).mesh
    assert np.array_equal(mesh.vertices, stuff_surface(vertices, faces).vertices)


def test_the_size_of_the_tets_can_be_chosen(run: Run, surface: Path, tmp_path: Path) -> None:
    named, path = problem(tmp_path, surface=surface.name), tmp_path / "m.snapspace"
    counts = []
    for length in (0.06, 0.12):
        told = run("build", "--problem", named, *SMALL, "--edge-length", length, "-o", path)
        assert told.code == 0
        counts.append(len(posing_model(path).problem.mesh.tets))
    assert counts[0] > 4 * counts[1]


def test_tets_that_differ_in_each_run_are_kept(
    run: Run, surface: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """fTetWild takes its points in a random order; quick tets stand in for it here."""
    quick = surface_filling.stuff_surface
    monkeypatch.setattr(
        surface_filling, "fill_surface", lambda v, f, **o: quick(v, f, edge_length=o["edge_length"])
    )
    named, path = problem(tmp_path, surface=surface.name), tmp_path / "m.snapspace"
    told = run("build", "--problem", named, "--exact", *SMALL, *LARGE_TETS, "-o", path)
    assert told.code == 0
    kept = tmp_path / "m-tets.msh"
    assert f"wrote {kept}; give it in place of bar.obj" in told.err
    assert np.array_equal(read_tets(kept).tets, posing_model(path).problem.mesh.tets)


def test_quick_tets_that_are_too_large_are_reported(
    run: Run, surface: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    quick = surface_filling.stuff_surface
    monkeypatch.setattr(surface_filling, "stuff_surface", refused)
    monkeypatch.setattr(
        surface_filling, "fill_surface", lambda v, f, **_: quick(v, f, edge_length=0.08)
    )
    named, path = problem(tmp_path, surface=surface.name), tmp_path / "m.snapspace"
    told = run("build", "--problem", named, *SMALL, "-o", path)
    assert told.code == 0
    assert "notice: bar.obj has parts or gaps too thin for quick tets" in told.err
    assert (tmp_path / "m-tets.msh").is_file()


def refused(*_: object, **__: object) -> NoReturn:
    raise ValueError("too thin")


def test_a_problem_needs_tets_or_a_surface(run: Run, tmp_path: Path) -> None:
    told = run("build", "--problem", problem(tmp_path), *SMALL, "-o", tmp_path / "m.snapspace")
    assert told.code == 2
    assert "the entries 'mesh' and 'surface' are missing; one is needed" in told.err
    with pytest.raises(ValueError, match=r"bar\.json: the entries 'mesh' and 'surface'"):
        read_problem(problem(tmp_path))


def test_a_surface_that_cannot_be_filled_is_refused(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "flat.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", encoding="utf-8")
    told = run(
        "build", "--problem", problem(tmp_path), path, *SMALL, "-o", tmp_path / "m.snapspace"
    )
    assert told.code == 2 and "flat.obj: " in told.err and "Traceback" not in told.err
