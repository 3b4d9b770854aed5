"""Blends of a surface and of the same surface subdivided: does a frame cost the same?

    python benchmarks/subdivided_blends.py                       # the lion, and to 500,000 vertices
    python benchmarks/subdivided_blends.py --parts 1 2 3         # smaller
    python benchmarks/subdivided_blends.py --parts 1 2 3 --radius 0
    python benchmarks/subdivided_blends.py --set dog --parts 1 4 --poses 3 --most-samples 160

Every edge of all poses is split into this many equal parts, and every triangle into the square of
that number, all in its plane. The models are those of `interpolate --shell`, but with 20 samples at
most: a sample with 500,000 vertices takes a minute. A path goes through random blends, 60 frames
from one to the next. *Solves* are in reduced coordinates alone, *frames* have all vertices, too.
The peak of the memory is that of the process: each row's is no less than that of the rows before.
"""

from __future__ import annotations

import argparse
import json
import resource
import sys
import time
from collections.abc import Callable
from typing import Any

import blend_paths
import common
import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace.accurate.model_search import ModelSearch, SearchOptions
from snapspace.accurate.solving import Solving
from snapspace.material import BLEND_RADIUS

FloatArray = NDArray[np.float64]


def split(
    shapes: FloatArray, triangles: NDArray[np.int32], parts: int
) -> tuple[FloatArray, NDArray[np.int32]]:
    """Shapes (k, n, 3) and triangles (f, 3) with every edge in this many equal parts."""
    # the points of a triangle: how many parts of each corner they have, (p, 3)
    shares = np.array(
        [(i, j, parts - i - j) for i in range(parts + 1) for j in range(parts + 1 - i)]
    )
    place = {(i, j): k for k, (i, j, _) in enumerate(shares.tolist())}
    small = [
        [place[i, j], place[i + 1, j], place[i, j + 1]]
        for i in range(parts)
        for j in range(parts - i)
    ] + [
        [place[i + 1, j], place[i + 1, j + 1], place[i, j + 1]]
        for i in range(parts)
        for j in range(parts - 1 - i)
    ]
    # a point is the same in two triangles if it has the same shares of the same vertices
    corner = np.where(shares > 0, triangles[:, None].astype(np.int64), -1)
    share = np.broadcast_to(shares, corner.shape)
    order = np.argsort(corner, axis=2)
    keys = np.concatenate([np.take_along_axis(a, order, axis=2) for a in (corner, share)], axis=2)
    points, names = np.unique(keys.reshape(-1, 6), axis=0, return_inverse=True)
    finer = np.einsum("pc,kpcx->kpx", points[:, 3:] / parts, shapes[:, points[:, :3]])
    names = names.reshape(len(triangles), -1)
    return finer, names[:, small].reshape(-1, 3).astype(np.int32)


def finer_poses(poses: ss.ShellPoses, parts: int, count: int) -> ss.ShellPoses:
    """The first poses, subdivided."""
    shapes, triangles = split(poses.shapes[:count], poses.triangles, parts)
    return ss.ShellPoses(shapes, triangles, thickness=poses.thickness)


class Clock:
    """Seconds of the stages of a build, one after the other."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self._stage, self._since = "", time.perf_counter()

    def begins(self, stage: str) -> None:
        """Begins a stage, which ends the one before; a stage may occur several times."""
        now = time.perf_counter()
        self.seconds[self._stage] = self.seconds.get(self._stage, 0.0) + now - self._since
        self._stage, self._since = stage, now


def tell(line: str) -> None:
    """Prints a line about the progress of a build, with the time."""
    print(f"{time.perf_counter():9.1f} {line}", file=sys.stderr, flush=True)


def built(
    problem: ss.InterpolationProblem, options: SearchOptions, clock: Clock
) -> tuple[ss.InterpolationModel, ModelSearch]:
    """The model of `accurate_model`, and the search that found it."""
    clock.begins("mean shape")
    problem.solve_mean_shape()
    clock.begins("snapshots")
    search = ModelSearch(problem, options, Solving(), begins=clock.begins, tell=tell)
    for _ in search.trials():
        pass
    clock.begins("certificate")
    model = search.chosen.model
    clock.begins("end")
    assert isinstance(model, ss.InterpolationModel)
    return model, search


def rate(frames: FloatArray, frame: Callable[[FloatArray], object]) -> float:
    """Frames a second, of the median frame: other work of the machine delays a few."""
    seconds = []
    for weights in frames:
        begin = time.perf_counter()
        frame(weights)
        seconds.append(time.perf_counter() - begin)
    return float(1.0 / np.median(seconds))


def figures(poses: ss.ShellPoses, args: argparse.Namespace, parts: int) -> dict[str, Any]:
    """A row of the table."""
    clock = Clock()
    clock.begins("poses")
    finer = finer_poses(poses, parts, args.poses)
    problem = ss.InterpolationProblem(finer, material=ss.ARAP(radius=args.radius))
    options = SearchOptions(target_error=args.target_error, most_samples=args.most_samples)
    begin = np.array([time.perf_counter(), time.process_time()])
    model, search = built(problem, options, clock)
    seconds = np.array([time.perf_counter(), time.process_time()]) - begin
    reports = search.samples.snapshots.reports
    frames = common.path(problem, frames=args.frames, seed=args.seed)
    session = model.session()
    solves = rate(frames, session.blend)
    evaluations = np.median([session.blend(w).evaluations for w in frames])

    def shown(weights: FloatArray) -> NDArray[np.float32]:
        session.blend(weights)
        return session.positions

    stages = ("poses", "mean shape", "snapshots", "subspace", "energy", "certificate")
    assert model.cubature is not None
    return {
        "set": args.set,
        "poses": len(finer),
        "vertices": len(problem.mesh.vertices),
        "triangles": len(problem.mesh.cells),
        "samples": len(reports),
        "evaluations of a sample": float(np.median([r.evaluations for r in reports])),
        "converged": sum(r.status == "converged" for r in reports),
        "d": model.dimension,
        "stars": len(model.cubature.tets),
        "projection": search.chosen.step.projection,
        "error": search.chosen.step.error,
        **{f"{stage}, s": clock.seconds.get(stage, 0.0) for stage in stages},
        "build, s": float(seconds[0]),
        "build, s of processors": float(seconds[1]),
        "peak, GiB": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20,
        "solves a second": solves,
        "evaluations of a frame": float(evaluations),
        "frames a second": rate(frames[: args.frames // 4], shown),
    }


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--set", choices=blend_paths.SETS, default="lion")
    parser.add_argument("--parts", type=int, nargs="+", default=[1, 10], help="parts of every edge")
    parser.add_argument("--poses", type=int, default=2, help="the first ones of the set")
    parser.add_argument("--radius", type=float, default=BLEND_RADIUS, help="radius of the stars")
    parser.add_argument("--target-error", type=float, metavar="SHARE")
    parser.add_argument("--most-samples", type=int, default=20)
    parser.add_argument("--frames", type=int, default=600)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", action="store_true", help="one line per row, once it is known")
    args = parser.parse_args()
    poses = blend_paths.read_surfaces(args.set)
    rows = []
    for parts in sorted(args.parts):
        rows.append(figures(poses, args, parts))
        if args.json:
            print(json.dumps(rows[-1]), flush=True)
    if not args.json:
        # one column per size: there are more figures than sizes
        columns = [
            {"figure": name, **{str(row["vertices"]): row[name] for row in rows}}
            for name in rows[0]
        ]
        common.print_rows(columns, title="blends of subdivided surfaces", width=100)


if __name__ == "__main__":
    main()
