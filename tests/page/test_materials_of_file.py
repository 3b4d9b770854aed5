"""The page shows a surface in the materials of the user's own file."""

from __future__ import annotations

import io
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from snapspace import PosingModel, export_html
from snapspace.mesh import MeshNotice, SurfaceFile
from snapspace.model_file import appearance
from snapspace.model_file.appearance import appearance_arrays
from snapspace.model_file.shown_surface import places_of, surface_arrays, surface_content

from ..own_file import BLUE, RED, own_file, picture, with_file
from .pages import OpenPage, Page

MATERIAL = "[...document.querySelectorAll('[role=radio]')].find((b) => b.innerText == 'Material')"
#: Pixels; the graphics of the tests take 8192 along a side.
WIDER_THAN_TEXTURES = 9000
GLOW = 25  # light changes colours, but not which part is the largest


def pixel(page: Page, x: float, y: float) -> np.ndarray:
    """The colour at a place of the page."""
    clip = {"x": x, "y": y, "width": 1, "height": 1}
    shot = page.page.screenshot(clip=clip)
    return np.array(Image.open(io.BytesIO(shot)).convert("RGB"))[0, 0].astype(int)


def opened_with(model: PosingModel, file: SurfaceFile, folder: Path, opened: OpenPage) -> Page:
    path = export_html(with_file(model, file), folder / "own.html")
    page = opened(path.as_uri(), sharp=True)
    page.wait(f"{MATERIAL}.getAttribute('aria-checked') === 'true'")
    page.settle()
    return page


def ends(page: Page) -> list[tuple[float, float]]:
    """Places in the picture a third from both ends of the body."""
    return [
        page.run(
            f"""(() => {{
              const {{ stage }} = snapspace, shape = snapspace.shown();
              let [low, high] = [Infinity, -Infinity];
              for (let i = 0; i < shape.length; i += 3) {{
                low = Math.min(low, shape[i]); high = Math.max(high, shape[i]);
              }}
              const middle = [0, 0, 0];
              for (let i = 0; i < shape.length; i++) middle[i % 3] += 3 * shape[i] / shape.length;
              middle[0] = low + {share} * (high - low);
              const at = stage.camera.position.clone().set(...middle);
              stage.root.localToWorld(at).project(stage.camera);
              const {{ clientWidth: w, clientHeight: h }} = stage.renderer.canvas;
              return [(at.x + 1) / 2 * w, (1 - at.y) / 2 * h];
            }})()"""
        )
        for share in (0.3, 0.7)
    ]


def test_its_texture_moves_with_the_shape(
    posing_model: PosingModel, tmp_path: Path, opened: OpenPage
) -> None:
    page = opened_with(posing_model, own_file(posing_model), tmp_path, opened)
    for _ in range(2):
        first, last = ends(page)
        blue, red = pixel(page, *first), pixel(page, *last)
        assert blue[2] > blue[0] + GLOW, blue  # v = 0 is the lower half of the picture
        assert red[0] > red[2] + GLOW, red
        page.drag(page.run("snapspace.handle(1)"), 30, -40)
        page.rest()
    page.page.get_by_role("radio", name="Handles").click()
    page.settle()
    clay = pixel(page, *ends(page)[0])
    assert np.ptp(clay) < 90 and clay[0] >= clay[2], "clay, no longer the texture"


def test_a_picture_that_is_too_large_for_the_graphics_is_scaled(
    posing_model: PosingModel, tmp_path: Path, opened: OpenPage
) -> None:
    file = own_file(posing_model)
    large = picture(RED, BLUE, width=WIDER_THAN_TEXTURES)
    page = opened_with(
        posing_model, replace(file, beside={**file.beside, "own.png": large}), tmp_path, opened
    )
    assert page.run("snapspace.stage.renderer.graphics.mostTexels") < WIDER_THAN_TEXTURES
    first, last = ends(page)
    blue, red = pixel(page, *first), pixel(page, *last)
    assert blue[2] > blue[0] + GLOW, blue
    assert red[0] > red[2] + GLOW, red


def test_a_model_file_brings_its_materials(
    posing_model: PosingModel, posing_page: Path, tmp_path: Path, opened: OpenPage
) -> None:
    """Opened in a page that has no server, as when it is dropped there."""
    path = with_file(posing_model, own_file(posing_model)).save(tmp_path / "own.snapspace")
    page = opened(posing_page.as_uri(), sharp=True)
    page.page.locator("footer input[type=file]").set_input_files(path)
    page.wait(f"{MATERIAL}?.getAttribute('aria-checked') === 'true'")
    page.settle()
    first, last = ends(page)
    blue, red = pixel(page, *first), pixel(page, *last)
    assert blue[2] > blue[0] + GLOW, blue
    assert red[0] > red[2] + GLOW, red
    assert page.run("snapspace.stage.up") == "y", "as in most .obj files"


