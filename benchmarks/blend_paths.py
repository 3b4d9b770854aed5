"""Paths between poses: are they smooth, the same there and back, and does a jump end on them?

    python benchmarks/blend_paths.py                       # generated sets, and those of the meshes
    python benchmarks/blend_paths.py --set lizard-4 lion   # some of them
    python benchmarks/blend_paths.py --shell --material arap --set lizard-4 lion   # as surfaces
    python benchmarks/blend_paths.py --shell --material arap --radius 0 --set lion

A path goes from one pose to another in steps of 1 % of the weight, in a live session. Distances are
the largest of any vertex, relative to the diagonal of the first pose. Some unseen blends are solved
in the full space from three starts each: if the minimum is unique, the solutions are the same.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Iterator
from itertools import combinations
from typing import Any

import common
import interpolation
import numpy as np
from rich.console import Console
from rich.table import Table

import snapspace as ss
from snapspace import _core as core
from snapspace.generators import lizard_poses
from snapspace.material import BLEND_RADIUS
from snapspace.snapshots.fast_solve import solve_fast

STEPS = 100
#: Sets of the meshes' folder: the base set, and the poses in addition to the first one.
REAL = {
    "lion": ("lion", ("lion-02", "lion-05", "lion-08")),
    "dog": ("dog", ("dog1", "dog2")),
    "centaur": ("centaur", tuple(f"centaur{k}" for k in range(1, 6))),
    "lions": ("lion", tuple(f"lion-{k:02d}" for k in range(1, 10))),
}
GENERATED = {"lizard-4": 4, "lizard-11": 11, "lizard-20": 20}
SETS = (*GENERATED, *REAL)


#: With --shell, a thickness relative to the diagonal, on which ARAP does not depend.
THICKNESS = 0.02


def read_surfaces(name: str) -> ss.ShellPoses:
    """The poses as surfaces; those of generated bodies are the boundaries of their tets."""
    if name in GENERATED:
        meshes = lizard_poses(GENERATED[name], 8_000, seed=GENERATED[name])
        used, faces = np.unique(meshes[0].surface, return_inverse=True)
        shapes, triangles = [m.vertices[used] for m in meshes], faces.reshape(-1, 3)
    else:
        base, names = REAL[name]
        reference = common.meshes_folder() / interpolation.SETS[base].reference.replace(
            "_fixed", ""
        )
        files = [reference, *(reference.with_name(f"{k}{reference.suffix}") for k in names)]
        surfaces = [ss.read_surface(file) for file in files]
        shapes, triangles = [vertices for vertices, _ in surfaces], surfaces[0][1]
    diagonal = float(np.linalg.norm(np.ptp(shapes[0], axis=0)))
    return ss.ShellPoses(shapes, triangles, thickness=THICKNESS * diagonal)


def read(name: str, *, shell: bool) -> ss.Poses | ss.ShellPoses:
    if shell:
        return read_surfaces(name)
    if name in GENERATED:
        count = GENERATED[name]
        return ss.Poses.of(lizard_poses(count, 8_000, seed=count))
    base, names = REAL[name]
    poses, _, _ = interpolation.read_poses(interpolation.SETS[base], names)
    return poses


def walk(session: Any, ends: tuple[int, int], poses: int) -> tuple[np.ndarray, list[float]]:
    """Shapes (101, n, 3) from one pose to another, and the milliseconds of each solve."""
    shapes, milliseconds = [], []
    for share in np.linspace(0.0, 1.0, STEPS + 1):
        weights = np.zeros(poses)
        weights[ends[0]], weights[ends[1]] = 1.0 - share, share
        milliseconds.append(1e3 * session.blend(weights).seconds)
        shapes.append(session.vertices)
    return np.array(shapes), milliseconds


def apart_from_other_starts(problem: ss.InterpolationProblem, blends: int) -> float:
    """Largest distance between tight solutions from different starts, for some uniform blends.

    Starts are the mean shape, the straight blend, and the pose with the largest weight.
    """
    center = np.asarray(problem.domain.center)
    weights = ss.sample(problem.domain, blends, method="sobol", seed=9)
    known, shapes = problem.known_solutions()
    starts = []
    for w in weights:
        pose = shapes[np.argmin(((known - np.eye(len(w))[np.argmax(w)]) ** 2).sum(axis=1))]
        mean = shapes[np.argmin(((known - center) ** 2).sum(axis=1))]
        starts += [x - problem.base for x in (mean, problem.linear_blend(w).reshape(-1), pose)]
    options = ss.SolverOptions(tolerance=1e-12, max_iterations=3000).resolved(problem)
    solved, _ = solve_fast(
        problem,
        np.repeat(weights, 3, axis=0),
        np.array(starts),
        core.SolveControl(),
        options,
        threads=0,
    )
    every = problem.registered(solved).reshape(blends, 3, -1, 3)
    distances = np.linalg.norm(every[:, :, None] - every[:, None], axis=-1)
    return float(distances.max()) / problem.mesh.diagonal


def built(
    problem: ss.InterpolationProblem, args: argparse.Namespace
) -> tuple[ss.InterpolationModel, ss.Snapshots]:
    """A model as the command builds it; for St.Venant-Kirchhoff with the given samples and d."""
    if problem.material.exact_degree != 4 or args.shell:
        accurate = ss.accurate_model(
            problem, target_error=args.target_error, tell=lambda line: print(line, file=sys.stderr)
        )
        return accurate.model, accurate.snapshots
    parameters = ss.sample(problem.domain, args.samples, method="sobol")
    snapshots = ss.solve_snapshots(problem, parameters, progress=common.progress)
    subspace = ss.snapshot_pca(snapshots, dimension=min(args.dimension, len(snapshots)))
    return ss.reduce(problem, subspace, snapshots=snapshots), snapshots


def figures(name: str, kind: str, args: argparse.Namespace) -> Iterator[dict[str, Any]]:
    poses = read(name, shell=args.shell)
    material = ss.ARAP(radius=args.radius) if kind == ss.ARAP.kind else ss.MATERIALS[kind]()
    begin = time.perf_counter()
    problem = ss.InterpolationProblem(poses, material=material)
    model, snapshots = built(problem, args)
    seconds = time.perf_counter() - begin
    validation = ss.validate(model, samples=args.validate, progress=common.progress)
    session, diagonal = model.session(), problem.mesh.diagonal
    steps, there_back, jump_drag, milliseconds = [], 0.0, 0.0, []
    pairs = list(combinations(range(len(poses)), 2))
    count = len(pairs) if args.pairs is None else min(args.pairs, len(pairs))
    for pair in [pairs[k] for k in np.linspace(0, len(pairs) - 1, count).astype(int)]:
        there, times = walk(session, pair, len(poses))
        back, _ = walk(session, pair[::-1], len(poses))
        milliseconds += times
        moved = np.linalg.norm(np.diff(there, axis=0), axis=2).max(axis=1)
        steps.append(moved.max() / np.median(moved))
        apart = np.linalg.norm(there - back[::-1], axis=2).max() / diagonal
        there_back = max(there_back, float(apart))
        for k in range(10, STEPS, 20):
            weights = np.zeros(len(poses))
            weights[pair[0]], weights[pair[1]] = 1.0 - k / STEPS, k / STEPS
            session.reset()
            session.blend(weights)
            apart = np.linalg.norm(session.vertices - there[k], axis=1).max() / diagonal
            jump_drag = max(jump_drag, float(apart))
    yield {
        "set": name,
        "material": kind,
        "radius": args.radius,
        "poses": len(poses),
        "longest over median step": float(max(steps)),
        "there against back": there_back,
        "jump against drag": jump_drag,
        "full solutions apart": apart_from_other_starts(problem, args.starts),
        "held-out error, mean": float(np.mean(validation.error)),
        "projection, mean": float(np.mean(validation.projection_error)),
        "inverted tets of a sample": max(r.inverted_tets for r in snapshots.reports),
        "ms of a solve": float(np.median(milliseconds)),
        "ms after a jump": float(np.median(validation.solve_ms)),
        "samples": len(snapshots),
        "d": model.dimension,
        "built, s": seconds,
    }


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--set", nargs="+", choices=SETS, default=list(SETS))
    parser.add_argument("--material", nargs="+", default=["stvk", "stable-neo-hookean"])
    parser.add_argument("--shell", action="store_true", help="blend surfaces, without tets")
    parser.add_argument(
        "--radius", type=float, default=BLEND_RADIUS, help="radius of the stars of arap"
    )
    parser.add_argument("--target-error", type=float, default=0.005, metavar="SHARE")
    parser.add_argument("--samples", type=int, default=40, help="number of samples, for stvk")
    parser.add_argument("--dimension", type=int, default=30, help="d, for stvk")
    parser.add_argument("--pairs", type=int, help="number of paths per set [default: all]")
    parser.add_argument("--validate", type=int, default=12, help="number of unseen blends")
    parser.add_argument("--starts", type=int, default=6, help="blends solved from three starts")
    parser.add_argument("--json", action="store_true", help="one line per row, once it is known")
    args = parser.parse_args()
    table = None
    for name in args.set:
        for kind in args.material:
            for row in figures(name, kind, args):
                if args.json:
                    print(json.dumps(row), flush=True)
                    continue
                if table is None:
                    table = Table(*row, title="paths; goals: 4, 1e-3, 1e-3, 0.005")
                table.add_row(
                    *(f"{x:.3g}" if isinstance(x, float) else str(x) for x in row.values())
                )
    if table is not None:
        Console().print(table)


if __name__ == "__main__":
    main()
