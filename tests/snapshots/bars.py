"""Bars to pose: small, quick, and with motions too mild to invert tets."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from snapspace import (
    Handles,
    PosingProblem,
    SampleReport,
    Snapshots,
    SolverOptions,
    StVK,
    sample,
)
from snapspace import _core as core
from snapspace.generators import bar
from snapspace.problem import HandleBox
from snapspace.snapshots.solver_options import Solver

FloatArray = NDArray[np.float64]


def posing_bar(
    nx: int = 8, ny: int = 2, nz: int = 2, *, bound: float = 0.25, **options: Any
) -> PosingProblem:
    """A bar of length 4, held at its foot, its tip moved by up to `bound` units and radians.

    The material is the paper's unless the options say otherwise: its reduced energy is exact.
    """
    mesh = bar(nx, ny, nz)
    x = mesh.vertices[:, 0]
    handles = Handles([x < 0.6, x > 3.4], names=["foot", "tip"])
    domain = HandleBox(translation=bound, angle=bound)
    usual = {"material": StVK(), "stiffness": 1000.0}
    return PosingProblem(mesh, handles, domain=domain, **{**usual, **options})


def parameters(problem: PosingProblem, count: int, *, seed: int = 3) -> FloatArray:
    return sample(problem.domain, count, seed=seed)


def tight(solver: Solver = "newton") -> SolverOptions:
    """Options to converge as far as double precision goes."""
    return SolverOptions(solver=solver, tolerance=1e-14)


def core_solve(
    problem: PosingProblem,
    solver: Solver,
    targets: FloatArray,
    starts: FloatArray,
    *,
    tolerance: float,
    max_iterations: int,
    **widths: int,
) -> core.Batch:
    """One call of the compiled solver, on one thread: targets (k, p, 3), starts (k, 3n).

    `widths` are the options lanes and single of the fast solver.
    """
    options: dict[str, Any] = {
        "tolerance": tolerance,
        "max_iterations": max_iterations,
        "threads": 1,
        "control": core.SolveControl(),
    }
    if solver == "newton":
        return problem.system.solve_newton(
            targets.reshape(len(targets), -1),
            starts,
            projection=core.Projection.stretches,
            threshold=0.6,
            **options,
        )
    return problem.system.solve_fast(targets.reshape(len(targets), -1), starts, **widths, **options)


def without_seconds(snapshots: Snapshots) -> list[SampleReport]:
    """Reports without the wall time, the only entry that may differ between equal runs."""
    return [replace(report, seconds=0.0) for report in snapshots.reports]


def assert_same_bits(a: Snapshots, b: Snapshots) -> None:
    np.testing.assert_array_equal(a.shapes, b.shapes)
    assert without_seconds(a) == without_seconds(b)
