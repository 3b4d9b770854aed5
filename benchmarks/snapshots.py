"""The snapshot engine: speed, hardware limits, growth with the mesh, all problems, other handles.

    python benchmarks/snapshots.py --part speed      # against Newton's method, and the subspace
    python benchmarks/snapshots.py --part limits     # loops against the limits of the processor
    python benchmarks/snapshots.py --part growth     # cost of a sample, 25k to 1M tets
    python benchmarks/snapshots.py --part problems   # every problem of the meshes' folder
    python benchmarks/snapshots.py --part handles    # other handles for a body that has a model

Times of one run are compared with each other: ratios are general, seconds depend on the machine.
"""

from __future__ import annotations

import argparse
import sys
import time
from typing import Any

import common
import handle_changes
import numpy as np

import snapspace as ss
from snapspace import _core as core
from snapspace.cli.memory import peak_memory_bytes
from snapspace.validation import solved_reference, unseen_errors

Rows = list[tuple[str, Any, str]]


def speed(args: argparse.Namespace) -> tuple[dict[str, Any], Rows]:
    """All samples by the fast solver, some by Newton's method, and the two subspaces.

    The solvers take turns in rounds, since the speed of the machine varies.
    """
    fast, fast_seconds, newton_seconds = fast_and_newton(args)
    newton_samples = args.newton * args.rounds
    fast_mean, newton_each = float(np.mean(fast_seconds)), sum(newton_seconds) / newton_samples
    ratio = newton_each / (fast_mean / len(fast))
    result = {
        "samples": len(fast),
        "fast_seconds": fast_seconds,
        "fast_iterations": float(np.mean([r.iterations for r in fast.reports])),
        "fast_evaluations": float(np.mean([r.evaluations for r in fast.reports])),
        "fast_converged": int(fast.converged.sum()),
        "newton_samples": newton_samples,
        "newton_seconds_each": newton_each,
        "ratio": ratio,
    }
    rows: Rows = [
        ("samples, all", len(fast), ""),
        ("fast, s including set-up: mean", fast_mean, "<= 30, then 15"),
        ("fast, s including set-up: longest", max(fast_seconds), ""),
        ("fast, evaluations each", result["fast_evaluations"], ""),
        ("converged", f"{result['fast_converged']} of {len(fast)}", "all"),
        ("newton, s each", newton_each, f"{newton_samples} samples"),
        ("newton / fast, per sample", ratio, ">= 200"),
    ]
    if args.tight:
        problem, samples = fast.problem, fast.parameters
        reference = common.references(problem, 30)
        tight = common.solved(problem, samples, tolerance=1e-7, max_iterations=5000)
        for name, snapshots in (("fast", fast), ("tight", tight)):
            errors = common.projection_errors(ss.snapshot_pca(snapshots, dimension=40), reference)
            mean, median = float(errors.mean()), float(np.median(errors))
            result[f"{name}_projection_error"] = {"mean": mean, "median": median}
            goal = "" if name == "tight" else "within 5 % of tight"
            rows.append((f"projection error, {name}: mean", mean, goal))
            rows.append((f"projection error, {name}: median", median, goal))
    return result, rows


def fast_and_newton(args: argparse.Namespace) -> tuple[ss.Snapshots, list[float], list[float]]:
    """The fast solver's samples, and the seconds of each round of both solvers.

    Every round of the fast solver starts without any results. Newton's method continues in each
    round with the next samples.
    """
    fast_seconds, newton_seconds = [], []
    newton: ss.Snapshots | None = None
    for round_ in range(args.rounds):
        problem = common.read_problem(args.problem)
        samples = ss.sample(problem.domain, args.samples, seed=args.seed)
        begin = time.perf_counter()
        fast = common.solved(problem, samples)
        fast_seconds.append(time.perf_counter() - begin)
        begin = time.perf_counter()
        some = samples[round_ * args.newton : (round_ + 1) * args.newton]
        few = common.solved(problem, some, known=newton, solver="newton")
        newton_seconds.append(time.perf_counter() - begin)
        newton = few if newton is None else newton.joined(few)
    return fast, fast_seconds, newton_seconds


