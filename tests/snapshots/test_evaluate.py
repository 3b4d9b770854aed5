"""Objectives of several samples at once equal those of each sample alone."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import InterpolationProblem, PosingProblem
from snapspace.snapshots.starts import lowest_start

from ..shapes import bar_problem, interpolation_problem

FloatArray = NDArray[np.float64]
COUNT = 11  # a pack and a part of one, for any width


def samples(problem: PosingProblem | InterpolationProblem) -> tuple[FloatArray, FloatArray]:
    """Displacements (k, 3n) and inputs (k, input_size)."""
    rng = np.random.default_rng(5)
    size = 0.05 * problem.mesh.diagonal
    shapes = problem.tau - problem.base + size * rng.normal(size=(COUNT, problem.base.size))
    if isinstance(problem, InterpolationProblem):
        return shapes, rng.dirichlet(np.ones(problem.parameter_count), size=COUNT)
    return shapes, size * rng.normal(size=(COUNT, problem.system.input_size))


@pytest.mark.parametrize("make", [interpolation_problem, bar_problem])
def test_values_and_gradients_equal_those_of_each_sample_alone(make) -> None:  # type: ignore[no-untyped-def]
    problem = make()
    shapes, inputs = samples(problem)
    values, gradients = problem.system.evaluate(shapes, inputs)
    for k in range(COUNT):
        value, gradient = problem.system.value_and_gradient(shapes[k], inputs[k])
        assert values[k] == pytest.approx(value, rel=1e-12)
        assert gradients[k] == pytest.approx(
            gradient, rel=1e-10, abs=1e-12 * np.abs(gradient).max()
        )


def test_neither_threads_nor_other_samples_matter() -> None:
    problem = interpolation_problem()
    shapes, inputs = samples(problem)
    values, gradients = problem.system.evaluate(shapes, inputs, threads=1)
    for threads in (2, 5):
        again = problem.system.evaluate(shapes, inputs, threads=threads)
        assert (again[0] == values).all() and (again[1] == gradients).all()
    alone = problem.system.evaluate(shapes[4:5], inputs[4:5])
    assert alone[0][0] == values[4] and (alone[1][0] == gradients[4]).all()


@pytest.mark.parametrize(("rows", "columns", "widths"), [(3, 0, 0), (4, 1, 0), (4, 0, 1)])
def test_rows_that_do_not_fit_are_refused(rows: int, columns: int, widths: int) -> None:
    system = interpolation_problem().system
    size, width = len(interpolation_problem().base), system.input_size
    needed = r"needs \(k, 3n\) displacements and \(k, input_size\) inputs"
    with pytest.raises(ValueError, match=needed):
        system.evaluate(np.zeros((4, size + columns)), np.zeros((rows, width + widths)))


def test_the_start_is_the_guess_of_least_energy() -> None:
    problem = interpolation_problem()
    shapes, inputs = samples(problem)
    calm = 0.01 * shapes
    guesses = [np.vstack([shapes[:5], calm[5:]]), np.vstack([calm[:5], shapes[5:]])]
    assert (lowest_start(problem.system, inputs, guesses) == calm).all()
