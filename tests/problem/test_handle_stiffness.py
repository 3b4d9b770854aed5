"""The default stiffness of handles follows the body, so its unit of length does not matter."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from snapspace import (
    HandleBox,
    Handles,
    PosingProblem,
    StableNeoHookean,
    TetMesh,
    generators,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.problem import handle_misses, usual_stiffness

from ..shapes import bar_problem


def bar(scale: float, *, mu: float = 1.0, stiffness: float | None = None) -> PosingProblem:
    """A bar held at both ends, in some unit of length and pressure."""
    mesh = generators.bar(16, 3, 3, length=6.0)
    x = mesh.vertices[:, 0]
    return PosingProblem(
        TetMesh(scale * mesh.vertices, mesh.tets),
        Handles([x < 0.5, x > 5.5], names=["left", "right"]),
        domain=HandleBox(translation=0.8 * scale, angle=0.6),
        material=StableNeoHookean(lam=mu, mu=mu),
        stiffness=stiffness,
    )


def posed(problem: PosingProblem, scale: float) -> np.ndarray:
    """The vertices of a model for one motion, in the bar's own unit."""
    snapshots = solve_snapshots(problem, sample(problem.domain, 24, method="sobol"))
    assert snapshots.converged.all()
    subspace = snapshot_pca(snapshots, dimension=10)
    session = reduce(problem, subspace, snapshots=snapshots).session(tolerance=1e-12)
    session.move("right", euler=(0.3, 0.2, -0.4), translation=(-0.5 * scale, 0.2 * scale, 0.0))
    vertices: np.ndarray = session.vertices / scale
    return vertices


@pytest.mark.parametrize(("scale", "mu"), [(1e-3, 1.0), (1e3, 1.0), (1.0, 1e6)])
def test_a_model_is_the_same_in_any_unit(scale: float, mu: float) -> None:
    """Millimetres, metres, kilometres and other pressures agree up to the solvers' tolerance."""
    apart = np.abs(posed(bar(scale, mu=mu), scale) - posed(bar(1.0), 1.0)).max()
    assert apart < 1e-3


def test_solutions_follow_their_handles() -> None:
    problem = bar(0.01)
    snapshots = solve_snapshots(problem, sample(problem.domain, 8, method="sobol"))
    misses = handle_misses(problem, snapshots.parameters, snapshots.displacements)
    assert misses.shape == (8,) and misses.max() < 0.01
    soft = bar(0.01, stiffness=1000.0)
    loose = solve_snapshots(soft, snapshots.parameters)
    assert np.median(handle_misses(soft, snapshots.parameters, loose.displacements)) > 0.05


def test_misses_are_shares_of_the_motion() -> None:
    problem = bar_problem()
    parameters = sample(problem.domain, 3, method="sobol")
    rest = np.zeros((3, problem.base.size))
    assert handle_misses(problem, parameters, rest) == pytest.approx(1.0), "nothing has moved"
    exact = rest.copy().reshape(3, -1, 3)
    exact[:, problem.pinned] = problem.inputs(parameters).reshape(3, -1, 3)
    halfway = 0.5 * exact.reshape(3, -1)
    assert handle_misses(problem, parameters, exact.reshape(3, -1)) == pytest.approx(0.0)
    assert handle_misses(problem, parameters, halfway) == pytest.approx(0.5)
    still = np.zeros((1, problem.parameter_count))
    assert handle_misses(problem, still, rest[:1]) == 0.0


def test_stiff_parts_count_by_their_volume() -> None:
    problem = bar(1.0)
    mesh, usual = problem.mesh, problem.stiffness
    assert usual == usual_stiffness(mesh, problem.material)
    mu = np.ones(len(mesh.tets))
    half = np.cumsum(mesh.volumes) < 0.5 * mesh.volume
    mu[half] = 3.0
    partly = usual_stiffness(mesh, replace(problem.material, mu=mu))
    share = mesh.volumes[half].sum() / mesh.volume
    assert partly == pytest.approx(usual * (1.0 + 2.0 * share))
