"""Certificates and polish: how well estimates follow true errors, and what iterations remove.

    python benchmarks/certificate.py --part estimates --problem dragon   # rank correlations, bounds
    python benchmarks/certificate.py --part polish --problem dragon      # error left, milliseconds
    python benchmarks/certificate.py --part estimates --problem helix --samples 30 --dimension 10

Errors are true errors at unseen parameters, against tight solutions. `--problem helix` blends the
cylinder and the helix of the meshes' folder. Times of one run are compared with each other.
"""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import replace
from typing import Any

import common
import numpy as np
from scipy.stats import spearmanr

import snapspace as ss
from snapspace import _core as core
from snapspace.greedy import estimated_errors
from snapspace.mesh import mass_norm, mass_norms
from snapspace.validation import unseen_parameters

Rows = list[tuple[str, Any, str]]
Model = ss.PosingModel | ss.InterpolationModel
LEFT_AFTER = (1, 5, 10, 30)


def read_problem(name: str) -> ss.PosingProblem | ss.InterpolationProblem:
    """A problem of the meshes' folder, a creature, or the interpolation problem "helix"."""
    if name != "helix":
        return common.read_problem(name)
    folder = common.meshes_folder() / "poses" / "synthetic_helix"
    return ss.InterpolationProblem(
        [ss.read_tets(folder / f"{pose}.mesh") for pose in ("cylinder", "helix")]
    )


def built(args: argparse.Namespace) -> tuple[Model, ss.Snapshots]:
    """A model, and tight solutions that it has not seen."""
    problem = read_problem(args.problem)
    samples = ss.sample(problem.domain, args.samples, seed=args.seed)
    snapshots = ss.solve_snapshots(problem, samples, progress=common.progress)
    subspace = ss.snapshot_pca(snapshots, dimension=args.dimension)
    model = ss.reduce(problem, subspace, snapshots=snapshots)
    tolerance = min(1e-9, 0.01 * problem.solving.tolerance)
    tight = ss.SolverOptions(tolerance=tolerance, max_iterations=5000)
    unseen = unseen_parameters(problem.domain, args.unseen, seed=1)
    reference = ss.solve_snapshots(problem, unseen, options=tight, progress=common.progress)
    return model, reference.select(reference.converged)


def miss(model: Model, shape: np.ndarray, full: np.ndarray) -> float:
    """Root mean square distance of a shape (3n,) from a full solution."""
    moved = model.problem.aligned(shape, full)
    return mass_norm(model.subspace.mass, moved - full) / float(np.sqrt(model.subspace.mass.sum()))


def frames(model: Model, reference: ss.Snapshots) -> Any:
    """Sessions at the unseen parameters, each from tau, with the full solutions."""
    session = model.session()
    for w, row in zip(reference.parameters, reference.displacements, strict=True):
        session.reset()
        session.set_parameters(w)
        yield session, w, model.problem.base + row


def estimates(args: argparse.Namespace) -> tuple[dict[str, Any], Rows]:
    """Both certificates and other indicators against true errors."""
    model, reference = built(args)
    begin = time.perf_counter()
    model = ss.calibrate(model, samples=args.calibration, seed=args.seed)
    seconds = time.perf_counter() - begin
    found: dict[str, list[Any]] = {"quick": [], "thorough": []}
    truth, relative, others = [], [], []
    for session, w, full in frames(model, reference):
        shape = model.subspace.shape(session.q)
        truth.append(miss(model, shape, full))
        relative.append(truth[-1] / miss(model, model.subspace.tau, full))
        for name, certificates in found.items():
            certificates.append(session.certificate(thorough=name == "thorough"))
        others.append(other_indicators(model, session, w))
    errors, relative_errors = np.array(truth), np.array(relative)
    result: dict[str, Any] = {
        "calibration_seconds": seconds,
        "error_median": float(np.median(relative_errors)),
        "error_mean": float(relative_errors.mean()),
    }
    rows: Rows = [
        ("unseen samples", len(errors), ""),
        ("true relative error, median", result["error_median"], ""),
        ("calibration, s", seconds, f"{args.calibration} samples"),
    ]
    for name, certificates in found.items():
        result[name] = judged(certificates, errors, relative_errors)
        goals = {"covered": "about 0.9", "ms": "<= 1" if name == "quick" else ""}
        rows += [(f"{name}: {k}", v, goals.get(k, "")) for k, v in result[name].items()]
    result["others"] = {}
    five = mass_norms(model.subspace.mass, estimated_errors(model, reference.parameters))
    sizes = np.array([s for s, *_ in others])
    table = np.column_stack([np.array([rest for _, *rest in others]), five / sizes])
    labels = ("residual by A^-1", "first step, M-norm", "distance to nearest sample", "five steps")
    for label, values in zip(labels, table.T, strict=True):
        rho = float(spearmanr(values, relative_errors)[0])
        result["others"][label] = rho
        rows.append((f"rank correlation: {label}", rho, ""))
    return result, rows


