"""Error estimators are saved with their model; files of models without one lack the arrays."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from safetensors.numpy import load_file

from snapspace import InterpolationModel, PosingModel, calibrate, load
from snapspace.model_file.container import read_container, write_container
from snapspace.model_file.error_estimator import DTYPES


@pytest.fixture(scope="module")
def models(posing_model: PosingModel, blending_model: InterpolationModel) -> dict[str, object]:
    return {
        "posing": calibrate(posing_model, samples=9, threads=1),
        "blending": calibrate(blending_model, samples=9, threads=1),
    }


@pytest.mark.parametrize("kind", ["posing", "blending"])
def test_a_loaded_model_gives_the_same_certificates(
    models: dict[str, PosingModel], kind: str, tmp_path: Path
) -> None:
    model = models[kind]
    loaded = load(model.save(tmp_path / "model.snapspace"))
    certificates = []
    for one in (model, loaded):
        session = one.session()
        session.set_parameters(
            one.problem.domain.from_unit(np.full((1, 12 if kind == "posing" else 2), 0.3))[0]
        )
        certificates.append(
            [session.certificate(thorough=thorough).upper_distance for thorough in (False, True)]
        )
    assert certificates[0] == certificates[1]


def test_models_without_an_estimator_have_no_such_arrays(
    posing_model: PosingModel, tmp_path: Path
) -> None:
    path = posing_model.save(tmp_path / "model.snapspace")
    assert not set(load_file(path)) & set(DTYPES)
    assert load(path).error_estimator is None


def test_files_of_earlier_calibrations_have_the_exponent_one(
    models: dict[str, PosingModel], tmp_path: Path
) -> None:
    """Their ratios are to the residual itself."""
    fitted = models["posing"].error_estimator
    assert fitted is not None
    model = replace(models["posing"], error_estimator=replace(fitted, exponent=1.7))
    path = model.save(tmp_path / "model.snapspace")
    after = load(path).error_estimator
    assert after is not None and after.exponent == 1.7
    arrays, header = read_container(path)
    del arrays["estimator_exponent"]
    write_container(path, arrays, header)
    earlier = load(path).error_estimator
    assert earlier is not None and earlier.exponent == 1.0


@pytest.mark.parametrize("name", DTYPES)
def test_a_file_with_an_incomplete_estimator_is_refused(
    models: dict[str, PosingModel], name: str, tmp_path: Path
) -> None:
    path = models["posing"].save(tmp_path / "model.snapspace")
    arrays, header = read_container(path)
    del arrays[name]
    write_container(path, arrays, header)
    with pytest.raises(ValueError, match=f"the array '{name}' is missing; build the model again"):
        load(path)


def test_a_damaged_estimator_is_refused(models: dict[str, PosingModel], tmp_path: Path) -> None:
    path = models["posing"].save(tmp_path / "model.snapspace")
    arrays, header = read_container(path)
    write_container(path, {**arrays, "estimator_weights": np.ones(1)}, header)
    with pytest.raises(ValueError, match="one positive weight per vertex"):
        load(path)
    write_container(path, {**arrays, "estimator_residual_ratios": np.full(9, -1.0)}, header)
    with pytest.raises(ValueError, match=r"positive ratios, .* calibrate"):
        load(path)
