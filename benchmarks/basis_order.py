"""Errors of a model's leading dimensions, for bases of the same snapshots in several orders.

    python benchmarks/basis_order.py                  # problems of the meshes, generated ones
    python benchmarks/basis_order.py --problem bar tripod

Each model is made once, with the largest d, in stable neo-Hookean. Errors are those of `leading(d)`
at held-out samples that are solved more tightly. The bases:

    default    `snapshot_pca`, a PCA in the mass with heavy handles
    mass       the same with the mass alone, as in the paper
    responses  the linear responses to all parameters first, then a PCA in the mass of the rest
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from typing import Any

import common
import numpy as np
import problems
from rich.console import Console
from rich.table import Table

import snapspace as ss
from snapspace.mesh import apply_mass
from snapspace.validation import unseen_errors

KIND = "stable-neo-hookean"
DIMENSIONS = (5, 10, 20, 30, 40, 60, 80, 120)
#: Responses are computed at this share of a parameter's largest value.
SMALL = 1e-3
#: Tolerance of held-out samples, relative to that of the others.
JUDGING = 0.01


def by_default(snapshots: ss.Snapshots, d: int) -> ss.AffineSubspace:
    return ss.snapshot_pca(snapshots, dimension=d)


def by_mass(snapshots: ss.Snapshots, d: int) -> ss.AffineSubspace:
    return ss.snapshot_pca(snapshots, dimension=d, handle_weight=0)


def by_responses(snapshots: ss.Snapshots, d: int) -> ss.AffineSubspace:
    problem = snapshots.problem
    assert isinstance(problem, ss.PosingProblem)
    small = SMALL * np.diag(problem.domain.half_widths)
    first = ss.affine_subspace(problem.guesses(small).T, problem)
    rows = snapshots.displacements.array()
    left = rows - (apply_mass(first.mass, rows) @ first.basis) @ first.basis.T
    count = d - first.dimension
    if count <= 0:
        return first.leading(d)
    rest = ss.pca(problem.tau + left, problem.tau, first.mass, dimension=count)
    return ss.affine_subspace(np.column_stack([first.basis, rest.basis]), problem)


BASES: dict[str, Callable[[ss.Snapshots, int], ss.AffineSubspace]] = {
    "default": by_default,
    "mass": by_mass,
    "responses": by_responses,
}


def figures(name: str, args: argparse.Namespace) -> list[dict[str, Any]]:
    """One row per basis: medians and means by d."""
    problem = common.with_material(problems.read(name), KIND)
    parameters = ss.sample(problem.domain, args.samples + args.unseen, method="sobol", seed=0)
    snapshots = common.solved(problem, parameters[: args.samples])
    unseen = common.solved(
        problem,
        parameters[args.samples :],
        known=snapshots,
        tolerance=JUDGING * problem.solving.tolerance,
        max_iterations=5000,
    )
    snapshots, unseen = snapshots.select(snapshots.usable), unseen.select(unseen.usable)
    dimensions = [d for d in DIMENSIONS if d <= 0.8 * len(snapshots)]
    rows = []
    for basis in args.basis:
        subspace = BASES[basis](snapshots, dimensions[-1])
        model = ss.reduce(problem, subspace, snapshots=snapshots)
        errors = np.array([unseen_errors(model.leading(d), unseen) for d in dimensions])
        median = np.median(errors, axis=1)
        projections = [common.projection_errors(subspace.leading(d), unseen) for d in dimensions]
        rows.append(
            {
                "problem": name,
                "half": "choosing" if name in problems.CHOOSING else "judging",
                "parameters": problem.parameter_count,
                "basis": basis,
                "dimensions": dimensions,
                "median": median.tolist(),
                "mean": errors.mean(axis=1).tolist(),
                "projection": np.median(projections, axis=1).tolist(),
                "largest rise": float((median[1:] / median[:-1]).max()),
            }
        )
    return rows


def table(rows: list[dict[str, Any]]) -> Table:
    """Medians / means; a rise above 1 is an error that grows with d."""
    shown = Table("problem", "basis", *(f"d = {d}" for d in DIMENSIONS), "largest rise")
    for row in rows:
        both = [f"{a:.2g} / {b:.2g}" for a, b in zip(row["median"], row["mean"], strict=True)]
        both += [""] * (len(DIMENSIONS) - len(both))
        shown.add_row(row["problem"], row["basis"], *both, f"{row['largest rise']:.2f}")
    return shown


def ratios(rows: list[dict[str, Any]], half: str, basis: str) -> str:
    """Ratios of medians to those of the mass: geometric mean and worst of a half's problems."""
    chosen = [row for row in rows if row["half"] == half]
    plain = {row["problem"]: row["median"] for row in chosen if row["basis"] == "mass"}
    some = [row for row in chosen if row["basis"] == basis]
    words = []
    for k, d in enumerate(DIMENSIONS):
        pairs = [(row["median"], plain[row["problem"]]) for row in some]
        found = np.array([a[k] / b[k] for a, b in pairs if k < len(a)])
        if len(found):
            words.append(f"d = {d}: {np.exp(np.log(found).mean()):.2f} ({found.max():.2f})")
    return f"{half}, {basis}, {len(some)} problems: {', '.join(words)}"


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    known = list(problems.NAMES)
    parser.add_argument("--problem", nargs="+", choices=known, default=known)
    parser.add_argument("--basis", nargs="+", choices=list(BASES), default=list(BASES))
    parser.add_argument("--samples", type=int, default=160)
    parser.add_argument("--unseen", type=int, default=24)
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    rows = []
    for name in args.problem:
        rows += figures(name, args)
        if args.json:
            print(json.dumps(rows[-len(args.basis) :]), flush=True)
    if args.json:
        return
    Console(width=160).print(table(rows))
    for half in ("choosing", "judging"):
        for basis in args.basis:
            compared = "mass" in args.basis and basis != "mass"
            if compared and any(row["half"] == half for row in rows):
                print(ratios(rows, half, basis))


if __name__ == "__main__":
    main()
