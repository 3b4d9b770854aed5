"""Accuracy and build time of models with default options.

    python benchmarks/accuracy.py                     # problems of the meshes, and generated ones
    python benchmarks/accuracy.py --problem bar spot  # some of them

The models are those of `snapspace build` without options, in stable neo-Hookean. Errors are those
of 30 unseen motions against tight full solutions, relative to the displacement. "Warm" is a frame
of a drag, a "jump" is a frame from rest to one of these motions; both are the solve alone, and all
vertices are read between frames. The first model is the one that `growing_models` and the page show
in the meantime; its errors are measured at the motions that validate the last model. Defaults were
chosen on one half of the problems, and are judged on the other.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Iterator
from typing import Any

import common
import numpy as np
import problems
from rich.console import Console
from rich.table import Table

import snapspace as ss
from snapspace.validation import unseen_errors

KIND = "stable-neo-hookean"
#: Problems with more parameters are listed but do not count.
MOST_PARAMETERS = 12


def figures(name: str, args: argparse.Namespace) -> dict[str, Any]:
    body = common.with_material(problems.read(name), KIND)
    begin = time.perf_counter()
    built = ss.accurate_model(
        body, target_error=args.target_error, tell=lambda line: print(name, line, file=sys.stderr)
    )
    seconds = time.perf_counter() - begin
    fresh = common.with_material(problems.read(name), KIND)  # with nothing computed yet
    first = next(ss.growing_models(fresh))
    first_errors = unseen_errors(first.model, built.snapshots.select(built.held_out))
    found = ss.validate(built.model, samples=args.validate)
    assert isinstance(built.model, ss.PosingModel)
    warm, _ = common.drag(built.model, frames=300, seed=1)
    return {
        "problem": name,
        "half": "choosing" if name in problems.CHOOSING else "judging",
        "parameters": body.parameter_count,
        "samples": len(built.snapshots),
        "d": built.model.dimension,
        "median": float(np.median(found.error)),
        "mean": float(found.error.mean()),
        "90 %": float(np.quantile(found.error, 0.9)),
        "said": built.step.error,
        "projection": float(np.median(found.projection_error)),
        "warm ms": float(np.median(warm)),
        "jump ms": common.solutions(built.model, found.reference)[1],
        "first s": first.seconds,
        "first median": float(np.median(first_errors)),
        "s": seconds,
    }


def summary(rows: list[dict[str, Any]]) -> Iterator[str]:
    """Summaries over the problems with few parameters: each half, and all of them."""
    counted = [row for row in rows if row["parameters"] <= MOST_PARAMETERS]
    for half in ("choosing", "judging", None):
        some = [row for row in counted if half in (None, row["half"])]
        if not some:
            continue
        medians, means = ([row[key] for row in some] for key in ("median", "mean"))
        yield (
            f"{half or 'all'}, {len(some)} problems: median of medians {np.median(medians):.4f}, "
            f"of means {np.median(means):.4f}; worst {max(medians):.4f}, {max(means):.4f}"
        )


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--problem", nargs="+", default=list(problems.NAMES), metavar="NAME", help=problems.HELP
    )
    parser.add_argument("--target-error", type=float, help="as for `snapspace build`")
    parser.add_argument("--validate", type=int, default=30, help="number of unseen motions")
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    rows = []
    for name in args.problem:
        rows.append(figures(name, args))
        if args.json:
            print(json.dumps(rows[-1]), flush=True)
    if args.json:
        return
    table = Table(*rows[0], title="models with default options")
    for row in rows:
        table.add_row(*(f"{x:.3g}" if isinstance(x, float) else str(x) for x in row.values()))
    Console().print(table)
    for line in summary(rows):
        print(line)


if __name__ == "__main__":
    main()
