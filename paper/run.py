"""run_program: runs one experiment, in a process of its own."""

from __future__ import annotations

import importlib
import time
from pathlib import Path
from typing import Protocol, cast

from snapspace.pictures import save_png

from .orderings import Rows
from .result import Result


class Program(Protocol):
    """A module of this package that is an experiment."""

    def run(self, *, quick: bool = False) -> Result:
        """Its rows, on real meshes or, quick, on small generated shapes."""

    def faults(self, rows: Rows) -> list[str]:
        """Orderings that the rows break, in lines; digits are not judged."""

    def draw(self, rows: Rows, folder: Path) -> None:
        """Writes the charts of the rows, NAME.png or NAME_*.png."""


def run_program(name: str, *, quick: bool, results: Path, pictures: Path) -> list[str]:
    """Runs a program, prints and writes what it found, and returns its faults."""
    begin = time.perf_counter()
    program = cast(Program, importlib.import_module(f"paper.{name}"))
    result = program.run(quick=quick)
    result.print()
    path = result.save(results)
    pictures.mkdir(parents=True, exist_ok=True)
    program.draw(result.rows, pictures)
    for picture, pixels in result.pictures.items():
        save_png(pictures / f"{picture}.png", pixels)
    print(f"{path}, {time.perf_counter() - begin:.0f} s", flush=True)
    return program.faults(result.rows)
