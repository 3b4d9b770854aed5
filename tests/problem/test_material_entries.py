"""The material of a problem file: names, moduli, regions, and writing it again."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from snapspace import (
    ARAP,
    MATERIALS,
    Corotational,
    Material,
    StableNeoHookean,
    StVK,
)
from snapspace.generators import bar
from snapspace.problem.material_entries import material_content, material_from

from ..shells.sheets import sheet

MESH = bar(4, 1, 1)  # x = 0, 1, 2, 3, 4; six tets in each cube
COUNT = len(MESH.tets)
CENTROIDS = MESH.vertices[MESH.tets].mean(axis=1)
FAR = CENTROIDS[:, 0] > 2
FAR_BOX = [[[2, None, None], [None, None, None]]]


@pytest.mark.parametrize("kind", sorted(MATERIALS))
def test_every_material_goes_by_its_name_and_the_names_of_its_moduli(kind: str) -> None:
    material = MATERIALS[kind]
    values = {name: 0.5 + k for k, name in enumerate(material.names())}
    assert material_from({"model": kind, **values}, MESH) == material(**values)


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ({}, StableNeoHookean()),
        ({"young": 2.0, "poisson": 0.25}, StableNeoHookean(lam=0.8, mu=0.8)),
        # files from before materials had names
        ({"lam": 2.0}, StVK(lam=2.0)),
        ({"lam": 2.0, "mu": 0.5}, StVK(lam=2.0, mu=0.5)),
        ({"model": "corotational"}, Corotational()),
        ({"model": "arap", "young": 2.0, "poisson": 0.25}, ARAP(mu=0.8)),
    ],
)
def test_files_without_a_model_keep_their_meaning(content: Any, expected: Material) -> None:
    assert material_from(content, MESH) == expected


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ({}, ARAP(radius=0.02)),
        ({"radius": 0.05}, ARAP(radius=0.05)),
        ({"young": 2.0, "poisson": 0.25}, StableNeoHookean(lam=0.8, mu=0.8)),
        ({"lam": 2.0}, StVK(lam=2.0)),
        ({"model": "arap"}, ARAP()),
    ],
)
def test_shells_are_as_rigid_as_possible_if_nothing_is_said_of_moduli(
    content: Any, expected: Material
) -> None:
    assert material_from(content, sheet(2, 2)) == expected


def test_a_solid_has_no_radius() -> None:
    with pytest.raises(ValueError, match="radius"):
        material_from({"radius": 0.05}, MESH)


def test_young_and_poisson_are_those_of_a_pulled_bar() -> None:
    """Hooke's law: a strain diag(1, -nu, -nu) has the stress diag(E, 0, 0)."""
    material = material_from({"model": "stvk", "young": 3.0, "poisson": 0.4}, MESH)
    strain = np.diag([1.0, -0.4, -0.4])
    stress = 2 * material.mu * strain + material.lam * np.trace(strain) * np.eye(3)
    assert stress == pytest.approx(np.diag([3.0, 0.0, 0.0]), abs=1e-12)


def test_lists_have_one_number_per_tet() -> None:
    mu = np.linspace(1, 2, COUNT)
    material = material_from({"model": "stvk", "lam": 3.0, "mu": mu.tolist()}, MESH)
    assert material == StVK(lam=3.0, mu=mu)
    young = material_from({"young": mu.tolist(), "poisson": 0.25}, MESH)
    assert young.mu == pytest.approx(mu / 2.5)


def test_a_region_has_the_tets_whose_centroids_are_in_it() -> None:
    region = {"boxes": FAR_BOX, "mu": 5.0}
    material = material_from({"model": "stvk", "mu": 2.0, "regions": [region]}, MESH)
    assert np.array_equal(material.mu, np.where(FAR, 5.0, 2.0))
    assert np.array_equal(material.lam, np.ones(COUNT))
    ball = {"spheres": [[[0.5, 0.5, 0.5], 0.6]], "factor": 10}
    inside = np.linalg.norm(CENTROIDS - 0.5, axis=1) <= 0.6
    assert 0 < inside.sum() < COUNT
    soft = material_from({"model": "stvk", "lam": 3.0, "regions": [ball]}, MESH)
    assert np.array_equal(soft.mu, np.where(inside, 10.0, 1.0))
    assert np.array_equal(soft.lam, np.where(inside, 30.0, 3.0)), "a factor scales all moduli"


def test_three_corners_among_the_vertices_make_a_tet_a_part_of_a_region() -> None:
    chosen = MESH.tets[0, :3]
    inside = np.isin(MESH.tets, chosen).sum(axis=1) == 3
    assert inside[0] and not inside.all()
    region = {"vertices": chosen.tolist(), "mu": 4.0}
    material = material_from({"model": "arap", "regions": [region]}, MESH)
    assert np.array_equal(material.mu, np.where(inside, 4.0, 1.0))
    with pytest.raises(ValueError, match="it contains no tet"):
        material_from({"regions": [{"vertices": chosen[:2].tolist(), "mu": 4.0}]}, MESH)


