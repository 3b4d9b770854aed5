"""The live solve: the exact quartic, a drag, ARAP, vertices, large meshes, coefficients.

    python benchmarks/online.py --part quartic       # against the caches' read rate, and NumPy
    python benchmarks/online.py --part drag          # Newton's method and BFGS during a drag
    python benchmarks/online.py --part arap          # libigl's ARAP on the same mesh and handles
    python benchmarks/online.py --part vertices      # against the memory's read rate
    python benchmarks/online.py --part mesh          # frame time at 25k and at 1M tets
    python benchmarks/online.py --part coefficients  # against the rate of a symmetric product

Times of one run are compared with each other: ratios are general, seconds depend on the machine. A
model file (--model) saves solving snapshots.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from dataclasses import replace
from typing import Any

import common
import numpy as np
from frame_vertices import vertices
from scipy.linalg.blas import dsyrk

import snapspace as ss
from snapspace import _core as core
from snapspace.reduction import coefficient_count, reduced_quartic

Rows = list[tuple[str, Any, str]]


def model_of(args: argparse.Namespace) -> ss.PosingModel:
    """The model file, or a new model of the problem."""
    if args.model:
        model = ss.load(args.model)
        assert isinstance(model, ss.PosingModel)
        return model.leading(min(args.dimension, model.dimension))
    problem = common.read_problem(args.problem)
    samples = ss.sample(problem.domain, args.samples, seed=args.seed)
    snapshots = common.solved(problem, samples)
    subspace = ss.snapshot_pca(snapshots, dimension=args.dimension)
    return ss.reduce(problem, subspace, snapshots=snapshots)


def quartic(args: argparse.Namespace) -> tuple[dict[str, Any], Rows]:
    """Energy, gradient and Hessian of random quartics, against two bounds.

    The bounds are reading the coefficients once, and three multiply-adds per coefficient.
    """
    rng = np.random.default_rng(args.seed)
    peak = core.peak_flops(single=False)
    result: dict[str, Any] = {}
    rows: Rows = []
    for d in (20, 40, 60):
        coefficients, q = rng.normal(size=coefficient_count(d)), rng.normal(size=d)
        x = np.append(1.0, q)
        pairs = np.triu_indices(d + 1)
        gram = rng.normal(size=(len(pairs[0]), len(pairs[0])))

        def dense(x: np.ndarray = x, pairs: Any = pairs, gram: np.ndarray = gram) -> Any:
            """x_i x_j (A x x)_ij with its gradient, by a dense matrix A."""
            outer = x[pairs[0]] * x[pairs[1]]
            product = gram @ outer
            gradient = np.zeros(len(x))
            np.add.at(gradient, pairs[0], product * x[pairs[1]])
            np.add.at(gradient, pairs[1], product * x[pairs[0]])
            return outer @ product, 2.0 * gradient

        numpy_seconds = common.best_of(200 if d < 60 else 30, dense)
        entry: dict[str, Any] = {"numpy_value_and_gradient": numpy_seconds}
        for single in (False, True):
            size = coefficients.size * (4 if single else 8)
            bound = size / core.read_bandwidth(size, repeats=300)
            first, second = core.time_quartic(d, coefficients, q, single=single)
            name = "single" if single else "double"
            adding = 6.0 * coefficients.size / peak
            binding = "multiply-adds" if adding > bound else "reading"
            entry[name] = {
                "bound": bound,
                "multiply_adds": adding,
                "value_and_gradient": first,
                "derivatives": second,
            }
            goal = "<= 30" if d == 40 and not single else ""
            aim = ">= 0.5" if d == 40 and not single else ""
            label = f"d = {d}, {name}"
            rows += [
                (f"{label}: reading {size / 1e6:.2f} MB once, us", 1e6 * bound, ""),
                (f"{label}: value + gradient, us", 1e6 * first, ""),
                (f"{label}: share of the read rate", bound / first, ""),
                (f"{label}: value + gradient + Hessian, us", 1e6 * second, goal),
                (f"{label}: share of the read rate", bound / second, aim),
                (f"{label}: three multiply-adds each, us", 1e6 * adding, ""),
                (f"{label}: share of their rate", adding / second, ""),
                (f"{label}: share of the bound that binds", max(adding, bound) / second, binding),
            ]
        rows.append(
            (f"d = {d}: NumPy, dense matrix, value + gradient, us", 1e6 * numpy_seconds, "")
        )
        ratio = numpy_seconds / entry["double"]["value_and_gradient"]
        rows.append((f"d = {d}: times faster than NumPy", ratio, ""))
        result[str(d)] = entry
    return result, rows


def drag(args: argparse.Namespace) -> tuple[dict[str, Any], Rows]:
    """A drag through the domain, 60 frames from one random motion to the next."""
    model = model_of(args)
    result: dict[str, Any] = {"dimension": model.dimension}
    rows: Rows = []
    for minimizer in ("newton", "bfgs"):
        for precision in ("double", "single"):
            solve, frame = common.drag(
                model, frames=args.frames, seed=7, minimizer=minimizer, precision=precision
            )
            label = f"{minimizer}, {precision}"
            goal = "<= 0.5" if label == "newton, double" else ""
            figures = {
                "solve_median": float(np.median(solve)),
                "solve_p95": float(np.percentile(solve, 95)),
                "frame_median": float(np.median(frame)),
                "frame_p95": float(np.percentile(frame, 95)),
            }
            result[label] = figures
            rows += [
                (f"{label}: solve, ms, median", figures["solve_median"], goal),
                (f"{label}: solve, ms, 95 %", figures["solve_p95"], ""),
                (f"{label}: with vertices, ms, median", figures["frame_median"], ""),
                (f"{label}: with vertices, ms, 95 %", figures["frame_p95"], ""),
            ]
    return result, rows


def arap(args: argparse.Namespace) -> tuple[dict[str, Any], Rows]:
    """As-rigid-as-possible on the tets with the same handles, ten iterations per frame."""
    try:
        import igl
    except ImportError:
        sys.exit("--part arap needs libigl: pip install libigl")
    model = model_of(args)
    problem = model.problem
    vertices, tets = problem.mesh.vertices, problem.mesh.tets.astype(np.int64)
    data = igl.ARAPData()
    data.max_iter = 10
    igl.arap_precomputation(vertices, tets, 3, problem.pinned.astype(np.int32), data)
    ends = ss.sample(problem.domain, 2, seed=7)
    session, shape = model.session(), vertices.copy()
    ours, with_vertices, theirs = [], [], []
    for share in np.linspace(0, 1, args.arap_frames):
        w = share * ends[0]
        begin = time.perf_counter()
        ours.append(session.pose(w).seconds)
        _ = session.vertices
        with_vertices.append(time.perf_counter() - begin)
        pinned = vertices[problem.pinned] + problem.target_displacements(problem.offsets(w))
        begin = time.perf_counter()
        shape = igl.arap_solve(pinned, data, shape)
        theirs.append(time.perf_counter() - begin)
    result = {
        "arap": float(np.median(theirs)),
        "solve": float(np.median(ours)),
        "frame": float(np.median(with_vertices)),
    }
    rows: Rows = [
        ("ARAP of libigl, 10 iterations, ms per frame", 1e3 * result["arap"], ""),
        ("solve, ms", 1e3 * result["solve"], ""),
        ("solve and vertices, ms", 1e3 * result["frame"], ""),
        ("times faster, solve", result["arap"] / result["solve"], ""),
        ("times faster, with vertices", result["arap"] / result["frame"], ""),
    ]
    return result, rows


def mesh(args: argparse.Namespace) -> tuple[dict[str, Any], Rows]:
    """The same reduced problem with a small and a large mesh, frames in turn."""
    problem = common.creature_problem(args.sizes[0])
    samples = ss.sample(problem.domain, 40, seed=args.seed)
    snapshots = common.solved(problem, samples)
    subspace = ss.snapshot_pca(snapshots, dimension=min(args.dimension, 36))
    small = ss.reduce(problem, subspace, snapshots=snapshots)
    large_problem = common.creature_problem(args.sizes[1])
    size = (subspace.dimension, large_problem.tau.size)
    basis = np.random.default_rng(args.seed).normal(size=size).T  # only its size matters
    large = replace(
        small,
        problem=large_problem,
        subspace=ss.AffineSubspace(
            large_problem.tau, basis, large_problem.mass(), subspace.snapshot_energies
        ),
    )
    sessions = [small.session(), large.session()]
    seconds: list[list[float]] = [[], []]
    for w in common.path(problem, frames=args.frames, seed=7):
        for session, times in zip(sessions, seconds, strict=True):
            begin = time.perf_counter()
            session.pose(w)
            times.append(time.perf_counter() - begin)
    medians = [float(np.median(times)) for times in seconds]
    result = {"sizes": [len(m.problem.mesh.tets) for m in (small, large)], "medians": medians}
    rows: Rows = [
        (f"{len(m.problem.mesh.tets)} tets: set and solve, ms, median", 1e3 * t, "")
        for m, t in zip((small, large), medians, strict=True)
    ]
    rows.append(("ratio", medians[1] / medians[0], "0.9 to 1.1"))
    return result, rows


def coefficients(args: argparse.Namespace) -> tuple[dict[str, Any], Rows]:
    """The quartic's coefficients; bound: as a symmetric product at the rate of BLAS."""
    problem = common.read_problem(args.problem)
    rng = np.random.default_rng(args.seed)
    d, n = args.dimension, len(problem.mesh.vertices)
    noise = ss.AffineSubspace(
        problem.tau, rng.normal(size=(d, 3 * n)).T, problem.mass(), np.ones(d)
    )
    problem.energy.value(problem.base)
    seconds = common.best_of(2, lambda: reduced_quartic(problem.energy, noise))
    columns = (d + 1) * (d + 2) // 2
    flops = 6.0 * len(problem.mesh.tets) * columns * (columns + 1)
    panel = rng.normal(size=(columns, 6 * 2048)).T
    syrk = (
        columns * (columns + 1) * len(panel) / common.best_of(5, lambda: dsyrk(1.0, panel, trans=1))
    )
    threads = os.cpu_count() or 1
    peak = threads * core.peak_flops(single=False)
    result = {"seconds": seconds, "rate": flops / seconds, "syrk": syrk, "peak": peak}
    rows: Rows = [
        (f"coefficients at d = {d}, s", seconds, "<= 15"),
        ("GFLOP/s", result["rate"] / 1e9, ""),
        ("BLAS dsyrk of such a panel, GFLOP/s", syrk / 1e9, "all threads"),
        ("share of dsyrk", result["rate"] / syrk, ">= 0.7"),
        ("share of the multiply-adds in registers", result["rate"] / peak, f"{threads} threads"),
    ]
    return result, rows


PARTS = {f.__name__: f for f in (quartic, drag, arap, vertices, mesh, coefficients)}


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--part", choices=PARTS, default="quartic")
    parser.add_argument("--problem", default="dragon")
    parser.add_argument("--model", help="a .snapspace file, for drag and arap")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--dimension", type=int, default=40)
    parser.add_argument("--frames", type=int, default=600)
    parser.add_argument("--arap-frames", type=int, default=20)
    parser.add_argument("--sizes", type=int, nargs=2, default=[25_000, 1_000_000])
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    result, rows = PARTS[args.part](args)
    common.show(args.part, rows, {"part": args.part, **result}, args.json)


if __name__ == "__main__":
    sys.exit(main())
