"""Arguments that are not what they claim to be are refused, and long work is announced."""

from __future__ import annotations

import math
import time
import warnings
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import snapspace as ss
from snapspace.generators import bar
from snapspace.reduction import LongWorkNotice, exact_seconds, quartic_cost, reduced_quartic

from ..shapes import bar_poses, bar_problem


@dataclass(frozen=True, eq=False)
class StiffStVK(ss.StVK):
    """A user's own density; the core would compute that of StVK instead."""

    def energy(self) -> float:
        return 7.0


NO_MATERIALS: list[tuple[Any, str]] = [
    ("stvk", "material is 'stvk' of type str, but it must be one of StableNeoHookean, "),
    (ss.StVK, "material is the class StVK; give an instance, such as StVK.from_lame"),
    (StiffStVK(lam=1.0, mu=1.0), "of type StiffStVK, but it must be one of "),
    (SimpleNamespace(kind="stvk", check_tets=lambda *_: None), "of type SimpleNamespace, but"),
    ({"model": "stvk"}, "of type dict, but it must be one of "),
]


@pytest.mark.parametrize(("material", "message"), NO_MATERIALS)
def test_objects_that_are_not_materials_are_refused(material: Any, message: str) -> None:
    problem = bar_problem()
    for who, make in (
        ("PosingProblem", lambda: ss.PosingProblem(
            problem.mesh, problem.handles, domain=problem.domain, material=material
        )),
        ("InterpolationProblem", lambda: ss.InterpolationProblem(bar_poses(), material=material)),
        ("ElasticEnergy", lambda: ss.ElasticEnergy(problem.mesh, material)),
    ):  # fmt: skip
        with pytest.raises(ValueError) as caught:
            make()
        assert str(caught.value).startswith(f"{who}: material is ")
        assert message in str(caught.value)


@pytest.fixture
def subspace(posing_snapshots: ss.Snapshots) -> ss.AffineSubspace:
    return ss.snapshot_pca(posing_snapshots, dimension=12)


BASES = {
    "longer": lambda basis: 1.01 * basis,
    "one column longer": lambda basis: basis * (1.0 + 0.01 * (np.arange(12) == 7)),
    "a column twice": lambda basis: basis[:, [*range(11), 0]],
    "skew": lambda basis: basis + 0.01 * basis[:, ::-1],
    "euclidean": lambda basis: np.linalg.qr(basis)[0],
    "not finite": lambda basis: np.where(np.arange(12) == 3, np.nan, basis),
}


@pytest.mark.parametrize("change", BASES.values(), ids=BASES)
def test_a_basis_that_is_not_orthonormal_is_refused(
    posing_snapshots: ss.Snapshots, subspace: ss.AffineSubspace, change: Any
) -> None:
    """Errors, coordinates and stopping tests rely on U^T M U = I."""
    wrong = replace(subspace, basis=np.asfortranarray(change(subspace.basis)))
    with pytest.raises(ValueError, match=r"reduce: the basis of the subspace (is not M-o|has num)"):
        ss.reduce(posing_snapshots.problem, wrong, snapshots=posing_snapshots)


def test_a_basis_in_single_precision_is_orthonormal_enough(
    posing_snapshots: ss.Snapshots, subspace: ss.AffineSubspace
) -> None:
    ss.reduce(posing_snapshots.problem, subspace.in_single_precision(), snapshots=posing_snapshots)


@pytest.mark.parametrize("threads", [10**30, 2**31, -1])
def test_impossible_numbers_of_threads_are_refused(
    posing_snapshots: ss.Snapshots, subspace: ss.AffineSubspace, threads: int
) -> None:
    problem, parameters = posing_snapshots.problem, posing_snapshots.parameters[:2]
    with pytest.raises(ValueError, match=f"reduce: threads is {threads}, but must be between 1 "):
        ss.reduce(problem, subspace, threads=threads)
    with pytest.raises(ValueError, match=f"solve_snapshots: threads is {threads}, but must be "):
        ss.solve_snapshots(problem, parameters, threads=threads)


def test_the_cost_of_a_quartic_grows_with_coefficients_and_poses() -> None:
    problem = bar_problem()
    poses = ss.InterpolationProblem(bar_poses(), material=ss.StVK(lam=1.0, mu=1.0))
    per_tet = exact_seconds(problem, 20) / len(problem.mesh.tets)
    assert exact_seconds(poses, 20) == pytest.approx(3 * len(poses.mesh.tets) * per_tet)
    growth = exact_seconds(problem, 40) / exact_seconds(problem, 20)
    assert growth == pytest.approx(math.comb(44, 4) / math.comb(24, 4))


def test_the_cost_is_within_an_order_of_magnitude() -> None:
    """A shared machine may be slower, and one with many cores faster."""
    mesh = bar(10, 5, 5)
    problem = SimpleNamespace(mesh=mesh)
    energy = ss.ElasticEnergy(mesh, ss.StVK(lam=1.0, mu=1.0))
    basis = np.linalg.qr(np.random.default_rng(0).normal(size=(mesh.vertices.size, 30)))[0]
    subspace = ss.AffineSubspace(mesh.vertices.ravel(), basis, ss.mass_matrix(mesh))
    begin = time.perf_counter()
    reduced_quartic(energy, subspace, threads=1)
    seconds = time.perf_counter() - begin
    assert 0.1 < seconds / exact_seconds(problem, 30) < 20  # type: ignore[arg-type]


def test_a_warning_announces_a_quartic_of_more_than_a_minute_and_names_the_cure(
    posing_snapshots: ss.Snapshots, subspace: ss.AffineSubspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    problem = posing_snapshots.problem
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ss.reduce(problem, subspace, energy="exact")
    monkeypatch.setattr(quartic_cost, "_SECONDS", 1.0)
    with pytest.warns(LongWorkNotice, match=r"1820 coefficients .* energy='cubature'"):
        ss.reduce(problem, subspace, energy="exact")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ss.reduce(problem, subspace, energy="cubature", snapshots=posing_snapshots)


def test_angles_that_look_like_degrees_give_a_warning(posing_model: ss.PosingModel) -> None:
    session = posing_model.session()
    name = posing_model.problem.handles.names[1]
    with pytest.warns(UserWarning, match=r"euler of .* 45 radians, .* np\.deg2rad") as caught:
        session.move(name, euler=(0, 0, 45))
    assert caught[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        session.move(name, euler=(0, 0, -6.28))
