"""Input that ElasticEnergy and the core's energy refuse."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from snapspace import ElasticEnergy, Material, StVK
from snapspace import _core as core

from ..shapes import CORNER_TET, irregular_bar
from .densities import every_kind, every_material, varied

MESH = irregular_bar()
CALLS: dict[str, Callable[[ElasticEnergy, np.ndarray], object]] = {
    "value": lambda energy, x: energy.value(x),
    "value_and_gradient": lambda energy, x: energy.value_and_gradient(x),
    "hessian": lambda energy, x: energy.hessian(x),
    "hessian_product": lambda energy, x: energy.hessian_product(x, MESH.vertices),
    "clamped_hessian": lambda energy, x: energy.clamped_hessian(x, threshold=0.5),
    "projected_hessian": lambda energy, x: energy.projected_hessian(x),
    "inverted_tets": lambda energy, x: energy.inverted_tets(x),
}


@pytest.fixture
def energy() -> ElasticEnergy:
    return ElasticEnergy(MESH, StVK())


@pytest.mark.parametrize("name", CALLS)
def test_a_shape_of_another_mesh_is_refused(energy: ElasticEnergy, name: str) -> None:
    message = f"ElasticEnergy: the shape has 12 coordinates, but the mesh has {len(MESH.vertices)}"
    with pytest.raises(ValueError, match=message):
        CALLS[name](energy, CORNER_TET)


def test_a_direction_of_another_mesh_is_refused(energy: ElasticEnergy) -> None:
    with pytest.raises(ValueError, match="the direction has 12 coordinates, but the mesh has 36"):
        energy.hessian_product(MESH.vertices, CORNER_TET)


def test_vertices_and_shape_vectors_mean_the_same(energy: ElasticEnergy) -> None:
    x = MESH.vertices * [1.2, 1.0, 0.9]
    assert energy.value(x) == energy.value(x.reshape(-1)) == energy.value(np.asfortranarray(x))


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf, 1e200])
@every_material
def test_a_shape_that_is_not_finite_has_no_finite_energy(material: Material, wrong: float) -> None:
    x = MESH.vertices.copy()
    x[3, 1] = wrong
    assert not np.isfinite(ElasticEnergy(MESH, material).value(x))


@every_kind
def test_moduli_of_another_number_of_tets_are_refused(kind: type[Material]) -> None:
    tets = len(MESH.tets)
    for count in (tets - 1, tets + 1, 2):
        material = varied(kind, count)
        message = f"ElasticEnergy: .*moduli for {count} tets, but the mesh has {tets}; give one"
        with pytest.raises(ValueError, match=message):
            ElasticEnergy(MESH, material)
        with pytest.raises(ValueError, match="moduli for a different number of tets"):
            core.ElasticEnergy(MESH.vertices, MESH.tets, material.core)


@every_kind
def test_the_core_refuses_another_number_of_moduli(kind: type[Material]) -> None:
    count = len(kind.names())
    for moduli in (np.ones((1, count + 1)), np.ones((1, count - 1)), np.ones((0, count))):
        with pytest.raises(ValueError, match=rf"moduli must be \(1 or tets, {count}\)"):
            core.Material(kind.kind, moduli)


@pytest.mark.parametrize("name", ["foo", "", "StVK", "stvk "])
def test_the_core_refuses_an_unknown_material_by_name(name: str) -> None:
    with pytest.raises(ValueError, match=f"unknown material '{name}'"):
        core.Material(name, np.ones((1, 2)))


def test_an_unknown_projection_is_refused(energy: ElasticEnergy) -> None:
    for projection in ("none", "stretches", "Clamp"):
        message = f"unknown projection '{projection}'; known are clamp, absolute"
        with pytest.raises(ValueError, match=message):
            energy.projected_hessian(MESH.vertices, projection=projection)


def test_the_core_refuses_vertices_that_do_not_exist() -> None:
    for corner in (4, -1):
        tets = np.array([[0, 1, 2, corner]], dtype=np.int32)
        with pytest.raises(ValueError, match="a tet has a vertex index out of range"):
            core.ElasticEnergy(CORNER_TET, tets, StVK().core)
