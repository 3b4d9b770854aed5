"""Subspaces that are widened by parts of snapshots."""

from __future__ import annotations

import importlib

import numpy as np
import pytest

from snapspace import (
    AffineSubspace,
    HandleBox,
    Handles,
    PosingProblem,
    Snapshots,
    affine_subspace,
    handle_windows,
    snapshot_pca,
    solve_snapshots,
    widen,
)
from snapspace.generators import bar
from snapspace.mesh import mass_gram

from ..shapes import interpolation_problem

COUNT = 12


def two_ended_bar(*, box: HandleBox | None = None) -> PosingProblem:
    """A bar that is held in its middle, and both of whose ends move."""
    mesh = bar(16, 2, 2)
    x = mesh.vertices[:, 0] / mesh.vertices[:, 0].max()
    handles = Handles([abs(x - 0.5) < 0.1, x < 0.06, x > 0.94], names=["middle", "left", "right"])
    return PosingProblem(mesh, handles, domain=box or HandleBox(translation=0.4, angle=0.6))


def motions(count: int) -> np.ndarray:
    """Random motions of both ends, (count, 12)."""
    return 0.4 * np.random.default_rng(3).uniform(-1.0, 1.0, (count, 12))


@pytest.fixture(scope="module")
def together() -> Snapshots:
    """Samples that move both ends."""
    return solve_snapshots(two_ended_bar(), motions(COUNT))


@pytest.fixture(scope="module")
def whole(together: Snapshots) -> AffineSubspace:
    return snapshot_pca(together, dimension=COUNT)


def projection_errors(subspace: AffineSubspace, snapshots: Snapshots) -> np.ndarray:
    shapes = snapshots.shapes
    left = shapes - subspace.shapes(subspace.coordinates(shapes))
    squares = [np.diag(mass_gram(subspace.mass, d, d)) for d in (left, shapes - subspace.tau)]
    errors: np.ndarray = np.sqrt(squares[0] / squares[1])
    return errors


@pytest.mark.parametrize("moving", [1.0, 0.0])
def test_windows_add_up_to_one_and_tell_the_handles_apart(moving: float) -> None:
    bounds = np.array([[0.4] * 3, [0.4 * moving] * 3])  # a handle that is at rest has a window too
    problem = two_ended_bar(box=HandleBox(translation=bounds, angle=bounds, moving=2))
    windows = handle_windows(problem)
    assert windows.shape == (3, len(problem.mesh.vertices))
    np.testing.assert_allclose(windows.sum(axis=0), 1.0, rtol=0, atol=1e-14)
    for window, own in zip(windows, problem.handles, strict=True):
        for handle in problem.handles:
            wanted = 1.0 if handle is own else 0.0
            np.testing.assert_allclose(window[handle.vertices], wanted, rtol=0, atol=0.02)
    x = problem.mesh.vertices[:, 0]
    along = [windows[1][x == place].mean() for place in np.unique(x)]
    assert (np.diff(along) < 0.01).all(), "the body follows less and less"


def test_parts_of_few_snapshots_do_what_many_would(
    together: Snapshots, whole: AffineSubspace
) -> None:
    parameters = motions(COUNT)
    exchanged = np.hstack([parameters[:, :6], parameters[::-1, 6:]])
    unseen = solve_snapshots(together.problem, exchanged)
    wide = widen(whole, together, dimension=2 * COUNT)
    assert (projection_errors(wide, unseen) < 0.6 * projection_errors(whole, unseen)).all()


