"""Exported pages."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from snapspace import InterpolationModel, PosingModel
from snapspace.page import export_html

from .many_poses import many_poses_model
from .pages import OpenPage, open_page

__all__ = ["many_poses_model"]  # a fixture


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


@pytest.fixture(scope="session")
def many_poses_page(
    many_poses_model: InterpolationModel, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    return export_html(many_poses_model, tmp_path_factory.mktemp("pages") / "many.html")
