"""The page on which handles are chosen, with the creature: two are, and the tail is painted."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from snapspace.generators import creature
from snapspace.mesh import write_tets


@contextmanager
def creature_served(folder: Path, tets: int) -> Iterator[str]:
    """The address of a page that works on the creature, until the end of the block."""
    path = folder / "Creature.mesh"
    write_tets(path, creature(tets))
    command = [sys.executable, "-m", "snapspace", "view", "--no-browser", str(path)]
    server = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    assert server.stderr is not None
    try:
        yield server.stderr.readline().split()[2]
    finally:
        server.terminate()
        server.communicate()


def stroke(page: Any, *points: tuple[float, float]) -> None:
    """Presses at the first point, goes along the others and lets go."""
    page.mouse.move(*points[0])
    page.mouse.down()
    for point in points[1:]:
        page.mouse.move(*point, steps=6)
    page.mouse.up()


def name_handle(page: Any, name: str) -> None:
    """The selection becomes a handle."""
    page.keyboard.press("Enter")
    page.keyboard.type(name)
    page.keyboard.press("Enter")


def choosing(page: Any) -> None:
    """Feet by a box, the head by a lasso; the brush is over the tail."""
    page.keyboard.press("x")
    stroke(page, (360, 505), (660, 640))
    name_handle(page, "feet")
    page.keyboard.press("l")
    stroke(page, (570, 110), (760, 110), (780, 372), (610, 380), (570, 320), (490, 260), (490, 180))
    name_handle(page, "head")
    page.keyboard.press("b")
    stroke(page, (334, 250), (322, 285), (322, 310))
