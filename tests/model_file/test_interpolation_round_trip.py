"""Files of interpolation models: the same bits come back, or one line says why not."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from safetensors import safe_open
from safetensors.numpy import load_file

from snapspace import (
    EmbeddedSurface,
    InterpolationModel,
    InterpolationProblem,
    Poses,
    StVK,
    load,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
    validate,
)
from snapspace.mesh import boundary_surface
from snapspace.reduction import PoseQuartics

from ..shapes import bar_poses, bent, irregular_bar
from .test_bad_files import Change, refused, rewrite

ARRAYS = {
    "poses",
    "tets",
    "mean_shape",
    "surface_faces",
    "surface_corners",
    "surface_weights",
    "basis",
    "eigenvalues",
    "quartics",
    "training_parameters",
    "training_coordinates",
}


@pytest.fixture
def saved(blending_model: InterpolationModel, tmp_path: Path) -> Path:
    return blending_model.save(tmp_path / "bar.snapspace")


def assert_same_model(a: InterpolationModel, b: InterpolationModel) -> None:
    """Everything of one model is in the other, to the last bit."""
    assert a.problem.fingerprint == b.problem.fingerprint
    assert a.problem.poses.names == b.problem.poses.names
    assert a.problem.material == b.problem.material
    assert a.problem.domain == b.problem.domain
    np.testing.assert_array_equal(a.problem.poses.shapes, b.problem.poses.shapes)
    np.testing.assert_array_equal(a.problem.poses.tets, b.problem.poses.tets)
    np.testing.assert_array_equal(a.problem.pose_shapes, b.problem.pose_shapes)
    for attribute in ("tau", "basis", "snapshot_energies"):
        np.testing.assert_array_equal(
            getattr(a.subspace, attribute), getattr(b.subspace, attribute)
        )
    assert (a.subspace.mass != b.subspace.mass).nnz == 0
    for attribute in ("faces", "corners", "weights"):
        np.testing.assert_array_equal(getattr(a.surface, attribute), getattr(b.surface, attribute))
    for attribute in ("training_parameters", "training_coordinates"):
        np.testing.assert_array_equal(getattr(a, attribute), getattr(b, attribute))
    assert type(a.blends) is type(b.blends)
    names = ("coefficients",) if isinstance(a.blends, PoseQuartics) else ("tets", "weights", "rows")
    for attribute in names:
        np.testing.assert_array_equal(getattr(a.blends, attribute), getattr(b.blends, attribute))
    assert a.provenance == b.provenance


def loaded(path: Path) -> InterpolationModel:
    model = load(path)
    assert isinstance(model, InterpolationModel)
    return model


def test_nothing_is_lost(blending_model: InterpolationModel, saved: Path) -> None:
    assert_same_model(loaded(saved), blending_model)


def test_nothing_of_a_cubature_is_lost(
    blended_cubature_model: InterpolationModel, tmp_path: Path
) -> None:
    path = blended_cubature_model.save(tmp_path / "bar.snapspace")
    again = loaded(path)
    assert_same_model(again, blended_cubature_model)
    weights = [0.2, 0.5, 0.3]
    shapes = []
    for model in (again, blended_cubature_model):
        session = model.session()
        assert session.blend(weights).converged
        shapes.append(session.vertices)
    np.testing.assert_array_equal(*shapes)


def test_a_loaded_session_gives_the_same_shapes(
    blending_model: InterpolationModel, saved: Path
) -> None:
    here, there = blending_model.session(), loaded(saved).session()
    np.testing.assert_array_equal(here.vertices, there.vertices)
    for w in sample(blending_model.problem.domain, 4, seed=8):
        one, other = here.blend(w), there.blend(w)
        assert (one.status, one.iterations, one.value) == (
            other.status,
            other.iterations,
            other.value,
        )
        np.testing.assert_array_equal(here.vertices, there.vertices)


def test_a_loaded_model_is_validated_and_solved_to_the_same_bits(
    blending_model: InterpolationModel, saved: Path
) -> None:
    """The mean shape is read, not solved for again."""
    model = loaded(saved)
    here, there = (validate(m, samples=2, threads=1) for m in (blending_model, model))
    np.testing.assert_array_equal(here.error, there.error)
    np.testing.assert_array_equal(here.reference.shapes, there.reference.shapes)


def test_saving_twice_gives_identical_bytes(
    blending_model: InterpolationModel, saved: Path, tmp_path: Path
) -> None:
    again = loaded(saved).save(tmp_path / "again.snapspace")
    assert again.read_bytes() == saved.read_bytes()
    assert blending_model.save(tmp_path / "b.snapspace").read_bytes() == saved.read_bytes()


def test_a_truncated_model_survives(blending_model: InterpolationModel, tmp_path: Path) -> None:
    leading = blending_model.leading(3)
    assert_same_model(loaded(leading.save(tmp_path / "m.snapspace")), leading)


def test_everything_unusual_survives(tmp_path: Path) -> None:
    """Names, an extrapolated domain, a lumped mass, inverted tets, its own surface."""
    mesh = irregular_bar(6, 2, 2)
    shapes = np.stack([mesh.vertices, bent(mesh, 0.8) * [1.0, 1.0, -1.0]])
    poses = Poses(shapes, mesh.tets, names=["Fuß", 'the "mirror"'], accept_inverted=True)
    assert poses.inverted_tets[1] == len(mesh.tets)
    problem = InterpolationProblem(poses, material=StVK(lam=0.0, mu=0.1 + 0.2), extrapolation=0.1)
    snapshots = solve_snapshots(problem, sample(problem.domain, 4), threads=1)
    subspace = snapshot_pca(snapshots, dimension=3, lumped=True, include_unconverged=True)
    whole = boundary_surface(mesh)
    part = EmbeddedSurface(whole.faces[:7], whole.corners, whole.weights)
    model = reduce(
        problem,
        subspace,
        surface=part,
        provenance={"seconds": 0.1 + 0.2, "mesh": "Löwe.obj", "none": None},
    )
    again = loaded(model.save(tmp_path / "m.snapspace"))
    assert_same_model(again, model)
    assert again.subspace.lumped
    assert again.training_parameters.shape == (0, 2)


def test_any_safetensors_reader_opens_it(blending_model: InterpolationModel, saved: Path) -> None:
    arrays = load_file(saved)
    assert set(arrays) == ARRAYS
    assert {str(array.dtype) for array in arrays.values()} == {"float64", "float32", "int32"}
    assert arrays["basis"].dtype == np.float32
    np.testing.assert_array_equal(arrays["poses"], bar_poses().shapes)
    np.testing.assert_array_equal(arrays["basis"].T, blending_model.subspace.basis)
    with safe_open(saved, framework="np") as file:
        header = file.metadata()
    own = {"format", "version", "kind", "problem", "provenance", "timings"}
    assert set(header) == own | {"checksum", "timings_checksum"}
    assert header["kind"] == "interpolation"
    content = json.loads(header["problem"])
    assert content["poses"] == ["rest", "bent", "twisted"]
    assert content["material"] == {"model": "stvk", "lam": 1.5, "mu": 0.7}


def test_a_rewritten_file_is_fine_if_nothing_changed(saved: Path) -> None:
    """So the files of the tests below are refused only because of their changes."""
    rewrite(saved, lambda arrays, header: None)
    assert load(saved).dimension == 12


@pytest.mark.parametrize("name", sorted(ARRAYS - {"eigenvalues"}))
def test_a_missing_array_is_named(saved: Path, name: str) -> None:
    rewrite(saved, lambda arrays, header: arrays.pop(name))
    assert refused(saved).endswith(f"the array '{name}' is missing; build the model again")


@pytest.mark.parametrize("name", sorted(ARRAYS))
def test_a_wrong_type_is_named(saved: Path, name: str) -> None:
    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        arrays[name] = arrays[name].astype(np.float16)

    rewrite(saved, change)
    assert f"the array '{name}' is float16, not " in refused(saved)


@pytest.mark.parametrize("name", sorted(ARRAYS))
def test_an_altered_array_is_noticed(saved: Path, name: str) -> None:
    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        arrays[name] = arrays[name].copy()
        arrays[name].reshape(-1).view(np.uint8)[0] ^= 1

    rewrite(saved, change, sign=False)
    assert "the checksum does not match: the file was altered" in refused(saved)


@pytest.mark.parametrize("name", sorted(ARRAYS - {"eigenvalues"}))
def test_a_wrong_size_does_not_fit(saved: Path, name: str) -> None:
    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        arrays[name] = np.ascontiguousarray(arrays[name][..., :-1])

    rewrite(saved, change)
    assert "the model is inconsistent" in refused(saved)


@pytest.mark.parametrize("index", [-1, 10_000])
@pytest.mark.parametrize("name", ["surface_faces", "surface_corners", "tets"])
def test_an_index_out_of_range_is_refused(saved: Path, name: str, index: int) -> None:
    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        arrays[name] = arrays[name].copy()
        arrays[name][3, 1] = index

    rewrite(saved, change)
    message = refused(saved)
    assert "the model is inconsistent" in message
    assert name == "tets" or f"'{name}' has an index that is not between 0 and" in message


def header_change(**changes: Any) -> Change:
    """Replaces entries of the problem's content; None removes one."""

    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        content = {**json.loads(header["problem"]), **changes}
        kept = {key: value for key, value in content.items() if value is not None}
        header["problem"] = json.dumps(kept)

    return change


