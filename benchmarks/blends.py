"""Uniform samples against blends of few poses: projection errors at blends of 2, 3 and all poses.

python benchmarks/blends.py --poses 12 --seed 13
"""

from __future__ import annotations

import argparse
import json

import common
import numpy as np
from rich.console import Console
from rich.table import Table

import snapspace as ss
from snapspace.generators import lizard_poses
from snapspace.problem.problem import solutions_beyond_tau
from snapspace.validation import unseen_parameters

METHODS = ("sobol", "blends")
SIZES = ((40, 20), (80, 40), (120, 40))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--poses", type=int, default=12)
    parser.add_argument("--tets", type=int, default=1_500)
    parser.add_argument("--seed", type=int, default=13, help="seed of the poses")
    parser.add_argument("--unseen", type=int, default=60, help="number of blends of each kind")
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()

    poses = ss.Poses.of(lizard_poses(args.poses, args.tets, seed=args.seed))
    problem = ss.InterpolationProblem(poses, material=ss.StVK())
    gram = ss.SnapshotGram.of(problem)
    gram.add(list(solutions_beyond_tau(problem)[1] - problem.base))
    known = np.arange(len(gram))
    most = max(count for count, _ in SIZES)
    rows = {
        method: solved(problem, gram, ss.sample(problem.domain, most, method=method))
        for method in METHODS
    }
    tight = {"tolerance": 1e-10, "max_iterations": 5000}
    new = {
        kind: solved(problem, gram, weights, **tight)
        for kind, weights in unseen(problem.domain, args.unseen).items()
    }
    norms = np.sqrt(np.diag(gram.matrix))
    spread = float(np.sqrt((norms[known] ** 2).mean()))
    result = []
    for count, dimension in SIZES:
        for method in METHODS:
            training = np.concatenate([known, rows[method][:count]])
            row: dict[str, object] = {"samples": count, "d": dimension, "method": method}
            for kind, which in new.items():
                errors = gram.held_out_error(training, which, dimension)
                row[kind] = float(errors.mean())
                row[f"{kind}, of the spread"] = float((errors * norms[which]).mean() / spread)
            result.append(row)
    if args.json:
        print(json.dumps({"poses": args.poses, "seed": args.seed, "rows": result}))
        return
    table = Table(*result[0], title=f"lizard, {args.poses} poses; mean projection errors")
    for row in result:
        table.add_row(*(f"{v:.4f}" if isinstance(v, float) else str(v) for v in row.values()))
    Console(width=160).print(table)


def solved(
    problem: ss.InterpolationProblem, gram: ss.SnapshotGram, weights: np.ndarray, **options: float
) -> np.ndarray:
    """Solves, adds the solutions to the Gram matrix, and returns the rows of converged ones."""
    snapshots = common.solved(problem, weights, **options)
    first = len(gram)
    gram.add([*snapshots.displacements])
    return first + np.flatnonzero(snapshots.converged)


def unseen(domain: ss.Simplex, count: int) -> dict[str, np.ndarray]:
    """Random blends of two poses, of three poses and of all."""
    chance = np.random.default_rng(99)
    found = {}
    for few, name in ((2, "two"), (3, "three")):
        weights = np.zeros((count, domain.corners))
        for row in weights:
            chosen = chance.choice(domain.corners, few, replace=False)
            row[chosen] = chance.dirichlet(np.ones(few))
        found[name] = weights
    return found | {"all": unseen_parameters(domain, count, seed=5)}


if __name__ == "__main__":
    main()
