"""The picture of interpolation: a cylinder becomes a helix, elastically and on straight lines."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from pictures_placing import placed

import snapspace as ss
from snapspace.generators import cylinder, helix
from snapspace.mesh import tet_volumes
from snapspace.pictures import render_row
from snapspace.pictures.colormap import TEAL, TERRACOTTA

FloatArray = NDArray[np.float64]

COLUMNS = 7
RADIAL, ALONG, LENGTH, RADIUS = 3, 76, 9.6, 0.45


def helix_picture() -> NDArray[np.uint8]:
    """Blends of the model above, linear blends below, at equal steps of the weights."""
    straight = cylinder(RADIAL, ALONG, length=LENGTH, radius=RADIUS)
    coiled = helix(RADIAL, ALONG, length=LENGTH, radius=RADIUS, turns=2.0, coil_radius=0.68)
    problem = ss.InterpolationProblem([straight, coiled])
    elastic, linear = both_paths(problem)
    above = [f"volume {share:.0%}" for share in volume_shares(problem, elastic)]
    below = [f"volume {share:.0%}" for share in volume_shares(problem, linear)]
    labels = ["cylinder", *above[1:-1], "helix", "linear blend", *below[1:-1], "helix"]
    return render_row(
        [placed(shape) for shape in elastic + linear],
        problem.mesh.surface,
        labels=labels,
        columns=COLUMNS,
        colors=[TEAL] * COLUMNS + [TERRACOTTA] * COLUMNS,
        size=(220, 420),
        elevation=10.0,
        margin=0.05,
        samples=4,
        font_size=22,
    )


def both_paths(problem: ss.InterpolationProblem) -> tuple[list[FloatArray], list[FloatArray]]:
    """Vertices from the first pose to the second, in COLUMNS steps: the model's, and linear."""
    snapshots = ss.solve_snapshots(problem, ss.sample(problem.domain, 30, method="grid"))
    subspace = ss.snapshot_pca(snapshots, dimension=20)
    session = ss.reduce(problem, subspace, snapshots=snapshots).session()
    elastic, linear = [], []
    for share in np.linspace(0.0, 1.0, COLUMNS):
        weights = [1.0 - share, share]
        session.blend(weights)
        elastic.append(session.vertices)
        linear.append(problem.linear_blend(weights))
    return elastic, linear


def volume_shares(problem: ss.InterpolationProblem, shapes: list[FloatArray]) -> list[float]:
    """Volume of each shape relative to the first pose."""
    tets, volume = problem.mesh.tets, problem.mesh.volume
    return [float(tet_volumes(shape, tets).sum()) / volume for shape in shapes]