def limits(args: argparse.Namespace) -> tuple[dict[str, Any], Rows]:
    """The element kernel and the solves against the peak of a core."""
    problem = common.read_problem(args.problem)
    u = 0.01 * np.random.default_rng(args.seed).standard_normal(problem.base.size)
    result: dict[str, Any] = {
        "read_bytes_per_second": core.read_bandwidth(1 << 28),
        "inverse": problem.system.inverse.name,
        "inverse_products": problem.system.inverse_products,
    }
    rows: Rows = [("reads from memory, GB/s", result["read_bytes_per_second"] / 1e9, "")]
    solves = "triangular solves" if problem.system.inverse.name == "factor" else "multigrid cycle"
    for single in (True, False):
        name = "single" if single else "double"
        peak = core.peak_flops(single=single)
        # the preconditioner is always in single precision
        solve_peak = core.peak_flops(single=True)
        parts = core.time_parts(problem.system, u, single=single)
        kernel = parts.kernel_flops / parts.kernel_seconds
        solve = parts.solve_flops / parts.solve_seconds
        result[name] = {
            "peak": peak,
            "kernel_seconds": parts.kernel_seconds,
            "kernel_share": kernel / peak,
            "solve_seconds": parts.solve_seconds,
            "solve_share": solve / solve_peak,
        }
        rows += [
            (f"{name}: multiply-adds in registers, GFLOP/s", peak / 1e9, ""),
            (f"{name}: element kernel, ms per pack", 1e3 * parts.kernel_seconds, ""),
            (f"{name}: element kernel, GFLOP/s", kernel / 1e9, ""),
            (f"{name}: element kernel, share of peak", kernel / peak, ">= 0.5"),
            (f"{name}: {solves}, ms per pack", 1e3 * parts.solve_seconds, ""),
            (f"{name}: {solves}, GFLOP/s", solve / 1e9, ""),
            (f"{name}: {solves}, share of peak", solve / solve_peak, ">= 0.5"),
        ]
    return result, rows


def growth(args: argparse.Namespace) -> tuple[dict[str, Any], Rows]:
    """Seconds per sample for creatures of several sizes, and the fitted exponent."""
    sizes, seconds, entries = [], [], []
    rows: Rows = []
    for tets in args.sizes:
        problem = common.creature_problem(tets)
        begin = time.perf_counter()
        inverse, products = problem.system.inverse.name, problem.system.inverse_products
        inverse_seconds = time.perf_counter() - begin
        samples = ss.sample(problem.domain, args.samples, seed=args.seed)
        begin = time.perf_counter()
        snapshots = common.solved(problem, samples)
        spent = time.perf_counter() - begin
        evaluations = float(np.mean([r.evaluations for r in snapshots.reports]))
        sizes.append(len(problem.mesh.tets))
        seconds.append(spent / len(samples))
        memory = peak_memory_bytes() or 0
        entries.append(
            {
                "vertices": len(problem.mesh.vertices),
                "tets": sizes[-1],
                "inverse": inverse,
                "inverse_products": products,
                "inverse_seconds": inverse_seconds,
                "seconds_each": seconds[-1],
                "evaluations": evaluations,
                "converged": int(snapshots.converged.sum()),
                "peak_memory_bytes": memory,
            }
        )
        rows.append(
            (f"{sizes[-1]} tets: {inverse}, s", inverse_seconds, f"{products / 1e6:.1f}M products")
        )
        rows.append(
            (f"{sizes[-1]} tets: s per sample", seconds[-1], f"{evaluations:.0f} evaluations")
        )
        rows.append((f"{sizes[-1]} tets: peak memory so far, GiB", memory / 2**30, "< 16"))
    exponent = float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0])
    rows.append(("exponent of the cost of a sample", exponent, "<= 1.15"))
    return {"sizes": entries, "exponent": exponent, "samples": args.samples}, rows


