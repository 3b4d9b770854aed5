"""Cost of solving samples, by material: parts `cost` and `newton` of materials.py."""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator
from typing import Any

import common
import numpy as np
import problems

import snapspace as ss
from snapspace import _core as core

#: Iterations and samples of a timed call; the samples fill several packs of 16.
ITERATIONS, BATCH = 20, 32
#: A tolerance that is never reached in so few iterations.
NEVER = 1e-30


def cost(name: str, args: argparse.Namespace) -> Iterator[dict[str, Any]]:
    """Milliseconds per evaluation, and seconds of settled samples, both relative to St.VK.

    An evaluation is one of the whole fast solver for one sample: single precision, soft modes, a
    fixed number of iterations. The materials take turns; results are medians over the rounds.
    """
    bodies = {kind: common.with_material(problems.read(name), kind) for kind in _with_stvk(args)}
    samples = ss.sample(bodies["stvk"].domain, args.samples or 300, method="sobol", seed=args.seed)
    for body in bodies.values():
        body.solving.soft_modes()  # made before timing
    starts = {kind: body.guesses(samples[:BATCH]) for kind, body in bodies.items()}
    each: dict[str, list[float]] = {kind: [] for kind in bodies}
    settled: dict[str, list[float]] = {kind: [] for kind in bodies}
    evaluations: dict[str, float] = {}
    for round_ in range(args.rounds):
        for kind, body in bodies.items():
            each[kind].append(_evaluation(body, samples[:BATCH], starts[kind]))
            if round_ < 3:
                seconds, solved = cpu_seconds(
                    lambda body=body: common.solved(body, samples, settling=1e-2)
                )
                settled[kind].append(seconds)
                evaluations[kind] = float(np.mean([r.evaluations for r in solved.reports]))
    for kind in bodies:
        yield {
            "problem": name,
            "material": kind,
            "evaluation, CPU ms": 1e3 * float(np.median(each[kind])),
            "over stvk": ratio(each[kind], each["stvk"]),
            f"{len(samples)} settled, CPU s": float(np.median(settled[kind])),
            "settled, over stvk": ratio(settled[kind], settled["stvk"]),
            "evaluations a sample": evaluations[kind],
        }


def newton(name: str, args: argparse.Namespace) -> Iterator[dict[str, Any]]:
    """Seconds per sample of Newton's method over those of the fast solver.

    The fast solver solves all samples, as in a build, and Newton's method the first few of them.
    All stop at the default criterion of the problem's snapshots.
    """
    kinds = [(kind, None) for kind in _with_stvk(args)]
    kinds += [(kind, "absolute") for kind in args.material if kind != "stvk"]
    fast: dict[str, float] = {}
    for kind, projection in kinds:
        body = common.with_material(problems.read(name), kind)
        # random: the first points of a Sobol sequence are mild, and Newton's method solves few
        samples = ss.sample(body.domain, args.samples or 300, seed=args.seed)
        if kind not in fast:
            seconds, _ = cpu_seconds(lambda body=body, w=samples: common.solved(body, w))
            fast[kind] = seconds / len(samples)
        few = samples[: args.newton]
        options = {"solver": "newton", "projection": projection}
        seconds, solved = cpu_seconds(lambda b=body, w=few, o=options: common.solved(b, w, **o))
        yield {
            "problem": name,
            "material": kind,
            "projection": projection or body.solving.projection,
            "fast, CPU s a sample": fast[kind],
            "newton, CPU s a sample": seconds / len(few),
            "newton over fast": seconds / len(few) / fast[kind],
            "newton, iterations": float(np.mean([r.iterations for r in solved.reports])),
            "newton, converged": f"{solved.converged.sum()} of {len(few)}",
        }


def ratio(values: list[float], others: list[float]) -> float:
    """The median of the rounds' ratios, since the machine's speed varies between rounds."""
    return float(np.median(np.divide(values, others)))


def cpu_seconds(work: Callable[[], ss.Snapshots]) -> tuple[float, ss.Snapshots]:
    """Processor time of all threads, and the result."""
    begin = time.process_time()
    result = work()
    return time.process_time() - begin, result


def _evaluation(body: ss.PosingProblem, samples: np.ndarray, starts: np.ndarray) -> float:
    """Processor seconds of one evaluation of one sample."""
    begin = time.process_time()
    batch = body.system.solve_fast(
        body.inputs(samples),
        starts,
        tolerance=NEVER,
        max_iterations=ITERATIONS,
        threads=0,
        control=core.SolveControl(),
        single=True,
        modes=body.solving.soft_modes(),
    )
    spent = time.process_time() - begin
    return spent / sum(report.evaluations for report in batch.reports)


def _with_stvk(args: argparse.Namespace) -> list[str]:
    return ["stvk", *(kind for kind in args.material if kind != "stvk")]
