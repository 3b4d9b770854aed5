"""Ambient occlusion: creases get less of the light from all sides, flat and convex parts all."""

from __future__ import annotations

import base64
import io
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from snapspace import (
    HandleBox,
    Handles,
    PosingModel,
    PosingProblem,
    StVK,
    TetMesh,
    export_html,
    reduce,
)
from snapspace.generators import bar

from ..shapes import random_subspace
from .pages import OpenPage, Page

#: On the outer side, and on the inner side beside the other arm and far from it.
OUTER, CORNER, END = (0.2, 0.0, 0.3), (1.2, 0.5, 1.0), (3.2, 0.5, 1.0)


@pytest.fixture(scope="module")
def angle_model() -> PosingModel:
    """Two arms of a right angle, in a random subspace: only its shape at rest counts."""
    block = bar(8, 2, 8, length=4.0, width=1.0, height=4.0)
    middle = block.vertices[block.tets].mean(axis=1)
    tets = block.tets[(middle[:, 0] < 1.0) | (middle[:, 2] < 1.0)]
    used, tets = np.unique(tets, return_inverse=True)
    mesh = TetMesh(block.vertices[used], tets.reshape(-1, 4))
    x, _, z = mesh.vertices.T
    problem = PosingProblem(
        mesh,
        Handles([x > 3.4, z > 3.4], names=["foot", "head"]),
        domain=HandleBox(translation=1.0, angle=1.0),
        material=StVK(lam=1.0, mu=1.0),
    )
    return reduce(problem, random_subspace(mesh, 4))


@pytest.fixture(scope="module")
def angle_page(angle_model: PosingModel, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return export_html(angle_model, tmp_path_factory.mktemp("angle") / "angle.html")


def picture(page: Page) -> NDArray[np.int64]:
    """The stage as it is drawn on nothing, (h, w, 4)."""
    data = page.run(
        """(() => {
          const { renderer, scene, camera } = snapspace.stage;
          renderer.render(scene, camera);
          return renderer.canvas.toDataURL().split(",")[1];
        })()"""
    )
    return np.array(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGBA")).astype(int)


def lit_and_occluded(page: Page) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Pictures without and with occlusion, which is on at first."""
    occluded = picture(page)
    page.page.locator("#occlusion").click()
    lit = picture(page)
    page.page.locator("#occlusion").click()
    return lit, occluded


def at(page: Page, point: tuple[float, float, float]) -> tuple[int, int]:
    """Row and column of a point of the body in the picture."""
    row, column = page.run(
        """(point) => {
          const { stage } = snapspace, { width, height } = stage.renderer.canvas;
          const seen = stage.camera.position.clone().set(...point);
          stage.root.localToWorld(seen).project(stage.camera);
          return [(1 - seen.y) / 2 * height, (1 + seen.x) / 2 * width];
        }""",
        point,
    )
    return int(row), int(column)


@pytest.mark.parametrize("query", ["", "?deform=cpu"])
def test_corners_are_darker_and_flat_parts_as_they_were(
    angle_page: Path, opened: OpenPage, query: str
) -> None:
    page = opened(angle_page.as_uri() + query, sharp=True)
    lit, occluded = lit_and_occluded(page)
    outer, corner, end = (at(page, point) for point in (OUTER, CORNER, END))
    assert lit[outer][3] == lit[corner][3] == lit[end][3] == 255, "all are on the body"
    assert (occluded[outer] == lit[outer]).all()
    darker = [occluded[place][:3].sum() / lit[place][:3].sum() for place in (corner, end)]
    assert darker[0] < 0.99 and darker[0] < darker[1], darker
    assert (occluded[:, :, 3] == lit[:, :, 3]).all(), "transparent where it was"
    assert (occluded[lit[:, :, 3] == 0] == 0).all(), "the background stays"
    body = lit[:, :, 3] == 255
    assert (occluded[body] <= lit[body] + 1).all(), "nothing gets lighter: there are no halos"


def test_a_convex_shape_gets_all_light(posing_page: Path, opened: OpenPage) -> None:
    """Picture for picture, bit for bit: what is below the horizon of a vertex hides nothing."""
    page = opened(posing_page.as_uri(), sharp=True)
    lit, occluded = lit_and_occluded(page)
    assert (lit == occluded).all()


def test_it_follows_the_shape(posing_page: Path, opened: OpenPage) -> None:
    """A bar that is bent has a hollow side."""
    bend = "#pose=foot:0,0,0,0,0,0;head:0,-1.2,0,-1,0,1;belly:0,0,0,0,0,0"
    page = opened(posing_page.as_uri() + bend, sharp=True)
    page.rest()
    lit, occluded = lit_and_occluded(page)
    body = lit[:, :, 3] == 255
    assert (occluded[body] <= lit[body] + 1).all(), "nothing gets lighter"
    share = occluded[body][:, :3].sum(axis=1) / lit[body][:, :3].sum(axis=1)
    assert share.min() < 0.9 and (share == 1.0).mean() > 0.2, (share.min(), (share == 1).mean())


def test_the_panel_says_where_it_is_not_possible(
    angle_page: Path, tmp_path: Path, opened: OpenPage
) -> None:
    """Float textures are missing, as on some phones."""
    text = angle_page.read_text(encoding="utf-8")
    without = tmp_path / "without.html"
    without.write_text(text.replace("EXT_color_buffer_float", "EXT_missing"), encoding="utf-8")
    page = opened(without.as_uri())
    assert all("EXT_missing extension not supported" in fault for fault in page.faults)
    page.faults.clear()
    switch = page.page.locator("#occlusion")
    assert switch.is_disabled() and switch.get_attribute("aria-pressed") == "false"
    assert "float textures" in (switch.get_attribute("title") or "")
