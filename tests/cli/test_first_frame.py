"""A model is written and called built only after one of its frames was solved and is finite."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from snapspace import InterpolationModel, PosingModel, reduce
from snapspace.cli import accurate_pipeline, pipeline
from snapspace.cli.first_frame import check_first_frame
from snapspace.reduction import HandleQuadric

from .conftest import Run
from .files import write_problem
from .test_build_accuracy import neo_hookean


def broken(model: PosingModel) -> PosingModel:
    """The model with handle forces that are NaN."""
    L = np.full_like(model.handles.L, np.nan)
    return replace(model, handles=HandleQuadric(model.handles.K, L, model.handles.S))


def test_a_good_model_passes(
    posing_model: PosingModel,
    blending_model: InterpolationModel,
    blended_cubature_model: InterpolationModel,
    cubature_model: PosingModel,
) -> None:
    for model in (posing_model, blending_model, blended_cubature_model, cubature_model):
        check_first_frame(model)


def test_a_frame_that_is_not_finite_is_refused(posing_model: PosingModel) -> None:
    with pytest.raises(ValueError, match=r"the model is not written: its first frame, in 20 dim"):
        check_first_frame(broken(posing_model))


def test_samples_of_a_broken_model_are_kept_and_it_is_not_called_built(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"
    words = ("build", "--problem", problem, "--samples", 12, "--dimension", 4, "-o", path)

    def bad(*arguments: Any, **options: Any) -> PosingModel:
        return broken(reduce(*arguments, **options))

    with monkeypatch.context() as patch:
        patch.setattr(pipeline, "reduce", bad)
        patch.setattr(pipeline, "judged", lambda *_, **__: None)
        patch.setattr(pipeline, "with_estimates", lambda model, _: model)
        result = run(*words)
    assert result.code == 2
    assert "the model is not written: its first frame" in result.err.splitlines()[-1]
    assert "built" not in result.err
    assert not path.exists()
    assert "resuming: 12 of 12" in run(*words).err
    assert path.exists()


def test_models_made_to_a_target_error_are_checked_too(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file, path = neo_hookean(tmp_path), tmp_path / "m.snapspace"
    words = ("build", "--problem", file, "--target-error", 0.2, "-o", path)
    real = accurate_pipeline.accurate_model

    def bad(*arguments: Any, **options: Any) -> Any:
        built = real(*arguments, **options)
        return replace(built, model=broken(built.model))

    with monkeypatch.context() as patch:
        patch.setattr(accurate_pipeline, "accurate_model", bad)
        patch.setattr(accurate_pipeline, "judged", lambda *_, **__: None)
        result = run(*words)
    assert result.code == 2
    assert "the model is not written: its first frame" in result.err.splitlines()[-1]
    assert not path.exists()
    assert list(tmp_path.glob("*.partial-*"))
