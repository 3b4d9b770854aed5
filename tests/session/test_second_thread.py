"""Live solves on two threads are bitwise those on one, after a fork and with many callers, too."""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import Cubature, InterpolationProblem, TetMesh, affine_subspace
from snapspace import _core as core
from snapspace.cubature import BlendedCubature
from snapspace.reduction import handle_quadric

from ..shapes import bar_poses, bar_problem, irregular_bar

#: Work of more words is shared (core/online/half_runner.h).
SHARED_WORDS = 2**15
affinity = pytest.mark.skipif(
    not hasattr(os, "sched_setaffinity"), reason="this system cannot bind a process to a processor"
)


def waves(mesh: TetMesh, count: int) -> NDArray[np.float64]:
    """Smooth displacements (3n, count) along each axis."""
    x = mesh.vertices - mesh.vertices.mean(axis=0)
    frequencies = np.random.default_rng(5).normal(size=(3, count // 3))
    shares = np.cos(x @ frequencies / np.abs(x).max() + np.arange(count // 3))
    return np.einsum("np,ab->napb", shares, np.eye(3)).reshape(x.size, -1)


def blended_loop() -> core.BlendedCubatureLoop:
    """A loop with enough tets and dimensions to share its evaluations with a second thread."""
    poses = bar_poses(irregular_bar(10, 5, 5))
    problem = InterpolationProblem(poses, mean_shape=poses.shapes[0])
    space = affine_subspace(waves(problem.mesh, 24), problem)
    tets = np.arange(len(poses.tets), dtype=np.int32)
    cubature = BlendedCubature.of_tets(problem, space, tets, np.array(problem.mesh.volumes))
    assert cubature.rows.size > 2 * SHARED_WORDS
    return core.BlendedCubatureLoop(*cubature.core_arguments)


def posing_loop() -> core.CubatureLoop:
    """A loop with enough dimensions to share its inverse Hessian and the form of its handles."""
    problem = bar_problem(irregular_bar(10, 5, 5))
    space = affine_subspace(waves(problem.mesh, 192), problem)
    assert space.dimension**2 > SHARED_WORDS
    tets, volumes = np.arange(len(problem.mesh.tets), dtype=np.int32), problem.mesh.volumes
    cubature = Cubature.of_tets(problem, space, tets, np.array(volumes))
    energy = cubature.core_rows, cubature.weights, cubature.material.core
    form = handle_quadric(problem, space)
    return core.CubatureLoop(*energy, form.K, form.L, form.S)


def set_weights(loop: Any, t: float) -> None:
    loop.set_weights(np.array([1.0 - t, 0.7 * t, 0.3 * t]))


def set_offsets(loop: Any, t: float) -> None:
    """Moves the second handle along its axes, and stretches it."""
    offsets = np.zeros((3, 3, 4))
    offsets[1] = t * np.array([[0.1, 0, 0, 0.3], [0, 0.1, 0, 0.2], [0, 0, 0.1, -0.2]])
    loop.set_offsets(offsets)


#: The loops, and what sets their inputs between two shapes, t = 0 ... 1.
LOOPS: dict[str, tuple[Callable[[], Any], Callable[[Any, float], None]]] = {
    "blended": (blended_loop, set_weights),
    "posed": (posing_loop, set_offsets),
}


def walk(loop: Any, set_inputs: Callable[[Any, float], None], steps: int = 20) -> bytes:
    """The bits of all frames between two shapes."""
    loop.q = np.zeros(loop.dimension)
    frames = []
    for t in np.linspace(0.0, 1.0, steps):
        set_inputs(loop, t)
        loop.solve(
            method=core.Method.bfgs,
            tolerance=1e-9,
            max_iterations=200,
            max_evaluations=400,
            value_scale=1.0,
            coordinate_scale=1.0,
        )
        frames.append(loop.q)
    assert np.ptp(frames, axis=0).max() > 0.1  # the shape moves
    return np.array(frames).tobytes()


def walk_anew(name: str) -> bytes:
    make, set_inputs = LOOPS[name]
    return walk(make(), set_inputs)


def print_walk_on_one_processor(name: str) -> None:
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    sys.stdout.write(walk_anew(name).hex())


@affinity
@pytest.mark.parametrize("name", LOOPS)
def test_one_processor_gives_the_same_bits(name: str) -> None:
    code = f"from {__name__} import print_walk_on_one_processor as run; run({name!r})"
    alone = subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True, cwd=os.getcwd()
    )
    assert bytes.fromhex(alone.stdout) == walk_anew(name)


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux forks by default")
@pytest.mark.parametrize("name", LOOPS)
def test_a_forked_process_solves_without_the_thread_of_its_parent(name: str) -> None:
    expected = walk_anew(name)
    context = multiprocessing.get_context("fork")
    with context.Pool(1) as pool:
        assert pool.apply_async(walk_anew, (name,)).get(timeout=60) == expected


@pytest.mark.parametrize("name", LOOPS)
def test_many_callers_get_their_own_frames(name: str) -> None:
    """Hessians release Python's lock; concurrent solves do not disturb each other."""
    expected = walk_anew(name)
    make, set_inputs = LOOPS[name]

    def both(_: int) -> bytes:
        loop = make()
        loop.hessian(np.zeros(loop.dimension))
        return walk(loop, set_inputs)

    with ThreadPoolExecutor(4) as callers:
        assert set(callers.map(both, range(8))) == {expected}
