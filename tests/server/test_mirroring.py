"""A server mirrors handles that a page chose, and tells pages how poses are mirrored."""

from __future__ import annotations

import json
from codecs import BOM_UTF8
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from snapspace import MirrorPlane, PosingModel, read_problem
from snapspace.generators import bar
from snapspace.mesh import boundary_surface, write_tets
from snapspace.page import packed
from snapspace.page.mirror import mirror_about
from snapspace.problem import problem_content
from snapspace.server.bodies import problem_body
from snapspace.server.body import Body
from snapspace.server.messages import HandleChoice, Mirror
from snapspace.server.mirroring import Mirroring

from ..shapes import bar_problem

BAR = bar(12, 4, 4, length=4.0, width=1.0, height=1.0)


def body(folder: Path, **more: Any) -> Body:
    return Body(name="bar", mesh=BAR, file=None, folder=folder, **more)


def end(vertices: np.ndarray, *, right: bool = False, **more: Any) -> HandleChoice:
    x = vertices[:, 0]
    inside = np.flatnonzero(x > 3.3 if right else x < 0.7)
    name = f"{'right' if right else 'left'} end"
    return HandleChoice(name=name, vertices=tuple(inside.tolist()), **more)


def test_the_mirror_image_of_a_handle(tmp_path: Path) -> None:
    mirroring = Mirroring(body(tmp_path))
    own: dict[str, Any] = {"translation": (0.1, 0.2, 0.3), "angle": (0.4, 0.5, 0.6)}
    answer = mirroring.mirrored(Mirror(request=3, handle=end(BAR.vertices, **own)))
    assert (answer.request, answer.normal) == (3, (1, 0, 0))
    assert answer.deviation is not None and answer.deviation < 1e-12
    expected = end(BAR.vertices, right=True, **own)
    assert replace(answer.handle, translation=None, angle=None) == replace(
        expected, translation=None, angle=None
    )
    assert answer.handle.translation == pytest.approx(own["translation"])
    assert answer.handle.angle == pytest.approx(own["angle"])
    assert mirroring.plane is None  # found again where it is needed


def test_on_the_surface_of_the_user_its_own_vertices_are_taken(tmp_path: Path) -> None:
    surface = boundary_surface(BAR)
    points = surface.vertices(BAR.vertices)
    mirroring = Mirroring(body(tmp_path, surface=surface))
    answer = mirroring.mirrored(Mirror(request=1, handle=end(points)))
    assert answer.handle == end(points, right=True)


def test_a_chosen_axis_and_a_plane_of_the_file_are_kept(tmp_path: Path) -> None:
    mirroring = Mirroring(body(tmp_path))
    mirroring.mirrored(Mirror(request=1, handle=end(BAR.vertices), axis="x"))
    assert mirroring.plane is not None and mirroring.plane.normal == (1, 0, 0)
    given = MirrorPlane((1, 0, 0), (2, 0, 0))
    mirroring = Mirroring(body(tmp_path, mirror=given))
    answer = mirroring.mirrored(Mirror(request=1, handle=end(BAR.vertices)))
    assert answer.deviation is None and mirroring.plane == given


@pytest.mark.parametrize(
    ("axis", "vertices", "message"),
    [
        ("y", None, "'left end' lies across the mirror plane and is its own mirror image"),
        ("w", None, "mirror: axis is 'w', but it must be one of x, y, z"),
        ("x", (9999,), "handle 'left end' has vertex index 9999, but there are 325 vertices"),
        ("x", (-1,), "handle 'left end' has vertex index -1"),
        ("x", (), "handle 'left end' has no vertices"),
    ],
)
def test_what_cannot_be_mirrored_is_refused(
    tmp_path: Path, axis: str, vertices: tuple[int, ...] | None, message: str
) -> None:
    handle = end(BAR.vertices)
    handle = handle if vertices is None else replace(handle, vertices=vertices)
    with pytest.raises(ValueError, match=message):
        Mirroring(body(tmp_path)).mirrored(Mirror(request=1, handle=handle, axis=axis))


def test_an_asymmetric_body_asks_for_the_axis(tmp_path: Path) -> None:
    x, y, z = BAR.vertices.T
    spiral = np.stack([x, y + 0.2 * x**2, z + 0.3 * x * (y + 1)], axis=1)
    surface = replace(boundary_surface(BAR))
    mirroring = Mirroring(body(tmp_path, surface=surface))
    mirroring._vertices = surface.vertices(spiral)
    with pytest.raises(ValueError, match=r"is not symmetric: .*\. Choose the axis across the pl"):
        mirroring.mirrored(Mirror(request=1, handle=end(mirroring._vertices)))
    answer = mirroring.mirrored(Mirror(request=1, handle=end(mirroring._vertices), axis="x"))
    assert answer.deviation is not None and answer.deviation > 0.015


def test_the_plane_of_a_problem_file_comes_back(tmp_path: Path) -> None:
    problem, plane = bar_problem(), MirrorPlane((0, 3, 4), (1, 2, 3))
    write_tets(tmp_path / "bar.mesh", problem.mesh)
    path = tmp_path / "bar.json"
    content = problem_content(problem, "bar.mesh", mirror=plane)
    path.write_text(json.dumps(content))
    assert problem_body(path).mirror == plane
    path.write_bytes(BOM_UTF8 + path.read_bytes())  # as editors on Windows do
    assert problem_body(path).mirror == plane
    for damaged, message in (
        ({"normal": [1, 0]}, r"bar.json: mirror.normal must be \[x, y, z\]"),
        ({"normal": [0, 0, 0]}, "bar.json: MirrorPlane: the normal is zero"),
        ({"point": [0, 0, 0]}, "bar.json: the entry 'normal' is missing"),
        ({"normal": [1, 0, 0], "axis": 1}, "bar.json: mirror: unknown entry 'axis'"),
        ("x", "bar.json: mirror must be an object"),
    ):
        path.write_text(json.dumps(content | {"mirror": damaged}))
        with pytest.raises(ValueError, match=message):
            read_problem(path)


def test_pages_get_plane_and_counterparts_or_the_reason(posing_model: PosingModel) -> None:
    def about(record: dict[str, Any]) -> dict[str, Any]:
        return mirror_about(replace(posing_model, provenance={"mirror": record}))

    assert about({})["normal"] == [0, 1, 0], "found on the surface where no record names it"
    assert about(MirrorPlane((1, 0, 0), (2, 0, 0)).content) == {
        "normal": [1, 0, 0],
        "counterparts": [1, 0, 2],
    }
    far = about(MirrorPlane((1, 0, 0), (50, 0, 0)).content)
    assert far == {"refused": "“foot” and others have no counterpart on the other side."}
    content = packed(posing_model, name="bar", mirror=far)
    header = json.loads(content[8 : 8 + int.from_bytes(content[:8], "little")])
    assert json.loads(header["__metadata__"]["about"])["mirror"] == far
