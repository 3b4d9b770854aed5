"""A picture of one path between two poses in several materials, with the longest step of one.

    python benchmarks/blend_strip.py --set lion -o docs/pictures/path-lion.png

A path has steps of 1 % of the weight. The pair of poses is the one with the longest step of the
first material. Columns are weights: evenly spread ones, and those before and after that step. Each
row is a material. The models are those of `blend_paths.py`.
"""

from __future__ import annotations

import argparse
from itertools import combinations
from pathlib import Path

import blend_paths
import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace.pictures import render_row, save_png

FloatArray = NDArray[np.float64]
MATERIALS = ("stvk", "stable-neo-hookean", "corotational", "arap")


def path(model: ss.InterpolationModel, pair: tuple[int, int]) -> FloatArray:
    """Shapes (101, n, 3) of a drag from one pose to another."""
    session = model.session()
    shapes, _ = blend_paths.walk(session, pair, len(model.problem.poses))
    return shapes


def steps(shapes: FloatArray) -> FloatArray:
    """The largest motion of a vertex from frame to frame, (100,)."""
    moved: FloatArray = np.linalg.norm(np.diff(shapes, axis=0), axis=2).max(axis=1)
    return moved


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--set", choices=blend_paths.SETS, default="lion")
    parser.add_argument("--material", nargs="+", default=MATERIALS)
    parser.add_argument("--samples", type=int, default=40, help="number of samples, for stvk")
    parser.add_argument("--dimension", type=int, default=30, help="d, for stvk")
    parser.add_argument("--up", choices=("x", "y", "z"), default="y")
    parser.add_argument("--azimuth", type=float, default=-50.0, help="degrees")
    parser.add_argument("-o", "--output", type=Path, required=True)
    args = parser.parse_args()
    poses = blend_paths.read(args.set)
    models = {}
    for kind in args.material:
        problem = ss.InterpolationProblem(poses, material=ss.MATERIALS[kind]())
        models[kind], _ = blend_paths.built(problem, args)
    first = models[args.material[0]]
    pairs = list(combinations(range(len(poses)), 2))
    pair = max(pairs, key=lambda p: float(steps(path(first, p)).max()))
    snap = int(np.argmax(steps(path(first, pair))))
    frames = sorted({10, 40, 70, snap, snap + 1})
    shapes, labels = [], []
    for kind, model in models.items():
        walk = path(model, pair)
        longest = steps(walk).max() / np.median(steps(walk))
        print(f"{kind}: longest step over the median {longest:.3g}")
        shapes += [walk[frame] for frame in frames]
        title = model.problem.material.title
        labels += [f"{title} {frames[0]} %", *(f"{frame} %" for frame in frames[1:])]
    picture = render_row(
        shapes,
        poses.reference.surface,
        labels=labels,
        columns=len(frames),
        up=args.up,
        azimuth=args.azimuth,
        size=(260, 200),
        margin=0.05,
        font_size=15,
    )
    save_png(args.output, picture)


if __name__ == "__main__":
    main()
