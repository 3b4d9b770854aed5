"""What the page's badge says, against the truth: error estimates of models of default options.

    python benchmarks/badges.py                     # problems of the meshes, and generated ones
    python benchmarks/badges.py --problem bar spot  # some of them

The models are those of `snapspace build` without options, in stable neo-Hookean, calibrated by the
16 motions that they hold out. Estimates are compared with the true errors of 60 other motions.
Wrong are frames that are called good and are twice as far off as that, or called rough and half.
"""

from __future__ import annotations

import argparse
import json
import time
from typing import Any

import common
import numpy as np
import problems
from rich.console import Console
from rich.table import Table
from scipy.stats import spearmanr

import snapspace as ss

KIND = "stable-neo-hookean"
#: Errors up to here are called good, as in web/ui/badge.ts.
GOOD = 0.01


def figures(name: str, unseen: int) -> dict[str, Any]:
    problem = common.with_material(problems.read(name), KIND)
    built = ss.accurate_model(problem)
    judging = built.snapshots.select(built.held_out & built.snapshots.converged)
    begin = time.perf_counter()
    ss.calibrate(built.model, reference=judging, thorough=False)
    seconds = time.perf_counter() - begin
    checked = ss.validate(built.model, samples=unseen, seed=5)
    session, estimates, milliseconds = built.model.session(), [], []
    for w in checked.reference.parameters:
        session.reset()
        session.set_parameters(w)
        certificate = session.certificate(confidence=0.8)
        estimates.append(certificate.relative)
        milliseconds.append(1e3 * certificate.seconds)
    said, true = np.array(estimates), checked.error
    tenth, median, ninth = np.quantile(true / said, [0.1, 0.5, 0.9])
    wrong = (said <= GOOD) & (true > 2 * GOOD) | (said > GOOD) & (true < 0.5 * GOOD)
    return {
        "problem": name,
        "error": float(np.median(true)),
        "estimate": float(np.median(said)),
        "true / estimate, 10 %": float(tenth),
        "median": float(median),
        "90 %": float(ninth),
        "rank correlation": float(spearmanr(said, true)[0]),
        "good": float((said <= GOOD).mean()),
        "wrong": float(wrong.mean()),
        "ms": float(np.median(milliseconds)),
        "calibration s": seconds,
    }


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--problem", nargs="+", default=list(problems.NAMES), metavar="NAME", help=problems.HELP
    )
    parser.add_argument("--unseen", type=int, default=60, help="motions that estimates are for")
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    rows = []
    for name in args.problem:
        rows.append(figures(name, args.unseen))
        if args.json:
            print(json.dumps(rows[-1]), flush=True)
    if args.json:
        return
    table = Table(*rows[0], title="error estimates of models of default options")
    for row in rows:
        table.add_row(*(f"{x:.2g}" if isinstance(x, float) else str(x) for x in row.values()))
    Console(width=160).print(table)


if __name__ == "__main__":
    main()
