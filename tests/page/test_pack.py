"""The page holds the model to the promised precision."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays as numpy_arrays

from snapspace import Cubature, InterpolationModel, PosingModel, Quartic, ReducedModel
from snapspace.material import MATERIALS
from snapspace.model_file.container import Arrays, read_container
from snapspace.page import packed
from snapspace.page.painted import handle_of_vertex
from snapspace.page.shape_space import quantised

from ..clustered import clustered_model
from .material_models import material_model


def unpacked(
    model: ReducedModel, folder: Path, before: PosingModel | None = None
) -> tuple[Arrays, dict[str, str]]:
    path = folder / "packed"
    path.write_bytes(packed(model, name="a name", before=before))
    return read_container(path)


def shapes(arrays: Arrays, name: str, coefficients: np.ndarray) -> np.ndarray:
    modes = arrays[f"{name}_modes"] * arrays[f"{name}_scales"][:, None].astype(np.float64)
    return np.asarray(arrays["base"] + coefficients @ modes).reshape(-1, 3)


@given(
    numpy_arrays(
        np.float64, (3, 9), elements=st.floats(-1e6, 1e6, allow_subnormal=False).map(float)
    )
)
def test_integers_are_close_to_the_largest_of_their_mode(modes: np.ndarray) -> None:
    integers, scales = quantised(modes)
    error = np.abs(integers * scales[:, None].astype(np.float64) - modes).max(axis=1)
    most = np.abs(modes).max(axis=1)
    assert (error <= 1.6e-5 * most + 1e-37).all()


def test_a_posing_model_keeps_its_surface(posing_model: PosingModel, tmp_path: Path) -> None:
    arrays, header = unpacked(posing_model, tmp_path)
    about = json.loads(header["about"])
    assert about["name"] == "a name"
    problem, mesh = posing_model.problem, posing_model.problem.mesh
    session = posing_model.session()
    session.pose(0.7 * problem.domain.half_widths)
    shown = shapes(arrays, "space", session.q)
    expected = session.vertices[mesh.surface_vertices]
    assert np.abs(shown - expected).max() < 2e-5 * mesh.diagonal
    assert np.array_equal(mesh.surface_vertices[arrays["faces"]], mesh.surface)
    for index, handle in enumerate(problem.handles):
        mine = mesh.surface_vertices[arrays["handle_of_vertex"] == index]
        assert np.array_equal(np.sort(mine), np.intersect1d(handle.vertices, mesh.surface_vertices))
        assert about["handles"][index] == {
            "name": handle.name,
            "center": problem.centroids[index].tolist(),
        }
    bounds = [[*box["translation"], *box["angle"]] for box in about["boxes"]]
    assert bounds == [[0.0] * 6, *problem.domain.bounds.tolist()]


def test_a_posing_model_shows_the_surface_of_the_user(
    own_surface_model: PosingModel, tmp_path: Path
) -> None:
    model = own_surface_model
    arrays, _ = unpacked(model, tmp_path)
    session = model.session()
    session.pose(0.7 * model.problem.domain.half_widths)
    shown, expected = shapes(arrays, "space", session.q), model.surface.vertices(session.vertices)
    assert np.abs(shown - expected).max() < 2e-5 * model.problem.mesh.diagonal
    assert np.array_equal(arrays["faces"], model.surface.faces)
    for index, handle in enumerate(model.problem.handles):
        mine = arrays["handle_of_vertex"] == index
        assert np.array_equal(mine, np.isin(model.surface.nearest, handle.vertices)) and mine.any()


def test_handles_look_as_they_were_painted(own_surface_model: PosingModel, tmp_path: Path) -> None:
    count, names = len(own_surface_model.surface.corners), own_surface_model.problem.handles.names
    painted = {name: [3 * index, 3 * index + 1] for index, name in enumerate(names)}

    def painted_model(record: object) -> PosingModel:
        return replace(own_surface_model, provenance={"painted": record})

    def owners(record: object) -> np.ndarray:
        return handle_of_vertex(painted_model(record))

    expected = np.full(count, -1)
    for index, name in enumerate(names):
        expected[painted[name]] = index
    assert np.array_equal(owners(painted), expected)
    arrays, _ = unpacked(painted_model(painted), tmp_path)
    assert np.array_equal(arrays["handle_of_vertex"], expected)
    nearest = owners(None)
    assert np.count_nonzero(nearest >= 0) > 6
    first = names[0]
    for bad in ([], {}, {first: [0]}, painted | {first: 3}, painted | {first: [count]}):
        assert np.array_equal(owners(bad), nearest)
    for index in (-1, 0.5, True, "0", 2**70):
        assert np.array_equal(owners(painted | {first: [index]}), nearest)


def test_an_interpolation_model_keeps_poses_and_blends(
    blending_model: InterpolationModel, tmp_path: Path
) -> None:
    arrays, _ = unpacked(blending_model, tmp_path)
    session = blending_model.session()
    weights = np.array([0.2, 0.5, 0.3])
    session.blend(weights)
    surface, mesh = blending_model.surface, blending_model.problem.mesh
    blend = surface.vertices(session.vertices)
    straight = surface.vertices(blending_model.problem.linear_blend(weights))
    assert np.abs(shapes(arrays, "space", session.q) - blend).max() < 2e-5 * mesh.diagonal
    assert np.abs(shapes(arrays, "poses", weights) - straight).max() < 2e-5 * mesh.diagonal


def test_the_bytes_are_the_same_and_small(posing_model: PosingModel) -> None:
    content = packed(posing_model, name="bar")
    assert content == packed(posing_model, name="bar")
    d, s = posing_model.dimension, len(posing_model.problem.mesh.surface_vertices)
    elastic = posing_model.elastic
    assert isinstance(elastic, Quartic)
    coefficients = 4 * elastic.coefficients.size
    assert len(content) < 6 * d * s + coefficients + 12 * s + 80_000


def test_shapes_of_the_model_before_are_carried_over(
    cubature_model: PosingModel, tmp_path: Path
) -> None:
    """A larger model has the shapes of a smaller one; carried back, they are the nearest ones."""
    small = cubature_model.leading(5)
    d = cubature_model.dimension
    larger, _ = unpacked(cubature_model, tmp_path, before=small)
    np.testing.assert_allclose(larger["from_before"], np.eye(d)[:, :5], atol=1e-6)
    smaller, _ = unpacked(small, tmp_path, before=cubature_model)
    np.testing.assert_allclose(smaller["from_before"], np.eye(d)[:5], atol=1e-6)
    assert "from_before" not in unpacked(small, tmp_path)[0]


def test_a_cubature_keeps_its_tets(cubature_model: PosingModel, tmp_path: Path) -> None:
    arrays, header = unpacked(cubature_model, tmp_path)
    elastic = cubature_model.elastic
    assert isinstance(elastic, Cubature)
    assert np.array_equal(arrays["cubature_rows"], elastic.rows)
    assert np.array_equal(arrays["cubature_weights"], elastic.weights)
    assert "quartic" not in arrays
    assert json.loads(header["about"])["material"] == {"model": elastic.material.kind}
    assert np.array_equal(arrays["cubature_moduli"], elastic.material.moduli)


def test_clusters_take_the_place_of_rows(cubature_model: PosingModel, tmp_path: Path) -> None:
    model = clustered_model(cubature_model, 10)
    arrays, _ = unpacked(model, tmp_path)
    rows = model.elastic.stored_rows
    assert np.array_equal(arrays["cubature_clusters"], rows.sizes)
    assert np.array_equal(arrays["cubature_local_rows"], rows.rows)
    assert np.array_equal(arrays["cubature_local_modes"], rows.modes)
    assert "cubature_rows" not in arrays


@pytest.mark.parametrize("kind", sorted(MATERIALS))
def test_moduli_of_single_tets_travel_along(
    cubature_model: PosingModel, tmp_path: Path, kind: str
) -> None:
    model = material_model(cubature_model, kind)
    elastic = model.elastic
    assert isinstance(elastic, Cubature)
    arrays, header = unpacked(model, tmp_path)
    assert header["version"] == "2"
    assert json.loads(header["about"])["material"] == {"model": kind}
    moduli = model.problem.material.moduli
    assert np.array_equal(arrays["cubature_moduli"], moduli[elastic.tets])
    assert len(arrays["estimator_moduli"]) == len(arrays["estimator_tets"])
    assert set(map(tuple, arrays["estimator_moduli"])) <= set(map(tuple, moduli))


def test_other_models_are_refused() -> None:
    with pytest.raises(TypeError, match="cannot show a str"):
        packed("model", name="")  # type: ignore[arg-type]


def test_other_axes_are_refused(posing_model: PosingModel) -> None:
    with pytest.raises(ValueError, match="up is 'w', but it must be one of x, y, z"):
        packed(posing_model, name="", up="w")
