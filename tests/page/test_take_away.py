"""Shapes, pictures, films and the address, taken out of a page that has no server."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from snapspace import PosingModel
from snapspace.mesh import read_surface

from ..gltf.khronos import faults_of
from .pages import OpenPage, Page

FloatArray = NDArray[np.float64]


def taken(page: Page, button: str, folder: Path) -> Path:
    """The file that a button gives."""
    with page.page.expect_download() as waiting:
        page.page.get_by_role("button", name=button, exact=True).click()
    download = waiting.value
    path = folder / download.suggested_filename
    download.save_as(path)
    return path


@pytest.fixture
def posed(posing: Page) -> Iterator[Page]:
    posing.drag(posing.run("snapspace.handle(1)"), 40, -30)
    yield posing


def test_the_shape_is_that_on_the_stage(
    posed: Page, posing_model: PosingModel, tmp_path: Path
) -> None:
    wanted = posed.shown()
    rest = posing_model.surface.vertices(posing_model.subspace.tau)
    assert np.abs(wanted - rest).max() > 0.01, "it is not the shape at rest"
    for suffix in ("obj", "ply", "glb"):
        path = taken(posed, suffix.upper(), tmp_path)
        assert path.name == f"bar.{suffix}"
        vertices, faces = read_surface(path)
        if suffix == "glb":  # readers turn z up to y up
            vertices = vertices[:, [0, 2, 1]] * [1.0, -1.0, 1.0]
            assert faults_of(path) == []
        np.testing.assert_allclose(vertices, wanted, rtol=0, atol=1e-6 * np.abs(wanted).max())
        np.testing.assert_array_equal(faces, posing_model.surface.faces)


def test_a_picture_has_the_size_and_background_that_were_asked_for(
    posed: Page, tmp_path: Path
) -> None:
    before = posed.page.locator("canvas").bounding_box()
    posed.page.get_by_label("Width in pixels").fill("300")
    posed.page.get_by_label("Height in pixels").fill("200")
    with Image.open(taken(posed, "PNG", tmp_path)) as picture:
        seen = np.asarray(picture)
    assert seen.shape == (200, 300, 4)
    assert seen[0, 0, 3] == 0 and 0.03 < (seen[:, :, 3] == 255).mean() < 0.9
    transparent = posed.page.get_by_role("button", name="Transparent")
    transparent.click()
    with Image.open(taken(posed, "PNG", tmp_path)) as picture:
        assert np.asarray(picture.convert("RGBA"))[:, :, 3].min() == 255
    transparent.click()
    assert posed.page.locator("canvas").bounding_box() == before, "the stage is as it was"


def test_a_size_that_is_no_size_is_refused(posed: Page) -> None:
    width = posed.page.get_by_label("Width in pixels")
    width.fill("0")
    posed.page.get_by_role("button", name="PNG", exact=True).click()
    assert width.evaluate("field => field.matches(':invalid')")
    width.fill("300")


def test_a_recording_is_a_film(posed: Page, tmp_path: Path) -> None:
    posed.page.get_by_role("button", name="Record", exact=True).click()
    posed.drag(posed.run("snapspace.handle(1)"), -20, 20)
    path = taken(posed, "Record", tmp_path)
    content = path.read_bytes()
    assert path.suffix == ".webm" and content[:4] == b"\x1a\x45\xdf\xa3", "EBML, as WebM begins"
    assert len(content) > 1000


def test_a_turntable_is_a_gif_that_shows_all_sides(posed: Page, tmp_path: Path) -> None:
    camera = "snapspace.stage.camera.position.toArray()"
    before = posed.run(camera)
    posed.page.set_viewport_size({"width": 300, "height": 200})
    posed.page.get_by_label("Seconds of a turn").fill("1")
    with Image.open(io.BytesIO(taken(posed, "Turn, GIF", tmp_path).read_bytes())) as film:
        frames = []
        for frame in range(film.n_frames):
            film.seek(frame)
            frames.append(np.asarray(film.convert("RGB"), np.float64))
    posed.page.set_viewport_size({"width": 800, "height": 480})
    assert len(frames) == 20
    turned = [np.abs(frame - frames[0]).mean() for frame in frames]
    assert max(turned) > 1.2 * turned[19] > 0.0, "the last frame is next to the first"
    np.testing.assert_allclose(posed.run(camera), before, atol=1e-9)


def test_pictures_have_no_dots_of_handles(posed: Page, tmp_path: Path) -> None:
    posed.page.get_by_label("Width in pixels").fill("900")
    posed.page.get_by_label("Height in pixels").fill("600")
    dots = "snapspace.stage.root.children.flatMap((part) => part.children).filter(isDot)"
    is_dot = "(part) => part.material && !part.material.depthTest"
    shown = f"((isDot) => {dots}.map(({{ visible }}) => visible))({is_dot})"
    before = posed.run(shown)
    assert len(before) > 1 and all(before)
    with Image.open(taken(posed, "PNG", tmp_path)) as picture:
        seen = np.asarray(picture.convert("RGBA"), np.int64)
    rims = (seen[:, :, :3].min(axis=2) == 255) & (seen[:, :, 3] == 255)
    assert not rims.any(), "the rim of a dot is white"
    assert posed.run(shown) == before


def test_a_turntable_is_cancelled(posed: Page) -> None:
    seconds = posed.page.get_by_label("Seconds of a turn")
    seconds.fill("60")
    downloads: list[Any] = []

    def given(download: Any) -> None:
        downloads.append(download)

    posed.page.on("download", given)
    turn = posed.page.get_by_role("button", name="Turn, GIF", exact=True)
    turn.dispatch_event("click")
    cancel = posed.page.get_by_role("button", name="Cancel", exact=True)
    cancel.wait_for()
    assert posed.page.get_by_role("button", name="Turn, WebM").is_disabled()
    cancel.dispatch_event("click")
    turn.wait_for()
    posed.wait("snapspace.stage.controls.enabled")
    seconds.fill("1")
    assert not posed.page.get_by_role("button", name="Turn, WebM").is_disabled()
    posed.page.remove_listener("download", given)
    assert downloads == [], "no part of a film is given"


def test_the_link_has_the_pose(posed: Page, opened: OpenPage) -> None:
    wanted, motions = posed.shown(), posed.motions()
    posed.run("navigator.clipboard.writeText = async (text) => { window.copied = text; }")
    posed.page.get_by_role("button", name="Copy link").click()
    posed.wait("window.copied !== undefined")
    other = opened(posed.run("window.copied"))
    for handle, (euler, shift) in other.motions().items():
        np.testing.assert_allclose(euler, motions[handle][0], atol=1e-5)
        np.testing.assert_allclose(shift, motions[handle][1], atol=1e-5)
    np.testing.assert_allclose(other.shown(), wanted, atol=1e-4 * np.abs(wanted).max())


def test_blends_are_taken_away_too(blending_page: Path, opened: OpenPage, tmp_path: Path) -> None:
    page: Any = opened(blending_page.as_uri())
    vertices, _ = read_surface(taken(page, "PLY", tmp_path))
    wanted = page.shown()
    np.testing.assert_allclose(vertices, wanted, rtol=0, atol=1e-6 * np.abs(wanted).max())
