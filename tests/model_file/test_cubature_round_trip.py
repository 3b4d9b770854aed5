"""Files of models with a cubature: the same bits come back, and there is no quartic."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from safetensors import safe_open

from snapspace import Cubature, PosingModel, load, reduce, snapshot_pca, solve_snapshots

from ..clustered import clustered_model
from ..snapshots.bars import parameters, posing_bar
from .test_bad_files import rewrite


@pytest.fixture(scope="module", params=["rows", "local rows"])
def model(request: pytest.FixtureRequest) -> PosingModel:
    problem = posing_bar()
    snapshots = solve_snapshots(problem, parameters(problem, 20), threads=1)
    subspace = snapshot_pca(snapshots, dimension=6)
    dense = reduce(problem, subspace, energy="cubature", snapshots=snapshots, tets=30)
    return dense if request.param == "rows" else clustered_model(dense, 5)


def test_nothing_is_lost(model: PosingModel, tmp_path: Path) -> None:
    other = load(model.save(tmp_path / "bar.snapspace"))
    assert isinstance(other, PosingModel)
    assert isinstance(other.elastic, Cubature)
    assert isinstance(model.elastic, Cubature)
    for name in ("tets", "weights", "rows"):
        np.testing.assert_array_equal(getattr(other.elastic, name), getattr(model.elastic, name))
    assert other.provenance == model.provenance
    here, there = model.session(), other.session()
    for w in parameters(model.problem, 3, seed=8):
        here.pose(w)
        there.pose(w)
        np.testing.assert_array_equal(here.vertices, there.vertices)


def test_the_file_names_its_kind_so_that_older_readers_refuse_it(
    model: PosingModel, tmp_path: Path
) -> None:
    path = model.save(tmp_path / "bar.snapspace")
    with safe_open(path, framework="np") as file:
        assert file.metadata()["kind"] == "posing-cubature"
        assert "quartic" not in file.keys()


@pytest.mark.parametrize("change", ["sizes", "count", "rank", "rows", "modes"])
def test_clusters_that_do_not_fit_are_refused(
    model: PosingModel, tmp_path: Path, change: str
) -> None:
    path = clustered_model(model, 5).save(tmp_path / "bar.snapspace")

    def altered(arrays: dict[str, Any], header: dict[str, str]) -> None:
        if change == "sizes":
            arrays["cubature_clusters"][0] += [-8, 0]
        elif change == "count":
            arrays["cubature_clusters"][-1, 0] = -1
        elif change == "rank":
            arrays["cubature_clusters"][-1, 1] += 1
        else:
            name = f"cubature_local_{change}"
            arrays[name] = arrays[name][:-1]

    rewrite(path, altered)
    with pytest.raises(ValueError, match="is inconsistent"):
        load(path)


@pytest.mark.parametrize("change", ["weight", "tet", "length"])
def test_a_cubature_that_does_not_fit_is_refused(
    model: PosingModel, tmp_path: Path, change: str
) -> None:
    path = model.save(tmp_path / "bar.snapspace")

    def altered(arrays: dict[str, Any], header: dict[str, str]) -> None:
        if change == "weight":
            arrays["cubature_weights"][2] = -1.0
        elif change == "tet":
            arrays["cubature_tets"][-1] = len(model.problem.mesh.tets)
        else:
            arrays["cubature_weights"] = arrays["cubature_weights"][:-1]

    rewrite(path, altered)
    with pytest.raises(ValueError, match="is inconsistent"):
        load(path)
