"""The exported page of twelve poses, a few of them chosen and blended."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import pytest

from snapspace import InterpolationModel

from .pages import OpenPage, Page, Tabs
from .test_blending_page import assert_shown

#: Rest takes part alone, and then the two others that take part at first. One pose must stay.
AT_FIRST = """(() => {
  const pose = (name) => document.querySelector(`[title='${name}']`);
  const others = [...document.querySelectorAll(".pose[aria-pressed=true]")].filter(
    (button) => button !== pose("rest"),
  );
  const last = others.pop();
  others.forEach((button) => button.click());
  if (pose("rest").getAttribute("aria-pressed") === "false") pose("rest").click();
  last?.click();
  for (const name of ["arc-01", "arc-02"]) pose(name).click();
  [...document.querySelectorAll("#panel button")].find((b) => b.textContent === "Mean").click();
  document.activeElement.blur();
  return null;
})()"""


@pytest.fixture(scope="module")
def kept_page(many_poses_page: Path, tabs: Tabs) -> Iterator[Page]:
    page = tabs.open(many_poses_page.as_uri(), size=(760, 480))
    yield page
    tabs.close(page)


@pytest.fixture
def page(kept_page: Page) -> Page:
    """The page as at first; tests share it."""
    kept_page.run(AT_FIRST)
    kept_page.settle()
    return kept_page


def weights_of(page: Page) -> list[float]:
    page.settle()
    weights: list[float] = page.run("snapspace.session.weights")
    return weights


def taking_part(page: Page) -> list[str]:
    """Names of the poses that are pressed in the list."""
    page.settle()
    names: list[str] = page.run(
        "[...document.querySelectorAll('.pose[aria-pressed=true]')].map((b) => b.title)"
    )
    return names


def click(page: Page, name: str) -> None:
    page.page.get_by_role("button", name=name, exact=True).click()
    page.settle()


def sparse(model: InterpolationModel, **given: float) -> list[float]:
    names = {name.replace("-", "_"): k for k, name in enumerate(model.problem.poses.names)}
    weights = np.zeros(len(names))
    for name, weight in given.items():
        weights[names[name]] = weight
    return weights.tolist()


def test_a_pose_that_is_chosen_does_not_change_the_shape_until_it_is_weighed(
    many_poses_model: InterpolationModel, page: Page
) -> None:
    assert taking_part(page) == ["arc-01", "arc-02", "rest"]
    assert np.count_nonzero(weights_of(page)) == 3, "of many poses only some take part at first"
    before = page.shown()
    click(page, "twist_4")
    assert np.array_equal(page.shown(), before)
    assert page.page.locator(".corner").count() == 4
    page.page.get_by_role("slider", name="twist_4").fill("0.7")
    third = 0.1
    wanted = sparse(many_poses_model, rest=third, arc_01=third, arc_02=third, twist_4=0.7)
    assert np.allclose(weights_of(page), wanted)
    assert_shown(many_poses_model, page)


def test_the_polygon_is_that_of_the_chosen_poses(
    many_poses_model: InterpolationModel, page: Page
) -> None:
    for name in ("rest", "arc-01", "look back"):  # leaves arc-02 and look back
        click(page, name)
    assert page.page.locator(".corner").count() == 2
    page.page.locator(".corner").nth(1).click()
    assert weights_of(page) == sparse(many_poses_model, **{"look back": 1.0})
    page.page.locator(".polygon").press("ArrowLeft")  # a twentieth of the radius, half the width
    wanted = sparse(many_poses_model, arc_02=0.025, **{"look back": 0.975})
    assert np.allclose(weights_of(page), wanted)
    assert_shown(many_poses_model, page)


def test_weights_are_typed_and_poses_taken_away(
    many_poses_model: InterpolationModel, page: Page
) -> None:
    page.page.get_by_role("spinbutton", name="Weight of rest").fill("50")
    page.page.keyboard.press("Enter")
    assert np.allclose(
        weights_of(page), sparse(many_poses_model, rest=0.5, arc_01=0.25, arc_02=0.25)
    )
    weight = page.page.get_by_role("spinbutton", name="Weight of rest")
    for wrong in ("150", "-20", ""):
        weight.fill(wrong)
        page.page.keyboard.press("Tab")
        assert weights_of(page)[0] == 0.5, "a weight is from 0 to 100 %"
        assert weight.input_value() == "50", "a number that is refused does not stay"
    take = page.page.get_by_role("button", name="Take arc-02 away")
    take.focus()
    page.page.keyboard.press("Enter")
    assert np.allclose(weights_of(page), sparse(many_poses_model, rest=2 / 3, arc_01=1 / 3))
    focused = "document.activeElement.getAttribute('aria-label')"
    assert page.run(focused) == "Take arc-01 away", "the focus does not get lost with its row"
    page.page.keyboard.press("Enter")
    assert weights_of(page) == sparse(many_poses_model, rest=1.0)
    assert page.run(focused) == "rest"
    click(page, "rest")
    assert taking_part(page) == ["rest"] and "One pose must stay" in page.text("#panel")


def test_clicks_between_two_pictures_all_count(page: Page) -> None:
    names = ["twist_1", "twist_2", "arc-01"]
    page.run(
        "names => names.forEach((n) => document.querySelector(`[title='${n}']`).click())", names
    )
    assert taking_part(page) == ["arc-02", "twist_1", "twist_2", "rest"]


def test_a_polygon_has_eight_corners_at_most(page: Page) -> None:
    for name in ("arc-03", "arc-04", "arc-05", "twist_1", "twist_2", "twist_3"):
        click(page, name)
    below = "document.querySelector('.steady').offsetTop"
    place = page.run(below)
    assert len(taking_part(page)) == 8 and "twist_3" not in taking_part(page)
    assert "8 poses at most" in page.text("#panel")
    click(page, "arc-05")
    assert page.run(below) == place, "a text that comes and goes moves nothing below"
    click(page, "twist_3")
    assert "twist_3" in taking_part(page), "seven poses take one more"


def shown_poses(page: Page) -> Sequence[str]:
    names: list[str] = page.run(
        "[...document.querySelectorAll('.group:not([hidden])[open] .pose:not([hidden])')]"
        ".map((b) => b.title)"
    )
    return names


def test_poses_are_searched_and_chosen_by_keys(page: Page) -> None:
    headings = page.run("[...document.querySelectorAll('summary')].map((s) => s.innerText)")
    assert [heading.split("\n")[0] for heading in headings] == ["arc", "twist", "Others"]
    page.page.locator("canvas").focus()
    page.page.keyboard.press("/")
    page.page.keyboard.type("Twist 5")
    assert shown_poses(page) == ["twist_5"]
    page.page.keyboard.press("Enter")
    assert "twist_5" in taking_part(page)
    page.page.keyboard.press("Escape")
    assert len(shown_poses(page)) == 12
    page.page.keyboard.type("none such")
    assert shown_poses(page) == [] and "No pose has" in page.text("#panel")
    page.page.keyboard.press("Escape")
    # four in a row: down from the first is the fifth, and from there the next group
    focused = "document.activeElement.title"
    seen = []
    for key in ("ArrowDown", "ArrowDown", "ArrowDown", "ArrowRight", "ArrowUp", "ArrowUp", "End"):
        page.page.keyboard.press(key)
        seen.append(page.run(focused))
    assert seen == ["arc-01", "arc-05", "twist_1", "twist_2", "arc-05", "arc-01", "look back"]
    page.page.keyboard.press("Space")
    assert "look back" in taking_part(page), "Space presses the button and does not play"
    assert (
        page.page.get_by_role("button", name="Play", exact=True).get_attribute("aria-pressed")
        == "false"
    )
    page.page.keyboard.press("Tab")
    assert page.run("document.activeElement.closest('.poses')") is None, "one step leads out"


def test_every_pose_has_a_picture_of_its_own(many_poses_page: Path, opened: OpenPage) -> None:
    page = opened(many_poses_page.as_uri(), sharp=True)
    page.wait("[...document.querySelectorAll('.pose img')].every((i) => i.complete && i.src)")
    pictures = page.run("[...document.querySelectorAll('.pose img')].map((i) => i.src)")
    assert len(set(pictures)) == 12


def test_strains_of_a_sparse_blend_are_relative_to_its_poses(
    many_poses_model: InterpolationModel, page: Page
) -> None:
    """Eleven weights are zero: strains are those from the twelfth pose, which is shown."""
    page.page.get_by_role("radio", name="Strain").click()
    page.page.get_by_role("slider", name="arc-02").fill("1")
    page.settle()
    strains = page.numbers("snapspace.strains()")
    model = many_poses_model
    pose = model.surface.vertices(model.problem.pose_shapes[2].reshape(-1, 3))
    error = np.abs(page.shown() - pose).max() / model.problem.mesh.diagonal
    assert strains.max() < 20 * error + 1e-4 < 0.1


#: Every picture comes a twentieth of a second after the one before; what each shows is kept.
STEADY = """
const next = window.requestAnimationFrame.bind(window);
let now = performance.now();
window.walked = [];
window.requestAnimationFrame = (act) => next(() => {
  act((now += 1000 / 20));
  walked.push([[...snapspace.session.weights], [...snapspace.shown()]]);
});
null
"""


def test_a_walk_moves_the_shape_evenly_and_not_the_weights(
    many_poses_model: InterpolationModel, many_poses_page: Path, opened: OpenPage
) -> None:
    """The walk starts at the present shape and visits the chosen poses in order."""
    page = opened(many_poses_page.as_uri(), size=(760, 320))  # small pictures are drawn sooner
    for name in ("rest", "arc-01", "twist_5", "look back", "arc-02"):
        click(page, name)  # instead of the first three: twist_5, look back
    page.page.get_by_role("slider", name="twist_5").fill("0.5")
    start = weights_of(page)
    page.page.locator("canvas").focus()
    page.run(STEADY)
    page.page.keyboard.press("Space")
    page.wait("walked.length > 85")
    page.page.keyboard.press("Space")
    frames = page.run("walked")
    weights = np.array([w for w, _ in frames])
    shapes = np.array([shape for _, shape in frames]).reshape(len(frames), -1, 3)
    names = many_poses_model.problem.poses.names
    assert np.abs(weights[1] - start).max() < 0.05, "it begins where the shape is"
    used = {names[k] for k in np.flatnonzero(weights.max(axis=0) > 0)}
    assert used == {"twist_5", "look back"}
    at_pose = np.flatnonzero(weights.max(axis=1) == 1)
    assert len(at_pose) >= 2, "it comes to the poses themselves"

    moved = np.linalg.norm(np.diff(shapes, axis=0), axis=2).max(axis=1)
    steps = np.abs(np.diff(weights, axis=0)).max(axis=1)
    # a step that ends at a pose is shorter
    inside = (weights[:-1].max(axis=1) < 1) & (weights[1:].max(axis=1) < 1) & (steps > 0)
    moved, steps = moved[inside][3:], steps[inside][3:]
    assert len(moved) > 40
    assert moved.max() < 1.3 * moved.min(), "the shape moves evenly"
    assert steps.max() > 1.8 * steps.min(), "the weights do not"


#: Blends that jump: weights of the second pose above a half give shapes of much larger weights.
LEAPING = """
const blend = snapspace.session.blend;
snapspace.session.blend = function (weights, start) {
  if (weights[1] <= 0.5) return blend.call(this, weights, start);
  const leapt = 0.8 + 0.2 * weights[1];
  return blend.call(this, weights.map((w, k) => k === 1 ? leapt : k === 5 ? 1 - leapt : 0), start);
};
null
"""


def test_a_jump_on_the_walk_is_reported_with_its_weight(
    many_poses_page: Path, opened: OpenPage
) -> None:
    page = opened(many_poses_page.as_uri(), size=(760, 320))
    for name in ("arc-05", "arc-02", "rest"):
        click(page, name)  # leaves arc-01 and arc-05
    page.page.get_by_role("slider", name="arc-05").fill("0.6")
    page.settle()
    page.run(LEAPING)
    page.page.get_by_role("button", name="Play", exact=True).click()
    remark = "document.querySelector('.hud p[role=status]:not(.badge)').textContent"
    page.wait(remark)
    assert page.run(remark) == "The shape jumps on the way to arc-01, at a weight of 50.0 %."
    page.page.get_by_role("button", name="Mean").click()
    assert page.run(remark) == "", "the remark ends with the walk"
