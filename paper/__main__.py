"""Runs the paper's experiments, prints the tables, and writes paper/results/*.json."""

from __future__ import annotations

import argparse
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from itertools import groupby
from multiprocessing import get_context
from pathlib import Path

from .cases import meshes_folder
from .result import FOLDER, PICTURES
from .run import run_program

#: Modules in the order in which they run. Among those that run together, the longest come first.
PROGRAMS = (
    "table1",
    "table2",
    "figures",
    "table3",
    "elephant",
    "figure9",
    "evaluations",
    "curves",
    "limits",
)
#: Those that print no seconds run two at a time: much of their work is on one core.
UNTIMED = ("table2", "figures", "table3", "elephant", "figure9")
AT_ONCE = 2


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
    begin = time.perf_counter()
    faults: list[str] = []
    for together, group in groupby(names, lambda name: name in UNTIMED):
        with ProcessPoolExecutor(AT_ONCE if together else 1, get_context("spawn")) as pool:
            run = partial(
                run_program,
                quick=options.quick,
                results=options.results,
                pictures=options.pictures,
            )
            for found in pool.map(run, group):
                faults += found
    print(f"{time.perf_counter() - begin:.0f} s in all")
    for fault in faults:
        print(f"paper: {fault}", file=sys.stderr)
    return 1 if faults and options.check else 0


if __name__ == "__main__":
    sys.exit(main())