def test_later_regions_win_and_factors_multiply() -> None:
    regions: list[Any] = [
        {"boxes": FAR_BOX, "young": 2.5, "poisson": 0.25},
        {"tets": [COUNT - 1], "mu": 7.0},
        {"boxes": FAR_BOX, "factor": 2},
    ]
    material = material_from({"regions": regions}, MESH)
    expected = np.where(FAR, 2.0, 1.0)
    expected[-1] = 14.0
    assert material.mu == pytest.approx(expected)
    assert np.array_equal(material.lam, np.where(FAR, 2.0, 1.0))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (5, "material must be an object"),
        ({"model": 5}, "material: model must be a string"),
        ({"model": "foo"}, "material: unknown material 'foo'; known are arap, corotational"),
        ({"model": "arap", "lam": 1}, "material: unknown entry 'lam'; known are model, mu"),
        ({"young": 1}, "material: 'young' also needs the entry 'poisson'"),
        ({"poisson": 0.3}, "material: 'poisson' also needs the entry 'young'"),
        ({"young": 1, "poisson": 0.5}, r"poisson_ratio is 0.5, but .* use 0.49"),
        ({"young": -1, "poisson": 0.3}, "youngs_modulus is -1.0, but it must be positive"),
        ({"model": "stvk", "young": 1, "mu": 1}, "'mu' and 'young' say the same thing"),
        ({"lam": 1, "young": 1}, "'lam' without 'model' means stvk, .* no 'young'; name the model"),
        ({"mu": 1, "regions": []}, "'mu' without 'model' means stvk, .* no 'regions'"),
        ({"model": "stvk", "mu": float("nan")}, "mu is nan, but it must be positive"),
        ({"model": "stvk", "lam": -1}, "lam is -1.0, but it must be zero or positive"),
        ({"model": "stvk", "mu": "soft"}, "material: mu must be a number, got 'soft'"),
        ({"model": "stvk", "mu": [1, "soft"]}, r"material: mu\[1\] must be a number, got 'soft'"),
        ({"model": "stvk", "mu": [1, 1]}, f"moduli for 2 tets, but the mesh has {COUNT}"),
        ({"model": "stvk", "mu": [1, 1], "lam": [1]}, "moduli of 1 and 2 tets do not match"),
        ({"model": "stvk", "mu": [1.0] * (COUNT - 1) + [0]}, f"mu of tet {COUNT - 1} is 0.0"),
        ({"regions": {}}, "material.regions must be a list"),
        ({"regions": [5]}, r"material.regions\[0\] must be an object"),
        ({"regions": [{"boxs": []}]}, r"material.regions\[0\]: unknown entry 'boxs'"),
        ({"regions": [{"boxes": FAR_BOX}]}, r"regions\[0\]: it changes nothing; give lam and mu"),
        ({"regions": [{"mu": 2}]}, r"regions\[0\]: it contains no tet"),
        ({"regions": [{"boxes": [1], "mu": 2}]}, r"regions\[0\]: a box must be a list"),
        ({"regions": [{"tets": [COUNT], "mu": 2}]}, f"a tet index is {COUNT}, but must be from 0"),
        ({"regions": [{"boxes": FAR_BOX, "mu": [2]}]}, r"regions\[0\]: mu must be a number"),
        ({"regions": [{"boxes": FAR_BOX, "mu": -2}]}, r"regions\[0\]: .*mu of tet \d+ is -2.0"),
        ({"regions": [{"boxes": FAR_BOX, "factor": 0}]}, "factor is 0.0, but it must be positive"),
        ({"regions": [{"boxes": FAR_BOX, "factor": 2, "mu": 1}]}, "give factor or 'mu', not both"),
        ({"regions": [{"boxes": FAR_BOX, "young": 2}]}, "'young' also needs the entry 'poisson'"),
    ],
)
def test_a_wrong_entry_is_named(content: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message) as caught:
        material_from(content, MESH)
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith("material")


def random_moduli(distinct: int) -> np.ndarray:
    random = np.random.default_rng(3)
    which = np.append(np.arange(distinct), random.integers(distinct, size=COUNT - distinct))
    return random.uniform(0.1, 9.0, distinct)[random.permutation(which)]


@pytest.mark.parametrize(
    "material",
    [
        StableNeoHookean(lam=1 / 3, mu=0.1),
        ARAP(mu=random_moduli(3)),
        StVK(lam=2.0, mu=random_moduli(5)),
        StVK(lam=random_moduli(2), mu=random_moduli(4)),
        Corotational(lam=2.0, mu=random_moduli(COUNT)),
    ],
    ids=["one", "three", "mu only", "both", "all different"],
)
def test_content_makes_the_same_material_again(material: Material) -> None:
    content = json.loads(json.dumps(material_content(material)))
    again = material_from(content, MESH)
    assert again == material
    assert again.key == material.key


def test_few_different_moduli_are_written_as_regions() -> None:
    """Most tets need no entry."""
    mu = np.where(FAR, 2.0, 1.0)
    mu[FAR.argmax()] = 1.0  # so that fewer are stiff
    content = material_content(StVK(lam=3.0, mu=mu))
    assert content == {
        "model": "stvk",
        "lam": 3.0,
        "mu": 1.0,
        "regions": [{"tets": np.flatnonzero(mu == 2.0).tolist(), "mu": 2.0}],
    }
    many = material_content(StVK(lam=3.0, mu=np.linspace(1, 2, COUNT)))
    assert many["lam"] == 3.0
    assert len(many["mu"]) == COUNT
    assert "regions" not in many
