"""Kept points become handles: the server improves the model, and posing continues smoothly."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from snapspace import (
    HandleBox,
    Handles,
    PosingProblem,
    growing_models,
    load,
    read_problem,
    solve_snapshots,
)
from snapspace.timeline import timeline_of

from ..server.in_process import started
from .choosing_page import (
    BAR,
    ENDS,
    bar_with_ends,
    cancel,
    compute,
    handles,
    press,
    saved_file,
    wait_for_text,
)
from .pages import OpenPage, Page
from .test_pull_page import free_vertex, press_pull, window
from .test_workspace_page import RECORDING, recorded

NAMES = "snapspace.session.model.handles.map(({ name }) => name)"

#: Lets the page believe that its connection is lost. The console must stay empty.
DISCONNECTED = """(() => {
  window.readyState = Object.getOwnPropertyDescriptor(WebSocket.prototype, "readyState");
  Object.defineProperty(WebSocket.prototype, "readyState", { configurable: true, get: () => 3 });
})()"""
CONNECTED = "Object.defineProperty(WebSocket.prototype, 'readyState', window.readyState); null"


def full_solution(page: Page, problem: PosingProblem) -> NDArray[np.float64]:
    """The surface of the full solution for the page's motions; the first handle is at rest."""
    moved = list(page.motions().values())[1:]
    parameters = np.array([[*translation, *euler] for euler, translation in moved])
    solved = solve_snapshots(problem, parameters.reshape(1, -1))
    assert solved.converged.all()
    surface: NDArray[np.float64] = solved.shapes[0].reshape(-1, 3)[problem.mesh.surface_vertices]
    return surface


def kept(page: Page, by: tuple[float, float]) -> int:
    """A vertex that is pulled and kept."""
    page.page.get_by_role("radio", name="Pull").click()
    button = page.page.get_by_role("button", name="Keep points")
    if button.get_attribute("aria-pressed") != "true":
        button.click()
    vertex = free_vertex(page)
    press_pull(page, window(page, vertex), by).up()
    page.settle()
    return vertex


def test_a_kept_point_becomes_a_handle_without_a_jolt(
    bar_server: str, bar_folder: Path, opened: OpenPage
) -> None:
    page = bar_with_ends(opened, bar_server)
    compute(page, most_samples=40, percent=5.0)
    page.wait("snapspace.kind === 'posing'")
    wait_for_text(page, "#panel", "Done in")
    press(page, "Polish")  # off: the live shape
    press(page, "Add key")
    page.drag(page.run("snapspace.handle(1)"), 20, -30)
    press(page, "Add key")
    motions, first = page.motions(), page.run("snapspace.session.model.dimension")
    page.run(RECORDING)
    kept(page, (15, 30))
    soft = page.shown()
    page.run("(window.recorded = [], null)")
    words = "document.getElementById('panel').innerText"
    improved = f"{words}.includes('The model is being improved for point 1.')"
    page.wait(f"{improved} && {words}.includes('and improving') && !{words}.includes('Done in')")
    page.wait(f"snapspace.session.model.dimension > {first}")
    assert page.run(NAMES) == ["foot", "head", "point 1"]
    assert page.run("snapspace.timeline.timeline.keys.map((key) => key.state.length)") == [3, 3]
    for handle, motion in motions.items():
        np.testing.assert_allclose(np.concatenate(page.motions()[handle]), np.concatenate(motion))
    page.page.wait_for_timeout(600)
    improved = page.shown()
    steps = recorded(page)
    assert steps.max() < 0.8 * steps.sum(), "the better shape comes in several steps"
    assert not page.page.get_by_role("button", name="Let go").is_visible() or (
        page.page.get_by_role("button", name="Let go").is_disabled()
    )
    wait_for_text(page, "#panel", "Done in")

    press(page, "Save")
    wait_for_text(page, "#panel", f"in {bar_folder}")
    file = bar_folder / saved_file(page)
    problem = read_problem(file)
    model = load(file.with_suffix(".snapspace"))
    assert problem.handles.names == model.problem.handles.names == ("foot", "head", "point 1")
    keys = timeline_of(model.provenance["timeline"]).keys
    assert [sorted(key.state) for key in keys] == [["foot", "head", "point 1"]] * 2
    solution = full_solution(page, problem)
    errors = [np.linalg.norm(shape - solution) for shape in (soft, improved)]
    assert errors[1] < 0.5 * errors[0], errors

    # keys and steps of undo have the shapes that they had with the soft point
    page.page.keyboard.press("Control+z")
    page.settle()
    at_rest = page.motions()
    assert np.abs(at_rest[1][1]).max() < 1e-9, "the head is back at rest"
    assert np.linalg.norm(at_rest[2][1]) > 0.05, "the point is where it was kept"
    page.page.keyboard.press("Control+Shift+z")
    page.settle()
    page.drag(page.run("snapspace.handle(2)"), 12, 12)
    assert np.linalg.norm(np.subtract(page.motions()[2][1], at_rest[2][1])) > 0.01

    press(page, "Choose handles")
    page.wait("snapspace.kind === 'choosing'")
    assert set(handles(page)) == {"foot", "head", "point 1"}
    assert handles(page)["point 1"] == set(problem.handles["point 1"].vertices.tolist())
    press(page, "Pose")
    page.wait("snapspace.kind === 'posing'")
    assert page.run("snapspace.timeline.timeline.keys.length") == 2, "the keys are still there"


def test_let_go_and_cancel_stop_computing_and_points_stay_soft(
    opened: OpenPage, tmp_path: Path
) -> None:
    ends = Handles(list(ENDS.values()), names=list(ENDS))
    problem = PosingProblem(BAR, ends, domain=HandleBox(translation=0.4, angle=0.5))
    model = next(growing_models(problem)).model
    model.save(tmp_path / "bar.snapspace")
    page = opened(started(model=model, folder=tmp_path))
    kept(page, (15, -25))
    wait_for_text(page, "#panel", "The model is being improved for point 1.")
    press(page, "Let go")
    cancelled = page.page.get_by_role("button", name="Cancel")
    cancelled.wait_for(state="hidden")
    rest = page.shown()
    kept(page, (15, -25))
    wait_for_text(page, "#panel", "The model is being improved for point 1.")
    cancel(page)
    wait_for_text(page, "#panel", "Soft, but usable: point 1.")
    assert np.abs(page.shown() - rest).max() > 0.01, "it still holds"
    press(page, "Make handles")
    wait_for_text(page, "#panel", "The model is being improved for point 1.")
    cancel(page)
    wait_for_text(page, "#panel", "Soft, but usable")

    page.run(DISCONNECTED)
    press(page, "HTML")
    wait_for_text(page, "#panel", "There is no connection to the server.")
    page.run(CONNECTED)

    page.page.locator("footer input").set_input_files(tmp_path / "bar.snapspace")
    page.page.get_by_role("button", name="Cancel").wait_for(state="detached")
    kept(page, (15, -25))
    wait_for_text(page, "#panel", "the server does not have this model")
