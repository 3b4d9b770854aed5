"""Exported pages."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from snapspace import InterpolationModel, PosingModel
from snapspace.mesh import write_tets
from snapspace.page import export_html

from .choosing_page import BAR
from .many_poses import many_poses_model
from .pages import OpenPage, Page, Tabs
from .serving import served

__all__ = ["many_poses_model"]  # a fixture

#: The page's own controls take it back to where it started; undo still has the steps before.
AT_REST = """(() => {
  const named = (name) => [...document.querySelectorAll("#panel button")].find(
    (button) => button.textContent === name,
  );
  document.activeElement.blur();
  document.dispatchEvent(new KeyboardEvent("keydown", { key: "Escape" }));
  for (const name of ["Move", "Handles", "z up", "Reset view", "Reset"]) named(name).click();
  const slider = document.querySelector("#panel input[type=range]");
  if (slider.value !== slider.max) {
    slider.value = slider.max;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  }
  return null;
})()"""


@pytest.fixture(scope="session")
def tabs(chromium: Any) -> Tabs:
    return Tabs(chromium)


@pytest.fixture
def opened(tabs: Tabs) -> Iterator[OpenPage]:
    """opened(address) opens a page; afterwards it must have met no errors and made no requests."""
    pages = []

    def open_it(address: str, **options: Any) -> Page:
        pages.append(tabs.open(address, **options))
        return pages[-1]

    yield open_it
    for page in pages:
        tabs.close(page)


@pytest.fixture(scope="session")
def bar_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where `bar_server` reads bar.mesh and saves."""
    folder = tmp_path_factory.mktemp("bar")
    write_tets(folder / "bar.mesh", BAR)
    return folder


@pytest.fixture(scope="session")
def bar_server(bar_folder: Path, chromium: object) -> Iterator[str]:
    """The address of a server that has `BAR`: each page gets its own workspace."""
    with served(bar_folder / "bar.mesh", cwd=bar_folder) as address:
        yield address


@pytest.fixture(scope="session")
def kept_posing_page(posing_page: Path, tabs: Tabs) -> Iterator[Page]:
    page = tabs.open(posing_page.as_uri())
    yield page
    tabs.close(page)


@pytest.fixture
def posing(kept_posing_page: Page) -> Page:
    """The page of the bar with its handles at rest; tests share it."""
    page = kept_posing_page
    page.page.mouse.move(0, 0)
    page.run(AT_REST)
    page.wait("document.querySelector('.notice').style.visibility === 'hidden'")
    page.settle()
    return page


@pytest.fixture(scope="session")
def posing_page(posing_model: PosingModel, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return export_html(posing_model, tmp_path_factory.mktemp("pages") / "bar.html")


@pytest.fixture(scope="session")
def blending_page(
    blending_model: InterpolationModel, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    return export_html(blending_model, tmp_path_factory.mktemp("pages") / "poses.html")


@pytest.fixture(scope="session")
def many_poses_page(
    many_poses_model: InterpolationModel, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    return export_html(many_poses_model, tmp_path_factory.mktemp("pages") / "many.html")
