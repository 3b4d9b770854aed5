"""From a mesh to a saved model, in a browser with the real server."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import PosingModel, load, read_problem
from snapspace.server import SharedBody, problem_body
from snapspace.timeline import timeline_of

from ..server.in_process import started
from .choosing_page import (
    BAR,
    bar_with_ends,
    cancel,
    compute,
    ends_as_handles,
    handles,
    press,
    saved_file,
    set_number,
    wait_for_text,
    widen,
)
from .pages import SECONDS, OpenPage, Page
from .serving import served
from .test_posing_page import assert_shown
from .test_take_away import taken


@pytest.fixture
def page(bar_server: str, opened: OpenPage) -> Page:
    return bar_with_ends(opened, bar_server)


#: The largest motion of a vertex from picture to picture.
RECORDING = """window.recorded = [];
let last = snapspace.shown();
const record = () => {
    if (snapspace.kind !== "posing" || window.recorded === null) return;
    const now = snapspace.shown();
    const step = now.reduce((most, x, i) => Math.max(most, Math.abs(x - last[i])), 0);
    if (step > 0) window.recorded.push(step);
    last = now;
    requestAnimationFrame(record);
};
requestAnimationFrame(record);
snapspace.session.model.dimension"""
STOP = "(() => { const { recorded } = window; window.recorded = null; return recorded; })()"


def recorded(page: Page) -> NDArray[np.float64]:
    """Ends the recording, which reads every picture."""
    return np.array(page.run(STOP))


def test_it_is_dragged_while_it_improves_and_saved(
    page: Page, bar_folder: Path, opened: OpenPage, tmp_path: Path
) -> None:
    chosen = handles(page)
    press(page, "Range")
    page.page.get_by_label("Turn, plus or minus").first.fill("30")
    compute(page, most_samples=70, percent=0.01)
    page.wait("snapspace.kind === 'posing'")
    wait_for_text(page, "#panel", "Ready to pose, and improving")
    first = page.run(RECORDING)  # before the drag, in which better models may come
    x, y = page.run("snapspace.handle(1)")
    mouse = page.page.mouse
    mouse.move(x, y)
    mouse.down()
    mouse.move(x + 30, y - 30, steps=4)
    page.settle()
    before = page.motions()[1][1]
    assert np.linalg.norm(before) > 0.02
    page.wait(f"snapspace.session.model.dimension > {first}")
    page.page.wait_for_timeout(600)
    steps = recorded(page)
    assert steps.max() < 0.8 * steps.sum(), "the better shape comes in several steps"
    assert page.motions()[1][1] == before, "the drag continued where it was"
    mouse.move(x + 50, y - 40, steps=4)
    mouse.up()
    page.settle()
    assert np.linalg.norm(np.subtract(page.motions()[1][1], before)) > 0.01
    wait_for_text(page, "#panel", "Done in")
    wait_for_text(page, ".hud", "polished, moved")  # by the last model
    press(page, "Add key")
    press(page, "Choose handles")  # keys are there in all views
    exported = taken(page, "Export HTML", tmp_path)
    press(page, "Pose")
    page.wait("snapspace.kind === 'posing'")
    content = exported.read_text(encoding="utf-8")
    assert exported.name == "bar.html" and 'snapspace-server" content' not in content
    alone = opened(exported.as_uri())
    (state,) = alone.run("snapspace.timeline.timeline.keys.map((key) => key.state)")
    np.testing.assert_allclose(state[1]["translation"], page.motions()[1][1], atol=1e-6)
    press(page, "Save")
    wait_for_text(page, "#panel", f"in {bar_folder}")

    file = bar_folder / saved_file(page)
    problem = read_problem(file)
    found = {handle.name: set(handle.vertices.tolist()) for handle in problem.handles}
    assert found == chosen and problem.handles.names[0] == "foot"
    np.testing.assert_allclose(problem.domain.half_widths[3:], np.deg2rad(30.0))
    model = load(file.with_suffix(".snapspace"))
    assert isinstance(model, PosingModel) and model.dimension > first
    assert model.provenance["accurate"]["target_error"] == pytest.approx(1e-4), "as was typed"
    (key,) = timeline_of(model.provenance["timeline"]).keys
    np.testing.assert_allclose(key.state["head"][1], page.motions()[1][1], atol=1e-6)
    press(page, "Polish")  # off: the live shape
    assert_shown(model, page)

    before = page.motions()[1]
    press(page, "Choose handles")
    page.wait("snapspace.kind === 'choosing'")
    assert handles(page) == chosen
    press(page, "Pose")
    page.wait("snapspace.kind === 'posing'")
    for again, left in zip(page.motions()[1], before, strict=True):
        assert again == pytest.approx(left, abs=1e-9), "posing resumes where it was left"


def test_a_computation_is_cancelled_and_another_begun(page: Page) -> None:
    widen(page)
    compute(page, most_samples=20_000, percent=0.01)
    page.wait("snapspace.kind === 'posing'")
    cancel(page)
    button = page.page.get_by_role("button", name="Cancel")
    button.wait_for(state="hidden", timeout=1000 * SECONDS)
    page.drag(page.run("snapspace.handle(1)"), 30, -20)
    assert np.linalg.norm(page.motions()[1][1]) > 0.02, "what there is can be posed"
    press(page, "Choose handles")
    page.wait("snapspace.kind === 'choosing'")
    compute(page)
    wait_for_text(page, "#panel", "Done in")


def test_a_refusal_of_the_server_is_shown(page: Page) -> None:
    page.page.locator("summary").click()
    for label in ("Travel", "Turn"):
        page.page.get_by_label(f"{label}, plus or minus").last.fill("0")
    press(page, "Compute")
    page.wait("document.querySelector('.fault').innerText !== ''")
    assert page.run("document.querySelector('.fault').role") == "alert"
    assert "zero" in page.text(".fault")
    assert page.run("snapspace.kind") == "choosing"


def test_two_pages_do_not_disturb_each_other(page: Page, bar_server: str, opened: OpenPage) -> None:
    other = opened(bar_server)
    other.wait("snapspace.kind === 'choosing'")
    assert handles(other) == {}
    ends_as_handles(other)
    name = other.page.get_by_label("Name of the handle").last
    name.fill("hand")
    name.press("Enter")
    set_number(other, "Error of unseen motions, %", 50.0)
    set_number(other, "Samples, at most", 20)
    widen(page)
    compute(page, most_samples=20_000, percent=0.01)
    page.wait("snapspace.kind === 'posing'")  # the server computes for this page
    press(other, "Compute")
    wait_for_text(other, "#panel", "Waiting for another computation")
    assert other.text(".progress-words").strip() == "Waiting for another computation"
    assert not other.page.locator("#panel progress").get_attribute("value"), "it has no end yet"
    cancel(page)
    page.page.get_by_role("button", name="Cancel").wait_for(state="hidden")
    press(page, "Choose handles")
    page.wait("snapspace.kind === 'choosing'")
    compute(page)
    for one, names in ((page, ["foot", "head"]), (other, ["foot", "hand"])):
        one.wait("snapspace.kind === 'posing'")
        wait_for_text(one, "#panel", "Done in")
        assert one.run("snapspace.session.model.handles.map(({ name }) => name)") == names


def test_a_problem_shows_its_handles(bar_folder: Path, opened: OpenPage) -> None:
    x = BAR.vertices[:, 0]
    vertices = {"low": np.flatnonzero(x < 0.5), "high": np.flatnonzero(x > 3.5)}
    content = {
        "mesh": "bar.mesh",
        "stiffness": 200.0,
        "domain": {"translation": 0.4, "angle_degrees": 20},
        "handles": [{"name": name, "vertices": v.tolist()} for name, v in vertices.items()],
    }
    path = bar_folder / "given.json"
    path.write_text(json.dumps(content), encoding="utf-8")
    page = opened(started(body=SharedBody(lambda _: problem_body(path)), folder=bar_folder))
    page.wait("snapspace.kind === 'choosing'")
    assert handles(page) == {name: set(v.tolist()) for name, v in vertices.items()}
    page.page.locator("summary").click()
    assert page.page.get_by_label("Handles' stiffness").input_value() == "200"
    assert page.page.get_by_label("Turn, plus or minus").last.input_value() == "20"
    assert page.page.get_by_role("button", name="Compute").is_enabled()


def test_the_end_of_the_server_is_reported_and_posing_continues(
    bar_folder: Path, opened: OpenPage
) -> None:
    with served(bar_folder / "bar.mesh", cwd=bar_folder) as address:
        page = bar_with_ends(opened, address)
        compute(page)
        page.wait("snapspace.kind === 'posing'")
        wait_for_text(page, "#panel", "Done in")
        page.loses_server = True
    wait_for_text(page, "#connection", "No connection to the server")
    page.drag(page.run("snapspace.handle(1)"), 30, -20)
    assert np.linalg.norm(page.motions()[1][1]) > 0.02
    wait_for_text(page, ".hud", "Not polished: there is no connection to the server.")
