"""The page's badge against true errors: error estimates of models with default options.

    python benchmarks/badges.py                     # problems of the meshes, and generated ones
    python benchmarks/badges.py --problem bar spot  # some of them

The models are those of `snapspace build` without options, in stable neo-Hookean, calibrated with
the 16 motions that they hold out. Estimates are compared with the true errors of 60 other motions.
A frame is wrong if it is called good and has more than twice the error that counts as good, or if
it is called rough and has less than half of it.
"""

from __future__ import annotations

import argparse
import json
import time
from typing import Any

import common
import numpy as np
import problems
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
    estimate, true = np.array(estimates), checked.error
    tenth, median, ninth = np.quantile(true / estimate, [0.1, 0.5, 0.9])
    wrong = (estimate <= GOOD) & (true > 2 * GOOD) | (estimate > GOOD) & (true < 0.5 * GOOD)
    return {
        "problem": name,
        "error": float(np.median(true)),
        "estimate": float(np.median(estimate)),
        "true / estimate, 10 %": float(tenth),
        "median": float(median),
        "90 %": float(ninth),
        "rank correlation": float(spearmanr(estimate, true)[0]),
        "good": float((estimate <= GOOD).mean()),
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
    parser.add_argument("--unseen", type=int, default=60, help="number of estimated motions")
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    rows = []
    for name in args.problem:
        rows.append(figures(name, args.unseen))
        if args.json:
            print(json.dumps(rows[-1]), flush=True)
    if args.json:
        return
    common.print_rows(rows, title="error estimates of models with default options", width=160)


if __name__ == "__main__":
    main()
