"""Poor models, the advice of `next_option` for them, and the errors after following it.

python benchmarks/next_options.py
python benchmarks/next_options.py --problem creature:25000 --samples 60 --dimension 40 --tets 40

Without options it takes problems of the meshes' folder (SNAPSPACE_MESHES) and generated ones, with
few samples, few tets or few dimensions. Errors are those of 12 unseen samples, the same before and
after. The material is stable neo-Hookean; `exact` is St.Venant-Kirchhoff with its quartic.
"""

from __future__ import annotations

import argparse
import json
import time
from typing import Any

import numpy as np
from common import meshes_folder, read_problem, with_material
from rich.console import Console
from rich.table import Table

import snapspace as ss
from snapspace.generators import lizard_poses
from snapspace.validation import solved_reference

#: Problem, samples, dimension, tets; None for the default.
POSING = [
    ("creature:25000", 30, 15, None),
    ("creature:25000", 120, 40, 40),
    ("spot", 120, 40, 40),
    ("armadillo", 60, 20, None),
    ("hand_five_fingers", 150, 60, 60),
    ("elephant exact", 60, 20, None),
]
BLENDS = [("lizard of 4 poses", 20, 8, None), ("lizard of 4 poses", 40, 24, 24)]


def poor_model(
    problem: ss.PosingProblem | ss.InterpolationProblem, samples: int, d: int, tets: int | None
) -> ss.ReducedModel:
    """A model from the first Sobol samples."""
    snapshots = ss.solve_snapshots(problem, ss.sample(problem.domain, samples))
    usable = snapshots.select(snapshots.usable)
    subspace = ss.snapshot_pca(snapshots, dimension=d)
    return ss.reduce(problem, subspace, snapshots=usable, tets=tets)


def trial(
    name: str,
    problem: ss.PosingProblem | ss.InterpolationProblem,
    samples: int,
    d: int,
    tets: int | None,
) -> dict[str, Any]:
    """Errors before and after, and the advice."""
    begin = time.perf_counter()
    reference = solved_reference(problem, samples=12)
    full_seconds = (time.perf_counter() - begin) / len(reference)
    model = poor_model(problem, samples, d, tets)
    before = ss.validate(model, reference=reference)
    begin = time.perf_counter()
    split = ss.split_errors(model, reference.select(range(5)))
    split_seconds = (time.perf_counter() - begin) / len(split.error)
    option = ss.next_option(model, split)
    names: dict[str, Any] = {"ss": ss, "problem": problem}
    exec(option.python, names)
    after = ss.validate(names["model"], reference=reference)
    return {
        "problem": name,
        "samples": samples,
        "dimension": d,
        "tets": tets,
        "parts": {part: float(np.median(getattr(split, part))) for part in ss.validation.PARTS},
        "part": option.part,
        "full_seconds": full_seconds,
        "split_seconds": split_seconds,
        "next": {"samples": option.samples, "dimension": option.dimension, "tets": option.tets},
        "error_before": float(np.median(before.error)),
        "projection_before": float(np.median(before.projection_error)),
        "error_after": float(np.median(after.error)),
        "projection_after": float(np.median(after.projection_error)),
    }


def posing_problem(name: str) -> ss.PosingProblem:
    base, _, exact = name.partition(" ")
    problem = read_problem(base)
    return problem if exact else with_material(problem, "stable-neo-hookean")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--problem", help="one problem, with --samples, --dimension and --tets")
    parser.add_argument("--samples", type=int, default=60)
    parser.add_argument("--dimension", type=int, default=30)
    parser.add_argument("--tets", type=int)
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    if args.problem:
        cases = [(args.problem, args.samples, args.dimension, args.tets)]
    else:
        has_meshes = (meshes_folder() / "problems").is_dir()
        cases = [case for case in POSING if has_meshes or case[0].startswith("creature")]
    rows = [trial(name, posing_problem(name), *sizes) for name, *sizes in cases]
    if not args.problem:
        poses = ss.InterpolationProblem(ss.Poses.of(lizard_poses(4, 4000, seed=1)))
        rows += [trial(name, poses, *sizes) for name, *sizes in BLENDS]
    if args.json:
        print(json.dumps(rows))
        return
    table = Table(
        "problem",
        "built",
        "parts: subspace / stiffness / cubature / minimum",
        "next",
        "error",
        "s / sample",
    )
    for row in rows:
        parts = " / ".join(f"{value:.2g}" for value in row["parts"].values())
        built = f"{row['samples']}, d = {row['dimension']}, tets {row['tets'] or 'default'}"
        after = row["next"]
        following = f"{after['samples']}, d = {after['dimension']}, tets {after['tets'] or '-'}"
        errors = f"{row['error_before']:.2g} -> {row['error_after']:.2g}"
        seconds = f"{row['full_seconds']:.2g} full, {row['split_seconds']:.2g} split"
        table.add_row(row["problem"], built, parts, following, errors, seconds)
    Console(width=150).print(table)


if __name__ == "__main__":
    main()
