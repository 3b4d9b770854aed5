"""`snapspace blend --path` moves the shape evenly, and reports where it jumps."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from snapspace import InterpolationProblem, StVK, load, reduce, snapshot_pca, solve_snapshots
from snapspace.cli.even_path import whole_steps
from snapspace.generators import bar, cylinder, helix
from snapspace.problem import Poses

from ..shapes import bent
from .conftest import Run

LENGTHS = st.lists(st.floats(0, 10), min_size=1, max_size=6)


@given(lengths=LENGTHS, more=st.integers(0, 40))
def test_no_other_whole_steps_are_shorter(lengths: list[float], more: int) -> None:
    """The longest step of all legs is as short as whole numbers of steps allow."""
    counts = whole_steps(np.array(lengths), len(lengths) + more)
    assert counts.sum() == len(lengths) + more and counts.min() >= 1
    longest = (np.array(lengths) / counts).max()
    if longest > 0:
        shorter = longest * (1 - 1e-9)
        needed = [max(int(np.ceil(length / shorter)), 1) for length in lengths]
        assert sum(needed) > counts.sum(), "shorter steps would need more frames"


def test_the_largest_motion_is_even_where_the_weights_are_not(run: Run, blend_model: Path) -> None:
    figures = run("blend", blend_model, "--path", 41, "--json").json
    motions = np.array(figures["path"]["motions"])
    weights = np.array([frame["weights"] for frame in figures["frames"]])
    assert figures["path"]["jumps"] == [] and len(motions) == 40
    middle = weights.tolist().index([0, 1, 0])
    for leg in (slice(0, middle), slice(middle, None)):
        assert motions[leg].max() < 1.05 * motions[leg].min()
    assert motions.max() < 1.2 * motions.min(), "legs differ by whole steps"
    steps = np.abs(np.diff(weights, axis=0)).max(axis=1)
    assert steps.max() > 1.5 * steps.min()
    by_weight = run("blend", blend_model, "--path", 41, "--even", "weights", "--json").json
    assert max(by_weight["path"]["motions"]) > 1.2 * motions.max()


def test_motions_are_those_of_the_written_vertices(run: Run, blend_model: Path) -> None:
    figures = run("blend", blend_model, "--path", 4, "--json").json
    session = load(blend_model).session()
    shapes = []
    for frame in figures["frames"]:
        session.blend(frame["weights"])
        shapes.append(session.vertices)
    wanted = np.linalg.norm(np.diff(shapes, axis=0), axis=2).max(axis=1)
    np.testing.assert_allclose(figures["path"]["motions"], wanted, rtol=1e-3)


@pytest.mark.parametrize("frames", [2, 3, 4, 12])
def test_poses_are_frames_if_there_are_enough(run: Run, blend_model: Path, frames: int) -> None:
    figures = run("blend", blend_model, "--path", frames, "--json").json
    weights = [frame["weights"] for frame in figures["frames"]]
    assert len(weights) == frames
    assert (weights[0], weights[-1]) == ([1, 0, 0], [0, 0, 1])
    assert ([0, 1, 0] in weights) == (frames > 2)


def distances(vertices: NDArray[np.float64]) -> NDArray[np.float64]:
    """Distances between all vertices, (n, n)."""
    between: NDArray[np.float64] = np.linalg.norm(vertices[:, None] - vertices, axis=2)
    return between


@pytest.fixture
def turning_model(tmp_path: Path) -> Path:
    """A slender cylinder that winds up and is twisted: it jumps once, and once turns as a whole."""
    size = {"length": 8.0, "radius": 0.2}
    wound = helix(1, 16, **size, turns=3.0, twist=6.0, coil_radius=0.4)
    problem = InterpolationProblem([cylinder(1, 16, **size), wound])
    snapshots = solve_snapshots(problem, np.linspace([1.0, 0.0], [0.0, 1.0], 21), threads=1)
    subspace = snapshot_pca(snapshots, dimension=12)
    path = tmp_path / "wound.snapspace"
    reduce(problem, subspace, snapshots=snapshots, threads=1).save(path)
    return path


def test_a_turn_of_the_whole_body_is_distinguished_from_a_jump(
    run: Run, turning_model: Path
) -> None:
    result = run("blend", turning_model, "--path", 40, "--json")
    jump, turn = result.json["path"]["jumps"]
    assert (jump["turns"], turn["turns"]) == (False, True)
    assert jump["deformation"] > 0.4 * jump["motion"]
    assert turn["deformation"] < 0.1 * turn["motion"] and turn["motion"] > jump["motion"]
    first, second = (line for line in result.err.splitlines() if "however small the step" in line)
    assert "the shape jumps by" in first and first.endswith("add poses between those of the path")
    assert "the body turns as a whole by" in second and "add poses" not in second

    # vertices leap in a step of 1e-4, and keep their distances from each other
    session, end, steps = load(turning_model).session(), turn["weights"][1], []
    for share in np.append(np.linspace(0, end - 5e-3, 400), end - np.arange(49, -1, -1) * 1e-4):
        before = session.vertices
        session.blend([1 - share, share])
        steps.append((before, session.vertices))
    before, after = max(steps[-3:], key=lambda step: np.abs(step[1] - step[0]).max())
    moved = np.linalg.norm(after - before, axis=1).max()
    assert moved > 0.9 * turn["motion"]
    assert np.abs(distances(after) - distances(before)).max() < 0.05 * moved


@pytest.fixture
def snapping_model(tmp_path: Path) -> Path:
    """A bar bent almost to a ring, to either side: in between, the energy has several minima."""
    mesh = bar(10, 1, 1, width=0.6, height=0.6)
    poses = Poses(np.stack([bent(mesh, 5.5), bent(mesh, -5.5)]), mesh.tets, names=["left", "right"])
    problem = InterpolationProblem(poses, material=StVK())
    weights = np.linspace([1.0, 0.0], [0.0, 1.0], 13)
    snapshots = solve_snapshots(problem, weights, threads=1)
    subspace = snapshot_pca(snapshots, dimension=8)
    path = tmp_path / "ring.snapspace"
    reduce(problem, subspace, snapshots=snapshots, threads=1).save(path)
    return path


def test_jumps_are_reported_with_their_frames_and_all_else_is_even(
    run: Run, snapping_model: Path
) -> None:
    result = run("blend", snapping_model, "--path", 40, "--json")
    motions, jumps = (result.json["path"][key] for key in ("motions", "jumps"))
    assert jumps and result.err.count("notice: the shape jumps") == len(jumps)
    even = np.median(motions)
    frames = {jump["frame"] for jump in jumps}
    far = {number for number, motion in enumerate(motions, start=1) if motion > 2 * even}
    assert far == frames, "the reported frames are those far from the frame before"
    session = load(snapping_model).session()
    for jump in jumps:
        assert jump["motion"] > 4 * even
        # steps of 1e-4 approach the jump, and one of them still leaps
        end, moved = jump["weights"][1], []
        for share in np.append(np.linspace(0, end - 5e-3, 400), end - np.arange(49, -1, -1) * 1e-4):
            before = session.vertices
            session.blend([1 - share, share])
            moved.append(np.linalg.norm(session.vertices - before, axis=1).max())
        assert max(moved[-3:]) > 0.9 * jump["motion"]
