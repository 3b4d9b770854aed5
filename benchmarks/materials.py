"""Comparison of materials in one run.

    python benchmarks/materials.py --part cost         # the fast solver, relative to St.VK
    python benchmarks/materials.py --part newton       # Newton's method over the fast solver
    python benchmarks/materials.py --part uniqueness   # tight solutions from several starts
    python benchmarks/materials.py --part live         # frames against tight full solutions

Each part has its own problems unless --problem names some: `choosing`, `judging`, `all`, or names
of benchmarks/problems.py. Ratios are of processor time, which other programs disturb least.
"""

from __future__ import annotations

import argparse
import json
import sys

import material_cost
import material_live
import material_uniqueness
import problems
from rich.console import Console
from rich.table import Table

PARTS = {
    "cost": material_cost.cost,
    "newton": material_cost.newton,
    "uniqueness": material_uniqueness.uniqueness,
    "live": material_live.live,
}
PROBLEMS = {
    "cost": ("dragon",),
    "newton": ("dragon",),
    "uniqueness": ("dragon", "elephant", "armadillo", "creature"),
    "live": problems.NAMES,
}
MATERIALS = {
    "cost": ("stvk", "stable-neo-hookean", "corotational", "arap"),
    "newton": ("stvk", "stable-neo-hookean", "corotational", "arap"),
    "uniqueness": ("stable-neo-hookean", "stvk"),
    "live": ("stable-neo-hookean",),
}
GROUPS = {
    "all": problems.NAMES,
    "choosing": problems.CHOOSING,
    "judging": problems.JUDGING,
}


def named(names: list[str]) -> list[str]:
    """Names of problems, with groups replaced by their members."""
    return [problem for name in names for problem in GROUPS.get(name, (name,))]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--part", choices=PARTS, required=True)
    parser.add_argument("--problem", nargs="+", help="default: those of the part's goals")
    parser.add_argument("--material", nargs="+", help="default: those of the part's goals")
    parser.add_argument(
        "--samples", type=int, help="default: cost and newton 300; live: see material_live.py"
    )
    parser.add_argument("--rounds", type=int, default=5, help="cost: rounds of all materials")
    parser.add_argument("--newton", type=int, default=6, help="newton: samples of Newton's method")
    parser.add_argument("--validate", type=int, help="unseen poses; default: uniqueness 8, live 30")
    parser.add_argument(
        "--tolerance", type=float, default=1e-7, help="live: tolerance of the samples"
    )
    parser.add_argument("--dimension", type=int, help="live: d; default: see material_live.py")
    parser.add_argument("--tets", type=int, default=1000, help="live: tets of the cubature")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true", help="one line per row, once it is known")
    args = parser.parse_args()
    args.material = args.material or MATERIALS[args.part]
    table = None
    for name in named(args.problem or list(PROBLEMS[args.part])):
        for row in PARTS[args.part](name, args):
            if args.json:
                print(json.dumps(row), flush=True)
                continue
            if table is None:
                table = Table(*row, title=f"{args.part}; {material_goals(args.part)}")
            table.add_row(*(text(value) for value in row.values()))
            print(*(text(value) for value in row.values()), sep="  ", file=sys.stderr, flush=True)
    if table is not None:
        Console(width=220).print(table)


def material_goals(part: str) -> str:
    """The goals of a part's figures, in one line."""
    goals: dict[str, str] = {
        "cost": "over stvk: stable-neo-hookean <= 1.05, others <= 1.5; its settled samples <= 1",
        "newton": "newton over fast: stvk >= 200",
        "uniqueness": "distances of stable-neo-hookean <= 1e-3",
        "live": "median and mean <= .005 and .010, Dragon .002 and .003, Elephant .003 and .007; "
        "warm <= 1 ms; hand as measured",
    }
    return goals[part]


def text(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


if __name__ == "__main__":
    main()
