"""The page's engine needs no document, drawing or network, and its renderer only three.js."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

WEB = Path(__file__).parents[2] / "web"
ENGINE, RENDER = WEB / "engine", WEB / "render"
SOURCES = sorted(ENGINE.glob("*.ts"))


def test_there_are_sources() -> None:
    assert len(SOURCES) > 5


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.name)
def test_the_engine_stands_alone(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    for target in re.findall(r'from "([^"]+)"', text):
        assert target.startswith("./"), f"{path.name} imports {target}"
    code = re.sub(r"//[^\n]*|/\*.*?\*/", " ", text, flags=re.S)
    for word in ("document", "window", "fetch", "navigator", "localStorage", "HTMLElement"):
        assert not re.search(rf"\b{word}\b", code), f"{path.name}: {word}"


@pytest.mark.parametrize("path", sorted(RENDER.glob("*.ts")), ids=lambda path: path.name)
def test_the_renderer_knows_nothing_of_models_and_pages(path: Path) -> None:
    for target in re.findall(r'from "([^"]+)"', path.read_text(encoding="utf-8")):
        assert target == "three" or target.startswith("./"), f"{path.name} imports {target}"


def test_nobody_imports_more_of_three_than_its_mathematics_and_controls() -> None:
    """Its renderer and its materials would double the component's size."""
    imported: set[str] = set()
    for folder in ("render", "ui", "viewer"):
        for path in (WEB / folder).glob("*.ts"):
            text = path.read_text(encoding="utf-8")
            for names in re.findall(r'import \{([^}]*)\} from "three";', text):
                imported |= {name.split()[-1] for name in names.split(",") if name.strip()}
    assert not [name for name in imported if re.search("Material|Geometry|Renderer|Light", name)]
    assert "Vector3" in imported
