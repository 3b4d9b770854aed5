"""Moduli of materials: numbers or one per tet; checks, comparison, pickling."""

from __future__ import annotations

import math
import pickle
from typing import Any

import numpy as np
import pytest

from snapspace import ARAP, MATERIALS, Material, StableNeoHookean, StVK
from snapspace.material import DEFAULT_MATERIAL, material_class

KINDS = list(MATERIALS.values())
MU = np.array([1.0, 2.0, 0.5])


@pytest.fixture(params=KINDS, ids=sorted(MATERIALS))
def kind(request: pytest.FixtureRequest) -> type[Material]:
    made: type[Material] = request.param
    return made


def test_the_registry_has_every_material_under_its_name() -> None:
    assert all(MATERIALS[material.kind] is material for material in KINDS)
    assert all(material_class(material.kind) is material for material in KINDS)
    assert DEFAULT_MATERIAL is StableNeoHookean
    with pytest.raises(ValueError, match=r"unknown material 'foo'; known are arap, coro.*, stvk"):
        material_class("foo")


def test_the_core_has_every_material_with_the_same_moduli_in_the_same_order() -> None:
    from snapspace import _core as core

    assert {k: tuple(names) for k, names in core.material_moduli().items()} == {
        material.kind: material.names() for material in KINDS
    }


def test_youngs_modulus_and_poisson_ratio_are_those_of_a_pulled_bar() -> None:
    """Hooke's law 2 mu e + lam tr(e) I: strain diag(1, -nu, -nu) has stress diag(E, 0, 0)."""
    youngs_modulus, poisson_ratio = 2.5, 0.3
    material = StVK.from_young(youngs_modulus=youngs_modulus, poisson_ratio=poisson_ratio)
    strain = np.diag([1.0, -poisson_ratio, -poisson_ratio])
    stress = 2 * material.mu * strain + material.lam * np.trace(strain) * np.eye(3)
    assert stress == pytest.approx(np.diag([youngs_modulus, 0.0, 0.0]), abs=1e-12)


def test_the_default_moduli_are_those_of_the_paper(kind: type[Material]) -> None:
    assert StVK() == StVK(lam=1.0, mu=1.0)
    assert kind().mu == 1.0
    assert kind().uniform
    assert kind().moduli.shape == (1, len(kind.names()))


def test_every_material_can_be_made_from_lames_parameters(kind: type[Material]) -> None:
    """Materials without a volume term ignore lam and report it as zero."""
    material = kind.from_lame(lam=3.0, mu=0.5)
    assert material.mu == 0.5
    assert material.lam == (3.0 if "lam" in kind.names() else 0.0)
    assert material.stiffness == 2 * material.mu + material.lam


def test_a_ratio_of_049_is_nearly_incompressible_and_allowed(kind: type[Material]) -> None:
    material = kind.from_young(youngs_modulus=2.98, poisson_ratio=0.49)
    assert material.mu == pytest.approx(1.0)
    if material.lam:
        assert material.lam == pytest.approx(49.0)  # 2 mu nu / (1 - 2 nu)


def test_young_and_poisson_may_differ_from_tet_to_tet(kind: type[Material]) -> None:
    material = kind.from_young(youngs_modulus=2.5 * MU, poisson_ratio=[0.25, 0.25, 0.0])
    assert material.mu[:2] == pytest.approx(MU[:2])
    assert material.mu[2] == pytest.approx(0.625)
    assert not material.uniform
    assert len(material.moduli) == 3


def test_a_material_without_volume_term_is_allowed() -> None:
    assert StVK(lam=0.0).lam == 0.0
    assert StVK.from_young(youngs_modulus=1.0, poisson_ratio=0.0).lam == 0.0


def test_arrays_have_one_number_per_tet() -> None:
    material = StVK(lam=2.0, mu=MU)
    assert material.moduli.tolist() == [[2.0, 1.0], [2.0, 2.0], [2.0, 0.5]]
    assert material.stiffness.tolist() == [4.0, 6.0, 3.0]
    with pytest.raises(ValueError, match="read-only"):
        material.mu[0] = 5.0
    material.check_tets(3, "here")
    with pytest.raises(ValueError, match=r"here: .*moduli for 3 tets, but the mesh has 4; give"):
        material.check_tets(4, "here")
    StVK().check_tets(4, "here")


def test_the_material_of_some_tets_has_their_moduli_in_their_order() -> None:
    some = StVK(lam=2.0, mu=MU).of_tets(np.array([2, 0]))
    assert some == StVK(lam=[2.0, 2.0], mu=[0.5, 1.0])  # type: ignore[arg-type]
    one = StVK(lam=2.0)
    assert one.of_tets(np.array([2, 0])) is one