def problems(args: argparse.Namespace) -> tuple[dict[str, Any], Rows]:
    """Converged samples, iterations and inverted tets of all problems."""
    folder = common.meshes_folder() / "problems"
    result: dict[str, Any] = {}
    rows: Rows = []
    for path in sorted(folder.glob("*.json")):
        problem = common.read_problem(path.stem)
        samples = ss.sample(problem.domain, args.samples, seed=args.seed)
        begin = time.perf_counter()
        snapshots = common.solved(problem, samples)
        seconds = time.perf_counter() - begin
        iterations = [r.iterations for r in snapshots.reports]
        inverted = [r.inverted_tets for r in snapshots.reports]
        result[path.stem] = {
            "vertices": len(problem.mesh.vertices),
            "tets": len(problem.mesh.tets),
            "parameters": problem.parameter_count,
            "samples": len(snapshots),
            "converged": int(snapshots.converged.sum()),
            "seconds": seconds,
            "iterations_mean": float(np.mean(iterations)),
            "iterations_max": max(iterations),
            "inverted_mean": float(np.mean(inverted)),
            "inverted_max": max(inverted),
        }
        figures = (
            f"{seconds:.1f} s, {np.mean(iterations):.0f} / {max(iterations)} iterations, "
            f"{np.mean(inverted):.0f} / {max(inverted)} inverted of {len(problem.mesh.tets)}"
        )
        done = f"{snapshots.converged.sum()} of {len(snapshots)} converged"
        rows.append((path.stem, figures, done))
    return result, rows


def handles(args: argparse.Namespace) -> tuple[dict[str, Any], Rows]:
    """Other handles for a body that has a model: starting over against starting from that model.

    The material is stable neo-Hookean, options are defaults. Errors are those of 30 unseen motions.
    """
    result: dict[str, Any] = {}
    rows: Rows = []
    for name, make in handle_changes.CHANGES.items():
        old = make()[0]
        before = ss.accurate_model(old, seed=args.seed).model
        assert isinstance(before, ss.PosingModel)
        begin = time.perf_counter()
        fresh = make()[1]  # with nothing computed yet
        over = ss.accurate_model(fresh, seed=args.seed)
        seconds = time.perf_counter() - begin
        models = {"starting over": (over.model, seconds)}
        for growth in ss.growing_models(make()[1], seed=args.seed, start=before):
            how = "impression" if growth.impression else "from the old model"
            models[how] = growth.model, growth.seconds
            if not growth.impression:
                break
        reference = solved_reference(fresh, samples=30)
        result[name] = {"parameters": fresh.parameter_count}
        for how, (model, taken) in models.items():
            errors = unseen_errors(model, reference)
            median, mean = float(np.median(errors)), float(errors.mean())
            result[name][how] = {
                "seconds": taken,
                "d": model.dimension,
                "median": median,
                "mean": mean,
                "times_faster": seconds / taken,
            }
            figures = f"{taken:.1f} s, d = {model.dimension}, {median:.4f} / {mean:.4f}"
            rows.append((f"{name}, {how}: median / mean", figures, ""))
            if how != "starting over":
                rows.append((f"{name}, {how}: times faster", seconds / taken, ">= 5"))
    return result, rows


PARTS = {f.__name__: f for f in (speed, limits, growth, problems, handles)}


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--part", choices=PARTS, default="speed")
    parser.add_argument("--problem", default="dragon")
    parser.add_argument("--samples", type=int, help="default: 300; growth 100; problems 64")
    parser.add_argument("--rounds", type=int, default=3, help="speed: rounds of both solvers")
    parser.add_argument("--newton", type=int, default=4, help="Newton's samples per round")
    parser.add_argument("--tight", action="store_true", help="speed: also compare the subspaces")
    parser.add_argument(
        "--sizes", type=int, nargs="+", default=[25_000, 75_000, 250_000, 1_000_000]
    )
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    if args.samples is None:
        args.samples = {"growth": 100, "problems": 64}.get(args.part, 300)
    result, rows = PARTS[args.part](args)
    title = f"{args.part}: {args.problem}" if args.part in ("speed", "limits") else args.part
    common.show(title, rows, {"part": args.part, **result}, args.json)


if __name__ == "__main__":
    sys.exit(main())
