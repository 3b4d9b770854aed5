from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from snapspace import ElasticEnergy, StVK
from snapspace import _core as core

from ..shapes import CORNER_TET, irregular_bar

MESH = irregular_bar()
CALLS: dict[str, Callable[[ElasticEnergy, np.ndarray], object]] = {
    "value": lambda energy, x: energy.value(x),
    "value_and_gradient": lambda energy, x: energy.value_and_gradient(x),
    "hessian": lambda energy, x: energy.hessian(x),
    "hessian_product": lambda energy, x: energy.hessian_product(x, MESH.vertices),
    "clamped_hessian": lambda energy, x: energy.clamped_hessian(x, threshold=0.5),
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
    with pytest.raises(ValueError, match="a shape vector must have 3 entries per vertex"):
        energy.hessian_product(MESH.vertices, CORNER_TET)


def test_vertices_and_shape_vectors_mean_the_same(energy: ElasticEnergy) -> None:
    x = MESH.vertices * [1.2, 1.0, 0.9]
    assert energy.value(x) == energy.value(x.reshape(-1)) == energy.value(np.asfortranarray(x))


def test_a_shape_that_is_not_finite_gives_an_energy_that_is_not(energy: ElasticEnergy) -> None:
    x = MESH.vertices.copy()
    x[3, 1] = np.nan
    assert np.isnan(energy.value(x))


def test_the_core_reads_no_vertex_that_is_not_there() -> None:
    for corner in (4, -1):
        tets = np.array([[0, 1, 2, corner]], dtype=np.int32)
        with pytest.raises(ValueError, match="a tet has a vertex index out of range"):
            core.ElasticEnergy(CORNER_TET, tets, 1.0, 1.0)