@pytest.mark.parametrize("dimension", [5, COUNT, 2 * COUNT])
def test_a_widened_basis_is_orthonormal_nested_and_knows_the_snapshots(
    together: Snapshots, whole: AffineSubspace, dimension: int
) -> None:
    wide = widen(whole, together, dimension=dimension)
    assert wide.dimension == dimension
    gram = mass_gram(wide.mass, wide.basis.T, wide.basis.T)
    np.testing.assert_allclose(gram, np.eye(dimension), rtol=0, atol=1e-12)
    largest = wide.basis[np.abs(wide.basis).argmax(axis=0), np.arange(dimension)]
    assert (largest > 0).all()
    more = widen(whole, together, dimension=dimension + 3)
    np.testing.assert_allclose(more.basis[:, :dimension], wide.basis, rtol=0, atol=1e-9)
    left = together.shapes - wide.shapes(wide.coordinates(together.shapes))
    energies = wide.snapshot_energies
    assert energies is not None and whole.snapshot_energies is not None
    np.testing.assert_allclose(
        energies[dimension:].sum(), np.trace(mass_gram(wide.mass, left, left)), rtol=1e-6
    )
    np.testing.assert_allclose(energies.sum(), whole.snapshot_energies.sum(), rtol=1e-12)


def test_one_window_of_ones_changes_nothing(together: Snapshots, whole: AffineSubspace) -> None:
    problem = two_ended_bar()
    ones = np.ones((1, len(problem.mesh.vertices)))
    same = widen(whole, together, dimension=4 * COUNT, windows=ones)
    assert same.dimension == COUNT, "there are not as many independent directions"
    turned = whole.basis.T @ np.kron(whole.mass.toarray(), np.eye(3)) @ same.basis
    np.testing.assert_allclose(turned @ turned.T, np.eye(COUNT), rtol=0, atol=1e-9)


def test_a_fit_to_some_vertices_is_as_good(
    together: Snapshots, whole: AffineSubspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    problem = two_ended_bar()
    unseen = solve_snapshots(problem, motions(2 * COUNT)[COUNT:])
    every = projection_errors(widen(whole, together, dimension=2 * COUNT), unseen)
    module = importlib.import_module("snapspace.subspace.widen")
    monkeypatch.setattr(module, "VERTICES", len(problem.mesh.vertices) // 3)
    some = projection_errors(widen(whole, together, dimension=2 * COUNT), unseen)
    assert some.mean() < 1.2 * every.mean()


def test_any_number_of_threads_gives_the_same_bits(
    together: Snapshots, whole: AffineSubspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = widen(whole, together, dimension=20)
    monkeypatch.setattr("os.cpu_count", lambda: 1)
    second = widen(whole, together, dimension=20)
    np.testing.assert_array_equal(first.basis, second.basis)


@pytest.mark.parametrize(
    ("windows", "message"),
    [
        (np.ones(5), r"widen: windows have shape \(5,\), but must be \(r, 153\)"),
        (np.ones((0, 153)), r"windows have shape \(0, 153\)"),
        (np.full((2, 153), np.nan), "window 0 has a weight that is not finite"),
    ],
)
def test_bad_windows(
    together: Snapshots, whole: AffineSubspace, windows: np.ndarray, message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        widen(whole, together, dimension=5, windows=windows)


def test_bad_dimension_weight_and_subspace(together: Snapshots, whole: AffineSubspace) -> None:
    with pytest.raises(ValueError, match="widen: dimension is 0, but must be at least 1"):
        widen(whole, together, dimension=0)
    with pytest.raises(ValueError, match="widen: handle_weight is -1, but must be finite and not"):
        widen(whole, together, dimension=5, handle_weight=-1)
    shorter = AffineSubspace(whole.tau[:-3], whole.basis[:-3], whole.mass[:-1, :-1], np.ones(1))
    with pytest.raises(
        ValueError, match="widen: the subspace is of 152 vertices, but the snapshot"
    ):
        widen(shorter, together, dimension=5)
    own = affine_subspace(whole.basis[:, :3], together.problem)
    with pytest.raises(ValueError, match="widen: the subspace has no energies"):
        widen(own, together, dimension=5)


def test_blends_have_no_handles() -> None:
    problem = interpolation_problem()
    weights = np.array([[0.5, 0.5, 0.0], [0.2, 0.3, 0.5], [0.0, 0.4, 0.6]])
    blends = solve_snapshots(problem, weights)
    subspace = snapshot_pca(blends, dimension=2)
    with pytest.raises(ValueError, match="only handles can split snapshots"):
        widen(subspace, blends, dimension=2)
