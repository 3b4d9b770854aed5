"""Headless Chromium for tests of the page."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from typing import Any

import pytest

NEEDED = "SNAPSPACE_NEEDS_BROWSER"  # CI sets it
#: Chromium without windows runs the same page in three quarters of the time.
PROGRAMS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
OPTIONS = (
    "--no-sandbox",
    # WebGL in software
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    # The processor puts the page's layers together. WebGL in software would take three times as
    # long for a picture, most of it for the blurred background of the panel.
    "--disable-gpu-compositing",
    # Shaders are compiled once for all pages of a browser, which have the same ones, not again for
    # each page: a fourth to almost half of what a start took in the process that draws.
    "--enable-angle-features=preferGlobalPipelineCache",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
)
#: Canvases have few pixels: software draws all of them, and most tests look at none.
COARSE = "Object.defineProperty(window, 'devicePixelRatio', { value: 0.05 });"


def missing(reason: str) -> None:
    """Skips the test, or fails it where a browser is required."""
    if os.environ.get(NEEDED):
        pytest.fail(f"{reason} ({NEEDED} is set)")
    pytest.skip(reason)


@pytest.fixture(scope="session")
def chromium() -> Iterator[Any]:
    """The browser; the tests are skipped where none is installed."""
    program = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if program is None:
        missing(f"needs a browser on the path: {', '.join(PROGRAMS)}")
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        missing("needs playwright")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=list(OPTIONS))
        yield browser
        browser.close()
