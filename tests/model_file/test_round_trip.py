"""Files of posing models: the same bits come back, and nothing in a file can be executed."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from safetensors import safe_open
from safetensors.numpy import load_file

from snapspace import (
    Handles,
    PosingProblem,
    ReducedModel,
    StVK,
    affine_subspace,
    load,
    pca,
    reduce,
    save_model,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.mesh import mass_matrix
from snapspace.problem import HandleBox

from ..shapes import bar_problem, irregular_bar
from ..snapshots.bars import parameters, posing_bar
from .test_bad_files import rewrite


def assert_same_model(a: ReducedModel, b: ReducedModel) -> None:
    """Everything of one model is in the other, to the last bit."""
    assert a.problem.mesh.fingerprint == b.problem.mesh.fingerprint
    assert a.problem.handles.names == b.problem.handles.names
    for one, other in zip(a.problem.handles, b.problem.handles, strict=True):
        np.testing.assert_array_equal(one.vertices, other.vertices)
    assert a.problem.material == b.problem.material
    assert a.problem.stiffness == b.problem.stiffness
    np.testing.assert_array_equal(a.problem.domain.half_widths, b.problem.domain.half_widths)
    for attribute in ("tau", "basis", "snapshot_energies"):
        np.testing.assert_array_equal(
            getattr(a.subspace, attribute), getattr(b.subspace, attribute)
        )
    assert (a.subspace.mass != b.subspace.mass).nnz == 0
    np.testing.assert_array_equal(a.elastic.coefficients, b.elastic.coefficients)
    for attribute in ("K", "L", "S"):
        np.testing.assert_array_equal(getattr(a.handles, attribute), getattr(b.handles, attribute))
    np.testing.assert_array_equal(a.training_parameters, b.training_parameters)
    np.testing.assert_array_equal(a.training_coordinates, b.training_coordinates)
    assert a.provenance == b.provenance


def test_nothing_is_lost(model: ReducedModel, saved: Path) -> None:
    assert_same_model(load(saved), model)


def test_a_loaded_session_gives_the_same_shapes(model: ReducedModel, saved: Path) -> None:
    here, there = model.session(), load(saved).session()
    for w in parameters(model.problem, 3, seed=8):
        one, other = here.pose(w), there.pose(w)
        assert (one.status, one.iterations, one.value) == (
            other.status,
            other.iterations,
            other.value,
        )
        np.testing.assert_array_equal(here.vertices, there.vertices)
    here.move("tip", euler=(0, 0, 0.2), translation=(0.1, 0, 0))
    there.move("tip", euler=(0, 0, 0.2), translation=(0.1, 0, 0))
    np.testing.assert_array_equal(here.vertices, there.vertices)


def test_three_handles_bounds_per_axis_and_a_lumped_mass_survive(tmp_path: Path) -> None:
    mesh = irregular_bar(8, 2, 2)
    x = mesh.vertices[:, 0]
    handles = Handles(
        [x < 0.6, np.abs(x - 2.0) < 0.2, x > 3.4], names=["Fuß", "middle part", 'the "tip"']
    )
    domain = HandleBox(translation=(0.1, 0.2, 0.3), angle=(0.3, 0.0, 0.1))
    problem = PosingProblem(
        mesh, handles, domain=domain, material=StVK(lam=0.0, mu=1 / 3), stiffness=1e5
    )
    snapshots = solve_snapshots(problem, parameters(problem, 6), threads=1)
    subspace = snapshot_pca(snapshots, dimension=4, lumped=True)
    made = reduce(problem, subspace, snapshots=snapshots, threads=1)
    assert_same_model(load(made.save(tmp_path / "m.snapspace")), made)


def test_bounds_of_single_handles_survive(tmp_path: Path) -> None:
    problem = bar_problem()
    box = HandleBox(translation=[(0.1, 0.2, 0.3), (0, 0, 0)], angle=0.2, moving=2)
    problem = problem.with_handles(problem.handles, domain=box)
    snapshots = solve_snapshots(problem, parameters(problem, 6), threads=1)
    made = reduce(problem, snapshot_pca(snapshots, dimension=4), snapshots=snapshots, threads=1)
    assert_same_model(load(made.save(tmp_path / "m.snapspace")), made)


def test_a_model_without_snapshots_survives(tmp_path: Path) -> None:
    problem = posing_bar()
    tau = problem.mesh.vertices.reshape(-1)
    shapes = tau + np.random.default_rng(0).normal(size=(2, tau.size))
    made = reduce(problem, pca(shapes, tau, mass_matrix(problem.mesh), dimension=2), threads=1)
    again = load(made.save(tmp_path / "m.snapspace"))
    assert_same_model(again, made)
    assert again.training_parameters.shape == (0, 6)


def test_a_basis_that_is_not_from_snapshots_survives(tmp_path: Path) -> None:
    problem = posing_bar()
    directions = np.random.default_rng(0).normal(size=(problem.tau.size, 3))
    made = reduce(problem, affine_subspace(directions, problem), threads=1)
    again = load(made.save(tmp_path / "m.snapspace"))
    assert again.subspace.snapshot_energies is None
    np.testing.assert_array_equal(again.subspace.basis, made.subspace.basis)


def test_bases_of_older_files_stay_as_they_are(saved: Path, tmp_path: Path) -> None:
    """Up to version 2 they are in double precision, and they are saved again without rounding."""

    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        arrays["basis"] = arrays["basis"].astype(np.float64) * (1.0 + 1e-12)
        header["version"] = "2"

    rewrite(saved, change)
    old = load(saved)
    again = load(old.save(tmp_path / "again.snapspace"))
    assert_same_model(again, old)
    assert not np.array_equal(old.subspace.basis, old.subspace.basis.astype(np.float32))


def test_a_truncated_model_survives(model: ReducedModel, tmp_path: Path) -> None:
    """Leading columns of arrays are not contiguous, but written arrays must be."""
    assert_same_model(load(model.leading(3).save(tmp_path / "m.snapspace")), model.leading(3))


def test_saving_twice_gives_identical_bytes(model: ReducedModel, tmp_path: Path) -> None:
    """So models can be compared by their hash; a loaded model saves the same bytes, too."""
    contents = {model.save(tmp_path / f"{i}.snapspace").read_bytes() for i in range(5)}
    contents.add(load(tmp_path / "0.snapspace").save(tmp_path / "again.snapspace").read_bytes())
    assert len(contents) == 1


def test_any_safetensors_reader_opens_it(model: ReducedModel, saved: Path) -> None:
    """Raw arrays and a header of JSON texts: nothing in it could be executed."""
    arrays = load_file(saved)
    assert set(arrays) == {
        "vertices",
        "tets",
        "handle_vertices",
        "handle_sizes",
        "basis",
        "eigenvalues",
        "quartic",
        "handle_K",
        "handle_L",
        "handle_S",
        "training_parameters",
        "training_coordinates",
    }
    assert {str(array.dtype) for array in arrays.values()} == {"float64", "float32", "int32"}
    assert arrays["basis"].dtype == np.float32
    np.testing.assert_array_equal(arrays["vertices"], model.problem.mesh.vertices)
    np.testing.assert_array_equal(arrays["basis"].T, model.subspace.basis)
    with safe_open(saved, framework="np") as file:
        header = file.metadata()
    own = {"format", "version", "kind", "problem", "provenance", "timings"}
    assert set(header) == own | {"checksum", "timings_checksum"}
    assert (header["format"], header["version"]) == ("snapspace-model", "4")
    assert header["kind"] == "posing"
    assert json.loads(header["problem"])["handles"] == ["foot", "tip"]
    timed = {"seconds": model.provenance["seconds"]}
    assert json.loads(header["provenance"]) | timed == model.provenance
    assert json.loads(header["timings"]) == {"entries": [[["seconds"], timed["seconds"]]]}


def test_arrays_are_aligned(saved: Path) -> None:
    """They begin at a multiple of eight bytes, so that other languages can map them into memory."""
    assert (8 + int.from_bytes(saved.read_bytes()[:8], "little")) % 8 == 0


def test_saving_returns_the_path(model: ReducedModel, tmp_path: Path) -> None:
    assert save_model(model, str(tmp_path / "m.snapspace")) == tmp_path / "m.snapspace"


@pytest.mark.parametrize("name", ["model.safetensors", "model", "model.snapspace.bak"])
def test_another_suffix_is_refused(model: ReducedModel, tmp_path: Path, name: str) -> None:
    with pytest.raises(ValueError, match=rf"{name}: a model file ends in \.snapspace"):
        model.save(tmp_path / name)
    assert list(tmp_path.iterdir()) == []
