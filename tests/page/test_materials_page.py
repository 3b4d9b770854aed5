"""Materials and parts, from the panel to the saved problem, in a browser with the real server."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from snapspace import load, read_problem
from snapspace.material import MATERIALS

from .choosing_page import (
    BAR,
    bar_with_ends,
    compute,
    handles,
    places,
    press,
    saved_file,
    stroke,
    take_ends,
    tool,
    wait_for_text,
)
from .pages import OpenPage, Page, Tabs


@pytest.fixture(scope="module")
def kept(bar_server: str, tabs: Tabs) -> Iterator[Page]:
    page = bar_with_ends(tabs.open, bar_server)
    yield page
    tabs.close(page)


@pytest.fixture
def page(kept: Page) -> Page:
    """The handles foot and head, and nothing else; tests share the page."""
    kept.run("(document.activeElement.blur(), null)")
    take_ends(kept)
    kept.page.get_by_label("Material").select_option("stable-neo-hookean")
    kept.page.get_by_label("Poisson's ratio").fill("0.25")
    kept.settle()
    return kept


def parts(page: Page) -> dict[str, dict[str, Any]]:
    return {part["name"]: part for part in page.run("snapspace.parts")}


def make_part(page: Page, kind: str, low: float, high: float) -> set[int]:
    """The vertices between two shares of the bar's length become a part."""
    x, y = places(page).T
    left, length = x.min(), np.ptp(x)
    tool(page, "Box")
    a, b = left + low * length, left + high * length
    stroke(page, (a, y.min() - 5), (b, y.max() + 5))
    chosen = set(page.run("snapspace.selected"))
    press(page, f"{kind} part")
    page.page.keyboard.press("Escape")  # its name could be typed
    return chosen


def test_the_materials_of_the_server_are_offered(page: Page) -> None:
    select = page.page.get_by_label("Material")
    found = select.locator("option").evaluate_all("(all) => all.map(({ value }) => value)")
    assert found == list(MATERIALS)
    assert select.input_value() == "stable-neo-hookean"
    ratio = page.page.get_by_label("Poisson's ratio")
    assert ratio.input_value() == "0.25"
    select.select_option("arap")
    assert not ratio.is_visible(), "it has no volume term"
    select.select_option("corotational")
    assert ratio.is_visible()
    ratio.fill("0.5")
    press(page, "Compute")
    assert not ratio.evaluate("(input) => input.validity.valid")
    assert page.run("snapspace.kind") == "choosing"


def test_parts_are_made_renamed_changed_and_taken_back(page: Page) -> None:
    chosen, before = make_part(page, "Stiff", 0.3, 0.6), handles(page)
    assert chosen and list(parts(page)) == ["stiff 1"]
    assert set(parts(page)["stiff 1"]["vertices"]) == chosen
    name = page.page.get_by_label("Name of the part")
    name.fill("bone")
    name.press("Enter")
    page.page.get_by_label("Stiffness of bone").fill("25")
    page.page.get_by_label("Stiffness of bone").press("Enter")
    assert parts(page)["bone"]["factor"] == 25
    make_part(page, "Soft", 0.5, 0.7)
    assert parts(page)["soft 1"]["factor"] == 0.1
    other = page.page.get_by_label("Name of the part").last
    other.fill("bone")
    other.press("Enter")
    assert "There is already a part named bone." in page.text("#panel")
    press(page, "Undo")
    press(page, "Undo")  # the soft part, and its selection
    assert list(parts(page)) == ["bone"]
    press(page, "Delete bone")
    assert parts(page) == {}
    page.page.keyboard.press("Control+z")
    assert list(parts(page)) == ["bone"] and handles(page) == before


def test_a_part_has_a_colour_of_its_own_below_handles(page: Page) -> None:
    make_part(page, "Stiff", 0.1, 0.6)
    page.settle()
    own = page.page.locator(".parts .swatch").evaluate(
        "(swatch) => getComputedStyle(swatch).backgroundColor"
    )
    assert own == "rgb(124, 138, 60)"
    script = (
        "(vertices) => vertices.map((v) => [0, 1, 2].map((i) => "
        "snapspace.choosing.surface.solid.geometry.attributes.vertexColor.data[3 * v + i]))"
    )
    inside = set(parts(page)["stiff 1"]["vertices"])
    foot = handles(page)["foot"]
    free = sorted(inside - foot)[0]
    rest = sorted(set(range(len(BAR.vertices))) - inside - foot - handles(page)["head"])[0]
    both = sorted(inside & foot)[0]
    shown = page.run(script, [free, rest, both, sorted(foot - inside)[0]])
    assert shown[0] != shown[1] and shown[2] == shown[3] != shown[0]


@pytest.mark.parametrize("kind", ["corotational", "arap"])
def test_materials_and_parts_are_computed_with_and_saved(
    bar_server: str, bar_folder: Path, opened: OpenPage, kind: str
) -> None:
    page = bar_with_ends(opened, bar_server)
    page.page.get_by_label("Material").select_option(kind)
    if kind == "corotational":
        page.page.get_by_label("Poisson's ratio").fill("0.4")
    make_part(page, "Stiff", 0.3, 0.6)
    make_part(page, "Soft", 0.5, 0.7)
    compute(page)
    page.wait("snapspace.kind === 'posing'")
    wait_for_text(page, "#panel", "Done in")
    assert page.run("snapspace.session.model.material") == kind
    page.drag(page.run("snapspace.handle(1)"), 40, -30)
    assert np.linalg.norm(page.motions()[1][1]) > 0.02
    press(page, "Save")
    wait_for_text(page, "#panel", f"in {bar_folder}")
    name = saved_file(page)
    material = read_problem(bar_folder / name).material
    assert material.kind == kind
    assert sorted(set(np.round(material.mu, 9))) == [0.1, 1.0, 10.0]
    if kind == "corotational":
        ratio = material.lam / (2 * (material.lam + material.mu))
        np.testing.assert_allclose(ratio, 0.4)
    model = load((bar_folder / name).with_suffix(".snapspace"))
    assert model.problem.material == material


def test_a_part_without_tets_is_refused_by_name(page: Page) -> None:
    page.run("snapspace.choosing.take(Int32Array.of(40), false)")
    page.run("snapspace.choosing.commit()")
    press(page, "Soft part")
    press(page, "Compute")
    page.wait("document.querySelector('.fault').innerText !== ''")
    assert "Part 'soft 1' has no tet" in page.text(".fault")
    field = page.page.get_by_label("Stiffness of soft 1")
    for bad in ("0", "-1", ""):
        field.fill(bad)
        press(page, "Compute")
        assert not field.evaluate("(input) => input.validity.valid")
    assert parts(page)["soft 1"]["factor"] == 0.1
