"""A cloth that is dragged by two corners: nothing is lost, turned over or thrown away.

`benchmarks/cloth.py` does the same with ten thousand triangles and as many drags.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    HandleBox,
    Handles,
    PosingModel,
    PosingProblem,
    ShellMesh,
    StableNeoHookean,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)

from .sheets import sheet

FloatArray = NDArray[np.float64]
#: A hinge that is bent farther, in radians, is folded onto itself.
FOLDED = 3.0


@pytest.fixture(params=[None, StableNeoHookean()], ids=["default", "hinges"], scope="module")
def model(request: pytest.FixtureRequest) -> PosingModel:
    """A square with folds, 288 triangles, in 40 dimensions."""
    flat = sheet(12, 12, size=(1.0, 1.0), alternating=True)
    x, y, _ = flat.vertices.T
    folds = 0.04 * (1.2 - y) * np.sin(3.0 * np.pi * x)
    mesh = ShellMesh(np.stack([x, y, folds], 1), flat.triangles, thickness=0.03)
    corners = [(side < 0.1) & (y > 0.9) for side in (x, 1.0 - x)]
    box = HandleBox(translation=0.14, angle=np.pi / 4)
    handles = Handles(corners, names=["left", "right"])
    problem = PosingProblem(mesh, handles, domain=box, material=request.param)
    snapshots = solve_snapshots(problem, sample(box, 80, seed=1), threads=1)
    subspace = snapshot_pca(snapshots, dimension=40)
    # one of 80 samples of hinges takes all its iterations; its forces train the cubature too
    used = {"snapshots": snapshots, "include_unconverged": True}
    made = reduce(problem, subspace, threads=1, **used)
    assert isinstance(made, PosingModel)
    return made


def angles(mesh: ShellMesh, shape: FloatArray) -> FloatArray:
    """Angles of all hinges, in (-pi, pi]."""
    v0, v1, v2, v3 = (shape[mesh.hinges[:, k]] for k in range(4))
    edge = v1 - v0
    first, second = np.cross(edge, v2 - v0), np.cross(v3 - v0, edge)
    sine = np.linalg.norm(edge, axis=1) * np.einsum("hi,hi->h", first, v3 - v0)
    return np.asarray(np.arctan2(sine, np.einsum("hi,hi->h", first, second)))


def area_ratios(mesh: ShellMesh, shape: FloatArray) -> FloatArray:
    a, b, c = (shape[mesh.triangles[:, k]] for k in range(3))
    return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1) / (2.0 * mesh.areas))


@pytest.mark.parametrize(("reach", "drags"), [(0.3, 120), (2.0, 30)])
def test_a_dragged_cloth_neither_flips_nor_flies(
    model: PosingModel, reach: float, drags: int
) -> None:
    mesh, half = model.problem.mesh, model.problem.domain.half_widths
    assert isinstance(mesh, ShellMesh)
    session, rng, w = model.session(), np.random.default_rng(5), np.zeros(6)
    bent, held = angles(mesh, mesh.vertices), model.problem.pinned
    before, swings = mesh.vertices, []
    for _ in range(drags):
        w = np.clip(w + reach * half * rng.uniform(-1, 1, 6), -half, half)
        assert np.isfinite(session.pose(w).value)
        shape = session.vertices
        assert np.isfinite(shape).all()
        # a corner that has swung to the other side may have moved farther, but not from the handles
        far = np.linalg.norm(shape[:, None] - shape[held], axis=2).min(axis=1)
        assert far.max() < 0.8 * mesh.diagonal
        now = angles(mesh, shape)
        assert np.abs(now).max() < FOLDED
        # Followed through whole turns, a hinge beyond half a turn has passed through itself. In a
        # jump hinges swing by up to three radians, and which way they went is not known.
        if reach < 1.0:
            bent = now + 2 * np.pi * np.round((bent - now) / (2 * np.pi))
            assert np.abs(bent).max() < np.pi
        ratios = area_ratios(mesh, shape)
        assert 0.2 < ratios.min() and ratios.max() < 3.0
        way = np.linalg.norm(shape - before, axis=1)
        swings.append(way.max() / way[held].max())
        before = shape
    # Nothing else holds the free corners: now and then they swing to the other side, and in which
    # frame is a matter of rounding.
    assert np.median(swings) < 4.0
    assert np.mean(np.array(swings) > 20.0) < 0.05
