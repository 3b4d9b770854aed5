from __future__ import annotations

import codecs
import copy
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from snapspace import (
    HandleBox,
    Handles,
    PosingProblem,
    StableNeoHookean,
    StVK,
    read_problem,
    write_tets,
)
from snapspace.generators import bar
from snapspace.problem import problem_content

from ..shapes import bar_problem

MESH = bar(4, 1, 1)  # 20 vertices; x = 0, 1, 2, 3, 4
CONTENT: dict[str, Any] = {
    "mesh": "../meshes/bar.msh",
    "material": {"model": "stvk", "lam": 2.0, "mu": 0.5},
    "stiffness": 30,
    "domain": {"translation": 0.5, "angle_degrees": [10, 20, 90]},
    "handles": [
        {"name": "foot", "boxes": [[[None, None, None], [0.1, None, None]]]},
        {"name": "head", "spheres": [[[4, 0, 0], 0.1]], "vertices": [17]},
    ],
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder problems/ beside meshes/, which holds the bar."""
    (tmp_path / "problems").mkdir()
    (tmp_path / "meshes").mkdir()
    write_tets(tmp_path / "meshes" / "bar.msh", MESH)
    return tmp_path / "problems"


def write(folder: Path, content: Any) -> Path:
    path = folder / "problem.json"
    path.write_text(content if isinstance(content, str) else json.dumps(content))
    return path


def test_every_entry_is_read(folder: Path) -> None:
    problem = read_problem(write(folder, CONTENT))
    assert problem.mesh.fingerprint == MESH.fingerprint, "the path is relative to the file"
    assert problem.material == StVK(lam=2.0, mu=0.5)
    assert problem.stiffness == 30.0
    assert problem.domain.half_widths[:3].tolist() == [0.5] * 3
    assert problem.domain.half_widths[3:] == pytest.approx(np.deg2rad([10, 20, 90]))
    assert problem.handles.names == ("foot", "head")
    assert problem.handles["foot"].vertices.tolist() == [0, 1, 2, 3]


def test_a_handle_is_the_union_of_boxes_spheres_and_vertices(tmp_path: Path) -> None:
    content = copy.deepcopy(CONTENT)
    content["handles"][1] = {
        "name": "head",
        "boxes": [
            [[3.9, 0.5, 0.5], [None, None, None]],
            [[2.9, None, None], [3.1, 0.1, 0.1]],
        ],
        "spheres": [[[4, 0, 0], 0.1], [[4, 0, 1], 0.1]],
        "vertices": [18, 9],
    }
    problem = read_problem(write(tmp_path, content), mesh=MESH)
    x, y, z = MESH.vertices.T
    end, corner = x == 4, (x == 3) & (y == 0) & (z == 0)
    expected = set(np.flatnonzero(end | corner)) | {9}
    assert set(problem.handles["head"].vertices) == expected


def test_a_given_mesh_replaces_the_one_in_the_file(folder: Path) -> None:
    content = {**CONTENT, "mesh": "missing.msh"}
    assert read_problem(write(folder, content), mesh=MESH).mesh is MESH
    del content["mesh"]
    assert read_problem(write(folder, content), mesh=MESH).mesh is MESH


def test_an_empty_handle_says_where_the_mesh_is(folder: Path) -> None:
    """Often the boxes are in another unit."""
    content = copy.deepcopy(CONTENT)
    content["handles"][1] = {"name": "head", "boxes": [[[900, 0, 0], [1000, 9, 9]]]}
    text = (
        "it has no vertices of the mesh, which reaches from (0, 0, 0) to (4, 1, 1); move or widen"
    )
    with pytest.raises(ValueError, match=re.escape(text)):
        read_problem(write(folder, content))


def test_a_byte_order_mark_is_skipped(folder: Path) -> None:
    """Editors on Windows write one."""
    path = write(folder, CONTENT)
    plain = problem_content(read_problem(path))
    path.write_bytes(codecs.BOM_UTF8 + path.read_bytes())
    assert problem_content(read_problem(path)) == plain


def test_a_handle_may_have_its_own_domain(folder: Path) -> None:
    content = copy.deepcopy(CONTENT)
    content["domain"] = {"translation": 0.5, "angle_degrees": 90}
    content["handles"][1]["domain"] = {"angle_degrees": [10, 20, 30]}
    content["handles"].append(
        {"name": "held", "vertices": [9], "domain": {"translation": 0, "angle_degrees": 0}}
    )
    bounds = read_problem(write(folder, content)).domain.bounds
    assert bounds[0] == pytest.approx([0.5, 0.5, 0.5, *np.deg2rad([10, 20, 30])])
    assert not bounds[1].any()


def test_material_and_names_have_defaults(folder: Path) -> None:
    content = copy.deepcopy(CONTENT)
    del content["material"], content["handles"][1]["name"]
    problem = read_problem(write(folder, content))
    assert problem.material == StableNeoHookean()
    assert problem.handles.names == ("foot", "handle_1")


def test_content_written_and_read_again_is_the_same_problem(folder: Path) -> None:
    for problem in (
        bar_problem(),
        PosingProblem(
            MESH,
            Handles([[0, 1, 2], [18, 17]]),
            domain=HandleBox(translation=(1, 0, 2), angle=(0.1, 0.2, 3)),
        ),
        PosingProblem(
            MESH,
            Handles([[0, 1, 2], [18, 17], [9, 10]]),
            domain=HandleBox(
                translation=[(1, 0, 2), (0, 0, 0)], angle=[(1, 1, 2), (0, 0, 0)], moving=2
            ),
        ),
    ):
        path = write(folder, problem_content(problem))
        again = read_problem(path, mesh=problem.mesh)
        assert again.material == problem.material
        assert again.stiffness == problem.stiffness
        assert again.handles.names == problem.handles.names
        assert again.domain.half_widths == pytest.approx(problem.domain.half_widths, rel=1e-15)
        for a, b in zip(again.handles, problem.handles, strict=True):
            assert np.array_equal(a.vertices, b.vertices)


def test_content_with_a_mesh_path_stands_alone(folder: Path) -> None:
    problem = read_problem(write(folder, CONTENT))
    path = write(folder, problem_content(problem, "../meshes/bar.msh"))
    assert read_problem(path).mesh.fingerprint == MESH.fingerprint


DELETE = object()
HEAD = ("handles", 1)
CORNER = [0.0, 0.0, 0.0]
WRONG: list[tuple[tuple[str | int, ...], Any, str]] = [
    (("mesh",), DELETE, "problem.json: the entries 'mesh' and 'surface' are missing; one"),
    (("mesh",), 5, "mesh must be a string, got 5"),
    (("mesh",), "missing.msh", "missing.msh"),
    (("stiffness",), "stiff", "stiffness must be a number, got 'stiff'"),
    (("stiffness",), True, "stiffness must be a number, got True"),
    (("stiffness",), -1, "stiffness is -1.0, but it must be positive"),
    (("stiffness",), float("nan"), "stiffness is nan, but it must be positive"),
    (("stiffness",), 10**400, "stiffness is too large a number"),
    (("handles", 0, "domain"), {"translation": 1}, "handles[0].domain: the first handle is held"),
    (("handles", 1, "domain"), 5, "handles[1].domain must be an object"),
    (("handles", 1, "domain"), {"angle": 5}, "handles[1].domain: unknown entry 'angle'"),
    (("handles", 1, "domain"), {"angle_degrees": 181}, "handles[1].domain.angle_degrees is 181"),
    (("handles", 1, "domain"), {"translation": [1, 2]}, "handles[1].domain.translation must be"),
    (("handles", 1, "domain"), {"translation": 0, "angle_degrees": 0}, "all bounds are zero"),
    (("stifness",), 1, "unknown entry 'stifness'; known are body, domain, handl"),
    (("material",), [], "material must be an object {...}, got []"),
    (("material",), None, "material must be an object {...}, got None"),
    (("material", "model"), "neohooke", "unknown material 'neohooke'; known are arap, cor"),
    (("material", "mu"), -1, "material: StVK: mu is -1.0, but it must be positive"),
    (("material", "lam"), None, "material: lam must be a number, got None"),
    (("material", "nu"), 0.3, "material: unknown entry 'nu'; known are lam, model, mu, poi"),
    (("domain",), DELETE, 'the entry \'domain\' is missing; add "domain": {"translation": 0.2'),
    (("domain",), 5, "domain must be an object {...}, got 5"),
    (("domain", "translation"), DELETE, "the entry 'translation' is missing"),
    (("domain", "angle_degrees"), DELETE, "the entry 'angle_degrees' is missing"),
    (("domain", "angle"), 1.0, "domain: unknown entry 'angle'; known are angle_degrees, tr"),
    (("domain", "translation"), [1, 2], "domain.translation must be one number or three, got 2"),
    (("domain", "translation"), [1, 2, "x"], "domain.translation must be a number, got 'x'"),
    (("domain", "translation"), -0.5, "translation is -0.5, but a bound must be zero or posit"),
    (("domain", "angle_degrees"), {}, "domain.angle_degrees must be a number, got {}"),
    (("domain", "angle_degrees"), 200, "domain.angle_degrees is 200.0, but it must be at most 180"),
    (("handles",), DELETE, "the entry 'handles' is missing"),
    (("handles",), {}, "handles must be a list, got {}"),
    (("handles",), [], "Handles: got 0, but posing needs a fixed handle"),
    (HEAD, 5, "handles[1] must be an object {...}, got 5"),
    ((*HEAD, "name"), 5, "handles[1].name must be a string, got 5"),
    ((*HEAD, "name"), "foot", "the name 'foot' is used twice"),
    ((*HEAD, "box"), [], "handles[1]: unknown entry 'box'; known are boxes, domain, name, pai"),
    ((*HEAD, "boxes"), 5, "handle 'head': boxes must be a list, got 5"),
    ((*HEAD, "boxes"), [CORNER], "handle 'head': a box must be [min corner, max corner], got [0"),
    ((*HEAD, "boxes"), [[CORNER, 1]], "handle 'head': a corner must be a list, got 1"),
    ((*HEAD, "boxes"), [[CORNER, [1, 1]]], "handle 'head': box: a corner needs three numbers"),
    (
        (*HEAD, "boxes"),
        [[CORNER, [1, 1, "x"]]],
        "handle 'head': a corner must be a number, got 'x'",
    ),
    ((*HEAD, "boxes"), [[CORNER, [1, -1, 1]]], "handle 'head': box: the lower corner"),
    ((*HEAD, "spheres"), [3.0], "handle 'head': a sphere must be a list, got 3.0"),
    ((*HEAD, "spheres"), [[CORNER]], "handle 'head': a sphere must be [center, radius]"),
    ((*HEAD, "spheres"), [[[0, 0], 1]], "handle 'head': a center must be [x, y, z], got [0, 0]"),
    ((*HEAD, "spheres"), [[CORNER, None]], "handle 'head': a radius must be a number, got None"),
    ((*HEAD, "spheres"), [[CORNER, 0]], "handle 'head': sphere: the radius is 0.0, but it must"),
    ((*HEAD, "vertices"), 17, "handle 'head': vertices must be a list, got 17"),
    ((*HEAD, "vertices"), [1.5], "handle 'head': a vertex must be an index, got 1.5"),
    ((*HEAD, "vertices"), [True], "handle 'head': a vertex must be an index, got True"),
    ((*HEAD, "vertices"), [20], "handle 'head': a vertex index is 20, but must be from 0 to 19"),
    ((*HEAD, "vertices"), [-1], "handle 'head': a vertex index is -1, but must be from 0 to 19"),
    ((*HEAD, "vertices"), [0], "'foot' and 'head' overlap in 1 vertices, the first is 0"),
    (HEAD, {"name": "head", "spheres": [[[9, 9, 9], 1]]}, "handle 'head': it has no vertices"),
]


@pytest.mark.parametrize(("place", "value", "message"), WRONG)
def test_a_wrong_entry_is_named(
    folder: Path, place: tuple[str | int, ...], value: Any, message: str
) -> None:
    content = copy.deepcopy(CONTENT)
    owner = content
    for key in place[:-1]:
        owner = owner[key]  # type: ignore[index]
    if value is DELETE:
        del owner[place[-1]]  # type: ignore[arg-type]
    else:
        owner[place[-1]] = value  # type: ignore[index]
    path = write(folder, content)
    with pytest.raises(ValueError, match=re.escape(message)) as caught:
        read_problem(path)
    text = str(caught.value)
    assert text.startswith(str(path)) and "\n" not in text and len(text) < 500


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "not valid JSON"),
        ('{"mesh": ', "not valid JSON"),
        ("[" * 100_000, "not valid JSON"),
        ("1" * 5_000, "not valid JSON"),
        ("[1, 2]", "a problem must be an object {...}, got [1, 2]"),
        ("null", "a problem must be an object {...}, got None"),
    ],
    ids=["empty", "cut", "deep", "long number", "list", "null"],
)
def test_text_that_is_not_a_problem_is_refused(tmp_path: Path, text: str, message: str) -> None:
    path = write(tmp_path, text)
    with pytest.raises(ValueError, match=re.escape(f"{path}: {message}")):
        read_problem(path)


def test_files_that_cannot_be_read_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="there is no such problem file"):
        read_problem(tmp_path / "none.json")
    with pytest.raises(ValueError, match="cannot be read as a problem file"):
        read_problem(tmp_path)
    binary = tmp_path / "binary.json"
    binary.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ValueError, match="cannot be read as a problem file"):
        read_problem(binary)
