"""The whole material counts: in moduli per tet, in the fingerprint, and in solver options."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from snapspace import (
    MATERIALS,
    HandleBox,
    InterpolationProblem,
    Material,
    PosingProblem,
    SolverOptions,
    StableNeoHookean,
    StVK,
)

from ..shapes import bar_poses, bar_problem

PROBLEM = bar_problem()
TETS = len(PROBLEM.mesh.tets)


def posing(material: Material | None = None) -> PosingProblem:
    domain = HandleBox(translation=0.8, angle=0.8)
    return PosingProblem(PROBLEM.mesh, PROBLEM.handles, domain=domain, material=material)


def test_the_default_is_stable_neo_hookean() -> None:
    assert posing().material == StableNeoHookean(lam=1.0, mu=1.0)
    assert InterpolationProblem(bar_poses()).material == StableNeoHookean(lam=1.0, mu=1.0)


def test_moduli_are_for_all_tets_of_the_mesh() -> None:
    mu = np.linspace(1, 2, TETS)
    assert posing(StVK(mu=mu)).system.input_size
    message = f"PosingProblem: .*moduli for {TETS - 1} tets, but the mesh has {TETS}; give one"
    with pytest.raises(ValueError, match=message):
        posing(StVK(mu=mu[1:]))
    with pytest.raises(ValueError, match=r"InterpolationProblem: .*moduli for 2 tets"):
        InterpolationProblem(bar_poses(), material=StVK(mu=[1.0, 2.0]))  # type: ignore[arg-type]


def test_fingerprints_hold_the_whole_material() -> None:
    """Two materials with the same moduli, or moduli that differ in one tet, are not the same."""
    one = np.ones(TETS)
    other = one.copy()
    other[7] = 1.5
    materials = [kind() for kind in MATERIALS.values()]
    materials += [StVK(lam=2.0), StVK(mu=one), StVK(mu=other), StVK(lam=other)]
    prints = {posing(material).fingerprint for material in materials}
    assert len(prints) == len(materials)
    stiffer = InterpolationProblem(bar_poses(), material=StVK(mu=2.0))
    assert stiffer.fingerprint != InterpolationProblem(bar_poses()).fingerprint


def test_a_problem_travels_with_its_material() -> None:
    problem = posing(StableNeoHookean(mu=np.linspace(1, 2, TETS)))
    again = pickle.loads(pickle.dumps(problem))
    assert again.material == problem.material
    assert again.fingerprint == problem.fingerprint
    assert problem.with_handles(problem.handles).material is problem.material


@pytest.mark.parametrize("kind", sorted(MATERIALS))
def test_samples_settle_where_only_shapes_count_and_are_tight_where_forces_do(kind: str) -> None:
    """An exact quartic needs shapes; a cubature is trained on forces at the samples."""
    options = SolverOptions().resolved(posing(MATERIALS[kind]()))
    if MATERIALS[kind].exact_degree == 4:
        assert options.settling == 1e-2
    else:
        assert options.settling == 0
        assert options.tolerance == 1e-7


def test_nearly_incompressible_materials_are_solved_more_tightly() -> None:
    """The scalar factor's steps are too small by (2 mu + lam) / mu, the ratio of moduli."""
    tolerances = [
        SolverOptions().resolved(posing(material)).tolerance
        for material in (
            StableNeoHookean(lam=0.0),
            StableNeoHookean(lam=1.0),
            StableNeoHookean(lam=7.0),
            StableNeoHookean(lam=7.0, mu=np.append(np.full(TETS - 1, 10.0), 1.0)),
        )
    ]
    assert tolerances == pytest.approx([1e-7, 1e-7, 1e-7 / 3.0, 1e-7 / 3.0])


def test_newtons_method_projects_as_the_paper_does_for_its_material() -> None:
    papers, other = posing(StVK()), posing()
    assert SolverOptions(solver="newton").resolved(papers).projection == "stretches"
    assert SolverOptions(solver="newton").resolved(other).projection == "clamp"
    absolute = SolverOptions(solver="newton", projection="absolute")
    assert absolute.resolved(papers).projection == "absolute"
    with pytest.raises(ValueError, match="unknown projection 'none'; known are stretches, clamp"):
        SolverOptions(projection="none")  # type: ignore[arg-type]


def test_single_precision_is_for_energies_in_its_range() -> None:
    """All tets are checked: those of a soft or stiff part may leave the range of single numbers."""
    usual = np.ones(TETS)
    soft, stiff = usual.copy(), usual.copy()
    soft[3], stiff[3] = 1e-30, 1e30
    options = SolverOptions(tolerance=1e-4)
    for mu, single in ((1.0, True), (usual, True), (soft, False), (stiff, False), (1e-30, False)):
        assert options.resolved(posing(StVK(lam=1e-40, mu=mu))).single == single, mu
