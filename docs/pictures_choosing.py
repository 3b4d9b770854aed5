"""The page on which handles are chosen, with the creature."""

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


#: Selects the ear and the horn on one side.
ONE_SIDE = """(() => {
  const { choosing } = snapspace;
  const { shape } = choosing.mesh;
  const vertices = Int32Array.from({ length: shape.length / 3 }, (_, vertex) => vertex);
  const selected = vertices.filter((v) => shape[3 * v + 1] < -0.25 && shape[3 * v + 2] > 1.9);
  choosing.go({ ...choosing.choice, selected });
})()"""


def mirroring(page: Any) -> None:
    """The feet, an ear and its mirror image, with the plane between them."""
    page.keyboard.press("x")
    stroke(page, (360, 505), (660, 640))
    name_handle(page, "feet")
    page.evaluate(ONE_SIDE)
    name_handle(page, "right ear")
    page.keyboard.press("m")
    page.get_by_text("is the mirror image of").wait_for()


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