def judged(
    certificates: list[ss.Certificate], errors: np.ndarray, relative_errors: np.ndarray
) -> dict[str, float]:
    """Comparison of certificates with true errors."""
    distance = np.array([c.distance for c in certificates])
    upper = np.array([c.upper_distance for c in certificates])
    relative = [c.relative for c in certificates]
    low, middle, high = np.quantile(errors / distance, [0.1, 0.5, 0.9])
    return {
        "rank correlation, distance": float(spearmanr(distance, errors)[0]),
        "rank correlation, relative": float(spearmanr(relative, relative_errors)[0]),
        "true / estimate, 10 %": float(low),
        "true / estimate, median": float(middle),
        "true / estimate, 90 %": float(high),
        "covered": float(np.mean(errors <= upper)),
        "upper / estimate": float(np.median(upper / distance)),
        "ms": 1e3 * float(np.median([c.seconds for c in certificates])),
        "first, ms": 1e3 * certificates[0].seconds,
    }


def other_indicators(model: Model, session: Any, w: np.ndarray) -> tuple[float, ...]:
    """Size of the displacement, and indicators from the whole mesh, relative to that size."""
    problem, subspace = model.problem, model.subspace
    size = float(np.linalg.norm(session.q))
    u = subspace.shape(session.q) - problem.base
    _, gradient = problem.system.value_and_gradient(u, problem.inputs(w[None])[0])
    step = problem.system.precondition(gradient)
    known, here = (problem.domain.scaled(p) for p in (model.training_parameters, w[None]))
    nearest = float(np.linalg.norm(known - here, axis=1).min())
    decrement = float(np.sqrt(max(gradient @ step, 0.0)))
    return size, decrement / size, mass_norm(subspace.mass, step) / size, nearest


def polish(args: argparse.Namespace) -> tuple[dict[str, Any], Rows]:
    """Error left after iterations with a seed of two levels and of one, and their cost."""
    model, reference = built(args)
    left: dict[str, list[list[float]]] = {"two levels": [], "one level": []}
    milliseconds = []
    for session, w, full in frames(model, reference):
        shape = model.subspace.shape(session.q)
        before = miss(model, shape, full)
        results = [session.polish(iterations=k, tolerance=1e-300) for k in LEFT_AFTER]
        longest = results[-1]
        milliseconds.append(1e3 * longest.seconds / longest.report.evaluations)
        left["two levels"].append(
            [miss(model, r.vertices.reshape(-1), full) / before for r in results]
        )
        left["one level"].append(
            [miss(model, one_level(model, shape, w, k), full) / before for k in LEFT_AFTER]
        )
    # as loaded from a file, with nothing computed yet
    loaded = replace(model, problem=read_problem(args.problem)).session()
    loaded.set_parameters(reference.parameters[0])
    result: dict[str, Any] = {
        "ms_per_evaluation": float(np.median(milliseconds)),
        "first_ms": 1e3 * loaded.polish(iterations=10).seconds,
        "ten_ms": 1e3 * loaded.polish(iterations=10).seconds,
    }
    rows: Rows = [
        ("unseen samples", len(milliseconds), ""),
        ("ms per evaluation", result["ms_per_evaluation"], "one thread"),
        ("ten iterations, first time, ms", result["first_ms"], "with the factor"),
        ("ten iterations, later, ms", result["ten_ms"], ""),
    ]
    for name, table in left.items():
        middle, mean = np.median(table, axis=0), np.mean(table, axis=0)
        result[name] = {"median": middle.tolist(), "mean": mean.tolist()}
        for k, a, b in zip(LEFT_AFTER, middle, mean, strict=True):
            rows.append((f"{name}: error left after {k}, median / mean", f"{a:.3f} / {b:.3f}", ""))
    return result, rows


def one_level(model: Model, shape: np.ndarray, w: np.ndarray, iterations: int) -> np.ndarray:
    """The snapshots' solver with the scalar factor alone, from a shape."""
    problem = model.problem
    batch = problem.system.solve_fast(
        problem.inputs(w[None]),
        (shape - problem.base)[None],
        tolerance=1e-300,
        max_iterations=iterations,
        threads=1,
        control=core.SolveControl(),
        lanes=2,
    )
    moved: np.ndarray = problem.base + batch.shapes[0]
    return moved


PARTS = {f.__name__: f for f in (estimates, polish)}


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--part", choices=PARTS, default="estimates")
    parser.add_argument("--problem", default="dragon")
    parser.add_argument("--samples", type=int, default=100, help="training samples of the model")
    parser.add_argument("--dimension", type=int, default=40)
    parser.add_argument("--calibration", type=int, default=50, help="samples of the calibration")
    parser.add_argument("--unseen", type=int, default=60, help="samples for the comparison")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    result, rows = PARTS[args.part](args)
    title = f"{args.part}: {args.problem}, {args.samples} samples, d = {args.dimension}"
    common.show(title, rows, {"part": args.part, "problem": args.problem, **result}, args.json)


if __name__ == "__main__":
    sys.exit(main())
