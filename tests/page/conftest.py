"""Headless Chromium, and exported pages."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from snapspace import InterpolationModel, PosingModel
from snapspace.page import export_html

from .pages import OpenPage, open_page

NEEDED = "SNAPSPACE_NEEDS_BROWSER"  # CI sets it
OPTIONS = (
    "--no-sandbox",
    # WebGL in software
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
)


def missing(reason: str) -> None:
    """Skips, or fails where a browser must be there."""
    if os.environ.get(NEEDED):
        pytest.fail(f"{reason} ({NEEDED} is set)")
    pytest.skip(reason)


@pytest.fixture(scope="session")
def chromium() -> Iterator[Any]:
    """The browser; the tests are skipped where none is installed."""
    names = ("chromium", "chromium-browser", "google-chrome")
    program = next(filter(None, map(shutil.which, names)), None)
    if program is None:
        missing(f"needs a browser ({', '.join(names)}), such as Debian's chromium")
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        missing("needs playwright")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=list(OPTIONS))
        yield browser
        browser.close()


@pytest.fixture
def opened(chromium: Any) -> Iterator[OpenPage]:
    """opened(address) opens a page; afterwards it must have met no errors and made no requests."""
    pages = []

    def open_it(address: str, **options: Any) -> Any:
        page = open_page(chromium, address, **options)
        pages.append(page)
        return page

    yield open_it
    for page in pages:
        page.close()
        assert page.faults == []


@pytest.fixture(scope="session")
def posing_page(posing_model: PosingModel, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return export_html(posing_model, tmp_path_factory.mktemp("pages") / "bar.html")


@pytest.fixture(scope="session")
def blending_page(
    blending_model: InterpolationModel, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    return export_html(blending_model, tmp_path_factory.mktemp("pages") / "poses.html")
