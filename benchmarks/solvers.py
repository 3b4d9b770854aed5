"""The fast snapshot solver against the paper's Newton method, on the same samples in the same run.

    python benchmarks/solvers.py --problem dragon --samples 10

Each solves as in a build: "newton" starts from the nearest finished sample (paper, sec. 4.2),
"fast" from an interpolation of finished samples. Newton's linear systems are solved by conjugate
gradients, preconditioned by the scalar factor. --direct also times the alternative, one sparse
factorisation of the first matrix.
"""

from __future__ import annotations

import argparse
import time

import common
import numpy as np
from scipy.sparse import csc_array, diags_array
from scipy.sparse.linalg import splu

import snapspace as ss


def timed(
    problem: ss.PosingProblem, parameters: np.ndarray, options: ss.SolverOptions
) -> tuple[float, ss.Snapshots]:
    begin = time.perf_counter()
    snapshots = ss.solve_snapshots(problem, parameters, options=options, progress=common.progress)
    return time.perf_counter() - begin, snapshots


def direct_seconds(problem: ss.PosingProblem) -> float:
    """One sparse factorisation of the 3n x 3n Newton matrix at rest."""
    rest = problem.mesh.vertices.reshape(-1)
    pins = np.zeros(len(problem.mesh.vertices))
    pins[problem.pinned] = 2.0 * problem.pin_weights
    matrix = csc_array(problem.energy.hessian(rest) + diags_array(np.repeat(pins, 3)))
    begin = time.perf_counter()
    splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return time.perf_counter() - begin


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--problem", default="dragon")
    parser.add_argument("--samples", type=int, default=10)
    parser.add_argument("--tolerance", type=float, default=ss.SolverOptions().tolerance)
    parser.add_argument("--clamp", type=float, default=ss.SolverOptions().clamp)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--direct", action="store_true")
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()

    problem = common.read_problem(args.problem)
    _ = problem.system  # both share one factor
    parameters = ss.sample(problem.domain, args.samples, seed=args.seed)
    fast_seconds, fast = timed(problem, parameters, ss.SolverOptions(tolerance=args.tolerance))
    newton_options = ss.SolverOptions(solver="newton", tolerance=args.tolerance, clamp=args.clamp)
    newton_seconds, newton = timed(problem, parameters, newton_options)

    values = np.array([[r.value for r in s.reports] for s in (fast, newton)])
    excess = values[0] / values[1] - 1.0  # negative: the fast solution has a lower energy
    result = {
        "problem": args.problem,
        "samples": args.samples,
        "seconds": {"fast": fast_seconds, "newton": newton_seconds},
        "ratio": newton_seconds / fast_seconds,
        "iterations": {
            name: [r.iterations for r in s.reports]
            for name, s in (("fast", fast), ("newton", newton))
        },
        "converged": {"fast": int(fast.converged.sum()), "newton": int(newton.converged.sum())},
        "value": {"fast": values[0].tolist(), "newton": values[1].tolist()},
        "excess": {
            "median": float(np.median(excess)),
            "max": float(excess.max()),
            "all_together": float(values[0].sum() / values[1].sum() - 1.0),
        },
        "within_half_percent": int((excess <= 0.005).sum()),
    }
    rows = [
        ("fast, s", fast_seconds, ""),
        ("newton, s", newton_seconds, ""),
        ("newton / fast", newton_seconds / fast_seconds, ">= 20"),
        ("fast converged", f"{result['converged']['fast']} of {args.samples}", ""),
        ("newton converged", f"{result['converged']['newton']} of {args.samples}", ""),
        ("energy fast / newton - 1, all together", result["excess"]["all_together"], "<= 0.005"),
        ("energy fast / newton - 1, median", float(np.median(excess)), "<= 0.005"),
        ("energy fast / newton - 1, max (other minimum)", float(excess.max()), ""),
        ("samples at or below newton + 0.5 %", f"{result['within_half_percent']}", ""),
    ]
    if args.direct:
        result["direct_factorisation_seconds"] = direct_seconds(problem)
        rows.append(("one direct factorisation, s", result["direct_factorisation_seconds"], ""))
    common.show(f"solvers on {args.problem}", rows, result, args.json)


if __name__ == "__main__":
    main()
