"""Live solves on two threads give the bits of one, also after a fork and with many callers."""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from snapspace import InterpolationProblem, affine_subspace
from snapspace import _core as core
from snapspace.cubature import BlendedCubature

from ..shapes import bar_poses, irregular_bar

D = 24
affinity = pytest.mark.skipif(
    not hasattr(os, "sched_setaffinity"), reason="this system cannot bind a process to a processor"
)


def large_loop() -> core.BlendedCubatureLoop:
    """A loop with enough tets and dimensions to share its evaluations with a second thread."""
    poses = bar_poses(irregular_bar(10, 5, 5))
    problem = InterpolationProblem(poses, mean_shape=poses.shapes[0])
    x = poses.shapes[0] - poses.shapes[0].mean(axis=0)
    frequencies = np.random.default_rng(5).normal(size=(3, D // 3))
    waves = np.cos(x @ frequencies / np.abs(x).max() + np.arange(D // 3))
    directions = np.einsum("np,ab->napb", waves, np.eye(3)).reshape(x.size, -1)
    space = affine_subspace(directions, problem)
    tets = np.arange(len(poses.tets), dtype=np.int32)
    cubature = BlendedCubature.of_tets(problem, space, tets, np.array(problem.mesh.volumes))
    assert cubature.rows.size > 2 * 2**16
    return core.BlendedCubatureLoop(*cubature.core_arguments)


def walk(loop: core.BlendedCubatureLoop, steps: int = 20) -> bytes:
    """The bits of all frames between two blends."""
    loop.q = np.zeros(loop.dimension)
    frames = []
    for t in np.linspace(0.0, 1.0, steps):
        loop.set_weights(np.array([1.0 - t, 0.7 * t, 0.3 * t]))
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


def print_walk_on_one_processor() -> None:
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    sys.stdout.write(walk(large_loop()).hex())


@affinity
def test_one_processor_makes_the_same_bits() -> None:
    code = f"from {__name__} import print_walk_on_one_processor as run; run()"
    alone = subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True, cwd=os.getcwd()
    )
    assert bytes.fromhex(alone.stdout) == walk(large_loop())


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux forks by default")
def test_a_forked_process_solves_without_the_thread_of_its_parent() -> None:
    expected = walk(large_loop())
    context = multiprocessing.get_context("fork")
    with context.Pool(1) as pool:
        assert pool.apply_async(_walk_anew).get(timeout=60) == expected


def _walk_anew() -> bytes:
    return walk(large_loop())


def test_many_callers_get_their_own_frames() -> None:
    """Hessians release Python's lock; concurrent solves do not disturb each other."""
    expected = walk(large_loop())

    def both(_: int) -> bytes:
        loop = large_loop()
        loop.hessian(np.zeros(D))
        return walk(loop)

    with ThreadPoolExecutor(4) as callers:
        assert set(callers.map(both, range(8))) == {expected}