def test_materials_are_equal_if_kind_and_moduli_are() -> None:
    same = StVK(lam=2.0, mu=MU), StVK(lam=np.full(3, 2.0), mu=MU.copy())
    assert same[0] == same[1]
    assert hash(same[0]) == hash(same[1])
    assert same[0].key == same[1].key
    others: list[Any] = [
        StableNeoHookean(lam=2.0, mu=MU),
        StVK(lam=2.0, mu=MU[::-1]),
        StVK(lam=2.0, mu=MU + 1e-15),
        StVK(lam=2.0),
        "stvk",
    ]
    for other in others:
        assert same[0] != other
    assert len({*same, *others}) == 1 + len(others)


def test_the_key_depends_on_every_modulus_of_every_tet(kind: type[Material]) -> None:
    names = kind.names()
    given = [kind(), kind(**dict.fromkeys(names, MU))]
    given += [kind(**{name: MU + 0.5 * np.eye(3)[tet]}) for name in names for tet in range(3)]
    keys = {tuple(material.key) for material in given}
    assert len(keys) == len(given)


def test_materials_are_pickled_without_their_compiled_part(kind: type[Material]) -> None:
    for material in (kind(), kind.from_lame(lam=1.0, mu=MU)):
        _ = material.core
        again = pickle.loads(pickle.dumps(material))
        assert again == material
        assert type(again) is kind
        assert "core" not in vars(again)
        assert repr(again) == repr(material)


@pytest.mark.parametrize("wrong", [-1.0, math.nan, math.inf])
def test_moduli_must_be_finite_and_not_negative(kind: type[Material], wrong: float) -> None:
    for name in kind.names():
        with pytest.raises(ValueError, match=rf"{kind.__name__}: {name} is .*must be"):
            kind(**{name: wrong})
        with pytest.raises(ValueError, match=rf"{kind.__name__}: {name} of tet 1 is .*must be"):
            kind(**{name: [1.0, wrong, 1.0]})


def test_the_shear_modulus_must_be_positive(kind: type[Material]) -> None:
    with pytest.raises(ValueError, match=rf"{kind.__name__}: mu.* must be positive"):
        kind.from_lame(lam=1.0, mu=0.0)


@pytest.mark.parametrize("lam", [-1e-3, math.nan, math.inf])
def test_lam_must_not_be_negative(lam: float) -> None:
    with pytest.raises(ValueError, match=r"StVK: lam is .*must be zero or positive"):
        StVK(lam=lam)
    with pytest.raises(ValueError, match=r"StVK: lam of tet 0 is .*must be zero or positive"):
        StVK(lam=[lam, 1.0])  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ("soft", "mu must be a number, or one per tet, got 'soft'"),
        (None, "mu is nan"),
        ([], r"mu has shape \(0,\)"),
        (np.ones((2, 2)), r"mu has shape \(2, 2\)"),
        ([[1.0], [1.0, 2.0]], "mu must be a number, or one per tet"),
    ],
)
def test_values_that_are_not_numbers_are_refused(wrong: Any, message: str) -> None:
    with pytest.raises(ValueError, match=f"ARAP: {message}"):
        ARAP(mu=wrong)


def test_moduli_of_different_numbers_of_tets_do_not_go_together() -> None:
    with pytest.raises(ValueError, match="StVK: moduli of 2 and 3 tets do not match"):
        StVK(lam=[1.0, 2.0], mu=MU)  # type: ignore[arg-type]


@pytest.mark.parametrize("youngs_modulus", [0.0, -1.0, math.nan, math.inf])
def test_youngs_modulus_must_be_positive(kind: type[Material], youngs_modulus: float) -> None:
    with pytest.raises(ValueError, match=r"youngs_modulus is .*must be positive"):
        kind.from_young(youngs_modulus=youngs_modulus, poisson_ratio=0.3)
    with pytest.raises(ValueError, match=r"youngs_modulus of tet 1 is .*must be positive"):
        kind.from_young(youngs_modulus=[1.0, youngs_modulus], poisson_ratio=0.3)


@pytest.mark.parametrize("poisson_ratio", [-0.1, 0.5, math.nan])
def test_poisson_ratio_must_be_below_a_half(kind: type[Material], poisson_ratio: float) -> None:
    with pytest.raises(ValueError, match=r"poisson_ratio is .*in \[0, 0\.5\); use 0\.49"):
        kind.from_young(youngs_modulus=1.0, poisson_ratio=poisson_ratio)