def not_finite_mean(arrays: dict[str, Any], header: dict[str, str]) -> None:
    arrays["mean_shape"] = arrays["mean_shape"] * np.nan


def posing_kind(arrays: dict[str, Any], header: dict[str, str]) -> None:
    header["kind"] = "posing"


CHANGES: list[tuple[Change, str]] = [
    (header_change(poses=["one", "two"]), "got 2 names for 3 poses"),
    (header_change(material=None), "the model is inconsistent"),
    (header_change(material={"model": "stvk", "lam": 1.0, "mu": -1.0}), "mu"),
    (header_change(extrapolation=-1.0), "extrapolation is -1.0, but it must be zero or positive"),
    (header_change(accept_inverted=None), "the model is inconsistent"),
    (header_change(lumped_mass=None), "the model is inconsistent"),
    (not_finite_mean, "the array 'mean_shape' has a number at [0] that is not finite"),
    (posing_kind, "the array 'vertices' is missing"),
]


@pytest.mark.parametrize(("change", "message"), CHANGES)
def test_content_that_is_not_a_valid_model_is_refused(
    saved: Path, change: Change, message: str
) -> None:
    rewrite(saved, change)
    assert message in refused(saved)


@pytest.mark.parametrize("kind", ["animation", "", "Interpolation"])
def test_an_unknown_kind_is_named(saved: Path, kind: str) -> None:
    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        header["kind"] = kind

    rewrite(saved, change)
    message = refused(saved)
    known = "posing, posing-cubature, posing-shell, interpolation"
    assert f"the kind is '{kind}', but this snapspace knows {known}" in message
    assert "install the snapspace that wrote it" in message
