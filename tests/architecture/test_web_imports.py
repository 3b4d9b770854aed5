"""The page's engine does not depend on documents, drawing or the network."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ENGINE = Path(__file__).parents[2] / "web" / "engine"
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
