"""Runs the paper's experiments, prints the tables, and writes paper/results/*.json."""

from __future__ import annotations

import argparse
import importlib
import sys
import time
from pathlib import Path
from typing import Protocol, cast

from snapspace.pictures import save_png

from .cases import meshes_folder
from .orderings import Rows
from .result import FOLDER, PICTURES, Result


class Program(Protocol):
    """A module of this package that is an experiment."""

    def run(self, *, quick: bool = False) -> Result:
        """Its rows, on real meshes or, quick, on small generated shapes."""

    def faults(self, rows: Rows) -> list[str]:
        """Orderings that the rows break, in lines; digits are not judged."""

    def draw(self, rows: Rows, folder: Path) -> None:
        """Writes the charts of the rows, NAME.png or NAME_*.png."""


#: Modules in the order in which they run.
PROGRAMS = (
    "table1",
    "table2",
    "table3",
    "elephant",
    "evaluations",
    "figure9",
    "figures",
    "curves",
    "limits",
)


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m paper", description=__doc__)
    parser.add_argument(
        "programs", nargs="*", metavar="NAME", help=f"one of {', '.join(PROGRAMS)}; all by default"
    )
    parser.add_argument("--quick", action="store_true", help="on small generated shapes")
    parser.add_argument("--check", action="store_true", help="fail where an ordering is wrong")
    parser.add_argument("--results", type=Path, default=FOLDER, help="folder of the JSON files")
    parser.add_argument("--pictures", type=Path, default=PICTURES, help="folder of the pictures")
    options = parser.parse_args()
    names = options.programs or list(PROGRAMS)
    unknown = [name for name in names if name not in PROGRAMS]
    if unknown:
        parser.error(f"unknown program {unknown[0]!r}; known are {', '.join(PROGRAMS)}")
    if not options.quick and meshes_folder() is None:
        print("paper: no meshes in SNAPSPACE_MESHES: generated shapes stand in", file=sys.stderr)
    faults: list[str] = []
    for name in names:
        begin = time.perf_counter()
        program = cast(Program, importlib.import_module(f"paper.{name}"))
        result = program.run(quick=options.quick)
        result.print()
        print(f"{result.save(options.results)}, {time.perf_counter() - begin:.0f} s")
        faults += program.faults(result.rows)
        options.pictures.mkdir(parents=True, exist_ok=True)
        program.draw(result.rows, options.pictures)
        for picture, pixels in result.pictures.items():
            save_png(options.pictures / f"{picture}.png", pixels)
    for fault in faults:
        print(f"paper: {fault}", file=sys.stderr)
    return 1 if faults and options.check else 0


if __name__ == "__main__":
    sys.exit(main())
