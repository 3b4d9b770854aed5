"""Exact or a cubature: chosen by material, dimension and the user's wish."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import (
    ARAP,
    MATERIALS,
    Cubature,
    InterpolationProblem,
    Material,
    PosingProblem,
    Quartic,
    Snapshots,
    StableNeoHookean,
    StVK,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.reduction import chosen_energy, fewest_snapshots, training_tolerance

from ..shapes import bar_poses, interpolation_problem, random_subspace
from ..snapshots.bars import posing_bar


@pytest.fixture(scope="module")
def snapshots() -> Snapshots:
    problem = posing_bar(material=StableNeoHookean())
    return solve_snapshots(problem, sample(problem.domain, 24, seed=1), threads=1)


@pytest.mark.parametrize("kind", sorted(MATERIALS))
def test_a_material_is_exact_where_its_density_is_a_quartic(kind: str) -> None:
    problem = posing_bar(material=MATERIALS[kind]())
    exact = kind == "stvk"
    assert chosen_energy(problem, 20) == ("exact" if exact else "cubature")
    assert chosen_energy(problem, 20, "cubature") == "cubature"
    assert fewest_snapshots(problem, 20) == (0 if exact else 10)
    if exact:
        assert chosen_energy(problem, 500, "exact") == "exact"
    else:
        message = f"{problem.material.title} is not a polynomial of degree four.*energy='cubature'"
        with pytest.raises(ValueError, match=message):
            chosen_energy(problem, 20, "exact")


def test_large_quartics_cost_more_than_they_are_worth() -> None:
    """They cost twice the multiply-adds of a cubature of 8 d tets: d^4 / 8 > 2 * 18 * 8 d^2."""
    problem = posing_bar()
    kinds = [chosen_energy(problem, d) for d in range(1, 300)]
    assert kinds == ["exact"] * 48 + ["cubature"] * 251


def test_interpolation_is_exact_at_any_dimension() -> None:
    problem = interpolation_problem()
    assert chosen_energy(problem, 200) == "exact"
    assert training_tolerance(problem, 200) is None
    assert chosen_energy(problem, 5, "cubature") == "cubature"


@pytest.mark.parametrize("kind", sorted(set(MATERIALS) - {"stvk"}))
def test_blends_of_other_materials_are_cubatures(kind: str) -> None:
    problem = InterpolationProblem(bar_poses(), material=MATERIALS[kind]())
    assert chosen_energy(problem, 5) == "cubature"
    with pytest.raises(ValueError, match="is not a polynomial of degree four"):
        chosen_energy(problem, 5, "exact")


def test_samples_that_train_a_cubature_are_tight() -> None:
    """Settled samples are not in equilibrium, and a cubature is trained on forces."""
    assert training_tolerance(posing_bar(), 40) is None
    assert training_tolerance(posing_bar(), 40, "cubature") == 1e-5
    assert training_tolerance(posing_bar(), 120) == 1e-5
    assert training_tolerance(posing_bar(material=ARAP()), 40) == 1e-7


def test_an_unknown_energy_is_named() -> None:
    with pytest.raises(ValueError, match="unknown energy 'quartic'; known are auto, exact, cuba"):
        chosen_energy(posing_bar(), 5, "quartic")  # type: ignore[arg-type]


def test_reduce_makes_the_chosen_energy(snapshots: Snapshots) -> None:
    papers = posing_bar()
    exact = reduce(papers, random_subspace(papers.mesh, 6), threads=1)
    assert isinstance(exact.elastic, Quartic)
    assert "cubature" not in exact.provenance
    subspace = snapshot_pca(snapshots, dimension=6)
    problem = snapshots.problem
    assert isinstance(problem, PosingProblem)
    model = reduce(problem, subspace, snapshots=snapshots, tets=40)
    assert isinstance(model.elastic, Cubature)
    assert model.provenance["cubature"]["tets"] == len(model.elastic.tets) <= 40


def test_the_option_tets_is_for_a_cubature() -> None:
    problem = posing_bar()
    with pytest.raises(ValueError, match="tets is for energy='cubature'"):
        reduce(problem, random_subspace(problem.mesh, 4), tets=20)


def test_an_error_says_what_a_cubature_needs(snapshots: Snapshots) -> None:
    problem, subspace = snapshots.problem, snapshot_pca(snapshots, dimension=6)
    assert isinstance(problem, PosingProblem)
    message = "energy of stable neo-Hookean in 6 dimensions is a cubature, .* there are 0; give"
    with pytest.raises(ValueError, match=message) as caught:
        reduce(problem, subspace)
    assert "exact" not in str(caught.value)
    few = snapshots.select(np.arange(24) < 9)
    with pytest.raises(ValueError, match=r"there are 9; give snapshots=.* with 10 samples or more"):
        reduce(problem, subspace, snapshots=few)


@pytest.mark.parametrize(
    "material", [StVK(lam=2.0), StableNeoHookean(lam=2.0), ARAP()], ids=lambda m: m.kind
)
def test_all_tets_with_their_volumes_are_the_whole_energy(material: Material) -> None:
    """Moduli differ from tet to tet."""
    mesh = posing_bar().mesh
    stiffer = 1.0 + np.random.default_rng(0).random(len(mesh.tets))
    material = type(material)(
        **{name: stiffer * getattr(material, name) for name in material.names()}
    )
    problem = posing_bar(material=material)
    subspace = random_subspace(mesh, 7)
    every = np.arange(len(mesh.tets), dtype=np.int32)
    cubature = Cubature.of_tets(problem, subspace, every, mesh.volumes)
    q = 0.3 * np.random.default_rng(2).normal(size=7)
    value, gradient = problem.energy.value_and_gradient(subspace.shape(q))
    assert cubature.value(q) == pytest.approx(value, rel=1e-5)
    reduced = subspace.basis.T @ gradient
    assert cubature.value_and_gradient(q)[1] == pytest.approx(
        reduced, abs=1e-5 * np.abs(reduced).max()
    )


def test_the_unit_of_energy_sums_the_moduli_of_tets(snapshots: Snapshots) -> None:
    mesh = posing_bar().mesh
    mu = 1.0 + np.random.default_rng(0).random(len(mesh.tets))
    for given, expected in ((3.0, 3.0 * mesh.volume), (mu, mu @ mesh.volumes)):
        problem = posing_bar(material=StVK(mu=given))  # type: ignore[arg-type]
        model = reduce(problem, random_subspace(mesh, 3), threads=1)
        assert model.value_scale == pytest.approx(0.01 * expected)
