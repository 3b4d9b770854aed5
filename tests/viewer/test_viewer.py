"""Shapes in anybody's page: solved as in Python, moved by scripts and pointers, and given back."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from snapspace import InterpolationModel, PosingModel

from .conftest import KEYS
from .site import PAGE, SCRIPT, Viewer

Open = Callable[[str], Viewer]


def assert_shown(viewer: Viewer, wanted: np.ndarray, rest: np.ndarray) -> None:
    """Shapes agree to a thousandth of the displacement: modes have 16 bits."""
    np.testing.assert_allclose(viewer.shape, wanted, atol=1e-3 * np.abs(wanted - rest).max())


def test_a_script_moves_handles_as_python_does(opened: Open, posing_model: PosingModel) -> None:
    viewer = opened("posing.html")
    info = viewer.run("viewer.model")
    assert info["kind"] == "posing" and info["name"] == "posing"
    assert info["handles"] == ["foot", "head", "belly"] and info["poses"] == []
    assert info["dimension"] == posing_model.dimension
    rest = viewer.shape
    viewer.run(
        "viewer.setHandles({ head: { degrees: [0, 20, 30], translation: [0.2, 0, 0.1] },"
        " foot: { translation: [0, 0.1, 0] } })"
    )
    session = posing_model.session()
    session.move("foot", translation=[0, 0.1, 0])
    session.move("head", euler=np.deg2rad([0, 20, 30]), translation=[0.2, 0, 0.1])
    wanted = posing_model.surface.vertices(session.vertices)
    assert_shown(viewer, wanted, rest)
    assert viewer.run("viewer.shape().faces.length") == posing_model.surface.faces.size
    found = viewer.run("viewer.handles")
    assert found["head"]["degrees"] == pytest.approx([0, 20, 30])
    assert found["foot"]["translation"] == pytest.approx([0, 0.1, 0])
    viewer.run("viewer.reset()")
    np.testing.assert_allclose(viewer.shape, rest, atol=1e-5)


def test_a_script_blends_poses_as_python_does(
    opened: Open, blending_model: InterpolationModel
) -> None:
    viewer = opened("blending.html")
    assert viewer.run("viewer.model.poses") == ["rest", "bent", "twisted"]
    rest = viewer.shape
    viewer.run("viewer.setWeights({ bent: 0.75, rest: 0.25 })")
    session = blending_model.session()
    session.blend([0.25, 0.75, 0.0])
    assert_shown(viewer, blending_model.surface.vertices(session.vertices), rest)
    assert viewer.run("viewer.weights") == {"rest": 0.25, "bent": 0.75, "twisted": 0}


def test_as_rigid_as_possible_surfaces_are_posed_and_blended_too(
    opened: Open, posed_surface: PosingModel, blended_surfaces: InterpolationModel
) -> None:
    viewer, handles = opened("posed-surface.html"), posed_surface.problem.handles.names
    rest = viewer.shape
    viewer.run(f"viewer.setHandles({{ {handles[1]!r}: {{ translation: [0.05, 0.02, 0.08] }} }})")
    posing = posed_surface.session()
    posing.move(handles[1], translation=[0.05, 0.02, 0.08])
    assert_shown(viewer, posed_surface.surface.vertices(posing.vertices), rest)

    viewer, poses = opened("blended-surfaces.html"), blended_surfaces.problem.poses.names
    rest = viewer.shape
    viewer.run(f"viewer.setWeights({{ {poses[0]!r}: 0.7, {poses[1]!r}: 0.3 }})")
    blending = blended_surfaces.session()
    blending.blend([0.7, 0.3, 0.0])
    assert_shown(viewer, blended_surfaces.surface.vertices(blending.vertices), rest)


def test_events_tell_what_was_solved(opened: Open) -> None:
    viewer = opened("posing.html")
    viewer.run(
        "(window.told = [], viewer.addEventListener('solve', (e) => told.push(e.detail)), null)"
    )
    viewer.run("viewer.setHandles({ head: { translation: [0.1, 0, 0] } })")
    viewer.settle()
    (detail,) = viewer.run("told")
    assert detail["handles"]["head"]["translation"] == pytest.approx([0.1, 0, 0])
    assert 0 <= detail["milliseconds"] < 1e4  # a browser's clock may stand still meanwhile


def test_a_handle_is_dragged_without_any_controls(opened: Open) -> None:
    """The middle of the picture is on the bar; its ends are the handles."""
    viewer = opened("posing.html")
    assert viewer.page.locator("snapspace-viewer .bar").is_hidden()
    box = viewer.page.locator("snapspace-viewer").bounding_box()
    places = [
        (box["x"] + box["width"] * (0.05 + 0.05 * i), box["y"] + box["height"] * (0.1 + 0.05 * j))
        for j in range(17)
        for i in range(19)
    ]
    for x, y in places:
        viewer.page.mouse.move(x, y)
        if viewer.run("viewer.shadowRoot.querySelector('canvas').style.cursor") == "grab":
            break
    else:
        pytest.fail("no handle is below the pointer")
    before = viewer.run("viewer.handles")
    viewer.page.mouse.down()
    viewer.page.mouse.move(x + 15, y + 5, steps=3)
    viewer.page.mouse.move(x + 30, y + 15, steps=3)
    viewer.page.mouse.up()
    after = viewer.run("viewer.handles")
    moved = [name for name in before if before[name] != after[name]]
    assert len(moved) == 1
    assert np.linalg.norm(after[moved[0]]["translation"]) > 0.02


#: What scripts do wrong with a page's model, and words of the answer.
MISTAKES = {
    "posing.html": {
        "viewer.setHandles({ tail: {} })": "no handle 'tail', but foot, head, belly",
        "viewer.setHandles({ head: { degrees: [1, 2] } })": "three finite numbers",
        "viewer.setHandles({ head: { translation: [NaN, 0, 0] } })": "three finite numbers",
        "viewer.setWeights({ rest: 1 })": "has handles, no poses",
        "viewer.play()": "no timeline",
    },
    "blending.html": {
        "viewer.setWeights({ nobody: 1 })": "no pose 'nobody', but rest, bent, twisted",
        "viewer.setWeights({ rest: 0.5 })": "sum to 0.5, but must sum to 1",
        "viewer.setHandles({ head: {} })": "has poses, no handles",
    },
}


@pytest.mark.parametrize("page", MISTAKES)
def test_mistakes_of_scripts_are_errors_that_change_nothing(opened: Open, page: str) -> None:
    viewer = opened(page)
    before = viewer.shape
    for script, words in MISTAKES[page].items():
        told = viewer.run(
            f"(() => {{ try {{ {script}; }} catch (error) {{ return error.message; }} }})()"
        )
        assert words in told, script
        np.testing.assert_array_equal(viewer.shape, before)


def test_the_bar_has_handles_or_weights(opened: Open) -> None:
    viewer = opened("posing-controls.html")
    head = viewer.page.get_by_role("button", name="head")
    head.click()
    assert head.get_attribute("aria-pressed") == "true"
    viewer.page.keyboard.press("ArrowUp")  # the focus is on the bar: keys are those of the shape
    viewer.page.get_by_role("button", name="Reset").click()
    assert viewer.run("viewer.handles.head.translation") == [0, 0, 0]
    viewer.run("(viewer.controls = false, null)")
    assert viewer.page.locator("snapspace-viewer .bar").is_hidden()

    viewer = opened("blending-controls.html")
    viewer.page.get_by_role("slider", name="bent").fill("0.8")
    weights = viewer.run("viewer.weights")
    assert weights["bent"] == pytest.approx(0.8)
    assert weights["rest"] == pytest.approx(0.1) and weights["twisted"] == pytest.approx(0.1)
    viewer.settle()
    assert float(viewer.page.get_by_role("slider", name="rest").input_value()) == pytest.approx(0.1)


def test_keys_of_the_shape_do_not_reach_the_host_page(opened: Open) -> None:
    """They act while the shape has the focus, and not on buttons of the page with the same ids."""
    viewer = opened("posing.html")
    viewer.run(
        "(document.body.insertAdjacentHTML('beforeend', '<button id=wires>w</button>'),"
        " document.getElementById('wires').onclick = () => { window.pressed = true; }, null)"
    )
    viewer.page.locator("snapspace-viewer canvas").focus()
    viewer.page.keyboard.press("w")
    viewer.page.keyboard.press("2")
    viewer.page.keyboard.press("ArrowUp")
    assert viewer.run("window.pressed ?? null") is None
    assert np.linalg.norm(viewer.run("viewer.handles.head.translation")) > 0


def test_the_film_that_a_model_was_saved_with_is_played(
    opened: Open, posing_model: PosingModel
) -> None:
    viewer = opened("film-controls.html")
    rest = viewer.shape
    viewer.page.get_by_role("button", name="Play").click()
    viewer.wait("!viewer.isPlaying")
    session = posing_model.session()
    end = KEYS["keys"][-1]["handles"]["head"]
    session.move("head", euler=np.deg2rad(end["degrees"]), translation=end["translation"])
    assert_shown(viewer, posing_model.surface.vertices(session.vertices), rest)
    press_in_film = """(canvas) => {
      const viewer = document.querySelector("snapspace-viewer");
      viewer.play();
      canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "r", code: "KeyR", bubbles: true }));
      return viewer.isPlaying;
    }"""
    canvas = viewer.page.locator("snapspace-viewer canvas")
    assert canvas.evaluate(press_in_film) is False, "a reset in the film stays"


def test_a_picture_is_transparent_and_has_the_size_that_was_asked_for(opened: Open) -> None:
    viewer = opened("posing.html")
    content = viewer.numbers(
        "viewer.picture(200, 150).then((blob) => blob.arrayBuffer())"
        ".then((bytes) => new Uint8Array(bytes))"
    )
    picture = np.array(Image.open(io.BytesIO(content.astype(np.uint8))))
    assert picture.shape == (150, 200, 4)
    assert picture[0, 0, 3] == 0 and (picture[..., 3] == 255).any()


def test_what_is_no_model_is_reported_and_another_one_can_follow(
    viewer: Viewer, folder: Path, address: str
) -> None:
    (folder / "broken.snapspace").write_bytes(b"no model")
    poster = "data:image/gif;base64,R0lGODlhAQABAAAAACwAAAAAAQABAAA="
    body = f'<snapspace-viewer src="broken.snapspace" poster="{poster}"></snapspace-viewer>'
    listener = (
        "<script>document.addEventListener('error',"
        " (e) => { window.told = e.detail?.message; }, true)</script>"
    )
    text = PAGE.format(head=listener + SCRIPT, body=body)
    (folder / "broken.html").write_text(text, encoding="utf-8")
    viewer.page.goto(f"{address}/broken.html")
    viewer.wait("window.told")
    assert "broken" in viewer.run("told") or "model" in viewer.run("told")
    assert viewer.page.locator("snapspace-viewer .poster").is_visible()
    assert viewer.page.locator("snapspace-viewer [role=alert]").is_visible()
    viewer.run("(viewer.src = 'posing.snapspace', null)")
    viewer.wait("viewer.model !== null")
    assert viewer.page.locator("snapspace-viewer .poster").is_hidden()
    assert viewer.page.locator("snapspace-viewer [role=alert]").is_hidden()


def test_elements_come_and_go_without_leaving_graphics_behind(opened: Open) -> None:
    """Browsers warn at 16 contexts; a warning would be a fault."""
    viewer = opened("posing.html")
    viewer.page.evaluate(
        """async () => {
          for (let time = 0; time < 20; time++) {
            const another = document.createElement("snapspace-viewer");
            const loaded = new Promise((go) => another.addEventListener("load", go));
            another.src = "posing.snapspace";
            document.body.append(another);
            await loaded;
            another.remove();
            await null;
          }
        }"""
    )
    viewer.run("(document.body.prepend(viewer), null)")  # moved: it keeps its shape
    viewer.settle()
    viewer.run("viewer.setHandles({ head: { translation: [0.1, 0, 0] } })")
    assert viewer.run("viewer.handles.head.translation") == pytest.approx([0.1, 0, 0])


def test_the_last_of_two_models_is_shown(opened: Open) -> None:
    viewer = opened("posing.html")
    viewer.run("(viewer.src = 'film.snapspace', viewer.src = 'blending.snapspace', null)")
    viewer.wait("viewer.model?.kind === 'interpolation'")
    viewer.page.wait_for_timeout(300)
    assert viewer.run("viewer.model.name") == "blending"


def test_the_example_runs(viewer: Viewer, address: str) -> None:
    viewer.open(f"{address}/example.html")
    viewer.page.get_by_role("button", name="Wave").click()
    viewer.page.wait_for_function("document.getElementById('told').textContent.endsWith(' ms')")
    viewer.wait("Math.abs(viewer.handles.belly.degrees[1]) > 1")