def test_a_body_stands_as_its_file_is_usually_written(posing_model: PosingModel) -> None:
    model = with_file(posing_model, own_file(posing_model))
    assert (posing_model.up, model.up) == ("z", "y")
    assert replace(model, provenance={"up": "x"}).up == "x", "what was saved comes first"


def test_textures_are_in_a_model_file_once(posing_model: PosingModel) -> None:
    surface = with_file(posing_model, own_file(posing_model)).surface
    arrays, content = surface_arrays(surface), surface_content(surface)
    assert not any(name.startswith("own_texture") for name in arrays), "it is beside the surface"
    (place,) = content["appearance"]["textures"]
    start, size = place
    assert arrays["surface_beside"][start : start + size].tobytes() == picture(RED, BLUE)


def test_a_texture_inside_the_surface_is_apart_in_a_model_file(posing_model: PosingModel) -> None:
    """So it is in .glb files, which the model file has compressed."""
    file = own_file(posing_model)
    surface = with_file(posing_model, file).surface
    look, _ = appearance_arrays(surface)
    assert places_of(look, {"own.mtl": file.beside["own.mtl"]}) == {"own_texture_0": None}


def test_edges_in_the_file_are_sharp_in_the_page(
    posing_model: PosingModel, tmp_path: Path, opened: OpenPage
) -> None:
    """With a normal per face a face has one shade; with none, shades run over faces."""
    spread = []
    for creases in (True, False):
        file = own_file(posing_model, creases=creases)
        page = opened_with(posing_model, file, tmp_path, opened)
        spread.append(shades(page))
    flat, smooth = spread
    assert flat < 0.7 * smooth, spread


def shades(page: Page) -> float:
    """How much neighbouring pixels of the body differ, in the middle of the differences."""
    clip = {"x": 300, "y": 250, "width": 200, "height": 200}
    image = Image.open(io.BytesIO(page.page.screenshot(clip=clip))).convert("RGB")
    pixels = np.array(image).astype(float)
    body = np.ptp(pixels, axis=2) > 60
    both = body[:, 1:] & body[:, :-1]
    return float((np.abs(np.diff(pixels, axis=1)).sum(axis=2)[both] > 0).mean())


def test_a_picture_that_is_none_leaves_the_material_white(
    posing_model: PosingModel, tmp_path: Path, opened: OpenPage
) -> None:
    file = own_file(posing_model)
    broken = replace(file, beside={**file.beside, "own.png": picture(RED, BLUE)[:60]})
    page = opened_with(posing_model, broken, tmp_path, opened)
    white = pixel(page, *ends(page)[0])
    assert np.ptp(white) < 40, white


def test_points_are_vertices_at_their_corners(posing_model: PosingModel) -> None:
    file = own_file(posing_model, creases=True)
    arrays, about = appearance_arrays(with_file(posing_model, file).surface)
    assert about is not None
    assert [one["triangles"] for one in about["materials"]] == [4, len(file.faces) - 4]
    points, triangles = arrays["own_points"], arrays["own_triangles"]
    assert np.array_equal(points[triangles], np.roll(file.faces, 4, axis=0)), "by material"
    assert len(points) == 3 * len(file.faces), "each corner has its own normal"
    look = file.appearance
    assert look is not None and look.texture_coordinates is not None
    at = np.roll(look.texture_coordinates.reshape(-1, 3, 2), 4, axis=0)
    assert np.array_equal(arrays["own_coordinates"][triangles], at)
    smooth, _ = appearance_arrays(with_file(posing_model, own_file(posing_model)).surface)
    assert len(smooth["own_points"]) == len(file.vertices) and "own_creases" not in smooth


def test_what_is_not_shown_is_reported(
    posing_model: PosingModel, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = own_file(posing_model)
    alone = with_file(posing_model, replace(file, beside={})).surface
    with pytest.warns(MeshNotice, match=r"not found beside own\.obj, .*: own\.mtl; the surf"):
        assert appearance_arrays(alone) == ({}, None)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert appearance_arrays(alone) == ({}, None), "once, also while models grow"
    monkeypatch.setattr(appearance, "MOST_TEXTURE_BYTES", 10)
    with pytest.warns(MeshNotice, match=r"the textures of own\.obj have 0 MB, and are not shown"):
        arrays, about = appearance_arrays(with_file(posing_model, file).surface)
    assert about is not None and about["materials"][1]["texture"] is None
    assert not any(name.startswith("own_texture") for name in arrays)


def test_a_file_without_materials_adds_nothing(posing_model: PosingModel) -> None:
    plain = SurfaceFile("own.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert appearance_arrays(with_file(posing_model, plain).surface) == ({}, None)
    assert appearance_arrays(posing_model.surface) == ({}, None)
