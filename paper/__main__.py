"""Runs the paper's experiments, prints the tables, and writes paper/results/*.json."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path

from . import table2, table3
from .cases import meshes_folder
from .orderings import errors_in_order, objectives_in_order
from .result import FOLDER, Result

PROGRAMS: dict[str, Callable[..., Result]] = {"table2": table2.run, "table3": table3.run}


#: What is wrong with the rows of a program, in lines.
CHECKS = {"table2": errors_in_order, "table3": objectives_in_order}


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m paper", description=__doc__)
    parser.add_argument("programs", nargs="*", metavar="NAME", help=f"of {', '.join(PROGRAMS)}")
    parser.add_argument("--quick", action="store_true", help="on small generated shapes")
    parser.add_argument("--check", action="store_true", help="fail where an ordering is wrong")
    parser.add_argument("--results", type=Path, default=FOLDER, help="folder of the JSON files")
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
        result = PROGRAMS[name](quick=options.quick)
        result.print()
        print(f"{result.save(options.results)}, {time.perf_counter() - begin:.0f} s")
        faults += CHECKS[name](result.rows)
    for fault in faults:
        print(f"paper: {fault}", file=sys.stderr)
    return 1 if faults and options.check else 0


if __name__ == "__main__":
    sys.exit(main())
