"""What L-BFGS asks of a sample is bitwise the same in packs of every width.

Solvers get narrower towards the end of their work, and when they do depends on the number of
threads. A compiler may contract either product of x * y + z * w to a multiply-add, and does not
choose the same one for every width.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    ARAP,
    InterpolationProblem,
    Material,
    PosingProblem,
    ShellMesh,
    StableNeoHookean,
    StVK,
    sample,
)

from ..energy.densities import KINDS, varied
from ..shapes import bar_poses, bar_problem
from ..shells.strips import strip, strip_problem

FloatArray = NDArray[np.float64]
Problem = PosingProblem | InterpolationProblem


def posed_tets(kind: type[Material]) -> Problem:
    problem = bar_problem()
    material = varied(kind, len(problem.mesh.tets))
    return PosingProblem(problem.mesh, problem.handles, domain=problem.domain, material=material)


def blended_tets(kind: type[Material]) -> Problem:
    poses = bar_poses()
    return InterpolationProblem(poses, material=varied(kind, len(poses.tets)))


def posed_strip(kind: type[Material]) -> Problem:
    mesh = strip()
    return strip_problem(mesh, material=varied(kind, len(mesh.triangles)))


def blended_strips(kind: type[Material]) -> Problem:
    mesh = strip(12, 3)
    shapes = mesh.vertices, mesh.vertices * [1.2, 1.5, 0.9], mesh.vertices * [0.8, 1.0, 2.0]
    poses = [ShellMesh(shape, mesh.triangles, thickness=mesh.thickness) for shape in shapes]
    return InterpolationProblem(poses, material=varied(kind, len(mesh.triangles)))


CASES = [
    *((make, kind) for make in (posed_tets, blended_tets) for kind in KINDS),
    *(
        (make, kind)
        for make in (posed_strip, blended_strips)
        for kind in (StableNeoHookean, StVK, ARAP)
    ),
]


def in_packs(
    problem: Problem, shapes: FloatArray, inputs: FloatArray, *, single: bool
) -> Iterator[tuple[FloatArray, ...]]:
    """Values, gradients and images of the samples for each width that the processor has."""
    for width in (2, 4, 8, 16):
        try:
            found = problem.system.evaluate_in_pack(shapes, inputs, width=width, single=single)
        except ValueError as error:
            assert "a width of packs that this processor has" in str(error)
            return
        yield found


@pytest.mark.parametrize("single", [False, True])
@pytest.mark.parametrize(
    ("make", "kind"), CASES, ids=lambda case: getattr(case, "kind", None) or case.__name__
)
def test_packs_of_every_width_give_the_same_bits(
    make: Callable[[type[Material]], Problem], kind: type[Material], single: bool
) -> None:
    problem = make(kind)
    rng = np.random.default_rng(5)
    at_rest, inputs = problem.tau - problem.base, problem.inputs(sample(problem.domain, 2, seed=1))
    for size in (1e-6, 1e-3, 0.02):
        noise = rng.normal(size=(2, problem.base.size))
        shapes = at_rest + size * problem.mesh.diagonal * noise
        first, *others = in_packs(problem, shapes, inputs, single=single)
        assert others or not single, "at least two widths in single precision"
        for found in others:
            for name, one, other in zip(
                ("values", "gradients", "products", "images"), first, found, strict=True
            ):
                np.testing.assert_array_equal(one, other, err_msg=f"{name} at {size}")
