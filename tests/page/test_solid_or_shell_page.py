"""In the page a surface is a solid or a shell, and handles stay when that changes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from snapspace import PosingModel, ShellMesh, load, write_surface
from snapspace.mesh.surface import compact_surface

from ..server.held_filling import HeldFilling
from ..server.in_process import started
from ..shells.sheets import sheet
from .choosing_page import (
    BAR,
    TAKE_HANDLES,
    handles,
    press,
    saved_file,
    set_number,
    wait_for_text,
)
from .pages import OpenPage, Page
from .test_posing_page import assert_shown


def dropped(
    opened: OpenPage, folder: Path, given: tuple[np.ndarray, np.ndarray], **options: Any
) -> Page:
    """A page on which a surface has been dropped."""
    file = folder / "dropped" / "it.obj"
    file.parent.mkdir()
    write_surface(file, *given)
    page: Page = opened(started(folder=folder, **options))
    page.page.set_input_files("#message input[type=file]", file)
    return page


def take_ends(page: Page) -> dict[str, set[int]]:
    """Both ends along x become the handles low and high."""
    x = page.numbers("snapspace.choosing.mesh.shape").reshape(-1, 3)[:, 0]
    ends = {"low": x < x.min() + 0.3, "high": x > x.max() - 0.3}
    page.run(TAKE_HANDLES, [[name, np.flatnonzero(end).tolist()] for name, end in ends.items()])
    return handles(page)


def is_chosen(page: Page, form: str) -> bool:
    radio = page.page.get_by_role("radio", name=form, exact=True)
    return bool(radio.get_attribute("aria-checked") == "true")


def choose(page: Page, form: str) -> None:
    page.page.get_by_role("radio", name=form, exact=True).click()


def test_an_open_surface_is_a_shell_that_is_posed_saved_and_reloaded(
    tmp_path: Path, opened: OpenPage, chromium: object
) -> None:
    mesh = sheet(16, 8, size=(2.0, 1.0))
    page = dropped(opened, tmp_path, (mesh.vertices, mesh.triangles))
    page.wait("snapspace.kind === 'choosing'")
    assert is_chosen(page, "Shell")
    assert "The surface is open, so it is a shell" in page.text("#body-hint")
    thickness = page.page.get_by_label("Thickness")
    assert float(thickness.input_value()) == pytest.approx(0.02 * mesh.diagonal, rel=0.05)
    thickness.fill("0.125")
    chosen = take_ends(page)
    options = page.page.locator("select[aria-label=Material] option:disabled").all_inner_texts()
    assert options and not any("neo-Hookean" in option for option in options)
    assert page.page.get_by_label("Material").input_value() == "arap"
    page.page.wait_for_timeout(300)  # choices are kept soon
    page.page.reload()
    page.wait("snapspace.kind === 'choosing'")
    assert page.page.get_by_label("Thickness").input_value() == "0.125"
    assert handles(page) == chosen

    press(page, "Check surface")
    wait_for_text(page, ".findings", "A shell stays as it is")
    choose(page, "Solid")  # a sheet encloses nothing
    wait_for_text(page, "#message", "encloses no volume")
    press(page, "Close")
    page.wait("snapspace.kind === 'choosing'")
    assert is_chosen(page, "Shell") and handles(page) == chosen
    assert page.page.get_by_label("Thickness").input_value() == "0.125"

    set_number(page, "Samples, at most", 20)
    press(page, "Compute")
    page.wait("snapspace.kind === 'posing'")
    wait_for_text(page, "#panel", "Done in")
    press(page, "Save")
    wait_for_text(page, "#panel", "Saved")
    file = tmp_path / saved_file(page)
    content = json.loads(file.read_text(encoding="utf-8"))
    assert content["body"] == {"shell": {"thickness": 0.125}} and "mesh" not in content
    model = load(file.with_suffix(".snapspace"))
    assert isinstance(model, PosingModel) and isinstance(model.problem.mesh, ShellMesh)
    assert model.problem.mesh.thickness == 0.125

    # the file of the shell, dropped on the page, gives the same shapes as Python
    opener = page.page.locator("footer input[type=file]")
    opener.set_input_files(file.with_suffix(".snapspace"))
    page.wait("snapspace.kind === 'posing' && !document.querySelector('#panel .saved')")
    page.drag(page.run("snapspace.handle(1)"), 40, -30)
    assert np.linalg.norm(page.motions()[1][1]) > 0.02
    assert_shown(model, page)


def test_a_closed_surface_is_a_shell_at_once_and_a_solid_later(
    tmp_path: Path, opened: OpenPage, chromium: object
) -> None:
    filling = HeldFilling(outcome=BAR)
    surface = compact_surface(BAR.vertices, BAR.surface)
    page = dropped(opened, tmp_path, surface, filling=filling)
    wait_for_text(page, "#message", "Making a solid of it")
    press(page, "Use as a shell")
    page.wait("snapspace.kind === 'choosing'")
    assert is_chosen(page, "Shell") and "The surface is open" not in page.text("#body-hint")
    chosen = take_ends(page)
    choose(page, "Solid")
    wait_for_text(page, "#message", "Making a solid of it")
    filling.let_go.set()
    page.wait("snapspace.kind === 'choosing'")
    assert is_chosen(page, "Solid") and handles(page) == chosen
    assert page.page.get_by_label("Thickness").is_hidden()
    material = page.page.get_by_label("Material")
    assert material.input_value() == "stable-neo-hookean"
    choose(page, "Shell")
    assert page.page.get_by_label("Thickness").is_visible()
    assert material.input_value() == "arap"
    material.select_option("stvk")
    choose(page, "Solid")
    assert material.input_value() == "stvk", "what was chosen stays"
    material.select_option("stable-neo-hookean")
    choose(page, "Shell")
    assert "of the diagonal" in page.text("#body-hint")
    press(page, "Save handles")
    wait_for_text(page, "#panel", "Saved")
    content = json.loads((tmp_path / saved_file(page)).read_text(encoding="utf-8"))
    assert content["body"]["shell"]["thickness"] == pytest.approx(0.085, abs=0.005)
    choose(page, "Solid")
    press(page, "Save handles")
    wait_for_text(page, "#panel .saved", ".msh")
