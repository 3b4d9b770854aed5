"""As-rigid-as-possible surfaces against libigl: time per frame, and the energy that is reached.

    python benchmarks/shell_arap.py --surface spot_low_829.obj

The surface's lowest vertices (y) are fixed, and those at one end of its longest axis move along a
path through the domain, 60 frames from one random motion to the next. All methods have the same
surface, handles and frames. libigl's local-global iterations, spokes and rims, start at their last
frame; its factorisation is not counted. Objectives are those of the full problem, elastic energy
and springs of the handles, relative to those of tight full solutions; libigl has its handles
exactly. Needs `pip install libigl`.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable
from typing import Any

import common
import igl
import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace.mesh import mass_norms, shell_of_file

FloatArray = NDArray[np.float64]

#: Share of the vertices in each handle.
HELD = 0.03
#: Every tenth frame is compared with a full solution.
COMPARED = 10


def problem_of(name: str, stiffness: float) -> ss.PosingProblem:
    """An ARAP surface of the meshes' folder; stiffness in units of the default."""
    file = ss.open_surface(common.meshes_folder() / "surfaces" / name)
    mesh = shell_of_file(file, thickness=1.0)[0]
    low = mesh.vertices[:, 1]
    along = mesh.vertices[:, np.argmax(np.ptp(mesh.vertices, axis=0) * [1, 0, 1])]
    feet = low < np.quantile(low, HELD)
    head = (along < np.quantile(along, HELD)) & ~feet
    handles = ss.Handles([feet, head], names=["feet", "head"])
    domain = ss.HandleBox(translation=0.1 * mesh.diagonal, angle=np.pi / 6)
    usual = ss.PosingProblem(mesh, handles, domain=domain, material=ss.ARAP())
    return ss.PosingProblem(
        mesh, handles, domain=domain, material=ss.ARAP(), stiffness=stiffness * usual.stiffness
    )


def walked(
    frames: FloatArray, pose: Callable[[FloatArray], FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Milliseconds of each frame, also of processor time (frames, 2), and shapes (frames, 3n)."""
    seconds, shapes = [], []
    for w in frames:
        begin = np.array([time.perf_counter(), time.process_time()])
        shape = pose(w)
        seconds.append(np.array([time.perf_counter(), time.process_time()]) - begin)
        shapes.append(np.array(shape).reshape(-1))
    return 1e3 * np.array(seconds), np.array(shapes)


def libigl_pose(problem: ss.PosingProblem, iterations: int) -> Callable[[FloatArray], FloatArray]:
    """libigl with this many iterations per frame."""
    data = igl.ARAPData()
    data.energy, data.max_iter = igl.ARAP_ENERGY_TYPE_SPOKES_AND_RIMS, iterations
    rest = np.array(problem.mesh.vertices)
    igl.arap_precomputation(rest, problem.mesh.triangles.astype(np.int64), 3, problem.pinned, data)
    last = [rest]

    def pose(w: FloatArray) -> FloatArray:
        places = rest[problem.pinned] + problem.target_displacements(problem.offsets(w))
        last[0] = igl.arap_solve(places, data, last[0])
        return last[0]

    return pose


def measured(args: argparse.Namespace) -> tuple[list[dict[str, Any]], dict[str, Any]]:
    """A row per method, and facts about the problem."""
    problem = problem_of(args.surface, args.stiffness)
    frames = common.path(problem, frames=args.frames, seed=args.seed + 1)
    compared = slice(COMPARED // 2, None, COMPARED)
    exact = common.solved(problem, frames[compared], tolerance=1e-9, max_iterations=5000)
    best = np.array([report.value for report in exact.reports])
    size = mass_norms(problem.mass(), exact.displacements.array())

    def row(method: str, ms: FloatArray, shapes: FloatArray) -> dict[str, Any]:
        values = [
            problem.value_and_gradient(x, w)[0]
            for x, w in zip(shapes, frames[compared], strict=True)
        ]
        above = np.array(values) / best - 1.0
        away = mass_norms(problem.mass(), shapes - exact.shapes) / size
        return {
            "method": method,
            "ms": float(np.median(ms[:, 0])),
            "cpu ms": float(np.median(ms[:, 1])),
            "objective above": float(np.median(above)),
            "90 %": float(np.quantile(above, 0.9)),
            "distance": float(np.median(away)),
        }

    rows = []
    for iterations in args.iterations:
        ms, shapes = walked(frames, libigl_pose(problem, iterations))
        rows.append(row(f"libigl, {iterations} iterations", ms, shapes[compared]))

    samples = ss.sample(problem.domain, args.samples, method="sobol", seed=args.seed)
    begin = time.perf_counter()
    snapshots = ss.solve_snapshots(problem, samples)
    solved = time.perf_counter()
    model = ss.reduce(
        problem, ss.snapshot_pca(snapshots, dimension=args.dimension), snapshots=snapshots
    )
    reduced = time.perf_counter()
    session = model.session()

    def live(w: FloatArray) -> FloatArray:
        session.pose(w)
        return session.vertices

    ms, shapes = walked(frames, live)
    rows.append(row(f"session, d = {args.dimension}", ms, shapes[compared]))

    start = np.array([time.perf_counter(), time.process_time()])
    full = ss.solve_snapshots(problem, frames[compared])
    spent = np.array([time.perf_counter(), time.process_time()]) - start
    each = 1e3 * spent[None] / len(full.parameters)
    rows.append(row("full solves, together", each, full.shapes))
    facts = {
        "surface": args.surface,
        "vertices": len(problem.mesh.vertices),
        "triangles": len(problem.mesh.triangles),
        "stiffness": args.stiffness,
        "samples": args.samples,
        "dimension": args.dimension,
        "stars": len(model.cubature.tets) if model.cubature else 0,
        "evaluations": float(np.median([r.evaluations for r in snapshots.reports])),
        "converged": int(snapshots.converged.sum()),
        "samples s": solved - begin,
        "model s": reduced - solved,
    }
    return rows, facts


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--surface", default="spot_low_829.obj")
    parser.add_argument(
        "--stiffness", type=float, default=100.0, help="stiffness, in units of the default"
    )
    parser.add_argument("--iterations", type=int, nargs="+", default=[1, 10, 100])
    parser.add_argument("--frames", type=int, default=180)
    parser.add_argument("--samples", type=int, default=300)
    parser.add_argument("--dimension", type=int, default=120)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    rows, facts = measured(args)
    if args.json:
        print(json.dumps({"problem": facts, "rows": rows}))
        return
    numbers = {k: f"{v:.4g}" if isinstance(v, float) else v for k, v in facts.items()}
    title = ", ".join(f"{name} {number}" for name, number in numbers.items())
    common.print_rows(rows, title=title, width=160)


if __name__ == "__main__":
    main()
