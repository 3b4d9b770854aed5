"""The built package, a site that uses it, and tabs."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from snapspace import ARAP, InterpolationModel, PosingModel, export_packed

from ..browser import COARSE, missing
from ..shells.strips import blended_strips, shell_model
from .site import PAGE, SCRIPT, Viewer, site

TOOLS = Path(__file__).parents[2] / "tools"

#: The head rises and turns within a fifth of a second.
KEYS = {
    "format": "snapspace-timeline",
    "version": 1,
    "kind": "posing",
    "loop": False,
    "keys": [
        {"time": 0.0, "handles": {}},
        {"time": 0.2, "handles": {"head": {"degrees": [0, 0, 15], "translation": [0, 0, 0.2]}}},
    ],
}


@pytest.fixture(scope="session")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The npm package's folder."""
    folder = tmp_path_factory.mktemp("viewer") / "package"
    script = (
        f"import sys; sys.path.insert(0, {str(TOOLS)!r})\n"
        "import build_viewer, node, pathlib\n"
        "sys.exit(2) if node.npm() is None else None\n"
        f"build_viewer.build(pathlib.Path({str(folder)!r}))"
    )
    built = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    if built.returncode == 2:
        missing("needs Node.js with npm")
    assert built.returncode == 0, built.stdout + built.stderr
    return folder


@pytest.fixture(scope="session")
def posed_surface() -> PosingModel:
    """An as-rigid-as-possible strip."""
    return shell_model(ARAP())


@pytest.fixture(scope="session")
def blended_surfaces() -> InterpolationModel:
    """Three shapes of a strip, whose blends are as rigid as possible."""
    return blended_strips()


@pytest.fixture(scope="session")
def folder(
    package: Path,
    posing_model: PosingModel,
    blending_model: InterpolationModel,
    posed_surface: PosingModel,
    blended_surfaces: InterpolationModel,
    tmp_path_factory: pytest.TempPathFactory,
) -> Path:
    """The site: the package, models, and pages."""
    folder = tmp_path_factory.mktemp("site")
    shutil.copytree(package, folder, dirs_exist_ok=True)
    export_packed(posing_model, folder / "posing.snapspace")
    export_packed(blending_model, folder / "blending.snapspace")
    posed_surface.save(folder / "posed-surface.snapspace")
    export_packed(blended_surfaces, folder / "blended-surfaces.snapspace")
    filmed = replace(posing_model, provenance={**posing_model.provenance, "timeline": KEYS})
    export_packed(filmed, folder / "film.snapspace")
    for name in ("posing", "blending", "film", "posed-surface", "blended-surfaces"):
        bodies = {
            name: f'<snapspace-viewer src="{name}.snapspace"></snapspace-viewer>',
            f"{name}-controls": f'<snapspace-viewer src="{name}.snapspace" controls>'
            "</snapspace-viewer>",
        }
        for page, body in bodies.items():
            text = PAGE.format(head=SCRIPT, body=body)
            (folder / f"{page}.html").write_text(text, encoding="utf-8")
    return folder


@pytest.fixture(scope="session")
def address(folder: Path) -> Iterator[str]:
    with site(folder) as address:
        yield address


@pytest.fixture(scope="session")
def tab(chromium: Any) -> Any:
    """Used by one test after the other: a new tab costs more than a page in it."""
    tab = chromium.new_page(
        viewport={"width": 480, "height": 360}, device_scale_factor=0.5, reduced_motion="reduce"
    )
    tab.add_init_script(COARSE)
    return tab


@pytest.fixture
def viewer(tab: Any) -> Iterator[Viewer]:
    """The pages of a tab; at the end they must have met no faults."""
    viewer = Viewer(tab)
    yield viewer
    viewer.close()
    assert viewer.faults == []


@pytest.fixture
def opened(viewer: Viewer, address: str) -> Callable[[str], Viewer]:
    """opened("posing.html") waits for the model of a page of the site."""

    def open_it(page: str) -> Viewer:
        viewer.open(f"{address}/{page}")
        return viewer

    return open_it
