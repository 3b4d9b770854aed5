"""Shells: evaluations and errors of posed surfaces, by thickness.

    python benchmarks/shells.py --surface spot_low_829.obj --thickness 0.03 0.015

The surface's lowest vertices (y) are fixed, and those at one end of its longest axis move.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from typing import Any

import common
import numpy as np

import snapspace as ss
from snapspace.mesh import shell_of_file

#: Share of the vertices in each handle.
HELD = 0.1


def read_shell(name: str, thickness: float) -> ss.ShellMesh:
    """A surface of the meshes' folder as a shell, its thickness a share of the diagonal."""
    file = ss.open_surface(common.meshes_folder() / "surfaces" / name)
    diagonal = float(np.linalg.norm(np.ptp(file.vertices, axis=0)))
    return shell_of_file(file, thickness=thickness * diagonal)[0]


def posed_surface(name: str, thickness: float) -> ss.PosingProblem:
    """`read_shell` with two handles."""
    mesh = read_shell(name, thickness)
    low = mesh.vertices[:, 1]
    along = mesh.vertices[:, np.argmax(np.ptp(mesh.vertices, axis=0) * [1, 0, 1])]
    feet = low < np.quantile(low, HELD)
    head = (along < np.quantile(along, HELD)) & ~feet
    domain = ss.HandleBox(translation=0.1 * mesh.diagonal, angle=np.pi / 6)
    handles = ss.Handles([feet, head], names=["feet", "head"])
    return ss.PosingProblem(mesh, handles, domain=domain, material=ss.StableNeoHookean())


def rows(args: argparse.Namespace) -> Iterator[dict[str, Any]]:
    """One row per thickness."""
    for thickness in args.thickness:
        problem = posed_surface(args.surface, thickness)
        samples = ss.sample(problem.domain, args.samples, method="sobol", seed=args.seed)
        begin = time.process_time()
        snapshots = common.solved(problem, samples)
        solved = time.process_time()
        subspace = ss.snapshot_pca(snapshots, dimension=args.dimension)
        model = ss.reduce(problem, subspace, snapshots=snapshots)
        reduced = time.process_time()
        found = ss.validate(model, samples=args.validate)
        split = ss.split_errors(model, found.reference)
        warm, _ = common.drag(model, frames=200, seed=args.seed + 1)
        yield {
            "thickness": thickness,
            "triangles": len(problem.mesh.cells),
            "evaluations": float(np.median([r.evaluations for r in snapshots.reports])),
            "converged": f"{int(snapshots.converged.sum())} of {len(samples)}",
            "median": float(np.median(found.error)),
            "mean": float(found.error.mean()),
            "subspace": float(np.median(split.subspace)),
            "stiffness": float(np.median(split.stiffness)),
            "cubature": float(np.median(split.cubature)),
            "warm ms": float(np.median(warm)),
            "samples cpu s": solved - begin,
            "model cpu s": reduced - solved,
        }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--surface", default="spot_low_829.obj")
    parser.add_argument("--thickness", type=float, nargs="+", default=[0.03, 0.015])
    parser.add_argument("--samples", type=int, default=300)
    parser.add_argument("--dimension", type=int, default=120)
    parser.add_argument("--validate", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    args = parser.parse_args()
    common.print_rows(list(rows(args)), title=f"shells: {args.surface}", width=160)


if __name__ == "__main__":
    main()
