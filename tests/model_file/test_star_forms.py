"""Files of as-rigid-as-possible surfaces have what the stars leave of the energy."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from safetensors.numpy import load_file

from snapspace import ARAP, Cubature, InterpolationModel, PosingModel, ReducedModel, load
from snapspace.cubature import BlendedStars

from ..shells.strips import blended_strips, shell_model
from .test_bad_files import rewrite


@pytest.fixture(scope="module")
def posed() -> PosingModel:
    return shell_model(ARAP())


@pytest.fixture(scope="module")
def blended() -> InterpolationModel:
    return blended_strips()


def test_star_forms_are_those_of_the_mesh(
    posed: PosingModel, blended: InterpolationModel, tmp_path: Path
) -> None:
    other = load(posed.save(tmp_path / "posed.snapspace"))
    assert isinstance(other, PosingModel) and isinstance(other.elastic, Cubature)
    elastic = other.elastic
    made = Cubature.of_tets(other.problem, other.subspace, elastic.tets, elastic.weights)
    np.testing.assert_array_equal(elastic.remainder, made.remainder)

    again = load(blended.save(tmp_path / "blended.snapspace"))
    assert isinstance(again, InterpolationModel) and isinstance(again.blends, BlendedStars)
    assert isinstance(blended.blends, BlendedStars)
    blends = again.blends
    anew = BlendedStars.of_tets(again.problem, again.subspace, blends.tets, blends.weights)
    np.testing.assert_allclose(blends.forms, anew.forms, atol=1e-9 * np.abs(anew.forms).max())
    np.testing.assert_array_equal(
        load_file(tmp_path / "blended.snapspace")["stars_dirichlet"], blended.blends.dirichlet_forms
    )


@pytest.mark.parametrize("change", ["missing", "size", "type"])
@pytest.mark.parametrize("kind", ["posed", "blended", "range"])
def test_a_file_without_them_or_with_others_is_refused(
    posed: PosingModel, blended: InterpolationModel, tmp_path: Path, kind: str, change: str
) -> None:
    models: dict[str, tuple[ReducedModel, str]] = {
        "posed": (posed, "stars_remainder"),
        "blended": (blended, "stars_forms"),
        "range": (blended, "stars_dirichlet"),
    }
    model, name = models[kind]
    path = model.save(tmp_path / "strip.snapspace")

    def altered(arrays: dict[str, Any], header: dict[str, str]) -> None:
        array = arrays.pop(name)
        if change == "size":
            arrays[name] = np.ascontiguousarray(array[..., :-1])
        elif change == "type":
            arrays[name] = array.astype(np.float32)

    rewrite(path, altered)
    with pytest.raises(ValueError, match=f"{name}.*build"):
        load(path)
