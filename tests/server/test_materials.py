"""The materials that a page offers and those that it computes with."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import ARAP, Corotational, StableNeoHookean, TetMesh
from snapspace.material import MATERIALS, Material
from snapspace.server.materials import (
    chosen_material,
    material_choices,
    shown_poisson,
    usual_kind,
)

from ..shells.sheets import sheet

#: Two tets with a common face.
SOLID = TetMesh(
    [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, -1]], [[0, 1, 2, 3], [0, 2, 1, 4]]
)
SHELL = sheet(3, 2)


def test_all_registered_materials_are_offered() -> None:
    choices = {choice.kind: choice for choice in material_choices()}
    assert set(choices) == set(MATERIALS)
    assert choices["stable-neo-hookean"].title == "stable neo-Hookean"
    assert choices["corotational"].has_poisson and not choices["arap"].has_poisson


@pytest.mark.parametrize("kind", sorted(MATERIALS))
@pytest.mark.parametrize("mu", [2.0, np.array([1.0, 3.0])])
def test_another_material_has_the_same_small_strains(kind: str, mu: float | np.ndarray) -> None:
    given = StableNeoHookean(lam=1.5, mu=mu)
    chosen = chosen_material(given, SOLID, kind=kind, poisson=None)
    assert chosen.kind == kind and np.array_equal(chosen.mu, mu)
    assert chosen.lam in (0.0, 1.5)
    bent = chosen_material(given, SOLID, kind=kind, poisson=0.49)
    assert np.array_equal(bent.mu, mu)
    if np.max(bent.lam) > 0:
        assert shown_poisson(bent) == pytest.approx(0.49)


def test_without_a_choice_the_given_material_stays() -> None:
    given = Corotational(lam=np.array([1.0, 2.0]), mu=1.0)
    assert chosen_material(given, SOLID, kind=None, poisson=None) is given
    assert chosen_material(given, SOLID, kind="corotational", poisson=None) is given


def test_bodies_begin_with_the_usual_material() -> None:
    for mesh, usual in ((SOLID, StableNeoHookean()), (SHELL, ARAP(radius=0.02))):
        assert chosen_material(None, mesh, kind=None, poisson=None) == usual
        assert chosen_material(None, mesh, kind=usual.kind, poisson=None) == usual
        assert usual_kind(None, shell=mesh is SHELL) == usual.kind


def test_another_material_than_the_usual_one_of_a_shell() -> None:
    hinged = chosen_material(None, SHELL, kind="stable-neo-hookean", poisson=None)
    assert hinged == StableNeoHookean(), "the moduli of solids, not those of arap"
    given = StableNeoHookean(lam=3.0, mu=2.0)
    rigid = chosen_material(given, SHELL, kind="arap", poisson=None)
    assert rigid == ARAP(mu=2.0, radius=0.02)
    wide = ARAP(mu=2.0, radius=0.1)
    assert chosen_material(wide, SHELL, kind="arap", poisson=None) is wide
    assert usual_kind(given, shell=True) == usual_kind(given, shell=False) == given.kind
    assert usual_kind(Corotational(), shell=True) == "stable-neo-hookean"


@pytest.mark.parametrize("ratio", [0.5, 0.491, -0.1, float("nan"), float("inf")])
def test_a_ratio_out_of_range_is_refused(ratio: float) -> None:
    with pytest.raises(ValueError, match=r"Poisson's ratio is .*from 0 to 0.49"):
        chosen_material(StableNeoHookean(), SOLID, kind=None, poisson=ratio)


def test_an_unknown_material_is_refused_with_the_known_ones() -> None:
    with pytest.raises(ValueError, match=r"unknown material 'mud'; known are arap, .*stvk"):
        chosen_material(StableNeoHookean(), SOLID, kind="mud", poisson=None)


@pytest.mark.parametrize(
    ("material", "ratio"),
    [
        (StableNeoHookean(), 0.25),
        (ARAP(), 0.0),
        (StableNeoHookean(lam=np.array([1.0, 10.0]), mu=np.array([1.0, 10.0])), 0.25),
        (StableNeoHookean(lam=np.array([1.0, 2.0])), None),
        (StableNeoHookean.from_young(youngs_modulus=1.0, poisson_ratio=0.499), None),
    ],
)
def test_the_ratio_is_shown_where_there_is_one(material: Material, ratio: float | None) -> None:
    assert shown_poisson(material) == (None if ratio is None else pytest.approx(ratio))
